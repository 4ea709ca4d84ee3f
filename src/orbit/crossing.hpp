#pragma once
/// Points at which two branches cross: where they are, and the orbits beside them on the other branch.
///
/// At a BP the equations F(v) = 0, J = F', have a second null direction, so that Newton's method fails in its neighbourhood. The branch itself is
/// smooth there: it is interpolated from points to either side. With the null directions phi_i of J and psi of J^T the directions of both branches solve
///     sum_ij a_ij c_i c_j = 0,    a_ij = psi . (dJ[phi_i] phi_j)
/// of which one is known. Source: Keller (1977); Govaerts (2000), chapter 8.
#include "orbit/path.hpp"

namespace slapstick::orbit {

/// The zero of a function of the points within `half_width` of a place, where Newton's method may fail at the zero itself.
/// @param near  arclength from `from`
/// @returns empty if the branch cannot be interpolated there
[[nodiscard]] std::optional<Located> locate_between(const Problem& problem, const PathPoint& from, double near,
                                                    double half_width, double range,
                                                    const std::function<double(const PathPoint&)>& f);

/// @param near  arclength from `from` at which the crossing is, but for some 1e-4
/// @returns empty if the branch cannot be interpolated there
[[nodiscard]] std::optional<Located> locate_crossing(const Problem& problem, const PathPoint& from, double near,
                                                     double range);

/// The crossing near an orbit that is one at other values of the parameters, in the first of which it is sought.
[[nodiscard]] std::optional<Located> crossing_near(const Problem& problem, const Orbit& orbit, double range);

/// Orbits on the branch that crosses at a point, one to either side; empty if the crossing is degenerate.
[[nodiscard]] std::vector<Orbit> crossing_branch(const Problem& problem, const PathPoint& at);

}  // namespace slapstick::orbit
