#pragma once
/// Bifurcation curves over a map: found from the map's own boundaries, each followed as `curve` follows it.
///
/// An edge is a pair of neighbouring pixels of different classes. The classes with most edges that no curve explains go
/// first. At one of their edges the cycle of one pixel is followed towards the other; the special point between the two
/// pixels is followed in both parameters. A curve is kept if the pixels on its two sides differ along most of it. An
/// edge is explained by a curve that passes within a pixel of it. What is left is counted.
#include <atomic>
#include <string>
#include <vector>

#include "figure/figure.hpp"
#include "map_options.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::app {

struct ChartCurve {
  orbit::SpecialType type = orbit::SpecialType::PD;
  std::string from{}, to{};  ///< classes of the two pixels between which it was found
  std::vector<double> x{}, y{};  ///< its points that are motions; NaN between pieces
  long edges = 0;            ///< that it explains, and no curve before
  /// Places along the curve, a pixel apart: where the pixels on both sides differ, and where they are alike.
  long differ = 0, alike = 0;
};

struct ChartCurves {
  std::vector<ChartCurve> curves;
  long edges = 0;      ///< of the whole map, with a cycle on one side at least
  long explained = 0;  ///< by some curve
  long without = 0;    ///< edges tried at which no curve was found, or none that is kept
  bool stopped = false;
};

/// Of a map with start = reset.
/// @param most  curves
[[nodiscard]] ChartCurves find_curves(const MapWish& wish, const sweep::Map& map, int most, const std::atomic<bool>& stop);

/// Draws them over every panel of a chart, in a style for each type.
void draw_curves(const ChartCurves& found, figure::Figure& chart);

/// A line for each curve and one for what is left, on standard error.
void report_curves(const ChartCurves& found);

}  // namespace slapstick::app
