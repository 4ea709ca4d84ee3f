/// Runs the motions that settle over a range of a parameter, for the background of a branch.
#include "settled_motions.hpp"

#include <vector>

#include "branch_colours.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "slapstick/sweep/parallel.hpp"

namespace slapstick::app {
namespace {

constexpr int recorded = 60;        ///< impacts, or periods, at each value
constexpr int most_periods = 1000;  ///< in which these impacts may happen

struct Places {
  std::vector<double> x;
  std::string failure;
};

/// The first coordinate at each event of a motion after its transient.
Places places_of(const System& system, const State& start, int transient, const std::atomic<bool>& stop) {
  Places found;
  try {
    Motion motion(system, start);
    (void)run_to(motion, {transient, 0.0}, &stop, [] {});
    (void)run_to(motion, {transient + recorded, 0.0}, &stop, [&] {
      if (motion.event().kind != EventKind::graze) found.x.push_back(motion.before().front());
    });
  } catch (const NumericalError& error) {
    found.failure = error.what();
  }
  return found;
}

void add(SettledMotions& all, double x, double y) {
  all.cloud.x.push_back(x);
  all.cloud.y.push_back(y);
}

void note(SettledMotions& all, const std::string& failure) {
  if (all.failed++ == 0) all.failure = failure;
}

/// How a parameter's value makes a model and its start.
struct Values {
  const ChosenModel& chosen;
  const ModelOptions& options;
  const std::string& parameter;
  const std::function<State(double value)>& instead;
  [[nodiscard]] Model model(double value) const {
    Overrides values = chosen.overrides;
    values[parameter] = value;
    return chosen.definition.build(values);
  }
  [[nodiscard]] State start(double value) const {
    try {
      const State own = options.start(chosen, {{parameter, value}});
      validate(model(value), own);
      return own;
    } catch (const InputError&) {
      return instead(value);
    }
  }
};

void add_speeds(const Values& values, const SettledRange& at, const std::atomic<bool>& stop, SettledMotions& all) {
  all.speeds = true;
  Progress progress("values", 2.0 * at.count, at.show_progress);
  sweep::DiagramProblem problem;
  problem.model_at = [&](double value) { return values.model(value); };
  problem.start_at = [&](double value) { return values.start(value); };
  problem.from = at.range.from;
  problem.to = at.range.to;
  problem.count = at.count;
  problem.transient_periods = at.transient;
  problem.impacts = recorded;
  problem.most_periods = most_periods;
  problem.direction = sweep::Direction::both;
  problem.progress = [&](int done, int) { progress.update(done); };
  problem.cancel = &stop;
  for (const sweep::DiagramPoint& point : sweep::run_diagram(problem).points) {
    for (std::size_t i = 0; i < point.impacts.size(); ++i) add(all, point.parameter, point.impacts[i].w);
    if (!point.failure.empty()) note(all, point.failure);
  }
}

void add_places(const Values& values, const SettledRange& at, const std::atomic<bool>& stop, SettledMotions& all) {
  std::vector<Places> places(static_cast<std::size_t>(at.count));
  const auto value_of = [&](int i) { return sweep::sweep_value(at.range.from, at.range.to, at.count, i); };
  const auto run = [&](int i) {
    const double value = value_of(i);
    places[static_cast<std::size_t>(i)] =
        places_of(System(values.model(value)), values.start(value), at.transient, stop);
  };
  sweep::for_each_index(at.count, 0, run, &stop);
  for (int i = 0; i < at.count; ++i) {
    const Places& found = places[static_cast<std::size_t>(i)];
    for (const double x : found.x) add(all, value_of(i), x);
    if (!found.failure.empty()) note(all, found.failure);
  }
}

}  // namespace

SettledMotions settled_motions(const ChosenModel& chosen, const ModelOptions& options, const std::string& parameter,
                               const SettledRange& at, const std::function<State(double value)>& instead,
                               const std::atomic<bool>& stop) {
  SettledMotions all;
  all.cloud.colour = settled_colour;
  all.cloud.diameter_mm = 0.3;
  const Values values{chosen, options, parameter, instead};
  if (stop_contacts(chosen.model).empty())
    add_places(values, at, stop, all);
  else
    add_speeds(values, at, stop, all);
  return all;
}

}  // namespace slapstick::app
