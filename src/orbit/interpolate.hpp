#pragma once
/// Zeros of functions along a branch at places where Newton's method may fail.
#include "orbit/path.hpp"

namespace slapstick::orbit {

/// The zero of a function of the points within `half_width` of a place, where Newton's method may fail at the zero
/// itself.
/// @param near  arclength from `from`
/// @returns empty if the branch cannot be interpolated there
[[nodiscard]] std::optional<Located> locate_between(const Problem& problem, const PathPoint& from, double near,
                                                    double half_width, double range,
                                                    const std::function<double(const PathPoint&)>& f);

}  // namespace slapstick::orbit
