/// slapstick's own runs. A System is compiled once, as every analysis uses it, except in `run_system`.
#include <chrono>
#include <thread>

#include "flow/compiled_system.hpp"
#include "runs.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::bench {
namespace {

const State start = {-0.5, 0.0, 0.0, 0.0};

Model paper_model(double omega) {
  static const ModelDefinition definition = load_model("vibro-impact");
  return definition.build({{"omega", omega}});
}

void run_to(Motion& motion, std::int64_t end) {
  while (motion.advance({end, 0.0}) == Outcome::event) {
  }
}

Model chain(int coordinates, int contacts) {
  Model model;
  model.name = "chain";
  model.omega = 1.3;
  for (int i = 0; i < coordinates; ++i) {
    const int before = i == 0 ? ground : i - 1;
    model.coordinates.push_back({"x" + std::to_string(i + 1), 1.0 + 0.02 * i});
    model.springs.push_back({i, before, 4.0 + 0.05 * i});
    model.dampers.push_back({i, before, 0.1});
  }
  model.forces.push_back({coordinates - 1, 1, 1.0, 0.0});
  model.forces.push_back({coordinates / 2, 1, 0.5, 1.0});
  for (int k = 0; k < contacts; ++k) {
    const int i = (k + 1) * coordinates / (contacts + 1);
    if (k % 2 == 1)
      model.stops.push_back({"stop" + std::to_string(k), i, ground, 0.3, 0.7});
    else
      model.frictions.push_back({"pad" + std::to_string(k), i, ground, 0.0, 0.2, 0.15});
  }
  return model;
}

Answer answer(double cpu, const Counters& from, const Counters& to) {
  return {{"cpu", cpu},
          {"impacts", static_cast<double>(to.impacts - from.impacts)},
          {"events", static_cast<double>(to.events - from.events)},
          {"windows", static_cast<double>(to.windows - from.windows)},
          {"evaluations", static_cast<double>(to.evaluations - from.evaluations)}};
}

/// From `begin` on, `repeats` times.
Answer repeated(const Motion& begin, std::int64_t end, int repeats) {
  Motion motion = begin;
  const double begun = cpu_time();
  for (int k = 0; k < repeats; ++k) {
    motion = begin;
    run_to(motion, end);
  }
  return answer((cpu_time() - begun) / repeats, begin.counters(), motion.counters());
}

}  // namespace

Answer run_slapstick(const Words& words) {
  const System system(paper_model(std::stod(words.at(1))));
  Motion begin(system, start);
  Motion met = begin;  // its modes are built before the clock runs
  run_to(met, std::stoi(words.at(2)));
  return repeated(begin, std::stoi(words.at(2)), std::stoi(words.at(3)));
}

Answer run_chain(const Words& words) {
  constexpr std::int64_t settled = 200;
  const System system(chain(std::stoi(words.at(1)), std::stoi(words.at(2))));
  const std::int64_t end = settled + std::stoi(words.at(3));
  Motion begin(system, State(2 * system.model().coordinates.size(), 0.0));
  run_to(begin, settled);
  Motion met = begin;
  run_to(met, end);
  return repeated(begin, end, std::stoi(words.at(4)));
}

Answer run_system(const Words& words) {
  const Model model = paper_model(std::stod(words.at(1)));
  const int repeats = std::stoi(words.at(2));
  std::vector<ModeId> met;
  {
    const System system(model);
    Motion motion(system, start);
    run_to(motion, 50);
    for (ModeId id = 0; id < system.mode_count(); ++id)
      if (system.compiled().known_mode(id) != nullptr) met.push_back(id);
  }
  const double begun = cpu_time();
  for (int k = 0; k < repeats; ++k) const System system(model);
  const double alone = cpu_time();
  for (int k = 0; k < repeats; ++k) {
    const System system(model);
    for (const ModeId id : met) (void)system.compiled().mode(id);
  }
  return {{"cpu", (alone - begun) / repeats},
          {"with_modes", (cpu_time() - alone) / repeats},
          {"modes", static_cast<double>(met.size())}};
}

sweep::BatchProblem lanes_of_starts(double omega, int periods) {
  sweep::BatchProblem problem;
  problem.threads = 1;
  problem.plan.periods = periods;
  problem.count = 64;
  problem.model_at = [model = paper_model(omega)](std::size_t) { return model; };
  problem.start_at = [](std::size_t i) { return State{start[0] - 0.001 * static_cast<double>(i), 0.0, 0.0, 0.0}; };
  return problem;
}

sweep::BatchProblem lanes_of_chart(int rows, int periods) {
  sweep::BatchProblem problem;
  problem.threads = 1;
  problem.plan.periods = periods;
  problem.count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows);
  problem.model_at = [rows, definition = load_model("vibro-impact")](std::size_t i) {
    const auto k = static_cast<int>(i);
    return definition.build(
        {{"omega", 1.0 + 5.0 * (k % rows) / (rows - 1)}, {"friction", 0.05 + 0.25 * (k / rows) / (rows - 1)}});
  };
  problem.start_at = [](std::size_t) { return start; };
  return problem;
}

namespace {

Answer run_lanes_of(const sweep::BatchProblem& problem) {
  const double begun = cpu_time();
  const auto before = std::chrono::steady_clock::now();
  const sweep::Batch batch = run_batch(problem);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - before;
  const double cpu = cpu_time() - begun;
  double impacts = 0.0;
  for (const BatchRun& run : batch.runs) impacts += static_cast<double>(run.impacts);
  return {{"cpu", cpu},
          {"wall", wall.count()},
          {"trajectories", static_cast<double>(problem.count)},
          {"impacts", impacts},
          {"lane_steps", static_cast<double>(batch.lane_steps)}};
}

}  // namespace

Answer run_lanes(const Words& words) {
  return run_lanes_of(lanes_of_starts(std::stod(words.at(1)), std::stoi(words.at(2))));
}

Answer run_chart(const Words& words) {
  sweep::BatchProblem problem = lanes_of_chart(std::stoi(words.at(1)), std::stoi(words.at(2)));
  problem.threads = std::stoi(words.at(3));
  problem.plan.exponent = words.at(4) == "1";
  return run_lanes_of(problem);
}

Answer run_threads(const Words& words) {
  const int threads = std::stoi(words.at(1)), periods = std::stoi(words.at(3));
  const System system(paper_model(std::stod(words.at(2))));
  Motion begin(system, start);
  Motion met = begin;
  run_to(met, periods);
  const double begun = cpu_time();
  const auto before = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> all;
    for (int k = 0; k < threads; ++k)
      all.emplace_back([&begin, periods] {
        Motion motion = begin;
        run_to(motion, periods);
      });
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - before;
  return {{"cpu", cpu_time() - begun}, {"wall", wall.count()}, {"trajectories", static_cast<double>(threads)}};
}

}  // namespace slapstick::bench
