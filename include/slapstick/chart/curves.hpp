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

#include "slapstick/chart/chart.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::chart {

struct FoundCurve {
  orbit::SpecialType type = orbit::SpecialType::PD;
  std::string from{}, to{};      ///< classes of the two pixels between which it was found
  std::vector<double> x{}, y{};  ///< its points that are motions; NaN between pieces
  long edges = 0;                ///< that it explains, and no curve before
  /// Places along the curve, a pixel apart: where the pixels on both sides differ, and where they are alike.
  long differ = 0, alike = 0;
};

struct Curves {
  std::vector<FoundCurve> curves;
  long edges = 0;      ///< of the whole map, with a cycle on one side at least
  long explained = 0;  ///< by some curve
  long without = 0;    ///< edges tried at which no curve was found, or none that is kept
  bool stopped = false;
};

/// Of a map with start = reset, complete or not; a refined one has all of its edges too.
/// @param most  curves
/// @param stop  when set, what was found so far comes back
/// @throws InputError for another start
[[nodiscard]] Curves find_curves(const Chart& chart, const sweep::Map& map, int most,
                                 const std::atomic<bool>* stop = nullptr);

}  // namespace slapstick::chart
