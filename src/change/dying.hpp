#pragma once
/// Where a motion dies out: legs of it shrink to nothing together, and its equations become singular before they are gone.
#include <optional>
#include <vector>

#include "change/change.hpp"

namespace slapstick::orbit {

/// The polynomial through values y at places x, at 0 (Neville).
[[nodiscard]] double at_zero(const std::vector<double>& x, std::vector<double> y);

struct Death {
  double value =
      0.0;  ///< of the parameter: extrapolated from the last points of the branch in the length of a leg, to nothing
  double error = 0.0;   ///< what one point less, the first or the last, or another leg, makes of it
  std::size_t leg = 0;  ///< that leg
  Orbit longest;        ///< the orbit on the way there in which it is longest
  Orbit near;           ///< one near the death whose equations are not singular yet
};

/// Behind the last point of a branch, by its points.
/// Empty if no leg shrinks, or what is extrapolated is not near the last point.
[[nodiscard]] std::optional<Death> dies_out(const std::vector<Solution>& points);

/// Where its points are too few, by others that lie before the last.
[[nodiscard]] std::optional<Death> dies_out(const Problem& problem, const std::vector<Solution>& points, const PathPoint& last,
                                            double range);

/// How fast a leg grows in a direction of arclength.
[[nodiscard]] double growth(const Problem& problem, const PathPoint& at, const Eigen::VectorXd& direction,
                            std::size_t leg);

/// Of the legs that shrink to nothing together the one that does so most evenly.
[[nodiscard]] std::size_t dying_leg(const Problem& problem, const PathPoint& at);

/// Points of a branch, the first near the place where it dies out, each with a longer dying leg.
[[nodiscard]] std::vector<PathPoint> away_from_death(const Problem& problem, const PathPoint& near, double range,
                                                     std::size_t most);

/// Where several legs are gone at a change, its place is told by their lengths at points ever nearer to it as well: the better known is taken.
/// @param from  one of the branch's last points
void sharpen_death(const Problem& problem, const std::vector<Solution>& points, const PathPoint& from, double range, Change& change);

}  // namespace slapstick::orbit
