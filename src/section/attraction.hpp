#pragma once
/// Is a motion drawn to a cycle? Decided by the rate at which the motion approaches, not by how near it has come:
/// beside a multiplier -1 + 1e-9 a motion comes no nearer for a million periods, and still has that cycle ahead.
///
/// section/approach.hpp says what a motion that is drawn loses in a stage. Stage after stage is asked for, up to 256
/// periods (points of the section) in all or until the motion is there; and at the end it must be beside the cycle,
/// within a twentieth of its size.
#include "section/point_record.hpp"
#include "section/return_map.hpp"

namespace slapstick::section {

struct Attraction {
  bool drawn = false;
  double distance = 0.0;  ///< of the motion from the cycle at the end of the trial, relative to its size
};

/// What a trial looks at. Without a record it follows the motion from where the motion stands. With one it begins at
/// the first point of the last 256 from which on the motion stays within 1e-3 of the cycle. The trial then follows the
/// motion only past the record's end.
struct Followed {
  const PointRecord* record = nullptr;  ///< whose last point is where the motion stands
  const Motion& motion;                 ///< at a point of the section; a copy is run
  double there = 1e-10;                 ///< of the motion's size: so near the cycle a trial ends
};

/// A trial lasts for 256 points and one stage at most.
/// @param n  points of the section in the cycle: of a driven motion forcing periods
/// @param scale  size of the motion, as of section::distance
[[nodiscard]] Attraction attraction(const ReturnMap& map, const Followed& followed, const FixedPoint& cycle, int n,
                                    const Eigen::VectorXd& scale, Stop stop);

/// Of how many dimensions is the continuum of cycles that x is a member of, or at whose end it lies? Counted are the
/// directions to whose one side at least there are other fixed points, 1e-3 of the motion's size away and half as far;
/// beside a fold there are none.
/// @param n  as of attraction. Cost: two maps, and 6 to 36 for each multiplier 1
[[nodiscard]] int family(const ReturnMap& map, const Eigen::VectorXd& x, int n, const Eigen::VectorXd& scale,
                         Stop stop);

/// Where the linear part of the map has its fixed point nearest to x, which returns almost: on a continuum of cycles
/// the member that x comes to, with an error of the order of the square of what x misses.
/// @param n  as of attraction. Cost: two maps. @throws InputError, NumericalError where the point is no motion's
[[nodiscard]] Eigen::VectorXd nearest_fixed_point(const ReturnMap& map, const Eigen::VectorXd& x, int n,
                                                  const Eigen::VectorXd& scale, Stop stop);

}  // namespace slapstick::section
