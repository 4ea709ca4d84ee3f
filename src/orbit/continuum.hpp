#pragma once
/// Continua of orbits at the same parameters: whether an orbit is one of a family, proved by the null vectors of its
/// equations.
///
/// A multiplier 1 makes the equations F(v) = 0 at fixed parameters singular. That alone says little: at a fold it is a
/// point, and beside a fold it is almost so. With the null vectors V of F_v and W of its transpose the bordered
/// equations
///     F(v) + W mu = 0,   V^T (v - v_0) = s
/// have a regular solution v(s), mu(s) (Lyapunov and Schmidt). At a fold mu grows as s^2, at a crossing as s^3; orbits
/// beside the orbit are those with mu = 0. So the direction s is one of a family if mu is rounding at a distance where
/// s^3 is not.
///
/// A number that no leg moves, as of a slider that rests all along, is a direction of its own. The equations keep it as
/// it is (Linearised::kept), and are regular: by the implicit function theorem orbits lie along it.
#include <complex>
#include <optional>

#include "orbit/equations.hpp"

namespace slapstick::orbit {

/// The dimension of the continuum of orbits that an orbit is a member of; 0 if it is isolated.
[[nodiscard]] int continuum(const Problem& problem, const Orbit& orbit,
                            const std::vector<std::complex<double>>& multipliers);

/// `refine`; from a guess whose equations are singular, as on a family, by steps of least change: a member stays the
/// member that it is.
[[nodiscard]] std::optional<Orbit> refine_in_place(const Problem& problem, const Orbit& guess,
                                                   const std::vector<Orbit>& besides = {});

/// Are two members of families members of one? Orbits of the same events lie between them.
[[nodiscard]] bool in_one_family(const Problem& problem, const Orbit& a, const Orbit& b);

}  // namespace slapstick::orbit
