/// Draws the picture of a motion.
#include "motion_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ranges.hpp"

namespace slapstick::app {
namespace {

namespace colours = figure::colours;
using Phase = MotionRecord::Phase;
using figure::Marker;

constexpr figure::Colour stick_colour = colours::grey, touch_colour = colours::sky_blue;

struct MomentSign {
  EventKind kind;
  const char* words;
  Marker marker;
  double diameter_mm;
};
constexpr std::array moment_signs{MomentSign{EventKind::impact, "impact", Marker::disc, 0.8},
                                  MomentSign{EventKind::graze, "graze", Marker::diamond, 1.1},
                                  MomentSign{EventKind::chatter, "end of a chatter", Marker::triangle, 1.1}};

/// The coordinates of one panel.
class View {
 public:
  View(const MotionRecord& record, const ShownPanel& panel)
      : record_(record), panel_(panel), base_(named_base(record) ? 0.0 : static_cast<double>(record.base())) {}

  /// From this many periods on an axis would have more digits than it has room for: its name has them then.
  static bool named_base(const MotionRecord& record) { return record.base() >= 100'000; }

  [[nodiscard]] bool over_time() const { return panel_.x == ShownPanel::time; }
  [[nodiscard]] double time(double t) const { return base_ + t; }
  [[nodiscard]] double x(double t, const std::vector<double>& numbers) const {
    return over_time() ? time(t) : numbers[static_cast<std::size_t>(panel_.x)];
  }
  [[nodiscard]] double y(const std::vector<double>& numbers) const {
    return numbers[static_cast<std::size_t>(panel_.y)];
  }

  /// Where the numbers of this panel do not jump, the line goes on.
  [[nodiscard]] figure::Line curve() const {
    figure::Line line{.colour = colours::dark_blue, .width_pt = 0.6};
    const std::vector<double>& t = record_.times();
    const std::vector<double>& y = record_.values(panel_.y);
    const std::vector<double>& x = over_time() ? t : record_.values(panel_.x);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const bool jump = std::isnan(t[i]) && i > 0 && i + 1 < t.size();
      if (jump && x[i - 1] == x[i + 1] && y[i - 1] == y[i + 1]) continue;
      line.x.push_back(over_time() ? time(x[i]) : x[i]);
      line.y.push_back(y[i]);
    }
    constexpr std::size_t crowded = 5000;
    if (!over_time() && line.x.size() > crowded) line.width_pt = 0.35;
    return line;
  }

  [[nodiscard]] figure::Line jumps() const {
    figure::Line line{.colour = colours::light_grey, .width_pt = 0.5};
    for (const MotionRecord::Moment& moment : record_.moments()) {
      const double x0 = x(moment.t, moment.before), x1 = x(moment.t, moment.after);
      if (x0 == x1 && y(moment.before) == y(moment.after)) continue;
      if (!line.x.empty()) line.x.push_back(std::nan("")), line.y.push_back(std::nan(""));
      line.x.insert(line.x.end(), {x0, x1});
      line.y.insert(line.y.end(), {y(moment.before), y(moment.after)});
    }
    return line;
  }

  [[nodiscard]] figure::Points marked(const MomentSign& sign) const {
    figure::Points points{.colour = colours::vermillion,
                          .drawing = figure::Drawing::discs,
                          .diameter_mm = sign.diameter_mm,
                          .marker = sign.marker,
                          .over_lines = true};
    for (const MotionRecord::Moment& moment : record_.moments()) {
      if (!moment.ours || moment.kind != sign.kind) continue;
      points.x.push_back(x(moment.t, moment.before));
      points.y.push_back(y(moment.before));
    }
    constexpr std::size_t many = 150, crowd = 1000;
    if (points.x.size() > many) points.diameter_mm *= points.x.size() > crowd ? 0.4 : 0.65;
    return points;
  }

  /// In a phase portrait a contact that sticks or rests is a place; on a belt it is not.
  [[nodiscard]] figure::Points places(Phase phase, figure::Colour colour) const {
    figure::Points points{.colour = colour, .drawing = figure::Drawing::discs, .diameter_mm = 1.6};
    for (const MotionRecord::Stretch& stretch : record_.stretches()) {
      if (stretch.phase != phase || far(x(stretch.from, stretch.start), x(stretch.to, stretch.finish)) ||
          far(y(stretch.start), y(stretch.finish)))
        continue;
      points.x.push_back(x(stretch.from, stretch.start));
      points.y.push_back(y(stretch.start));
    }
    return points;
  }

 private:
  static bool far(double a, double b) { return std::abs(a - b) > 1e-6 * (std::abs(a) + std::abs(b)) + 1e-12; }

  const MotionRecord& record_;
  const ShownPanel& panel_;
  double base_;
};

bool has(const MotionRecord& record, Phase phase) {
  return ranges::any_of(record.stretches(), [&](const auto& stretch) { return stretch.phase == phase; });
}

/// What colours and markers mean, for the first panel.
std::vector<figure::Key> moment_keys(const MotionRecord& record) {
  std::vector<figure::Key> all;
  for (const MomentSign& sign : moment_signs)
    if (ranges::any_of(record.moments(), [&](const auto& moment) { return moment.ours && moment.kind == sign.kind; }))
      all.push_back({.label = sign.words, .colour = colours::vermillion, .marker = sign.marker, .size = 1.1});
  for (const auto& [phase, words, colour] :
       {std::tuple{Phase::sticks, "stick", stick_colour}, {Phase::touches, "contact", touch_colour}})
    if (has(record, phase))
      all.push_back({.label = words, .colour = figure::tint(colour), .marker = Marker::square, .size = 2.4});
  return all;
}

figure::Panel panel_of(const MotionRecord& record, const ShownPanel& shown) {
  const View view(record, shown);
  const auto& numbers = record.shown().numbers;
  const ShownNumber& y = numbers[static_cast<std::size_t>(shown.y)];
  figure::Panel panel{.y_label = y.label};
  if (view.over_time()) {
    panel.x_label = record.shown().time;
    if (View::named_base(record)) panel.x_label += " \u2212 " + std::to_string(record.base());
    if (record.end() > record.begin())
      panel.x_range = figure::Range{view.time(record.begin()), view.time(record.end())};
    for (const MotionRecord::Stretch& stretch : record.stretches())
      panel.marks.push_back({.x = view.time(stretch.from),
                             .x_end = view.time(stretch.to),
                             .colour = stretch.phase == Phase::sticks ? stick_colour : touch_colour});
  } else {
    const ShownNumber& x = numbers[static_cast<std::size_t>(shown.x)];
    panel.x_label = x.label;
    panel.height_share = 2;
    for (const double limit : x.limits) panel.marks.push_back({.x = limit});
    panel.points = {view.places(Phase::sticks, colours::light_grey), view.places(Phase::touches, touch_colour)};
  }
  for (const double limit : y.limits) panel.marks.push_back({.y = limit});
  panel.lines = {view.jumps(), view.curve()};
  for (const MomentSign& sign : moment_signs) panel.points.push_back(view.marked(sign));
  std::erase_if(panel.points, [](const figure::Points& points) { return points.x.empty(); });
  std::erase_if(panel.lines, [](const figure::Line& line) { return line.x.empty(); });
  panel.legend = figure::Legend::none;
  return panel;
}

}  // namespace

figure::Figure motion_figure(const MotionRecord& record) {
  figure::Figure figure{.width_cm = 12};
  const auto& panels = record.shown().panels;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    figure.panels.push_back(panel_of(record, panels[i]));
    const bool next = i + 1 < panels.size() && panels[i + 1].x == ShownPanel::time;
    figure.panels.back().joins_below = next && panels[i].x == ShownPanel::time;
  }
  figure.panels.front().keys = moment_keys(record);
  if (!figure.panels.front().keys.empty()) figure.panels.front().legend = figure::Legend::above;
  return figure;
}

}  // namespace slapstick::app
