#pragma once
/// Sliders that a motion has drawn until they are just not drawn any more.
///
/// As a motion settles, each slip of such a slider is shorter than the one before. The cycle that is left is the end of
/// a family: with the slider farther from its limit it is a cycle too. At the end itself rounding says whether the
/// slider slips in the cycle, and so whether the map's derivative knows where it rests.
#include <optional>

#include "section/return_map.hpp"

namespace slapstick::section {

/// @param x  a fixed point of the map of n points, as Newton's method leaves it
/// @param scale  as of section::distance
/// @returns the point with such sliders clear of their limits: in its cycle they rest; empty if there are none
/// Cost: none for a model without sliders, else some cycles
[[nodiscard]] std::optional<Eigen::VectorXd> clear_of_limits(const ReturnMap& map, const Eigen::VectorXd& x, int n,
                                                             const Eigen::VectorXd& scale, Stop stop);

}  // namespace slapstick::section
