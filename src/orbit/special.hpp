#pragma once
/// Special points between two points of a branch: found by a change of sign, refined on the branch.
#include "orbit/path.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::orbit {

/// Those that leave the sequence of events as it is: LP, PD, NS, BP, in the order in which the branch meets them.
[[nodiscard]] std::vector<SpecialPoint> smooth_special_points(const Problem& problem, const PathPoint& from,
                                                              const PathPoint& to, double range);

/// The first point at which the orbit ceases to be a motion.
struct Change {
  SpecialPoint special;
  PathPoint at;
  double length = 0.0;  ///< from `from` to there
  TestValue test;
  std::optional<Solution>
      nearby;  ///< where several legs are gone at the change, and it may be singular: a regular orbit beside it
};
[[nodiscard]] std::optional<Change> find_change(const Problem& problem, const PathPoint& from, const PathPoint& to,
                                                double length, double range);

/// The zero of margin `test` between two points of a branch, at which its signs differ.
[[nodiscard]] std::optional<Located> locate_margin(const Problem& problem, const PathPoint& from, const PathPoint& to,
                                                   double length, double range, std::size_t test);

/// The function whose zero a special point is.
[[nodiscard]] double defining(const SpecialPoint& point, const Watched& watched);

}  // namespace slapstick::orbit
