#pragma once
/// The fall of a Stribeck law, exp(-x^e) over x = v / speed >= 0, approximated by a polyline.
#include <vector>

namespace slapstick {

struct StribeckFall {
  std::vector<double> at, left;  ///< corners beyond x = 0: x, and what is left of the fall there and beyond the last
  double error = 0.0;            ///< the largest of the polyline, in the unit of the fall
};

/// With nearly the same error in each piece and beyond the last corner; it falls with the square of their number.
/// @pre corners >= 1, exponent in [0.5, 10]
[[nodiscard]] StribeckFall stribeck_fall(int corners, double exponent);

}  // namespace slapstick
