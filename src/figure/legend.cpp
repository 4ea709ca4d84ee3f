/// Where the legend goes: the emptiest corner, or above the frame.
#include <algorithm>
#include <array>
#include <cmath>

#include "layout.hpp"
#include "text.hpp"

namespace slapstick::figure {
namespace {

struct Corner {
  Legend legend;
  bool right, top;
};
constexpr std::array<Corner, 4> corners{{{Legend::top_right, true, true},
                                         {Legend::top_left, false, true},
                                         {Legend::bottom_right, true, false},
                                         {Legend::bottom_left, false, false}}};

/// The size of the legend as a share of the frame.
struct Share {
  double across = 0, up = 0;
};

Share legend_share(const Panel& panel, const PanelLayout& layout, double em_cm) {
  double widest = 0;
  for (const auto& points : panel.points) widest = std::max(widest, width_em(points.label));
  for (const auto& line : panel.lines) widest = std::max(widest, width_em(line.label));
  for (const auto& key : panel.keys) widest = std::max(widest, width_em(key.label));
  const double em = em_cm * spacing::legend_font;
  return {(widest + 4.2) * em / layout.frame.width(), (legend_entries(panel) * 1.3 + 0.8) * em / layout.frame.height()};
}

/// How often data fall into each corner.
class Crowd {
 public:
  Crowd(const PanelLayout& layout, Share share) : layout_(layout), share_(share) {}

  void point(double x, double y) { place(layout_.x.place(x), layout_.y.place(y)); }

  /// Of a mark what is drawn over the legend: lines through the whole frame, and labels.
  void mark(const Mark& mark) {
    constexpr int samples = 64;
    if (mark.x_end || (!mark.x && !mark.y)) return;
    if (mark.x && mark.y) return point(*mark.x, *mark.y);
    for (int k = 0; k <= samples; ++k) {
      const double f = static_cast<double>(k) / samples;
      mark.x ? place(layout_.x.place(*mark.x), f) : place(f, layout_.y.place(*mark.y));
    }
  }

  void line(const Line& line) {
    constexpr int samples = 16;
    for (std::size_t i = 1; i < line.x.size(); ++i)
      for (int k = 0; k <= samples; ++k) {
        const double f = static_cast<double>(k) / samples;
        point(line.x[i - 1] + f * (line.x[i] - line.x[i - 1]), line.y[i - 1] + f * (line.y[i] - line.y[i - 1]));
      }
  }

  Legend free_corner() const {
    const auto free = std::find(inside_.begin(), inside_.end(), 0L);
    return free == inside_.end() ? Legend::above : corners[free - inside_.begin()].legend;
  }

 private:
  /// A place as shares of the frame.
  void place(double across, double up) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const double from_side = corners[i].right ? 1 - across : across, from_end = corners[i].top ? 1 - up : up;
      if (from_side >= 0 && from_side <= share_.across && from_end >= 0 && from_end <= share_.up) ++inside_[i];
    }
  }

  const PanelLayout& layout_;
  Share share_;
  std::array<long, 4> inside_{};
};

}  // namespace

std::optional<Colour> colour_of_both(const Panel& panel) {
  std::vector<Colour> named;
  for (const auto& points : panel.points)
    if (!points.label.empty() && in_raster(points)) named.push_back(points.colour);
  if (named.size() != 2 || !wants_raster(panel)) return std::nullopt;
  const auto ink = [](int a, int b) { return static_cast<std::uint8_t>(a * b / 255); };  // as inks, figure/raster.hpp
  return Colour{ink(named[0].red, named[1].red), ink(named[0].green, named[1].green),
                ink(named[0].blue, named[1].blue)};
}

int legend_entries(const Panel& panel) {
  const auto named = [](const auto& series) { return !series.label.empty(); };
  return (colour_of_both(panel) ? 1 : 0) + static_cast<int>(panel.keys.size()) +
         static_cast<int>(std::count_if(panel.points.begin(), panel.points.end(), named) +
                          std::count_if(panel.lines.begin(), panel.lines.end(), named));
}

Legend place_legend(const Panel& panel, const PanelLayout& layout, double em_cm) {
  if (legend_entries(panel) == 0) return Legend::none;
  if (panel.legend != Legend::automatic) return panel.legend;
  const Share share = legend_share(panel, layout, em_cm);
  if (!panel.insets.empty() || share.across > 0.6 || share.up > 0.5) return Legend::above;
  Crowd crowd(layout, share);
  for (const auto& points : panel.points)
    for (std::size_t i = 0; i < points.x.size(); ++i) crowd.point(points.x[i], points.y[i]);
  for (const auto& line : panel.lines) crowd.line(line);
  for (const auto& mark : panel.marks) crowd.mark(mark);
  return crowd.free_corner();
}

}  // namespace slapstick::figure
