/// Reads the options of `basins` and makes its problem of them.
#include "basin_options.hpp"

#include "base/text.hpp"
#include "parameter_ranges.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

void BasinOptions::declare(Arguments& arguments) {
  model.declare(arguments);
  model.declare_state(arguments);
  arguments.text("--x", x, "VAR=A:B:COUNT", "the initial value across: a displacement or a velocity").required();
  arguments.text("--y", y, "VAR=A:B:COUNT", "the initial value upwards").required();
  analysis.declare(arguments);
  arguments.count("--threads", threads, 0, 1024, "0: all cores; the result is the same for any number (0)");
}

namespace {

void refuse_axes_in_state(const BasinOptions& options, const Sweep& x, const Sweep& y) {
  for (const std::string& part : split(options.model.state, ','))
    for (const auto& [axis, name] : {std::pair{"--x", x.name}, std::pair{"--y", y.name}})
      if (part.starts_with(name + "=")) throw InputError("--state: " + in_quotes(name) + " has the values of " + axis);
}

/// The start, whose numbers along the axes are replaced: the model's own, with them, may be behind a stop.
State start_beside(const ModelOptions& options, const ChosenModel& chosen, const Sweep& x, const Sweep& y) {
  for (const double of_x : {x.from, x.to})
    for (const double of_y : {y.from, y.to}) {
      ModelOptions there = options;
      there.state += (there.state.empty() ? "" : ",") + chart::state_words({{x.name, of_x}, {y.name, of_y}});
      try {
        return there.start(chosen);
      } catch (const InputError&) {
      }
    }
  return options.start(chosen);  // says why
}

}  // namespace

BasinWish basin_wish(const BasinOptions& options) {
  ChosenModel chosen = options.model.load();
  const Sweep x = parse_sweep(options.x, "--x"), y = parse_sweep(options.y, "--y");
  if (const double starts = static_cast<double>(x.count) * y.count; starts > 1e8)
    throw InputError("--x and --y give " + shown(starts) + " starts, more than the 1e8 that a plane may have");
  demand_period(affordable_system(chosen, options.analysis.work()).model());
  refuse_axes_in_state(options, x, y);
  const State start = start_beside(options.model, chosen, x, y);
  try {
    chart::StartPlane plane = chart::starts_over(chosen.definition, chosen.overrides, start, x.name,
                                                 {x.from, x.to, x.count}, y.name, {y.from, y.to, y.count});
    options.analysis.apply(chosen.model, plane.problem);
    plane.problem.threads = static_cast<int>(options.threads);
    plane.stops = options.analysis.stops.names;
    return {std::move(chosen), std::move(plane)};
  } catch (const InputError& error) {  // its arguments are those of the options
    throw InputError((error.message().starts_with("--") ? "" : "--") + error.message());
  }
}

}  // namespace slapstick::app
