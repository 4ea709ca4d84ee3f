#pragma once
/// About where on paper a place of a panel lies: near enough to see what would lie on what in print.
#include <algorithm>
#include <cmath>
#include <limits>

#include "figure/figure.hpp"

namespace slapstick::app {

struct PlaceOnPaper {
  double x = 0.0, y = 0.0;  ///< cm from the lower left corner of the frame
};
[[nodiscard]] inline double distance(const PlaceOnPaper& a, const PlaceOnPaper& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The frame of a panel by what is in it, as one journal column shows it.
class FrameShares {
 public:
  static constexpr double width_cm = 7.0, height_cm = 4.2;

  explicit FrameShares(const figure::Panel& panel) {
    for (const figure::Points& points : panel.points) add(points.x, points.y);
    for (const figure::Line& line : panel.lines) add(line.x, line.y);
    if (panel.x_range) x_ = {panel.x_range->min, panel.x_range->max};
    if (panel.y_range) y_ = {panel.y_range->min, panel.y_range->max};
  }
  [[nodiscard]] PlaceOnPaper cm(double x, double y) const { return {width_cm * x_.share(x), height_cm * y_.share(y)}; }

 private:
  struct Extent {
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    void add(double value) {
      if (!std::isfinite(value)) return;
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
    [[nodiscard]] double share(double value) const {
      return largest > least ? (value - least) / (largest - least) : 0.5;
    }
  };
  void add(const std::vector<double>& x, const std::vector<double>& y) {
    for (const double value : x) x_.add(value);
    for (const double value : y) y_.add(value);
  }
  Extent x_, y_;
};

}  // namespace slapstick::app
