/// slapstick curve MODEL --from TYPE --params A,B

#include "base/ranges.hpp"
#include "branch_json.hpp"
#include "curve_figure.hpp"
#include "orbit_choice.hpp"
#include "orbit_options.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "base/text.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  OrbitOptions orbit;
  std::string from, parameters, out, plot;
  std::vector<std::string> ranges;
  long long which = 1, points = 500;
  double step = 0.01;
  bool progress = false;
};

/// The K-th special point of the wanted type on the branch in the first parameter.
orbit::SpecialPoint special_point(const Options& options, const ChosenModel& chosen,
                                  const std::vector<std::string>& names, const ParameterRange& range,
                                  const std::atomic<bool>& stop) {
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
    if (name(special.type) == options.from && ++count == options.which) return special;
  }
  throw NumericalError("curve: no " + options.from +
                       (options.which > 1 ? " number " + std::to_string(options.which) : "") + " on the branch of " +
                       first.label + " in " + names[0] + " (found: " + (seen.empty() ? "none" : seen) + "; " +
                       orbit::sentence(branch) + ")");
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

int run(const Options& options, const Context& context) {
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  Output out(options.out);
  const Plot plot(options.plot);
  const ChosenModel chosen = options.model.load();
  const std::vector<std::string> names = two_parameters(options.parameters);
  const auto ranges = two_ranges(options.ranges, names);
  const double second = value_inside(chosen, "--params", names[1], ranges[1]);
  if (!(options.step > 0.0 && options.step <= 0.2))
    throw InputError("--step: " + shown(options.step) + " is outside (0, 0.2]");
  orbit::SpecialPoint special = special_point(options, chosen, names, ranges[0], context.stop);
  special.solution.orbit.values = {special.value, second};
  const auto problem = orbit::pose(chosen.definition.family(names, chosen.overrides), special.solution.orbit.values);
  Progress progress("points at most", 2.0 * static_cast<double>(options.points), options.progress);
  orbit::CurveOptions how{
      .from = ranges[0].from, .to = ranges[0].to, .second_from = ranges[1].from, .second_to = ranges[1].to};
  how.longest_step = options.step;
  how.most_points = static_cast<int>(options.points);
  how.stop = &context.stop;
  how.progress = [&](long points) { progress.update(static_cast<double>(points)); };
  const orbit::Curve curve = orbit::locus(*problem, special, how);
  Json json = Json::object();
  json.set("model", chosen.model.name).set("type", options.from);
  const System system(chosen.model);
  const Json rest = curve_json(curve, names, *problem, system);
  for (const auto& [key, value] : std::get<Json::Object>(rest.value())) json.set(key, value);
  out.write(json.dump() + "\n");
  out.commit();
  const bool drawn = ranges::any_of(curve.points, [](const auto& point) { return point.solution.is_motion; });
  const int status = plot.write_or_say(curve_figure(curve, chosen.definition, names, options.from), !drawn, done);
  if (context.stop.load()) return interrupted;
  if (!curve.failed()) return status;
  throw NumericalError("curve: " + orbit::sentence(curve, system) + "; the points so far are written");
}

}  // namespace

Action add_curve(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->from = "PD";
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  options->orbit.declare(arguments);
  arguments.choice("--from", options->from, {"LP", "PD", "NS", "BP", "GR", "SL", "CH", "CO"},
                   "the type of special point to follow (PD)");
  arguments.text("--params", options->parameters, "A,B", "the two parameters; the point is sought along the first");
  arguments.repeated("--range", options->ranges, "NAME=A:B", "range of a parameter; give both");
  arguments.count("--which", options->which, 1, 1000, "the K-th point of that type along the branch (1)");
  arguments.number("--step", options->step, "S", "longest step along the curve, as a part of the ranges (0.01)");
  arguments.count("--points", options->points, 2, 1'000'000, "most points each way (500)");
  arguments.text("--plot", options->plot, "F.png", "draw the curve (.png, .pdf or .svg)");
  arguments.text("--out", options->out, "FILE", "write the JSON there instead of to standard output");
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "The locus of a special point of `continue` in two parameters, with the points of codimension two met on the "
      "way.\n"
      "  slapstick curve vibro-impact --orbit 1-1 --from PD --params omega,friction --range omega=2:4 --range "
      "friction=0:0.5");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app
