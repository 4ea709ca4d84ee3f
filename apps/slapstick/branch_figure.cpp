/// Draws branches: impact speeds over the parameter, with special points.
#include "branch_figure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "axis_units.hpp"
#include "base/ranges.hpp"
#include "branch_colours.hpp"
#include "branch_table.hpp"
#include "free_labels.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "special_markers.hpp"

namespace slapstick::app {
namespace {

using orbit::Solution;

/// What stands for an orbit: the speeds of its impacts, or 0; or the first coordinate at its events. In falling order:
/// which event a cycle begins with may change along a branch.
std::vector<double> heights(const orbit::Problem& problem, const Solution& solution, bool of_speeds) {
  std::vector<double> speeds, places;
  for (const orbit::EventOfOrbit& event : orbit::events(problem, solution.orbit)) {
    if (event.kind == EventKind::impact || event.kind == EventKind::engage) speeds.push_back(event.w);
    places.push_back(event.before.front());
  }
  if (places.empty()) places.push_back(orbit::at_phase_zero(problem, solution.orbit).front());
  if (speeds.empty()) speeds.push_back(0.0);
  std::vector<double>& all = of_speeds ? speeds : places;
  ranges::sort(all, std::greater<>());
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
    constexpr double same_height = 0.02;
    const auto off = [y](double other) { return std::abs(other - y); };
    const double best = *ranges::min_element(last_, {}, off);
    return off(best) < same_height * std::abs(y) ? std::optional(best) : std::nullopt;
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
  return ranges::any_of(branches, [](const orbit::Branch& branch) {
    return ranges::any_of(branch.points, [](const Solution& point) { return point.impacts > 0; });
  });
}

/// The lines of a branch. A change of events ends those of the old sequence and begins those of the new one; a special
/// point at which the branch ends is their end, though no point of the branch is so near.
void add_lines(figure::Panel& panel, const orbit::Branch& branch, figure::Colour colour,
               const std::function<std::vector<double>(const Solution&)>& heights_of) {
  Lines lines(panel, colour);
  const auto add = [&](const orbit::SpecialPoint& special, const Solution& beside) {
    lines.add(special.value, heights_of(special.solution), beside);
  };
  auto special = branch.special.begin();
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const Solution& here = branch.points[i];
    for (; special != branch.special.end() && begins_at(branch, *special); ++special)
      if (special->solution.orbit.legs() == here.orbit.legs()) add(*special, here);
    lines.add(here.orbit.parameter(), heights_of(here), here);
    for (; special != branch.special.end() && special->after == i; ++special) {
      const bool before = special->solution.orbit.legs() == here.orbit.legs();
      if (orbit::goes_on(branch, *special))
        add(*special, before ? here : branch.points[i + 1]);
      else if (before && i + 1 == branch.points.size())
        add(*special, here);
    }
  }
  lines.flush();
}

/// The n-p that most of a branch's orbits have; ".." if there are others.
std::string class_of(const orbit::Branch& branch) {
  std::vector<std::pair<long, std::string>> counts;
  for (const Solution& point : branch.points) {
    const std::string n = point.orbit.shape.n > 0 ? std::to_string(point.orbit.shape.n) : "free";
    const std::string label = n + "-" + (point.chatter ? "inf" : std::to_string(point.impacts));
    const auto seen = ranges::find(counts, label, &std::pair<long, std::string>::second);
    if (seen == counts.end())
      counts.emplace_back(-1, label);
    else
      --seen->first;
  }
  if (counts.empty()) return "";
  return ranges::min_element(counts, {}, &std::pair<long, std::string>::first)->second +
         (counts.size() > 1 ? " .." : "");
}

/// Styles, special points, then branches.
std::vector<figure::Key> keys(const std::vector<orbit::Branch>& branches, const figure::Panel& panel, bool settled) {
  std::vector<figure::Key> all;
  for (const auto& [dash, words] : {std::pair{figure::Dash::solid, "stable"}, {figure::Dash::dashed, "unstable"}})
    if (ranges::find(panel.lines, dash, &figure::Line::dash) != panel.lines.end())
      all.push_back({.label = words, .dash = dash});
  if (settled)
    all.push_back({.label = "settles", .colour = settled_colour, .marker = figure::Marker::disc, .size = 0.6});
  for (const figure::Key& key : special_keys(panel)) all.push_back(key);
  for (std::size_t b = 0; b < std::min(branches.size(), most_named_branches) && branches.size() > 1; ++b)
    all.push_back({.label = std::to_string(b + 1) + ": " + class_of(branches[b]),
                   .colour = branch_colour(b),
                   .size = 1.4,
                   .group = 2});
  return all;
}

}  // namespace

figure::Figure branch_figure(const std::vector<orbit::Branch>& branches, const BranchAxes& axes,
                             const orbit::Problem& problem, const SettledMotions& beneath) {
  const bool speeds = beneath.speeds || have_impacts(branches);
  const auto heights_of = [&](const Solution& solution) {
    return axes.y ? std::vector{axes.y(solution)} : heights(problem, solution, speeds);
  };
  figure::Panel panel{.x_label = axes.x_label,
                      .y_label = speeds ? with_unit("impact speed {/:Italic w}", axes.speed)
                                        : with_unit("first coordinate at the events", axes.place)};
  if (axes.y) panel.y_label = axes.y_label;
  panel.legend = figure::Legend::below;
  panel.x_range = figure::Range{axes.range.from, axes.range.to};
  if (axes.y_range) panel.y_range = figure::Range{axes.y_range->from, axes.y_range->to};
  if (!beneath.cloud.x.empty()) panel.points.push_back(beneath.cloud);
  std::vector<std::size_t> first_line;  // of each branch
  std::vector<SpecialPlace> specials;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    first_line.push_back(panel.lines.size());
    add_lines(panel, branches[b], branches.size() > 1 ? branch_colour(b) : figure::colours::black, heights_of);
    for (const orbit::SpecialPoint& point : branches[b].special)
      specials.push_back({point.type, point.value, heights_of(point.solution).front()});
  }
  add_special_points(panel, specials);
  panel.keys = keys(branches, panel, !beneath.cloud.x.empty());
  if (branches.size() > 1) add_branch_numbers(panel, first_line);
  figure::Figure figure;
  figure.panels.push_back(std::move(panel));
  figure.caption = std::string("stable: solid; unstable: dashed; ") +
                   (axes.y ? "" : "special points at the fastest impact; ") + "numbers: the branch (BR) of the table";
  return figure;
}

}  // namespace slapstick::app
