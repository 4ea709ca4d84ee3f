/// slapstick continue MODEL --param NAME --range A:B
#include <cmath>
#include <cstdio>
#include <limits>

#include "axis_text.hpp"
#include "axis_units.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "branch_figure.hpp"
#include "branch_json.hpp"
#include "branch_table.hpp"
#include "measured_diagram.hpp"
#include "orbit_choice.hpp"
#include "orbit_options.hpp"
#include "orbit_tables.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "settled_motions.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "slapstick/section/stop_choice.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  OrbitOptions orbit;
  std::string parameter, range, y, out, plot, plot_size, plot_range;
  std::vector<std::string> sensitivity;
  long long points = 2000, branches = 1, diagram = 0;
  double step = 0.01;
  bool table = false, stay = false, all_changes = false, progress = false;
};

/// What the JSON of a branch is made from.
struct Described {
  const orbit::Problem& problem;
  const System& system;
  std::vector<Wanted> wanted = {};  ///< --y
};

/// "values" of an orbit: what --y asks for, over its cycle.
Json values_json(const Described& with, const orbit::Orbit& orbit) {
  std::vector<Quantity> of;
  for (const Wanted& one : with.wanted) of.push_back(one.quantity);
  const Measured found = measure(with.problem, orbit, of);
  Json values = Json::object();
  for (std::size_t k = 0; k < of.size(); ++k)
    values.set(of[k].name + ":" + with.wanted[k].statistic, statistic(found.of[k], with.wanted[k].statistic));
  return values;
}

/// A branch and what is known of its special points besides.
struct Whole {
  const orbit::Branch& branch;
  const Sensitivities& rates;
  const std::vector<std::vector<std::size_t>>& images;
};

/// Adds the keys of one object to another, those of a check by the simulator only where it was made.
void add_keys(Json& json, const Json& of, bool checked) {
  for (const auto& [key, value] : std::get<Json::Object>(of.value()))
    if (checked || (key != "is_motion" && key != "why")) json.set(key, value);
}

Json on_branch_json(const Described& with, const orbit::Solution& solution) {
  Json json = Json::object();
  json.set("param", solution.orbit.parameter());
  add_keys(json, point_json(with.problem, solution, with.system.model()), true);
  if (!with.wanted.empty()) json.set("values", values_json(with, solution.orbit));
  return json;
}

Json special_json(const Described& with, const Whole& whole, std::size_t which) {
  const auto& [branch, sensitivities, images] = whole;
  const orbit::SpecialPoint& special = branch.special[which];
  Json json = Json::object();
  json.set("type", std::string(name(special.type))).set("param", special.value).set("error", special.error);
  add_keys(json, point_json(with.problem, special.solution, with.system.model()), false);
  json.set("what", orbit::what_happens(special, with.system) + image_words(images[which]));
  if (!with.wanted.empty()) json.set("values", values_json(with, special.solution.orbit));
  if (const std::string outcome = orbit::what_becomes(special); !outcome.empty()) json.set("outcome", outcome);
  add_keys(json, typed_json(special, with.system), true);
  if (const auto classes = orbit::classes_around(branch, special))
    json.set("class_before", classes->first).set("class_behind", classes->second);
  if (special.type == orbit::SpecialType::NS) json.set("rotation", special.rotation);
  if (special.normal_form.coefficient)
    json.set("coefficient", *special.normal_form.coefficient).set("coefficient_error", special.normal_form.error);
  if (const std::string verdict = orbit::sentence(special.normal_form); !verdict.empty())
    json.set("normal_form", verdict).set("verdict", std::string(name(special.normal_form.verdict)));
  if (!sensitivities.names.empty()) {
    Json sensitivity = Json::object(), known = Json::object();
    for (std::size_t j = 0; j < sensitivities.names.size(); ++j) {
      const orbit::Sensitivity& rate = sensitivities.rates[which][j];
      sensitivity.set(sensitivities.names[j], std::isfinite(rate.value) ? Json(rate.value) : Json());
      known.set(sensitivities.names[j], std::string(name(rate.known)));
    }
    json.set("sensitivity", std::move(sensitivity)).set("sensitivity_known", std::move(known));
  }
  return json;
}

orbit::ContinuationOptions continuation(const Options& options, const ParameterRange& range,
                                        const std::atomic<bool>& stop) {
  orbit::ContinuationOptions how;
  how.from = range.from;
  how.to = range.to;
  how.most_points = static_cast<int>(options.points);
  how.step = 0.5 * options.step;
  how.longest_step = options.step;
  how.through_changes = !options.stay;
  how.stop = &stop;
  return how;
}

/// Of each special point by each parameter alone: a group and one of its members may both be asked for.
Sensitivities sensitivities(const orbit::Branch& branch, const ChosenModel& chosen, const Options& options,
                            double range) {
  Sensitivities all{options.sensitivity, {}};
  if (all.names.empty()) return all;
  for (const orbit::SpecialPoint& point : branch.special) {
    std::vector<orbit::Sensitivity> rates;
    for (const std::string& other : all.names) {
      const std::vector<double> values = {point.value, present_value(chosen, "--sensitivity", other)};
      orbit::Sensitivity rate{std::numeric_limits<double>::quiet_NaN(), orbit::Known::not_solved};
      try {
        const Family family = chosen.definition.family({options.parameter, other}, chosen.overrides);
        rate = orbit::sensitivities(family, values, point, range).front();
      } catch (const NumericalError&) {  // the equations are singular there
      }
      rates.push_back(rate);
    }
    all.rates.push_back(std::move(rates));
  }
  return all;
}

Json branch_json(const Described& with, const Whole& whole) {
  const orbit::Branch& branch = whole.branch;
  Json json = Json::object(), points = Json::list(), special = Json::list();
  for (const orbit::Solution& point : branch.points) points.push(on_branch_json(with, point));
  for (std::size_t i = 0; i < branch.special.size(); ++i) special.push(special_json(with, whole, i));
  json.set("points", std::move(points)).set("special", std::move(special)).set("cascades", cascades_json(branch));
  json.set("ended", orbit::sentence(branch));
  json.set("ends", Json::object().set("down", end_json(branch, branch.down)).set("up", end_json(branch, branch.up)));
  return json;
}

/// What can be known to be wrong before the work.
void check(const Options& options, const ChosenModel& chosen) {
  if (options.diagram == 1) throw InputError("--diagram: a range has two ends; 1 is too few values");
  for (const std::string& name : options.sensitivity) {
    (void)present_value(chosen, "--sensitivity", name);
    if (name == options.parameter)
      throw InputError("--sensitivity: " + in_quotes(name) + " is the parameter of --param");
  }
}

Json birth_json(const Birth& birth) {
  return Json::object()
      .set("branch", static_cast<long long>(birth.branch) + 1)
      .set("type", std::string(name(birth.type)))
      .set("param", birth.value);
}

void write(Output& out, const std::vector<orbit::Branch>& branches, const Lineage& lineage, const ChosenModel& chosen,
           const Described& with, const Options& options) {
  std::vector<Sensitivities> rates;
  const ParameterRange range = parse_range("--range", options.range);
  for (const orbit::Branch& branch : branches)
    rates.push_back(sensitivities(branch, chosen, options, range.to - range.from));
  if (options.table) {
    const Followed in{options.parameter, range, &with.system, options.all_changes};
    out.write(branch_table(branches, in, rates, lineage));
  } else {
    Json json = branch_json(with, {branches.front(), rates.front(), lineage.images.front()});
    json.set("model", chosen.model.name).set("parameter", options.parameter);
    Json others = Json::list();
    for (std::size_t i = 1; i < branches.size(); ++i) {
      Json branch = branch_json(with, {branches[i], rates[i], lineage.images[i]});
      if (lineage.births[i]) branch.set("born_at", birth_json(*lineage.births[i]));
      others.push(std::move(branch));
    }
    if (branches.size() > 1) json.set("born", std::move(others));
    out.write(json.dump() + "\n");
  }
  out.commit();
}

/// What --y asks for, as columns.
MoreColumns more_columns(const orbit::Problem& problem, const std::vector<Wanted>& wanted) {
  MoreColumns more;
  std::vector<Quantity> of;
  for (const Wanted& one : wanted) {
    more.names.push_back(one.quantity.name + ":" + one.statistic);
    of.push_back(one.quantity);
  }
  if (wanted.empty()) return more;
  more.values = [&problem, wanted, of](const orbit::Solution& solution) {
    const Measured found = measure(problem, solution.orbit, of);
    std::vector<double> values;
    for (std::size_t k = 0; k < wanted.size(); ++k) values.push_back(statistic(found.of[k], wanted[k].statistic));
    return values;
  };
  return more;
}

/// The picture, over the motions that settle if --diagram asks for them.
void draw(const Plot& plot, const std::vector<orbit::Branch>& branches, const ChosenModel& chosen,
          const orbit::Problem& problem, const Options& options, const std::atomic<bool>& stop) {
  const auto nearest = [&](double value) {  // the state of the orbit of the branch that is nearest to a value
    const auto& points = branches.front().points;
    const auto off = [&](const orbit::Solution& point) { return std::abs(point.orbit.parameter() - value); };
    return orbit::at_phase_zero(problem, ranges::min_element(points, {}, off)->orbit);
  };
  const ParameterRange range = parse_range("--range", options.range);
  SettledMotions settled;
  if (options.diagram > 0)
    settled = settled_motions(
        chosen, options.model, options.parameter,
        {range, static_cast<int>(options.diagram), static_cast<int>(options.orbit.transient), options.progress},
        nearest, stop);
  if (settled.failed > 0)
    std::fprintf(stderr, "slapstick: %ld values of --diagram failed and are left out, first: %s\n", settled.failed,
                 settled.failure.c_str());
  const AxisUnits units(chosen.definition, chosen.model);
  BranchAxes axes{parameter_axis(chosen.definition, options.parameter), range, units.speed(stop_contacts(chosen.model)),
                  units.displacement(0, ground)};
  if (!options.plot_range.empty()) {
    const std::size_t comma = options.plot_range.find(',');
    axes.range = parse_range("--plot-range", options.plot_range.substr(0, comma));
    if (comma != std::string::npos) axes.y_range = parse_range("--plot-range", options.plot_range.substr(comma + 1));
  }
  if (!options.y.empty()) {
    const Wanted shown = parse_statistics("--y", options.y, chosen).front();
    axes.y_label = statistic_axis(shown);
    axes.y = [&problem, shown](const orbit::Solution& solution) {
      return statistic(measure(problem, solution.orbit, {shown.quantity}).of.front(), shown.statistic);
    };
  }
  plot.write(branch_figure(branches, axes, problem, settled));
}

int run(const Options& options, const Context& context) {
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  for (const char* ending : {".json", ".npz", ".h5", ".hdf5"})
    if (options.table && options.out.ends_with(ending))
      throw InputError(
          "--out: " + in_quotes(options.out) +
          " names another format than the text that --table asks for: leave --table out, or end the name in .txt");
  const bool file = is_table_file(options.out) && !options.table;
  if (file) const AtomicFile writable(options.out);  // goes away without a trace
  Output out(file ? "" : options.out);
  const Plot plot(options.plot, options.plot_size);
  const ChosenModel chosen = options.model.load();
  const ParameterRange range = parse_range("--range", options.range);
  const double value = value_inside(chosen, "--param", options.parameter, range);
  check(options, chosen);
  std::vector<Wanted> wanted;
  if (!options.y.empty()) wanted = parse_statistics("--y", options.y, chosen);
  const State start = options.model.start(chosen);
  const System system = affordable_system(chosen, {static_cast<double>(options.orbit.transient) + 1.0, "--transient"});
  const auto problem = orbit::pose(chosen.definition.family({options.parameter}, chosen.overrides), {value});
  const orbit::Solution first = *find_orbit(*problem, system, start, options.orbit, context.stop).orbit;
  Progress progress("points at most", 2.0 * static_cast<double>(options.points), options.progress);
  orbit::ContinuationOptions how = continuation(options, range, context.stop);
  how.progress = [&](double, long points) { progress.update(static_cast<double>(points)); };
  std::vector<orbit::Branch> branches = {orbit::follow(*problem, first.orbit, how)};
  const Lineage lineage = follow_born(*problem, branches, static_cast<std::size_t>(options.branches), how);
  if (file)
    write_branches(options.out, branches, options.parameter, *problem, chosen, more_columns(*problem, wanted));
  else
    write(out, branches, lineage, chosen, {*problem, system, std::move(wanted)}, options);
  if (plot.wanted()) draw(plot, branches, chosen, *problem, options, context.stop);
  if (context.stop.load()) return interrupted;
  const auto failed = ranges::find_if(branches, &orbit::Branch::failed);
  if (failed == branches.end()) return done;
  const std::string which = branches.size() > 1 ? "branch " + std::to_string(failed - branches.begin() + 1) + ": " : "";
  throw NumericalError("continue: " + which + orbit::sentence(*failed) + "; the points so far are written");
}

}  // namespace

Action add_continue(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  options->orbit.declare(arguments);
  arguments.text("--param", options->parameter, "NAME", "the parameter, or group of them, to continue in").required();
  arguments
      .text("--range", options->range, "A:B",
            "its range; the branch is followed both ways from the value of the first orbit")
      .required();
  arguments.number("--step", options->step, "S", "longest step along the branch, as a part of the range (0.01)",
                   {.least = 0.0, .most = 0.2, .above = true});
  arguments.count("--points", options->points, 1, 1'000'000, "most points each way (2000)");
  arguments.count("--branches", options->branches, 1, 100,
                  "follow the branches that are born at special points too, up to N in all (1)");
  arguments.flag("--same-events", options->stay, "end the branch where its sequence of events changes");
  arguments.repeated("--sensitivity", options->sensitivity, "NAME",
                     "give d param / d NAME of each special point; may be repeated");
  arguments.flag("--table", options->table, "write a table instead of JSON");
  arguments.flag("--all-changes", options->all_changes,
                 "with --table: a row for every change of a cascade towards a chatter, instead of one for all");
  arguments
      .text("--y", options->y, "Q:STAT,..",
            "statistics of every orbit's cycle, as `measure` gives them; --plot draws the first")
      .without({"--table"});
  arguments.text("--plot", options->plot, "F.png", "draw impact speeds along the branches (.png, .pdf or .svg)");
  arguments
      .count("--diagram", options->diagram, 0, 100'000,
             "draw the motions that settle at N values beneath, as `diagram` finds them (0)")
      .with({"--plot"})
      .without({"--y"});
  arguments.text("--out", options->out, "FILE",
                 "write the result there, or the orbits as a table (.csv, .npz, .h5), instead of to standard output");
  declare_plot_size(arguments, options->plot_size);
  arguments
      .text("--plot-range", options->plot_range, "A:B[,C:D]",
            "of the picture: the parameter, and the height (all that --range says, and all that there is)")
      .with({"--plot"});
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "Special points: LP fold; PD period doubling; NS torus; BP branches cross; GR a stop is grazed; SL stick gained "
      "or lost;\n"
      "CH complete chatter begins or ends; CO two events meet. docs/explanation/continuation.md says how they are "
      "found.\n"
      "  slapstick continue vibro-impact --set omega=2.2 --orbit 1-1 --param omega --range 1:4 --table");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
