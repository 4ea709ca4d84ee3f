#pragma once
/// Is a fixed point of a return map the only one near it, as far as its own error goes?
///
/// Let mu be the real multiplier nearest to 1, and e the error of the point: Newton's next correction, or the rounding
/// of the map over 1 - mu. By Kantorovich's theorem on Newton's method there is one fixed point, and Newton's method
/// comes to it, if 1 - mu changes by less than half within e along the eigenvector. Asked for is a quarter, at both
/// ends of e only: the map's curvature is taken for constant so near, and nothing is proved.
///
/// At the end of a continuum of fixed points 1 - mu is in proportion to the distance from the end. Newton's method
/// halves that distance with each step, so that e is the half of it at least, and the condition fails all the way.
#include "section/return_map.hpp"

namespace slapstick::section {

/// Newton's method goes on until the point is seen to be isolated, or until rounding ends it.
/// @param found  a fixed point of the map of n points, stable; it is nearer to its image afterwards
/// @param scale  as of section::distance
/// Cost: none where no multiplier is within 1e-4 of 1; else three maps for each step of Newton's method
[[nodiscard]] bool isolated(const ReturnMap& map, FixedPoint& found, int n, const Eigen::VectorXd& scale, Stop stop);

}  // namespace slapstick::section
