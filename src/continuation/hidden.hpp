#pragma once
/// Special points that a step from one point of a branch to the next can hide.
#include "orbit/path.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// Do the special points between two points of a branch account for the multipliers that have passed the unit circle?
/// Where a pair of special points of one type lies between them, their test functions show nothing.
[[nodiscard]] bool explained(const Watched& from, const Watched& to, const std::vector<SpecialPoint>& between);

/// Three points of a branch, and the arclengths from the first to the second and on to the third.
struct Triple {
  const PathPoint& first;
  const PathPoint& second;
  const PathPoint& third;
  double back, ahead;
};
/// A test function that comes near zero and turns back may have passed it twice.
struct Pair {
  std::vector<SpecialPoint> points;
  bool earlier = false;  ///< between the first and the second; else between the second and the third
};
/// Looks at the vertex of the parabola through three neighbouring values.
[[nodiscard]] Pair pair_within(const Problem& problem, const Triple& triple, double range);

/// A step with no other of its events beside it: by its middle.
[[nodiscard]] std::vector<SpecialPoint> within_halves(const Problem& problem, const PathPoint& from,
                                                      const PathPoint& to, double length, double range);

/// Those between a point and a change of events at `length` from there. An impact that loses its speed lets a
/// multiplier grow without bound: one that doubles lies close by. Where a leg shrinks to nothing the equations are
/// singular: not so close.
[[nodiscard]] std::vector<SpecialPoint> beside_change(const Problem& problem, const PathPoint& from, double length,
                                                      double range);

}  // namespace slapstick::orbit
