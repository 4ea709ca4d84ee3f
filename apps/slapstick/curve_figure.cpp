/// Draws a locus in two parameters, and what is met on it.
#include "curve_figure.hpp"

#include <algorithm>
#include <cmath>

#include "axis_text.hpp"
#include "base/ranges.hpp"
#include "branch_colours.hpp"
#include "free_labels.hpp"

namespace slapstick::app {
namespace {

/// What is met behind a point of the curve, in the curve's order.
std::vector<const orbit::CurveEvent*> met_behind(const orbit::Curve& curve, std::size_t point) {
  std::vector<const orbit::CurveEvent*> all;
  for (const orbit::CurveEvent& event : curve.met)
    if (event.after == point) all.push_back(&event);
  const std::vector<double>& here = curve.points[point].values;
  const std::vector<double>& next = curve.points[std::min(point + 1, curve.points.size() - 1)].values;
  const double a = next[0] - here[0], b = next[1] - here[1];  // a part of a step is nearly straight
  const auto along = [&](const orbit::CurveEvent* event) {
    const double x = a != 0.0 ? (event->values[0] - here[0]) / a : 0.0,
                 y = b != 0.0 ? (event->values[1] - here[1]) / b : 0.0;
    return x + y;
  };
  ranges::stable_sort(all, {}, along);
  return all;
}

/// The line through motions only, and what is met on it. Where a motion ends by what is met, the line goes on to there.
class Motions {
 public:
  explicit Motions(const orbit::Curve& curve) {
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const bool here = curve.points[i].solution.is_motion;
      const bool next = i + 1 < curve.points.size() && curve.points[i + 1].solution.is_motion;
      if (here) add(curve.points[i].values);
      if (here || next) meet(met_behind(curve, i), here, next);
      if (!next && !line.x.empty() && std::isfinite(line.x.back())) add({std::nan(""), std::nan("")});
    }
  }

  figure::Line line{};
  std::vector<const orbit::CurveEvent*> met{};

 private:
  void add(const std::vector<double>& values) {
    line.x.push_back(values[0]);
    line.y.push_back(values[1]);
  }
  /// Of several between a motion and none, those up to the change of events are on the line.
  void meet(std::vector<const orbit::CurveEvent*> events, bool here, bool next) {
    const auto changes = [](const orbit::CurveEvent* event) {
      return ranges::any_of(event->met,
                            [](const orbit::Meeting& one) { return one.kind == orbit::Meeting::Kind::margin; });
    };
    if (here != next && !events.empty()) {
      const auto change = here ? ranges::find_if(events, changes) : events.end();
      if (here && change != events.end()) events.erase(change + 1, events.end());
      const auto last = std::find_if(events.rbegin(), events.rend(), changes);
      if (!here && last != events.rend()) events.erase(events.begin(), last.base() - 1);
    }
    for (const orbit::CurveEvent* event : events) {
      add(event->values);
      met.push_back(event);
    }
  }
};

/// What is met, marked and named: resonances as 1:2, the others by their type.
void add_met(figure::Panel& panel, const std::vector<const orbit::CurveEvent*>& met) {
  figure::Points dots{
      .colour = figure::colours::black, .drawing = figure::Drawing::discs, .diameter_mm = 1.1, .over_lines = true};
  std::vector<NamedPlace> names;
  for (const orbit::CurveEvent* event : met) {
    const orbit::Meeting& met_first = event->met.front();
    const bool resonance =
        met_first.kind == orbit::Meeting::Kind::resonance || met_first.kind == orbit::Meeting::Kind::end_of_torus;
    dots.x.push_back(event->values[0]);
    dots.y.push_back(event->values[1]);
    names.push_back(
        {event->values[0], event->values[1], resonance ? "1:" + std::to_string(met_first.order) : name(met_first)});
  }
  if (!names.empty()) panel.points.push_back(std::move(dots));
  add_names(panel, names);
}

}  // namespace

figure::Figure curve_figure(const std::vector<NamedCurve>& curves, const ModelDefinition& definition,
                            const std::vector<std::string>& names) {
  figure::Panel panel{.x_label = parameter_axis(definition, names[0]), .y_label = parameter_axis(definition, names[1])};
  std::vector<const orbit::CurveEvent*> met;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Motions motions(curves[i].curve);
    motions.line.label = curves[i].type;
    motions.line.colour = curves.size() > 1 ? branch_colour(i) : figure::colours::black;
    motions.line.width_pt = 1.0;
    panel.lines.push_back(std::move(motions.line));
    met.insert(met.end(), motions.met.begin(), motions.met.end());
  }
  double low = INFINITY, high = -INFINITY;
  for (const figure::Line& line : panel.lines)
    for (const double x : line.x)
      if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  constexpr double margin = 0.04;  // so that no curve lies on the frame
  if (high - low > 1e-6 * std::max(std::abs(low), std::abs(high)))
    panel.x_range = figure::Range{low - margin * (high - low), high + margin * (high - low)};
  add_met(panel, met);
  figure::Figure figure;
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace slapstick::app
