#pragma once
/// Special points between two points of a branch: found by a change of sign, refined on the branch.
#include "change/change.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// Those that leave the sequence of events as it is: LP, PD, NS, BP, in the order in which the branch meets them.
[[nodiscard]] std::vector<SpecialPoint> smooth_special_points(const Problem& problem, const PathPoint& from,
                                                              const PathPoint& to, double range);

/// The first point at which the orbit ceases to be a motion.
[[nodiscard]] std::optional<Change> find_change(const Problem& problem, const PathPoint& from, const PathPoint& to,
                                                double length, double range);

/// The function whose zero a special point is.
[[nodiscard]] double defining(const SpecialPoint& point, const Watched& watched);

}  // namespace slapstick::orbit
