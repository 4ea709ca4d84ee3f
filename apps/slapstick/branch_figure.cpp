#include "branch_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "axis_text.hpp"

namespace slapstick::app {
namespace {

using orbit::Solution;

/// What stands for an orbit: the speeds of its impacts; if no orbit of the branches has any, the first coordinate at its events. In falling order: which event a cycle
/// begins with may change along a branch.
std::vector<double> heights(const orbit::Problem& problem, const Solution& solution, bool impacts) {
  std::vector<double> speeds, places;
  for (const orbit::EventOfOrbit& event : orbit::events(problem, solution.orbit)) {
    if (event.kind == EventKind::impact || event.kind == EventKind::engage) speeds.push_back(event.w);
    places.push_back(event.before.front());
  }
  std::ranges::sort(speeds, std::greater<>());
  std::ranges::sort(places, std::greater<>());
  if (impacts) return speeds;
  if (!places.empty()) return places;
  return {solution.orbit.x.front()[0]};
}

/// One line per impact; a change of their number, or of stability, begins new ones.
class Lines {
 public:
  explicit Lines(figure::Panel& panel, figure::Colour colour) : panel_(panel), colour_(colour) {}

  void add(double x, const std::vector<double>& y, const Solution& solution) {
    const bool same = open_.size() == y.size() && stable_ == solution.stable() && drawn_ == solution.is_motion;
    if (!same) {
      const bool goes_on = open_.size() == y.size() && !last_.empty();
      flush();
      open_.assign(y.size(), {});
      stable_ = solution.stable();
      drawn_ = solution.is_motion;
      if (goes_on)
        for (std::size_t i = 0; i < y.size(); ++i) push(i, last_x_, last_[i]);
    }
    for (std::size_t i = 0; i < y.size(); ++i) push(i, x, y[i]);
    last_x_ = x;
    last_ = y;
  }

  void flush() {
    for (figure::Line& line : open_) {
      if (!drawn_ || line.x.size() < 2) continue;
      line.colour = colour_;
      line.dash = stable_ ? figure::Dash::solid : figure::Dash::dashed;
      line.width_pt = stable_ ? 1.0 : 0.7;
      panel_.lines.push_back(std::move(line));
    }
    open_.clear();
  }

 private:
  void push(std::size_t i, double x, double y) {
    open_[i].x.push_back(x);
    open_[i].y.push_back(y);
  }

  figure::Panel& panel_;
  figure::Colour colour_;
  std::vector<figure::Line> open_;
  bool stable_ = true, drawn_ = true;
  double last_x_ = 0.0;
  std::vector<double> last_;
};

bool problem_has_impacts(const std::vector<orbit::Branch>& branches) {
  return std::ranges::any_of(branches, [](const orbit::Branch& branch) {
    return std::ranges::any_of(branch.points, [](const Solution& point) { return point.impacts > 0; });
  });
}

/// A name above the frame; of several that nearly coincide the first has one.
void add_label(figure::Panel& panel, double x, const std::string& label, const std::vector<double>& all) {
  constexpr double beside = 0.02;
  constexpr std::size_t most = 16;
  const auto [least, largest] = std::ranges::minmax_element(all);
  const double width = std::max(*largest - *least, 1e-12);
  const bool taken = std::ranges::any_of(
      panel.marks, [&](const figure::Mark& mark) { return std::abs(*mark.x - x) < beside * width; });
  if (taken || panel.marks.size() >= most)
    panel.marks.push_back({.x = x});
  else
    panel.marks.push_back({.x = x, .label = label});
}

}  // namespace

figure::Figure branch_figure(const std::vector<orbit::Branch>& branches, const std::string& parameter,
                             const orbit::Problem& problem) {
  figure::Panel panel;
  panel.x_label = axis_text(parameter);
  panel.y_label = problem_has_impacts(branches) ? "impact speed w" : "first coordinate at the events";
  const bool impacts = problem_has_impacts(branches);
  const std::array<figure::Colour, 4> palette = {figure::colours::black, figure::colours::dark_blue,
                                                 figure::colours::vermillion, figure::colours::green};
  figure::Points special{.label = "", .colour = figure::colours::vermillion, .diameter_mm = 0.9};
  for (std::size_t b = 0; b < branches.size(); ++b) {
    Lines lines(panel, palette[b % palette.size()]);
    for (const Solution& point : branches[b].points)
      lines.add(point.orbit.values[0], heights(problem, point, impacts), point);
    lines.flush();
    for (const orbit::SpecialPoint& point : branches[b].special) {
      const std::vector<double> y = heights(problem, point.solution, impacts);
      if (y.empty()) continue;
      const double top = *std::ranges::max_element(y);
      special.x.push_back(point.value);
      special.y.push_back(top);
      add_label(panel, point.value, std::string(name(point.type)), special.x);
    }
  }
  if (!special.x.empty()) panel.points.push_back(std::move(special));
  figure::Figure figure;
  figure.panels.push_back(std::move(panel));
  figure.caption = "stable: solid; unstable: dashed";
  return figure;
}

}  // namespace slapstick::app
