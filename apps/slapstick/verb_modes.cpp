/// slapstick modes MODEL
#include <cmath>
#include <complex>
#include <cstdio>

#include "axis_text.hpp"
#include "axis_units.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  std::string stuck, closed, sweep, out, plot, plot_size;
};

/// The modes at one value of a sweep.
struct Row {
  double value = 0.0;
  std::vector<NaturalMode> modes;
};

std::vector<std::string> names_of(const std::string& text) {
  return text.empty() ? std::vector<std::string>{} : split(text, ',');
}

/// What `read` says, or its refusal with the argument's name.
template <class Read>
auto named(const char* argument, const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(std::string(argument) + ": " + error.what());
  }
}

std::vector<NaturalMode> modes_at(const Options& options, const ChosenModel& chosen, const Overrides& more) {
  Overrides values = chosen.overrides;
  for (const auto& [name, value] : more) values[name] = value;
  const System system(chosen.definition.build(values));
  const State start = options.model.start(chosen, more);
  static_cast<void>(sliding_states(system, start));
  const auto closed = names_of(options.closed), stuck = names_of(options.stuck);
  static_cast<void>(named("--closed", [&] { return sliding_states(system, start, {}, closed); }));
  return natural_modes(system, named("--stuck", [&] { return sliding_states(system, start, stuck, closed); }));
}

std::vector<Row> rows_of(const Options& options, const ChosenModel& chosen, const Sweep& sweep,
                         const std::atomic<bool>& stop) {
  if (sweep.name.empty()) return {{0.0, modes_at(options, chosen, {})}};
  if (chosen.overrides.contains(sweep.name))
    throw InputError("--sweep: " + in_quotes(sweep.name) + " is given by --set too");
  std::vector<Row> rows;
  for (int i = 0; i < sweep.count && !stop.load(); ++i) {
    const double value = sweep::sweep_value(sweep.from, sweep.to, sweep.count, i);
    try {
      rows.push_back({value, modes_at(options, chosen, {{sweep.name, value}})});
    } catch (const InputError& error) {
      throw InputError("--sweep " + sweep.name + "=" + shown(value) + ": " + error.message());
    }
  }
  return rows;
}

/// Says what is easily taken for a machine that is stable: friction without its normal force, and nothing that moves.
void say(const Options& options, const ChosenModel& chosen, const std::vector<Row>& rows) {
  const System system(chosen.definition.build(chosen.overrides));
  const Model& model = system.model();
  const mode::ContactStates states =
      sliding_states(system, options.model.start(chosen), names_of(options.stuck), names_of(options.closed));
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const FrictionContact& friction = model.frictions[i];
    if (states.frictions[i] != mode::FrictionState::unloaded || !friction.normal) continue;
    const int pad = friction.normal->compliant_stop;
    const std::string advice =
        pad < 0 ? "at this --state"
                : "--closed " + model.compliant_stops[static_cast<std::size_t>(pad)].name + " makes it press";
    std::fprintf(stderr, "slapstick: friction '%s' has no normal force, and does nothing: %s\n", friction.name.c_str(),
                 advice.c_str());
  }
  if (ranges::all_of(rows, [](const Row& row) { return row.modes.empty(); }))
    std::fprintf(stderr, "slapstick: nothing can move with these contacts held: there are no modes\n");
}

TableFacts facts_of(const Options& options, const ChosenModel& chosen, const Sweep& sweep) {
  TableFacts facts = table_facts(chosen, sweep.name);
  for (const auto& [name, held] : {std::pair{"stuck", &options.stuck}, std::pair{"closed", &options.closed}})
    if (!held->empty()) facts.attributes.push_back({name, *held});
  for (const Coordinate& coordinate : chosen.model.coordinates) facts.units.erase(coordinate.name);  // of a shape
  if (const std::string time = facts.units["time"]; !time.empty()) {
    facts.units["frequency"] = "rad/" + time;
    facts.units["cycles"] = facts.units["decay"] = "1/" + time;
  }
  return facts;
}

/// A row for each mode: what it is, then of each coordinate the amplitude and the phase.
void write_table(const std::vector<Row>& rows, const Sweep& sweep, TableOutput& table) {
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.modes.size(); ++i) {
      const NaturalMode& mode = row.modes[i];
      if (!sweep.name.empty()) table.number(row.value);
      table.number(static_cast<double>(i + 1)).number(mode.frequency);
      table.number(mode.oscillates() ? mode.damping_ratio() : NAN).number(mode.decay).number(mode.cycles());
      for (const std::complex<double>& part : mode.shape) table.number(std::abs(part)).number(std::arg(part));
      table.end_row();
    }
  }
}

std::vector<std::string> columns_of(const Model& model, const Sweep& sweep) {
  std::vector<std::string> columns;
  if (!sweep.name.empty()) columns.push_back(sweep.name);
  columns.insert(columns.end(), {"mode", "frequency", "damping_ratio", "decay", "cycles"});
  for (const Coordinate& coordinate : model.coordinates) {
    columns.push_back(coordinate.name);
    columns.push_back(coordinate.name + ":phase");
  }
  return columns;
}

/// Frequencies above decays, over the parameter, in another colour where the motion grows.
/// What does not oscillate has no point above.
figure::Figure picture(const std::vector<Row>& rows, const ChosenModel& chosen, const Sweep& sweep) {
  figure::Points frequencies{.diameter_mm = 0.5}, decays = frequencies, growing = frequencies;
  growing.colour = figure::colours::vermillion;
  figure::Points squealing = growing;
  for (const Row& row : rows) {
    for (const NaturalMode& mode : row.modes) {
      figure::Points& of = mode.decay < 0.0 ? growing : decays;
      of.x.push_back(row.value);
      of.y.push_back(mode.decay);
      if (!mode.oscillates()) continue;
      figure::Points& above = mode.decay < 0.0 ? squealing : frequencies;
      above.x.push_back(row.value);
      above.y.push_back(mode.frequency);
    }
  }
  const std::string time = AxisUnits(chosen.definition, chosen.model).time();
  const auto per = [&](const char* unit) { return time.empty() ? std::string() : unit + ("/" + time); };
  const figure::Range reach{sweep.from, sweep.to};
  figure::Figure figure{.share_x = true};
  const std::string axis = parameter_axis(chosen.definition, sweep.name);
  figure.panels = {{.x_label = axis, .y_label = with_unit("frequency", per("rad")), .x_range = reach},
                   {.x_label = axis, .y_label = with_unit("decay", per("1")), .x_range = reach}};
  for (figure::Points* of : {&frequencies, &squealing})
    if (!of->x.empty()) figure.panels[0].points.push_back(std::move(*of));
  for (figure::Points* of : {&decays, &growing})
    if (!of->x.empty()) figure.panels[1].points.push_back(std::move(*of));
  figure.panels[1].marks.push_back({.y = 0.0});
  return figure;
}

int run(const Options& options, const Context& context) {
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  const ChosenModel chosen = options.model.load();
  const Sweep sweep = options.sweep.empty() ? Sweep{} : parse_sweep(options.sweep);
  const Plot plot(options.plot, options.plot_size);
  TableOutput table(options.out, columns_of(chosen.model, sweep), facts_of(options, chosen, sweep));
  const std::vector<Row> rows = rows_of(options, chosen, sweep, context.stop);
  const int status = context.stop.load() ? interrupted : done;
  write_table(rows, sweep, table);
  table.commit();
  say(options, chosen, rows);
  if (!plot.wanted()) return status;
  const bool empty = ranges::all_of(rows, [](const Row& row) { return row.modes.empty(); });
  return plot.write_or_say(empty ? figure::Figure{} : picture(rows, chosen, sweep), empty, status);
}

}  // namespace

Action add_modes(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  arguments.text("--stuck", options->stuck, "NAME,..", "friction contacts that stick; all others slide");
  arguments.text(
      "--closed", options->closed, "NAME,..",
      "stops that are closed: a rigid one holds its two sides together, a compliant one acts; all others are "
      "open");
  arguments.text("--sweep", options->sweep, "NAME=A:B:COUNT", "the modes over a parameter: rows for each value");
  arguments.text("--out", options->out, "FILE", "write the table there instead of to standard output");
  arguments.text("--plot", options->plot, "F.png", "frequencies and decays over the parameter").with({"--sweep"});
  declare_plot_size(arguments, options->plot_size);
  arguments.footer(
      "Natural frequencies, damping and shapes of the machine with these contacts held: eigenvalues lambda of its "
      "motions\n"
      "phi exp(lambda t). A negative decay is a motion that grows, as flutter of sliding friction.\n"
      "  slapstick modes vibro-impact --stuck friction");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
