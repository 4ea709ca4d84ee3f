/// A chain of masses on dampers and springs, every odd contact a stop, every even one friction against ground: what many contacts cost.
#include <benchmark/benchmark.h>

#include <cstdio>

#include "runner.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::bench {
namespace {

constexpr int settled = 200, measured = 1000;  ///< forcing periods

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

void run_chain(benchmark::State& state, int coordinates, int contacts) {
  const System system(chain(coordinates, contacts));
  const auto run = [](Motion& motion, int end) {
    while (motion.advance({end, 0.0}) == Outcome::event) {
    }
  };
  Motion start(system, State(static_cast<std::size_t>(2 * coordinates), 0.0));
  run(start, settled);
  long events = 0;
  for ([[maybe_unused]] auto _ : state) {
    Motion motion = start;
    run(motion, settled + measured);
    events = motion.counters().events - start.counters().events;
  }
  using benchmark::Counter;
  state.counters["us_per_period"] = Counter(measured * 1e-6, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["events_per_period"] = static_cast<double>(events) / measured;
}

}  // namespace

void register_chains() {
  for (const auto& [coordinates, contacts] : {std::pair{2, 2}, {8, 4}, {32, 8}}) {
    char title[64];
    std::snprintf(title, sizeof title, "chain/coordinates:%d/contacts:%d", coordinates, contacts);
    benchmark::RegisterBenchmark(title, [=](benchmark::State& state) {
      run_chain(state, coordinates, contacts);
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace slapstick::bench
