/// slapstick poincare MODEL
#include <cstdio>

#include "model_options.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"
#include "slapstick/section/run_impacts.hpp"
#include "slapstick/section/stroboscopic_section.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  std::string section = "impact", out, plot;
  double phase = 0.0;
  long long transient = 500, points = 1000, most_periods = 1'000'000;
  bool progress = false;
};

std::vector<std::string> columns(std::vector<std::string> names, const Model& model) {
  for (const std::string& name : state_names(model)) names.push_back(name);
  return names;
}

/// The points drawn: x and y of the picture.
struct Cloud {
  std::string x_label, y_label;
  std::vector<double> x, y;

  [[nodiscard]] figure::Figure figure() const {
    figure::Panel panel{.x_label = x_label, .y_label = y_label};
    panel.points.push_back({.x = x, .y = y});
    figure::Figure figure{.width_cm = 12, .height_cm = 9};
    figure.panels.push_back(std::move(panel));
    return figure;
  }
};

bool impact_points(const Options& options, const System& system, Motion motion, TableOutput& table, Cloud& cloud,
                   const Context& context) {
  cloud.x_label = system.model().forced() ? "phase of the forcing / 2π" : "fraction of the unit of time";
  cloud.y_label = "w just before the impact";
  Progress progress("points", static_cast<double>(options.points), options.progress);
  ImpactSection section(std::move(motion));
  if (!run_impacts(section, {options.transient, 0.0}, &context.stop, [](const SectionPoint&) { return true; }))
    return false;
  long long count = 0;
  const bool whole = run_impacts(
      section, {options.transient + options.most_periods, 0.0}, &context.stop, [&](const SectionPoint& point) {
        table.number(point.time.seconds(system.period())).number(point.phase).number(point.w);
        table.number(point.flight).number(point.sliding).numbers(point.state);
        if (system.model().stops.size() > 1) table.word(system.contact_name(point.stop));
        table.end_row();
        if (!options.plot.empty()) {
          cloud.x.push_back(point.phase);
          cloud.y.push_back(point.w);
        }
        progress.update(static_cast<double>(++count));
        return count < options.points;
      });
  if (whole && count < options.points)
    std::fprintf(stderr, "slapstick: only %lld impacts in %lld periods (see --most-periods)\n", count,
                 options.most_periods);
  return whole;
}

bool strobe_points(const Options& options, const System& system, Motion motion, TableOutput& table, Cloud& cloud,
                   const Context& context) {
  const RelativeMotion relative(system.model());
  cloud.x_label = relative.displacement;
  cloud.y_label = relative.velocity;
  Progress progress("points", static_cast<double>(options.points), options.progress);
  StroboscopicSection section(std::move(motion), options.phase);
  StroboscopicPoint point;
  for (long long i = 0; i < options.transient + options.points; ++i) {
    if (!section.next(point, &context.stop)) return false;
    if (i < options.transient) continue;
    table.number(point.time.seconds(system.period()))
        .number(point.time.fraction)
        .numbers(point.state)
        .word(system.mode_name(point.mode));
    table.end_row();
    if (!options.plot.empty()) {
      cloud.x.push_back(relative.y(point.state));
      cloud.y.push_back(relative.w(point.state));
    }
    progress.update(static_cast<double>(i - options.transient + 1));
  }
  return true;
}

/// Before anything is written.
void check(const Options& options, const Model& model) {
  if (options.section == "impact" && model.stops.empty())
    throw InputError("--section impact: model " + in_quotes(model.name) +
                     " has no stop; --section stroboscopic needs none");
  if (options.section == "stroboscopic" && !model.forced())
    throw InputError("--section stroboscopic: model " + in_quotes(model.name) + " has no harmonic forcing");
  if (!(options.phase >= 0.0 && options.phase < 1.0))
    throw InputError("--phase: " + shown(options.phase) + " is outside [0, 1)");
}

int poincare(const Options& options, const Context& context) {
  const ChosenModel chosen = options.model.load();
  check(options, chosen.model);
  const State start = options.model.start(chosen);
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  const bool impacts = options.section == "impact";
  const double periods = static_cast<double>(options.transient + (impacts ? 1 : options.points));
  const System system = affordable_system(chosen, {periods, impacts ? "--transient" : "--transient or --points"});
  const Plot plot(options.plot);
  auto names = columns(impacts ? std::vector<std::string>{"time", "phase", "w", "flight", "sliding"}
                               : std::vector<std::string>{"time", "phase"},
                       chosen.model);
  if (!impacts) names.emplace_back("mode");
  if (impacts && chosen.model.stops.size() > 1) names.emplace_back("contact");
  TableOutput table(options.out, names);
  Cloud cloud;
  const bool whole =
      (impacts ? impact_points : strobe_points)(options, system, Motion(system, start), table, cloud, context);
  table.commit();
  return plot.write_or_say(cloud.figure(), cloud.x.empty(), whole ? done : interrupted);
}

}  // namespace

Action add_poincare(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  arguments.choice("--section", options->section, {"impact", "stroboscopic"}, "where the motion is looked at (impact)");
  arguments.number("--phase", options->phase, "X", "of the stroboscopic section, a fraction of a period in [0, 1) (0)");
  arguments.count("--transient", options->transient, 0, 1'000'000'000, "forcing periods to run before (500)");
  arguments.count("--points", options->points, 1, 1'000'000'000, "points to record (1000)");
  arguments.count("--most-periods", options->most_periods, 1, 1'000'000'000,
                  "end the impact section here if impacts are rare (1000000)");
  arguments.text("--out", options->out, "F.csv", "write the points there instead of to standard output");
  arguments.text("--plot", options->plot, "F.png",
                 "picture of the points: .png, .pdf or .svg; its data and script lie beside it");
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "Columns: time, phase, w, flight, sliding and the state just before each impact; or time, phase, state, mode.\n"
      "flight is the time since the impact before, sliding the part of it in which the friction contact slips, both in "
      "periods.\n"
      "Example:\n  slapstick poincare vibro-impact --set omega=4.805 --points 5000 --plot circles.png --out "
      "points.csv");
  return [options, &arguments](const Context& context) {
    if (arguments.given("--phase") && options->section == "impact")
      throw InputError("--phase belongs to --section stroboscopic");
    return poincare(*options, context);
  };
}

}  // namespace slapstick::app
