#include "branch_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "branch_table.hpp"

namespace slapstick::app {
namespace {

using orbit::Solution;

/// What stands for an orbit: the speeds of its impacts, or 0; or the first coordinate at its events. In falling order: which event a cycle begins with may
/// change along a branch.
std::vector<double> heights(const orbit::Problem& problem, const Solution& solution, bool of_speeds) {
  std::vector<double> speeds, places;
  for (const orbit::EventOfOrbit& event : orbit::events(problem, solution.orbit)) {
    if (event.kind == EventKind::impact || event.kind == EventKind::engage) speeds.push_back(event.w);
    places.push_back(event.before.front());
  }
  if (places.empty()) places.push_back(orbit::at_phase_zero(problem, solution.orbit).front());
  if (speeds.empty()) speeds.push_back(0.0);
  std::vector<double>& all = of_speeds ? speeds : places;
  std::ranges::sort(all, std::greater<>());
  return all;
}

/// One line per impact; a change of their number, or of stability, begins new ones.
class Lines {
 public:
  explicit Lines(figure::Panel& panel, figure::Colour colour) : panel_(panel), colour_(colour) {}

  void add(double x, const std::vector<double>& y, const Solution& solution) {
    const bool same = open_.size() == y.size() && stable_ == solution.stable() && drawn_ == solution.is_motion;
    if (!same) {
      const bool paired = open_.size() == y.size();
      flush();
      open_.assign(y.size(), {});
      stable_ = solution.stable();
      drawn_ = solution.is_motion;
      for (std::size_t i = 0; !last_.empty() && i < y.size(); ++i)
        if (const auto from = paired ? std::optional(last_[i]) : nearest(y[i])) push(i, last_x_, *from);
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
  /// The end of a line that the one which begins at y goes on from, if there is one.
  [[nodiscard]] std::optional<double> nearest(double y) const {
    constexpr double near = 0.02;
    const auto off = [y](double other) { return std::abs(other - y); };
    const double best = *std::ranges::min_element(last_, {}, off);
    return off(best) < near * std::abs(y) ? std::optional(best) : std::nullopt;
  }
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

bool have_impacts(const std::vector<orbit::Branch>& branches) {
  return std::ranges::any_of(branches, [](const orbit::Branch& branch) {
    return std::ranges::any_of(branch.points, [](const Solution& point) { return point.impacts > 0; });
  });
}

/// The lines of a branch. A change of events ends those of the old sequence and begins those of the new one.
void add_lines(figure::Panel& panel, const orbit::Branch& branch, figure::Colour colour,
               const std::function<std::vector<double>(const Solution&)>& heights_of) {
  Lines lines(panel, colour);
  auto special = branch.special.begin();
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    lines.add(branch.points[i].orbit.values[0], heights_of(branch.points[i]), branch.points[i]);
    for (; special != branch.special.end() && special->after == i; ++special) {
      if (!classes_around(branch, *special)) continue;
      const bool before = special->solution.orbit.legs() == branch.points[i].orbit.legs();
      lines.add(special->value, heights_of(special->solution), branch.points[before ? i : i + 1]);
    }
  }
  lines.flush();
}

/// Vertical lines, with names above the frame: one for all points that the eye cannot tell apart. Of several of one type that nearly coincide one is named;
/// the more there are, the farther that reaches.
void add_marks(figure::Panel& panel, std::vector<std::pair<double, std::string>> specials) {
  constexpr std::size_t most = 16;
  constexpr double line = 0.004;  // of the width
  std::ranges::sort(specials);
  const double width = specials.empty() ? 0.0 : specials.back().first - specials.front().first;
  for (double beside = 0.02; beside < 1.0; beside *= 1.5) {
    std::map<std::string, double> last;  // of each type the last that was named
    std::vector<figure::Mark> marks;
    std::size_t named = 0;
    for (const auto& [x, type] : specials) {
      if (marks.empty() || x - *marks.back().x > line * width) marks.push_back({.x = x});
      const auto seen = last.find(type);
      if (seen != last.end() && x - seen->second < beside * width) continue;
      std::string& label = marks.back().label;
      label += (label.empty() ? "" : " ") + type;
      last[type] = x;
      ++named;
    }
    if (named > most) continue;
    panel.marks = std::move(marks);
    return;
  }
}

/// The values of the parameter that are shown: they fill the frame.
std::optional<figure::Range> range_of(const std::vector<orbit::Branch>& branches, const figure::Points& cloud) {
  std::vector<double> values = cloud.x;
  for (const orbit::Branch& branch : branches)
    for (const Solution& point : branch.points) values.push_back(point.orbit.values[0]);
  const auto [least, largest] = std::ranges::minmax(values);
  return least < largest ? std::optional(figure::Range{least, largest}) : std::nullopt;
}

}  // namespace

figure::Figure branch_figure(const std::vector<orbit::Branch>& branches, const std::string& x_label,
                             const orbit::Problem& problem, const SettledMotions& beneath) {
  const bool speeds = beneath.speeds || have_impacts(branches);
  const auto heights_of = [&](const Solution& solution) { return heights(problem, solution, speeds); };
  figure::Panel panel{.x_label = x_label, .y_label = speeds ? "impact speed w" : "first coordinate at the events"};
  const std::array<figure::Colour, 4> palette = {figure::colours::black, figure::colours::dark_blue,
                                                 figure::colours::vermillion, figure::colours::green};
  figure::Points dots{.colour = figure::colours::vermillion, .drawing = figure::Drawing::discs, .diameter_mm = 0.9};
  std::vector<std::pair<double, std::string>> specials;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    add_lines(panel, branches[b], palette[b % palette.size()], heights_of);
    for (const orbit::SpecialPoint& point : branches[b].special) {
      dots.x.push_back(point.value);
      dots.y.push_back(heights_of(point.solution).front());
      specials.emplace_back(point.value, name(point.type));
    }
  }
  add_marks(panel, std::move(specials));
  panel.x_range = range_of(branches, beneath.cloud);
  if (!beneath.cloud.x.empty()) panel.points.push_back(beneath.cloud);
  if (!dots.x.empty()) panel.points.push_back(std::move(dots));
  figure::Figure figure;
  figure.panels.push_back(std::move(panel));
  figure.caption = beneath.cloud.x.empty() ? "stable: solid; unstable: dashed"
                                           : "stable: solid; unstable: dashed; grey: motions that settle";
  return figure;
}

}  // namespace slapstick::app
