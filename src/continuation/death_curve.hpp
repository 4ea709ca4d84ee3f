#pragma once
/// The locus of a death (change/death.hpp) in two parameters.
///
/// The orbit's own equations are singular there, those of the death are regular: with one parameter more they have a
/// curve of solutions, which is followed by arclength.
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// One way from a point that has a death. @param sign  1: at first with the second parameter growing, -1: falling
[[nodiscard]] Curve death_curve(const Problem& problem, const SpecialPoint& point, const CurveOptions& options,
                                double sign);

}  // namespace slapstick::orbit
