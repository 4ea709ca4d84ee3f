/// slapstick curve MODEL --from TYPE --params A,B

#include <array>
#include <memory>
#include <string_view>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "branch_json.hpp"
#include "curve_figure.hpp"
#include "orbit_choice.hpp"
#include "orbit_options.hpp"
#include "orbit_tables.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

constexpr std::array<std::string_view, 8> types = {"LP", "PD", "NS", "BP", "GR", "SL", "CH", "CO"};

struct Options {
  ModelOptions model;
  OrbitOptions orbit;
  std::vector<std::string> from;
  std::string parameters, out, plot, plot_size;
  std::vector<std::string> ranges;
  long long which = 1, points = 500;
  double step = 0.01;
  bool progress = false;
};

/// The K-th special point of the wanted type on the branch in the first parameter.
orbit::SpecialPoint special_point(const Options& options, const ChosenModel& chosen,
                                  const std::vector<std::string>& names, const ParameterRange& range,
                                  const std::string& type, const std::atomic<bool>& stop) {
  const State start = options.model.start(chosen);
  const double value = value_inside(chosen, "--params", names[0], range);
  const System system = affordable_system(chosen, {static_cast<double>(options.orbit.transient) + 1.0, "--transient"});
  const auto problem = orbit::pose(chosen.definition.family({names[0]}, chosen.overrides), {value});
  const orbit::Solution first = *find_orbit(*problem, system, start, options.orbit, stop).orbit;
  orbit::ContinuationOptions how;
  how.from = range.from;
  how.to = range.to;
  how.stop = &stop;
  const orbit::Branch branch = orbit::follow(*problem, first.orbit, how);
  std::string seen;
  long long count = 0;
  for (const orbit::SpecialPoint& special : branch.special) {
    seen += (seen.empty() ? "" : ", ") + std::string(name(special.type)) + " at " + shown(special.value);
    if (name(special.type) == type && ++count == options.which) return special;
  }
  throw NumericalError("curve: no " + type + (options.which > 1 ? " number " + std::to_string(options.which) : "") +
                       " on the branch of " + first.label + " in " + names[0] +
                       " (found: " + (seen.empty() ? "none" : seen) + "; " + orbit::sentence(branch) + ")");
}

Json curve_json(const orbit::Curve& curve, const std::vector<std::string>& names, const orbit::Problem& problem,
                const System& system) {
  const Model& model = system.model();
  Json points = Json::list(), met = Json::list(), json = Json::object();
  for (const orbit::CurvePoint& point : curve.points) {
    Json item = Json::object();
    for (std::size_t i = 0; i < 2; ++i) item.set(names[i], point.values[i]);
    const Json rest = point_json(problem, point.solution, model);
    for (const auto& [key, value] : std::get<Json::Object>(rest.value())) item.set(key, value);
    points.push(std::move(item));
  }
  for (const orbit::CurveEvent& event : curve.met) {
    Json item = Json::object();
    for (std::size_t i = 0; i < 2; ++i) item.set(names[i], event.values[i]);
    Json meetings = Json::list();
    for (const orbit::Meeting& one : event.met) meetings.push(meeting_json(curve, one, system));
    item.set("type", name(event.met.front())).set("what", orbit::sentence(curve, event, system));
    met.push(item.set("met", std::move(meetings)).set("after", event.after));
  }
  json.set("points", std::move(points)).set("met", std::move(met)).set("ended", orbit::sentence(curve, system));
  return json.set("ends", Json::object().set("down", end_json(curve.down)).set("up", end_json(curve.up)));
}

/// What can be known to be wrong before the work.
void check(const Options& options) {
  for (const std::string& type : options.from)
    if (ranges::find(types, type) == types.end())
      throw InputError("--from: " + in_quotes(type) +
                       " is no type of special point; there are LP, PD, NS, BP, GR, SL, CH and CO");
  if (options.which > 1 && options.from.size() > 1)
    throw InputError("--which: only for the points of one type, and --from is given more than once");
}

/// A curve with its equations.
struct FollowedCurve {
  std::string type;
  std::shared_ptr<const orbit::Problem> problem;
  orbit::Curve curve;
};

FollowedCurve followed(const Options& options, const ChosenModel& chosen, const std::vector<std::string>& names,
                       const std::string& type, const std::atomic<bool>& stop) {
  const auto ranges = two_ranges(options.ranges, names);
  const double second = value_inside(chosen, "--params", names[1], ranges[1]);
  orbit::SpecialPoint special = special_point(options, chosen, names, ranges[0], type, stop);
  special.solution.orbit.values = {special.value, second};
  FollowedCurve one{
      type, orbit::pose(chosen.definition.family(names, chosen.overrides), special.solution.orbit.values), {}};
  Progress progress("points at most", 2.0 * static_cast<double>(options.points), options.progress);
  orbit::CurveOptions how{
      .from = ranges[0].from, .to = ranges[0].to, .second_from = ranges[1].from, .second_to = ranges[1].to};
  how.longest_step = options.step;
  how.most_points = static_cast<int>(options.points);
  how.stop = &stop;
  how.progress = [&](long points) { progress.update(static_cast<double>(points)); };
  one.curve = orbit::locus(*one.problem, special, how);
  return one;
}

/// One curve as it is, several as a list "curves".
Json whole_json(const std::vector<FollowedCurve>& all, const std::vector<std::string>& names, const ChosenModel& chosen,
                const System& system) {
  Json json = Json::object(), list = Json::list();
  json.set("model", chosen.model.name);
  for (const FollowedCurve& one : all) {
    Json here = Json::object();
    here.set("type", one.type);
    const Json rest = curve_json(one.curve, names, *one.problem, system);
    for (const auto& [key, value] : std::get<Json::Object>(rest.value())) here.set(key, value);
    if (all.size() > 1) {
      list.push(std::move(here));
      continue;
    }
    for (const auto& [key, value] : std::get<Json::Object>(here.value())) json.set(key, value);
  }
  if (all.size() > 1) json.set("curves", std::move(list));
  return json;
}

int run(const Options& options, const Context& context) {
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  const bool table = is_table_file(options.out);
  if (table) const AtomicFile writable(options.out);  // goes away without a trace
  Output out(table ? "" : options.out);
  const Plot plot(options.plot, options.plot_size);
  const ChosenModel chosen = options.model.load();
  const std::vector<std::string> names = two_parameters(options.parameters);
  (void)value_inside(chosen, "--params", names[1], two_ranges(options.ranges, names)[1]);
  check(options);
  std::vector<FollowedCurve> all;
  for (const std::string& type : options.from)
    if (!context.stop.load()) all.push_back(followed(options, chosen, names, type, context.stop));
  const System system(chosen.model);
  std::vector<CurveRows> rows;
  for (const FollowedCurve& one : all) rows.push_back({one.type, *one.problem, one.curve});
  if (table) write_curves(options.out, rows, names, chosen);
  if (!table) out.write(whole_json(all, names, chosen, system).dump() + "\n");
  if (!table) out.commit();
  std::vector<NamedCurve> named;
  bool drawn = false;
  for (const FollowedCurve& one : all) {
    named.push_back({one.type, one.curve});
    drawn = drawn || ranges::any_of(one.curve.points, [](const auto& point) { return point.solution.is_motion; });
  }
  const int status = plot.write_or_say(curve_figure(named, chosen.definition, names), !drawn, done);
  if (context.stop.load()) return interrupted;
  for (const FollowedCurve& one : all)
    if (one.curve.failed())
      throw NumericalError("curve: " + orbit::sentence(one.curve, system) + "; the points so far are written");
  return status;
}

}  // namespace

Action add_curve(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  options->orbit.declare(arguments);
  arguments.repeated("--from", options->from, "TYPE",
                     "the type of special point to follow: LP, PD, NS, BP, GR, SL, CH or CO; may be repeated (PD)");
  arguments.text("--params", options->parameters, "A,B", "the two parameters; the point is sought along the first")
      .required();
  arguments.repeated("--range", options->ranges, "NAME=A:B", "range of a parameter; give both").required();
  arguments.count("--which", options->which, 1, 1000, "the K-th point of that type along the branch (1)");
  arguments.number("--step", options->step, "S", "longest step along the curve, as a part of the ranges (0.01)",
                   {.least = 0.0, .most = 0.2, .above = true});
  arguments.count("--points", options->points, 2, 1'000'000, "most points each way (500)");
  arguments.text("--plot", options->plot, "F.png", "draw the curve (.png, .pdf or .svg)");
  arguments.text("--out", options->out, "FILE",
                 "write the JSON there, or a table (.csv, .npz, .h5), instead of to standard output");
  declare_plot_size(arguments, options->plot_size);
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "The locus of a special point of `continue` in two parameters, with the points of codimension two met on the "
      "way.\n"
      "  slapstick curve vibro-impact --orbit 1-1 --from PD --params omega,friction --range omega=2:4 --range "
      "friction=0:0.5");
  return [options](const Context& context) {
    if (options->from.empty()) options->from = {"PD"};
    return run(*options, context);
  };
}

}  // namespace slapstick::app
