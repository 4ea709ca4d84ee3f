/// slapstick diagram MODEL --sweep NAME=A:B:COUNT
#include <cstdio>
#include <limits>

#include "axis_text.hpp"
#include "axis_units.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "contact_clouds.hpp"
#include "diagram_store.hpp"
#include "fine_dots.hpp"
#include "inset_options.hpp"
#include "io/table.hpp"
#include "measured_diagram.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "stop_options.hpp"
#include "values_diagram.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

using sweep::Direction;

struct Options {
  ModelOptions model;
  StopOptions stops;
  InsetOptions insets;
  std::string sweep, direction = "up", start = "carry", y, at, out, plot, plot_size, store;
  static constexpr double not_given = std::numeric_limits<double>::infinity();
  double transient = not_given;
  long long impacts = 200, most_periods = 5000, periods = 0, threads = 0;
  bool resume = false, progress = false;

  /// What is computed, one way of many: without MODEL, --set and --threads.
  [[nodiscard]] std::vector<std::string> words() const {
    const Sweep of = parse_sweep(sweep);
    std::vector<std::string> all{
        "--sweep",     of.name + "=" + number_text(of.from) + ":" + number_text(of.to) + ":" + std::to_string(of.count),
        "--direction", direction,
        "--start",     start,
        "--y",         y,
        "--at",        at,
        "--state",     model.state};
    all.insert(all.end(), {"--transient", transient == not_given ? "500" : number_text(transient)});
    for (const auto& [name, value] : {std::pair{"--impacts", impacts},
                                      {"--most-periods", most_periods},
                                      {"--periods", periods == 0 ? 100 : periods}})
      all.insert(all.end(), {name, std::to_string(value)});
    for (const std::string& stop : stops.names) all.insert(all.end(), {"--stop", stop});
    return all;
  }
};

/// The model at one value; the same function for the check at both ends and for the sweep.
Overrides values_at(const ChosenModel& chosen, const Sweep& sweep, double value) {
  Overrides overrides = chosen.overrides;
  overrides[sweep.name] = value;
  return overrides;
}

/// The impacts are kept in memory until the end: about 100 bytes each.
void check_size(const Options& options, const Sweep& sweep) {
  constexpr double most = 1e8;
  const double rows = static_cast<double>(sweep.count) * static_cast<double>(options.impacts) *
                      (options.direction == "both" ? 2.0 : 1.0);
  if (rows > most)
    throw InputError("--sweep with --impacts " + std::to_string(options.impacts) + " may give " + shown(rows) +
                     " rows, more than the " + shown(most) + " that one run keeps; sweep it in parts");
}

/// What can be known to be wrong before hours of work.
void check_ends(const Options& options, const ChosenModel& chosen, const Sweep& sweep) {
  if (chosen.overrides.contains(sweep.name))
    throw InputError("--sweep: " + in_quotes(sweep.name) + " is given by --set too");
  if (options.y.empty() && stop_contacts(chosen.model).empty())
    throw InputError(
        "model " + in_quotes(chosen.model.name) +
        " has no stop, so a diagram has no impacts to show; `--y` shows statistics of quantities, and " +
        (chosen.model.forced() ? "`poincare --section stroboscopic` needs none" : "`simulate` needs none"));
  for (const double value : {sweep.from, sweep.to}) {
    try {
      const Work work{(options.transient == Options::not_given ? 500.0 : options.transient) + 1.0, "--transient"};
      const System system = affordable_system(chosen, work, {{sweep.name, value}});
      validate(system.model(), options.model.start(chosen, {{sweep.name, value}}));
    } catch (const InputError& error) {
      throw InputError("--sweep " + sweep.name + "=" + shown(value) + ": " + error.message());
    }
  }
}

sweep::DiagramProblem problem_of(const Options& options, const ChosenModel& chosen, const Sweep& sweep) {
  sweep::DiagramProblem problem;
  problem.model_at = [&chosen, sweep](double value) {
    return chosen.definition.build(values_at(chosen, sweep, value));
  };
  problem.start_at = [&options, &chosen, sweep](double value) {
    return options.model.start(chosen, {{sweep.name, value}});
  };
  if (options.y.empty() || !are_statistics(options.y)) problem.stops = options.stops.choice(chosen.model);
  problem.measured_periods = static_cast<double>(options.periods);
  problem.from = sweep.from;
  problem.to = sweep.to;
  problem.count = sweep.count;
  if (options.transient != Options::not_given) problem.transient_periods = options.transient;
  problem.impacts = static_cast<int>(options.impacts);
  problem.most_periods = static_cast<int>(options.most_periods);
  problem.direction = options.direction == "up"     ? Direction::up
                      : options.direction == "down" ? Direction::down
                                                    : Direction::both;
  problem.start = options.start == "carry" ? sweep::StartRule::carry : sweep::StartRule::reset;
  problem.threads = static_cast<int>(options.threads);
  return problem;
}

/// With several stops the last column says which one was hit. If every value has failed, no table is made.
void write_table(TableOutput& table, const sweep::Diagram& diagram, const Model& model) {
  for (const sweep::DiagramPoint& point : diagram.points) {
    for (std::size_t i = 0; i < point.impacts.size(); ++i) {
      const auto row = point.impacts[i];
      table.number(point.parameter).word(point.direction == Direction::up ? "up" : "down");
      table.number(row.w).number(row.flight).number(row.sliding).number(row.phase).numbers(row.state);
      if (several_stops(model)) table.word(stop_name(model, row.contact));
      table.end_row();
    }
  }
  if (ranges::any_of(diagram.points, [](const auto& point) { return point.failure.empty(); })) table.commit();
}

/// A cloud for each stop and direction, with points. Of two directions the first is thicker: where both agree it shows
/// as a rim around the second.
std::vector<figure::Points> clouds(const sweep::Diagram& diagram, const Model& model,
                                   const sweep::DiagramProblem& problem, bool flight) {
  DirectedClouds all(model, problem.stops, problem.direction == Direction::both);
  for (const sweep::DiagramPoint& point : diagram.points) {
    for (std::size_t i = 0; i < point.impacts.size(); ++i) {
      const auto row = point.impacts[i];
      all.add(row.contact, point.direction == Direction::up, point.parameter, flight ? row.flight : row.w);
    }
  }
  std::vector<figure::Points> points = all.points();
  constexpr double largest_mm = 0.5;
  make_dots_fine(points, largest_mm);
  return points;
}

figure::Figure picture(const sweep::Diagram& diagram, const Sweep& sweep, const ChosenModel& chosen,
                       const sweep::DiagramProblem& problem) {
  const Model& model = chosen.model;
  const AxisUnits units(chosen.definition, model);
  const std::string w = "w at " + contact_words(model, problem.stops);
  figure::Figure figure{.width_cm = 17.5, .share_x = true};
  for (const bool flight : {false, true}) {
    figure::Panel panel{.x_label = parameter_axis(chosen.definition, sweep.name),
                        .y_label = flight ? (model.forced() ? "flight / period" : with_unit("flight", units.time()))
                                          : with_unit(w, units.speed(chosen_stops(model, problem.stops))),
                        .x_range = figure::Range{sweep.from, sweep.to}};
    panel.points = clouds(diagram, model, problem, flight);
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// --inset of a diagram: known before the work, drawn after it.
class PanelInsets {
 public:
  /// @param shown  what is shown upwards in each panel
  PanelInsets(const InsetOptions& options, const Sweep& sweep, std::vector<std::string> shown)
      : shown_(std::move(shown)) {
    std::vector<NamedAxis> y;
    for (const std::string& name : shown_) y.push_back({name});
    insets_ = read_insets(options, {sweep.name, figure::Range{sweep.from, sweep.to}}, y);
  }
  [[nodiscard]] figure::Figure in(figure::Figure figure) const {
    add_insets(insets_, shown_, figure);
    return figure;
  }

 private:
  std::vector<std::string> shown_;
  std::vector<NamedInset> insets_;
};

/// "3 (up) and 1 (down)"
std::string per_direction(long up, long down) {
  std::string text = up > 0 ? std::to_string(up) + " (up)" : "";
  if (down > 0) text += (up > 0 ? " and " : "") + std::to_string(down) + " (down)";
  return text;
}

/// Says on standard error what a table cannot. @throws NumericalError if a value failed
void report(const sweep::Diagram& diagram, const Sweep& sweep, const std::string& noun, bool of_measures = false) {
  long notes = 0, failures = 0, empty[2] = {};
  const sweep::DiagramPoint *note = nullptr, *failure = nullptr, *without = nullptr;
  for (const sweep::DiagramPoint& point : diagram.points) {
    if (!point.note.empty() && notes++ == 0) note = &point;
    if (!point.failure.empty() && failures++ == 0) failure = &point;
    if (!point.done || !point.failure.empty() || point.impacts.size() > 0 || !point.values.empty() || of_measures)
      continue;
    if (without == nullptr) without = &point;
    ++empty[point.direction == Direction::up ? 0 : 1];
  }
  const auto at = [&](const sweep::DiagramPoint& point) { return sweep.name + " = " + shown(point.parameter); };
  if (!diagram.complete) {
    const auto finished = ranges::count_if(diagram.points, [](const auto& point) { return point.done; });
    std::fprintf(stderr, "slapstick: stopped after %ld of %zu values; the finished ones are written\n",
                 static_cast<long>(finished), diagram.points.size());
  }
  if (without != nullptr)
    std::fprintf(stderr, "slapstick: no %ss at %s of the values, first %s (see --most-periods)\n", noun.c_str(),
                 per_direction(empty[0], empty[1]).c_str(), at(*without).c_str());
  if (note != nullptr)
    std::fprintf(stderr, "slapstick: %ld values, first %s: %s\n", notes, at(*note).c_str(), note->note.c_str());
  if (failure != nullptr)
    throw NumericalError(std::to_string(failures) + " of " + std::to_string(diagram.points.size()) + " values failed" +
                         (failures < static_cast<long>(diagram.points.size()) ? " (the others are written)" : "") +
                         ", first " + at(*failure) + ": " + failure->failure);
}

sweep::Diagram run(sweep::DiagramProblem& problem, const Options& options, const ChosenModel& chosen,
                   const Context& context) {
  std::optional<DiagramStore> store;
  if (!options.store.empty()) {
    const int values = problem.count * (problem.direction == Direction::both ? 2 : 1);
    const StoreFacts facts = chart::run_facts("diagram", chosen.definition, chosen.overrides, options.words(), values,
                                              0, 1, problem.start == sweep::StartRule::reset ? "lanes" : "motion");
    store.emplace(open_store(options.store, facts, options.resume), problem);
  }
  Progress progress("values", problem.count * (problem.direction == Direction::both ? 2.0 : 1.0), options.progress);
  problem.progress = [&](int count, int) { progress.update(count); };
  problem.cancel = &context.stop;
  return sweep::run_diagram(problem);
}

/// --y: statistics instead of impacts.
int measured(const Options& options, const ChosenModel& chosen, const Sweep& sweep, const Context& context) {
  const MeasuredDiagram about(chosen, options.y, sweep);
  const PanelInsets insets(options.insets, sweep, about.shown());
  const Plot plot(options.plot, options.plot_size);
  TableOutput table(options.out, about.columns(), table_facts(chosen, sweep.name));
  sweep::DiagramProblem problem = problem_of(options, chosen, sweep);
  problem.of = about.of();
  const sweep::Diagram result = run(problem, options, chosen, context);
  about.write(result, table);
  const auto some = [](const sweep::DiagramPoint& point) { return !point.of.empty(); };
  const int status = plot.write_or_say(insets.in(about.figure(result)), ranges::none_of(result.points, some),
                                       result.complete ? done : interrupted);
  report(result, sweep, "", true);
  return status;
}

/// --y without a statistic: values at instants.
int values(const Options& options, const ChosenModel& chosen, const Sweep& sweep, const Context& context) {
  const ValuesDiagram about(chosen, options.y, options.at, sweep);
  const PanelInsets insets(options.insets, sweep, about.shown());
  const Plot plot(options.plot, options.plot_size);
  TableOutput table(options.out, about.columns(), table_facts(chosen, sweep.name));
  sweep::DiagramProblem problem = problem_of(options, chosen, sweep);
  about.complete(problem);
  const sweep::Diagram result = run(problem, options, chosen, context);
  about.write(result, table);
  const auto some = [](const sweep::DiagramPoint& point) { return !point.values.empty(); };
  const int status = plot.write_or_say(insets.in(about.figure(result)), ranges::none_of(result.points, some),
                                       result.complete ? done : interrupted);
  report(result, sweep, about.noun());
  return status;
}

int diagram(const Options& options, const Context& context) {
  const Sweep sweep = parse_sweep(options.sweep);
  check_size(options, sweep);
  const ChosenModel chosen = options.model.load();
  check_ends(options, chosen, sweep);
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add("--store", options.store);
  roles.add_plot(options.plot);
  if (!options.y.empty())
    return are_statistics(options.y) ? measured(options, chosen, sweep, context)
                                     : values(options, chosen, sweep, context);
  const PanelInsets insets(options.insets, sweep, {"w", "flight"});
  const Plot plot(options.plot, options.plot_size);
  std::vector<std::string> columns{sweep.name, "direction", "w", "flight", "sliding", "phase"};
  for (const std::string& name : state_names(chosen.model)) columns.push_back(name);
  if (several_stops(chosen.model)) columns.emplace_back("contact");
  TableOutput table(options.out, columns, table_facts(chosen, sweep.name));

  sweep::DiagramProblem problem = problem_of(options, chosen, sweep);
  const sweep::Diagram result = run(problem, options, chosen, context);
  write_table(table, result, chosen.model);
  bool any = false;
  for (const sweep::DiagramPoint& point : result.points) any = any || point.impacts.size() > 0;
  const int status =
      plot.write_or_say(insets.in(picture(result, sweep, chosen, problem)), !any, result.complete ? done : interrupted);
  report(result, sweep, contact_noun(chosen.model, problem.stops));
  return status;
}

/// Options that have no meaning together.
void check_words(const Options& options, const Arguments& arguments) {
  const bool statistics = !options.y.empty() && are_statistics(options.y);
  for (const char* name : {"--impacts", "--most-periods", "--stop", "--at"})
    if (statistics && arguments.given(name))
      throw InputError(std::string(name) + ": only for values at instants, and --y asks for statistics over --periods");
  if (!statistics && arguments.given("--periods"))
    throw InputError("--periods: only for statistics of --y, and --y names no statistic");
  if (options.start == "reset" && options.direction == "both")
    throw InputError("--direction both: with --start reset, up and down are the same; choose one, or --start carry");
}

/// --y and what belongs to it.
void declare_quantities(Arguments& arguments, Options& options) {
  arguments.text("--y", options.y, "Q[:STAT],..",
                 "instead of impacts statistics of quantities over --periods, as `measure` gives them; without STAT "
                 "values at the instants of --at");
  arguments
      .text("--at", options.at, "impact|period|EVENT",
            "without STAT: before every impact, at phase 0 of every period, or before every event as stick or "
            "stick:belt (impact; without stops period)")
      .with({"--y"});
  arguments
      .count("--periods", options.periods, 1, 1'000'000'000,
             "forcing periods that are measured (100; of a record all of it)")
      .with({"--y"});
}

}  // namespace

Action add_diagram(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  arguments.text("--sweep", options->sweep, "NAME=A:B:COUNT", "the parameter, its range and the number of values")
      .required();
  arguments.choice("--direction", options->direction, {"up", "down", "both"},
                   "in which the state is carried (up); both shows coexisting attractors");
  arguments.choice("--start", options->start, {"carry", "reset"},
                   "carry the state from value to value, or begin each anew (carry)");
  arguments.number("--transient", options->transient, "N",
                   "forcing periods at each value before recording (500; of a record none)",
                   {.least = 0.0, .most = 1e9});
  arguments.count("--impacts", options->impacts, 1, 1'000'000'000, "impacts to record at each value (200)");
  arguments.count("--most-periods", options->most_periods, 1, 1'000'000'000,
                  "end a recording here if impacts are rare (5000)");
  arguments.count("--threads", options->threads, 0, 1024, "0: all cores; the result is the same for any number (0)");
  declare_quantities(arguments, *options);
  options->stops.declare(arguments, "record the impacts of this stop only; may be repeated (all)");
  arguments.text("--store", options->store, "F.db", "write each value there as it is finished");
  arguments.flag("--resume", options->resume, "compute only what is not there yet").with({"--store"});
  arguments.text("--out", options->out, "F.csv",
                 "write the impacts there (.csv, .npz or .h5) instead of to standard output");
  arguments.text("--plot", options->plot, "F.png",
                 "diagrams of w and flight: .png, .pdf or .svg; its data and script lie beside it");
  declare_plot_size(arguments, options->plot_size);
  options->insets.declare(arguments);
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "Columns: the parameter, direction, w, flight, sliding, phase and the state just before each impact, with "
      "several stops "
      "also contact.\n"
      "A compliant stop takes part by its engagements. A value that fails is left out, named on standard error, and "
      "makes "
      "the\nexit status 3.\n"
      "Example:\n  slapstick diagram vibro-impact --sweep omega=4:6:1000 --direction both --plot diagram.png --out "
      "impacts.csv");
  return [options, &arguments](const Context& context) {
    check_words(*options, arguments);
    return diagram(*options, context);
  };
}

}  // namespace slapstick::app
