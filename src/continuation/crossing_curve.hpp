#pragma once
/// The locus of a branch point in two parameters. Where orbits are symmetric it is a curve; elsewhere a crossing breaks
/// up when a parameter is moved.
///
/// At a crossing the equations of orbits are singular. Each step therefore locates it anew, by interpolation along a
/// branch (crossing.hpp), in the parameter in which the curve moves less, with the other one held.
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// One way from a point. @param sign  1: at first with the second parameter growing, -1: falling
[[nodiscard]] Curve crossing_curve(const Problem& problem, const SpecialPoint& point, const CurveOptions& options,
                                   double sign);

}  // namespace slapstick::orbit
