/// slapstick poincare MODEL
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "event_options.hpp"
#include "fine_dots.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "section_points.hpp"
#include "slapstick/base/error.hpp"
#include "verb.hpp"
#include "work.hpp"

namespace slapstick::app {
namespace {

std::vector<std::string> columns(const std::string& section, const Model& model, const std::vector<Quantity>& of) {
  const bool impacts = section == "impact", strobe = section == "stroboscopic";
  auto names = impacts  ? std::vector<std::string>{"time", "phase", "w", "flight", "sliding"}
               : strobe ? std::vector<std::string>{"time", "phase"}
                        : std::vector<std::string>{"time", "return_time", "w"};
  for (const std::string& name : state_names(model)) names.push_back(name);
  if (strobe) names.emplace_back("mode");
  if (section == "event" || (impacts && several_stops(model))) names.emplace_back("contact");
  for (const Quantity& one : of) names.push_back(one.name);
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
  if (!(margin > 4e-8 * std::max(std::abs(low), std::abs(high)))) return {};
  return figure::Range{low - margin, high + margin};
}

/// A return map has equal axes and the diagonal, on which a point comes back to itself.
void make_map(figure::Panel& panel, figure::Figure& figure) {
  double low = INFINITY, high = -INFINITY;
  for (const figure::Points& cloud : panel.points)
    for (std::size_t i = 0; i < cloud.x.size(); ++i) {
      low = std::min({low, cloud.x[i], cloud.y[i]});
      high = std::max({high, cloud.x[i], cloud.y[i]});
    }
  const double margin = 0.04 * (high - low);
  if (!(margin > 4e-8 * std::max(std::abs(low), std::abs(high)))) return;
  panel.x_range = panel.y_range = figure::Range{low - margin, high + margin};
  panel.lines.push_back({.x = {low - margin, high + margin},
                         .y = {low - margin, high + margin},
                         .colour = figure::colours::grey,
                         .dash = figure::Dash::dashed,
                         .width_pt = 0.5});
  figure.width_cm = 9.5;
}

/// The picture of the points.
figure::Figure picture(Found found) {
  figure::Panel panel = std::move(found.panel);
  make_dots_fine(panel.points);
  figure::Figure figure{.width_cm = 12, .height_cm = 9};
  if (const auto reach = x_reach(panel.points)) panel.x_range = reach;
  if (found.map) make_map(panel, figure);
  figure.panels.push_back(std::move(panel));
  return figure;
}

/// Before anything is written.
void check(const PoincareOptions& options, const Model& model) {
  if (options.section == "impact" && stop_contacts(model).empty())
    throw InputError("--section impact: model " + in_quotes(model.name) +
                     " has no stop; --section event, and with forcing --section stroboscopic, need none");
  if (options.section == "stroboscopic" && !model.forced())
    throw InputError("--section stroboscopic: model " + in_quotes(model.name) +
                     " has no harmonic forcing; --section event --event KIND needs none");
  if (options.section == "event" && options.event.empty())
    throw InputError("--section event: name the events by --event KIND or KIND:CONTACT");
}

int poincare(const PoincareOptions& options, const Context& context) {
  const ChosenModel chosen = options.model.load();
  check(options, chosen.model);
  const StopChoice stops = options.stops.choice(chosen.model);
  const State start = options.model.start(chosen);
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  roles.add_plot(options.plot);
  const bool strobe = options.section == "stroboscopic";
  const auto periods = static_cast<double>(options.transient + (strobe ? options.points : 1));
  const System system = affordable_system(chosen, {periods, strobe ? "--transient or --points" : "--transient"});
  const Plot plot(options.plot, options.plot_size);
  const EventChoice events = options.section == "event" ? event_choice(options.event, system) : EventChoice{};
  PointQuantities of(options.of, chosen, system);
  TableOutput table(options.out, columns(options.section, chosen.model, of.of()), table_facts(chosen));
  const AxisUnits units(chosen.definition, chosen.model);
  Motion motion(system, start);
  Found found = strobe ? strobe_points(options, stops, std::move(motion), table, units, of, context)
                : options.section == "event"
                    ? event_points(options, events, std::move(motion), table, units, of, context)
                    : impact_points(options, stops, std::move(motion), table, units, of, context);
  if (found.points > 0) table.commit();
  return plot.write_or_say(found.points > 0 ? picture(found) : figure::Figure{}, found.points == 0,
                           found.whole ? done : interrupted);
}

}  // namespace

Action add_poincare(Arguments& arguments) {
  auto options = std::make_shared<PoincareOptions>();
  options->model.declare(arguments);
  options->model.declare_state(arguments);
  arguments.choice("--section", options->section, {"impact", "stroboscopic", "event"},
                   "where the motion is looked at (impact)");
  arguments
      .text("--event", options->event, "KIND[:CONTACT]",
            "impact, slip+, slip-, stick, release, graze, chatter, corner, unload, load, engage, disengage or separate")
      .with({"--section event"});
  arguments
      .number("--phase", options->phase, "X", "a fraction of a period (0)", {.least = 0.0, .most = 1.0, .below = true})
      .with({"--section stroboscopic"});
  arguments.count("--transient", options->transient, 0, 1'000'000'000, "forcing periods to run before (500)");
  arguments.count("--points", options->points, 1, 1'000'000'000, "points to record (1000)");
  arguments.count("--most-periods", options->most_periods, 1, 1'000'000'000,
                  "end here if points are rare (1000000, and after 10000 without a point)");
  arguments.text(
      "--of", options->of, "Q,..",
      "quantities as further columns; two or more are the axes of the picture ('slapstick quantities MODEL')");
  options->stops.declare(arguments, "points are the impacts of this stop only; may be repeated (all)");
  arguments.text("--out", options->out, "F.csv",
                 "write the points there (.csv, .npz or .h5) instead of to standard output");
  arguments.text("--plot", options->plot, "F.png",
                 "picture of the points: .png, .pdf or .svg; its data and script lie beside it");
  declare_plot_size(arguments, options->plot_size);
  arguments.flag("--progress", options->progress, "show progress even if standard error is not a terminal");
  arguments.footer(
      "Columns: time, phase, w, flight, sliding and the state just before each impact, with several stops also "
      "contact; "
      "or\ntime, phase, state, mode; or time, return_time, w, state, contact. A compliant stop takes part by its "
      "engagements.\n"
      "flight is the time since the impact before, sliding the part of it in which the friction contact slips, both in "
      "periods.\n"
      "Example:\n  slapstick poincare vibro-impact --set omega=4.805 --points 5000 --plot circles.png --out "
      "points.csv\n  slapstick poincare belt --section event --event stick --transient 0 --points 5");
  return [options, &arguments](const Context& context) {
    if (arguments.given("--most-periods")) options->patience = options->most_periods;
    if (!options->stops.names.empty() && options->section == "stroboscopic" && options->plot.empty())
      throw InputError("--stop: of the stroboscopic section only for the picture of --plot, and --plot is not given");
    if (!options->stops.names.empty() && options->section == "event")
      throw InputError("--stop: the event section takes its contact by --event KIND:CONTACT");
    return poincare(*options, context);
  };
}

}  // namespace slapstick::app
