#pragma once
/// Where legs of an orbit shrink to nothing together (a *death*), by a regular system of equations.
///
/// Near a death the orbit's own equations are singular: an event makes the guard that ends a dying leg zero at the
/// leg's start, so a leg without length solves its equation whatever the orbit. With the dying legs left out the orbit
/// there is an ordinary orbit of fewer events, on which the dying legs leave touches (change/touches.hpp). Its
/// equations and
///     guard = 0 at the touch; within a leg also d guard / dt = 0
/// are regular; the parameter and the instants of touches are further unknowns. There may be more equations than
/// unknowns: touches of a symmetric orbit come in pairs, and a member of a continuum meets some equations always. The
/// Gauss-Newton method solves them and is quadratic where they hold together; where they do not there is no death.
#include <optional>
#include <vector>

#include "orbit/path.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {

struct LocatedDeath {
  Death death;
  double error = 0.0;   ///< of the parameter: what the rounding of the equations makes of it
  std::size_t leg = 0;  ///< the longest of the dying ones
};

/// Do the events and the touches lie in order still? A cycle without events may begin anywhere.
[[nodiscard]] bool in_order(const Death& death);

/// The death near an orbit of a branch.
/// @param dying  of each leg of `near`: does it die?
/// @returns empty if what remains is no orbit of a shorter sequence, if its equations do not determine the parameter or
///          do not hold together, or if the solution is not near
[[nodiscard]] std::optional<LocatedDeath> death_near(const Problem& problem, const Orbit& near,
                                                     const std::vector<bool>& dying);

/// The death ahead of a point of a branch, of the legs that die the soonest as they shrink there.
[[nodiscard]] std::optional<LocatedDeath> death_ahead(const Problem& problem, const PathPoint& at);

/// The death at a change of events, if the margin that is used up there belongs to legs that die.
/// @param from  a point of the branch before the change
[[nodiscard]] std::optional<LocatedDeath> death_at(const Problem& problem, const PathPoint& from, const Orbit& change,
                                                   const TestValue& test);

/// How the first parameter moves with each other one where legs die, by the implicit function theorem: exact. Not a
/// number where another parameter parts what vanishes together.
[[nodiscard]] std::vector<double> death_rates(const Problem& problem, const Death& death);

}  // namespace slapstick::orbit
