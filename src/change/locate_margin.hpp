#pragma once
/// Where a margin of an orbit is used up between two points of a branch.
#include "orbit/path.hpp"

namespace slapstick::orbit {

/// The zero of margin `test` between two points of a branch, at which its signs differ.
[[nodiscard]] std::optional<Located> locate_margin(const Problem& problem, const PathPoint& from, const PathPoint& to,
                                                   double length, double range, std::size_t test);

}  // namespace slapstick::orbit
