/// Writes the points of a section into a table and a picture.
#include "section_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "axis_text.hpp"
#include "contact_clouds.hpp"
#include "event_options.hpp"
#include "progress.hpp"
#include "relative_motion.hpp"
#include "section/creep_watch.hpp"
#include "section/run_impacts.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/section/stroboscopic_section.hpp"
#include "span_options.hpp"

namespace slapstick::app {
namespace {

/// Says that the points are those of a transient.
void say_creep(const CreepWatch& watch, const Model& model) {
  const auto creep = watch.verdict();
  if (!creep) return;
  std::fprintf(stderr,
               "slapstick: the points still creep (%s moves one way, by steps that shrink to %.3g in a quarter of the "
               "recording): a slow transient, no curve; take a longer --transient\n",
               state_names(model)[creep->number].c_str(), creep->ratio);
}

/// Ends at the last point, or where there is no next one: at the section's last period, or after `patience` periods
/// without a point.
class ImpactPoints {
 public:
  ImpactPoints(const PoincareOptions& options, const System& system, const StopChoice& stops, TableOutput& table,
               const AxisUnits& units, PointQuantities& of)
      : options_(options),
        of_(of),
        system_(system),
        table_(table),
        units_(units),
        stops_(stops),
        clouds_(system.model(), stops, ContactClouds::Overlap::rare),
        watch_(options.points, 2 * static_cast<std::size_t>(system.model().size())) {}

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
        note(point, section.motion());
        now = point.time;
        progress.update(static_cast<double>(found_.points));
        return found_.points < options_.points;
      });
      if (found_.points == before) break;
    }
    if (found_.whole && found_.points < options_.points) report(section.motion().time());
    say_creep(watch_, system_.model());
    const Model& model = system_.model();
    const std::string w = "w just before the " + contact_words(model, stops_);
    const std::string unit = units_.speed(chosen_stops(model, stops_));
    found_.panel.x_label = model.forced() ? "phase of the forcing / 2π" : with_unit(w, unit);
    found_.panel.y_label = with_unit(model.forced() ? w : w + " after it", unit);
    of_.label(found_.panel);
    found_.panel.points = clouds_.points();
    found_.map = !model.forced();
    return std::move(found_);
  }

 private:
  void note(const SectionPoint& point, const Motion& motion) {
    table_.number(point.time.seconds(system_.period())).number(point.phase).number(point.w);
    table_.number(point.flight).number(point.sliding).numbers(point.state);
    if (several_stops(system_.model())) table_.word(stop_name(system_.model(), point.contact));
    const std::vector<double>& values = of_.before(motion);
    table_.numbers(values).end_row();
    ++found_.points;
    watch_.add(point.state);
    if (options_.plot.empty()) return;
    if (of_.are_axes()) return clouds_.add(point.contact, values[0], values[1]);
    if (system_.model().forced()) return clouds_.add(point.contact, point.phase, point.w);
    if (!std::isnan(w_before_)) clouds_.add(point.contact, w_before_, point.w);  // without a phase: the return map
    w_before_ = point.w;
  }

  /// Fewer points than were asked for. @throws NumericalError if there is no point
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

  const PoincareOptions& options_;
  PointQuantities& of_;
  const System& system_;
  TableOutput& table_;
  const AxisUnits& units_;
  StopChoice stops_;
  ContactClouds clouds_;
  CreepWatch watch_;
  double w_before_ = std::numeric_limits<double>::quiet_NaN();
  Found found_;
};

}  // namespace

PointQuantities::PointQuantities(const std::string& of, const ChosenModel& chosen, const System& system)
    : reader_(system, functions_of_time("--of", of, chosen)) {}

void PointQuantities::label(figure::Panel& panel) const {
  if (!are_axes()) return;
  panel.x_label = with_unit(axis_text(of()[0].name), of()[0].unit);
  panel.y_label = with_unit(axis_text(of()[1].name), of()[1].unit);
  panel.marks.clear();
}

Found impact_points(const PoincareOptions& options, const StopChoice& stops, Motion motion, TableOutput& table,
                    const AxisUnits& units, PointQuantities& of, const Context& context) {
  const System system = motion.system();
  return ImpactPoints(options, system, stops, table, units, of)(std::move(motion), context);
}

Found strobe_points(const PoincareOptions& options, const StopChoice& stops, Motion motion, TableOutput& table,
                    const AxisUnits& units, PointQuantities& of, const Context& context) {
  const System& system = motion.system();
  const RelativeMotion relative(system.model(), shown_contact(system.model(), stops));
  Found found{.panel = {.x_label = with_unit(relative.displacement, units.displacement(relative)),
                        .y_label = with_unit(relative.velocity, units.velocity(relative))}};
  for (const double limit : relative.limits) found.panel.marks.push_back({.x = limit});
  of.label(found.panel);
  figure::Points cloud;
  Progress progress("points", static_cast<double>(options.points), options.progress);
  StroboscopicSection section(std::move(motion), options.phase);
  StroboscopicPoint point;
  CreepWatch watch(options.points, 2 * static_cast<std::size_t>(system.model().size()));
  for (long long i = 0; i < options.transient + options.points; ++i) {
    found.whole = section.next(point, &context.stop);
    if (!found.whole) break;
    if (i < options.transient) continue;
    table.number(point.time.seconds(system.period())).number(point.time.fraction);
    const std::vector<double>& values = of.now(section.motion());
    table.numbers(point.state).word(system.mode_name(point.mode)).numbers(values).end_row();
    ++found.points;
    watch.add(point.state);
    if (!options.plot.empty()) {
      cloud.x.push_back(of.are_axes() ? values[0] : relative.y(point.state));
      cloud.y.push_back(of.are_axes() ? values[1] : relative.w(point.state));
    }
    progress.update(static_cast<double>(found.points));
  }
  say_creep(watch, system.model());
  found.panel.points.push_back(std::move(cloud));
  return found;
}

/// One coordinate of the return map.
static double mapped(Mapped quantity, const RelativeMotion& relative, const EventPoint& point) {
  if (quantity == Mapped::displacement) return relative.y(point.state);
  return quantity == Mapped::w ? point.w : point.return_time;
}

/// The axes of the return map of a kind of event.
static figure::Panel map_axes(std::string_view kind, Mapped quantity, const RelativeMotion& relative,
                              const AxisUnits& units) {
  const std::string label = quantity == Mapped::displacement ? relative.displacement
                            : quantity == Mapped::w          ? "w"
                                                             : "return time";
  const std::string unit = quantity == Mapped::displacement ? units.displacement(relative)
                           : quantity == Mapped::w          ? units.velocity(relative)
                                                            : units.time();
  const std::string at = label + " at " + axis_text(std::string(kind));
  return {.x_label = with_unit(at + " k", unit), .y_label = with_unit(at + " k + 1", unit)};
}

/// The picture is the return map: each point against the next.
Found event_points(const PoincareOptions& options, const EventChoice& events, Motion motion, TableOutput& table,
                   const AxisUnits& units, PointQuantities& of, const Context& context) {
  const System& system = motion.system();
  const Model& model = system.model();
  const RelativeMotion relative(model, mapped_contact(events, model));
  const Mapped quantity = mapped_quantity(events, model);
  Found found{.panel = map_axes(name(events.kind), quantity, relative, units)};
  of.label(found.panel);
  figure::Points cloud;
  Progress progress("points", static_cast<double>(options.points), options.progress);
  found.whole = run_to(motion, {options.transient, 0.0}, &context.stop, [] {});
  EventSection section(std::move(motion), events);
  const Instant last{options.transient + options.most_periods, 0.0};
  EventPoint point;
  double before = std::numeric_limits<double>::quiet_NaN();
  while (found.whole && found.points < options.points) {
    const Instant now = section.motion().time();
    if (!section.next(std::min(last, Instant{now.period + options.patience, now.fraction}), point, &context.stop)) {
      found.whole = !context.stop.load(std::memory_order_relaxed);
      break;
    }
    table.number(point.time.seconds(system.period())).number(point.return_time).number(point.w);
    const std::vector<double>& values = of.before(section.motion());
    table.numbers(point.state).word(system.contact_name(point.contact)).numbers(values).end_row();
    const double now_mapped = of.are_axes() ? values[1] : mapped(quantity, relative, point);
    if (of.are_axes()) before = values[0];
    if (!options.plot.empty() && !std::isnan(before)) {
      cloud.x.push_back(before);
      cloud.y.push_back(now_mapped);
    }
    before = now_mapped;
    ++found.points;
    progress.update(static_cast<double>(found.points));
  }
  found.map = !of.are_axes();
  const std::string in =
      " in " + std::to_string(section.motion().time().period - options.transient) + " periods after the transient";
  if (found.whole && found.points == 0)
    throw NumericalError("no such event" + in + ": try another --event, --set or --state, or a longer --most-periods");
  if (found.whole && found.points < options.points)
    std::fprintf(stderr, "slapstick: only %lld events%s (see --most-periods)\n", found.points, in.c_str());
  found.panel.points.push_back(std::move(cloud));
  return found;
}

}  // namespace slapstick::app
