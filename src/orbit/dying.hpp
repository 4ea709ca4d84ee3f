#pragma once
/// Where a motion dies out: legs of it shrink to nothing together, and its equations become singular before they are gone.
#include <optional>
#include <vector>

#include "orbit/special.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::orbit {

/// The polynomial through values y at places x, at 0 (Neville).
[[nodiscard]] double at_zero(const std::vector<double>& x, std::vector<double> y);

struct Death {
  double value =
      0.0;  ///< of the parameter: extrapolated from the last points of the branch in the length of a leg, to nothing
  double error = 0.0;      ///< what one point less, the first or the last, or another leg, makes of it
  std::size_t leg = 0;     ///< that leg
  std::size_t before = 0;  ///< a point of the branch at which it is longest
};

/// Empty if no leg shrinks, or what is extrapolated is not near the last point.
[[nodiscard]] std::optional<Death> dies_out(const Branch& branch);

/// Where several legs are gone at a change, its place is told by their lengths at points ever nearer to it as well: the better known is taken.
/// @param from  one of the branch's last points
void sharpen_death(const Problem& problem, const Branch& branch, const PathPoint& from, double range, Change& change);

}  // namespace slapstick::orbit
