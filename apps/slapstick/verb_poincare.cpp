/// slapstick poincare MODEL
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact_clouds.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "relative_motion.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"
#include "slapstick/section/run_impacts.hpp"
#include "slapstick/section/stroboscopic_section.hpp"
#include "stop_options.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  StopOptions stops;
  std::string section = "impact", out, plot;
  double phase = 0.0;
  long long transient = 500, points = 1000, most_periods = 1'000'000, patience = 10'000;
  bool progress = false;
};

std::vector<std::string> columns(std::vector<std::string> names, const Model& model) {
  for (const std::string& name : state_names(model)) names.push_back(name);
  return names;
}

/// The range of the points and 4 % on either side. Nothing if they have no extent; the figure then finds a range.
std::optional<figure::Range> x_reach(const std::vector<figure::Points>& clouds) {
  double low = INFINITY, high = -INFINITY;
  for (const figure::Points& cloud : clouds) {
    for (const double x : cloud.x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  const double margin = 0.04 * (high - low);
  if (!(margin > 1e-9 * std::max(std::abs(low), std::abs(high)))) return {};
  return figure::Range{low - margin, high + margin};
}

/// The picture of the points.
figure::Figure picture(figure::Panel panel) {
  const auto reach = x_reach(panel.points);
  if (reach) panel.x_range = reach;
  figure::Figure figure{.width_cm = 12, .height_cm = 9};
  figure.panels.push_back(std::move(panel));
  return figure;
}

/// What a section gave.
struct Found {
  long long points = 0;
  bool whole = true;  ///< false: stopped before its end
  figure::Panel panel;
};

/// Ends at the last point, or where there is no next one: at the section's last period, or after `patience` periods without a point.
class ImpactPoints {
 public:
  ImpactPoints(const Options& options, const System& system, const StopChoice& stops, TableOutput& table)
      : options_(options),
        system_(system),
        table_(table),
        stops_(stops),
        clouds_(system.model(), stops, ContactClouds::Overlap::rare) {}

  Found operator()(Motion motion, const Context& context) {
    Progress progress("points", static_cast<double>(options_.points), options_.progress);
    ImpactSection section(std::move(motion), stops_);
    const auto pass = [](const SectionPoint&) { return true; };
    found_.whole = run_impacts(section, {options_.transient, 0.0}, &context.stop, pass);
    const Instant last{options_.transient + options_.most_periods, 0.0};
    Instant end, now = section.motion().time();
    while (found_.whole && found_.points < options_.points && end < last) {
      end = std::min(last, Instant{now.period + options_.patience, now.fraction});
      const long long before = found_.points;
      found_.whole = run_impacts(section, end, &context.stop, [&](const SectionPoint& point) {
        note(point);
        now = point.time;
        progress.update(static_cast<double>(found_.points));
        return found_.points < options_.points;
      });
      if (found_.points == before) break;
    }
    if (found_.whole && found_.points < options_.points) report(section.motion().time());
    const Model& model = system_.model();
    found_.panel.x_label = model.forced() ? "phase of the forcing / 2π" : "fraction of the unit of time";
    found_.panel.y_label = "w just before the " + contact_words(model, stops_);
    found_.panel.points = clouds_.points();
    return std::move(found_);
  }

 private:
  void note(const SectionPoint& point) {
    table_.number(point.time.seconds(system_.period())).number(point.phase).number(point.w);
    table_.number(point.flight).number(point.sliding).numbers(point.state);
    if (several_stops(system_.model())) table_.word(stop_name(system_.model(), point.contact));
    table_.end_row();
    ++found_.points;
    if (!options_.plot.empty()) clouds_.add(point.contact, point.phase, point.w);
  }

  /// Fewer points than were asked for. @throws NumericalError if there is none
  void report(Instant end) const {
    const Model& model = system_.model();
    const auto what = " " + contact_noun(model, stops_) + "s in " + std::to_string(end.period - options_.transient) +
                      " periods after the transient";
    if (found_.points == 0)
      throw NumericalError("no" + what + ": try another --set or --state" +
                           (options_.stops.names.empty() ? "" : ", another --stop") + ", a longer --most-periods" +
                           (model.forced() ? ", or --section stroboscopic" : ", or a shorter --transient"));
    std::fprintf(stderr, "slapstick: only %lld%s (see --most-periods)\n", found_.points, what.c_str());
  }

  const Options& options_;
  const System& system_;
  TableOutput& table_;
  StopChoice stops_;
  ContactClouds clouds_;
  Found found_;
};

Found strobe_points(const Options& options, const System& system, const StopChoice& stops, Motion motion,
                    TableOutput& table, const Context& context) {
  const RelativeMotion relative(system.model(), shown_contact(system.model(), stops));
  Found found{.panel = {.x_label = relative.displacement, .y_label = relative.velocity}};
  for (const double limit : relative.limits) found.panel.marks.push_back({.x = limit});
  figure::Points cloud;
  Progress progress("points", static_cast<double>(options.points), options.progress);
  StroboscopicSection section(std::move(motion), options.phase);
  StroboscopicPoint point;
  for (long long i = 0; i < options.transient + options.points; ++i) {
    found.whole = section.next(point, &context.stop);
    if (!found.whole) break;
    if (i < options.transient) continue;
    table.number(point.time.seconds(system.period())).number(point.time.fraction);
    table.numbers(point.state).word(system.mode_name(point.mode)).end_row();
    ++found.points;
    if (!options.plot.empty()) {
      cloud.x.push_back(relative.y(point.state));
      cloud.y.push_back(relative.w(point.state));
    }
    progress.update(static_cast<double>(found.points));
  }
  found.panel.points.push_back(std::move(cloud));
  return found;
}

/// Before anything is written.
void check(const Options& options, const Model& model) {
  if (options.section == "impact" && stop_contacts(model).empty())
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
  const StopChoice stops = options.stops.choice(chosen.model);
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
  if (impacts && several_stops(chosen.model)) names.emplace_back("contact");
  TableOutput table(options.out, names);
  Motion motion(system, start);
  Found found = impacts ? ImpactPoints(options, system, stops, table)(std::move(motion), context)
                        : strobe_points(options, system, stops, std::move(motion), table, context);
  if (found.points > 0) table.commit();
  return plot.write_or_say(picture(std::move(found.panel)), found.points == 0, found.whole ? done : interrupted);
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
                  "end the impact section here if impacts are rare (1000000, and after 10000 without an impact)");
  options->stops.declare(arguments, "points are the impacts of this stop only; may be repeated (all)");
  arguments.text("--out", options->out, "F.csv", "write the points there instead of to standard output");
  arguments.text("--plot", options->plot, "F.png",
                 "picture of the points: .png, .pdf or .svg; its data and script lie beside it");
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "Columns: time, phase, w, flight, sliding and the state just before each impact, with several stops also "
      "contact; "
      "or\ntime, phase, state, mode. A compliant stop takes part by its engagements.\n"
      "flight is the time since the impact before, sliding the part of it in which the friction contact slips, both in "
      "periods.\n"
      "Example:\n  slapstick poincare vibro-impact --set omega=4.805 --points 5000 --plot circles.png --out "
      "points.csv");
  return [options, &arguments](const Context& context) {
    if (arguments.given("--phase") && options->section == "impact")
      throw InputError("--phase belongs to --section stroboscopic");
    if (arguments.given("--most-periods")) options->patience = options->most_periods;
    if (!options->stops.names.empty() && options->section == "stroboscopic" && options->plot.empty())
      throw InputError("--stop: of the stroboscopic section it is for the picture of --plot, which is not given");
    return poincare(*options, context);
  };
}

}  // namespace slapstick::app
