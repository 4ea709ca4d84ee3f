#pragma once
/// Points at which two branches cross: where they are, and the orbits beside them on the other branch.
///
/// At a BP the equations F(v) = 0, J = F', have a second null direction, so that Newton's method fails in its
/// neighbourhood. The branch itself is smooth there: it is interpolated from points to either side. With the null
/// directions phi_i of J and psi of J^T the directions of both branches solve
///     sum_ij a_ij c_i c_j = 0,    a_ij = psi . (dJ[phi_i] phi_j)
/// of which one is known. Source: Keller (1977); Govaerts (2000), chapter 8.
#include "orbit/interpolate.hpp"

namespace slapstick::orbit {

/// @param near  arclength from `from` at which the crossing is, to within 0.03
/// @returns empty if the branch cannot be interpolated there
[[nodiscard]] std::optional<Located> locate_crossing(const Problem& problem, const PathPoint& from, double near,
                                                     double range);

/// A crossing followed to other values of the parameters: the crossing near `values`, in the first of which it is
/// sought. From orbits beside it on its own branch, by arclength: a fold may be next to it.
[[nodiscard]] std::optional<Located> crossing_near(const Problem& problem, const Orbit& crossing,
                                                   const std::vector<double>& values, double range);

/// Orbits on the branch that crosses at a point, one to either side; empty if the crossing is degenerate.
[[nodiscard]] std::vector<Orbit> crossing_branch(const Problem& problem, const PathPoint& at);

}  // namespace slapstick::orbit
