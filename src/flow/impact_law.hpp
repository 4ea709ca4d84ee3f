#pragma once
/// What an impact does to the velocities: momentum through the stops, no impulse from friction or springs.
///
/// Newton, one stop: u+ = u- - (1 + r) v M^{-1} g^T / (g M^{-1} g^T), v = g u- > 0 towards the stop; afterwards
/// g u+ = -r v.
///
/// Moreau, the stops i in contact at once, D_ij = g_i M^{-1} g_j^T, impulses P_i:
///     0 <= P,   v+ + r v <= 0,   P . (v+ + r v) = 0,   v+ = v - D P,
/// a linear complementarity problem with D positive semidefinite: Lemke's method. A stop that is pressed by another's
/// impulse transmits it; one that would be pulled is left alone. The energy does not grow if all r are equal.
///
/// Source: Moreau (1988); Glocker (2001), Set-Valued Force Laws, chapter 9; Cottle, Pang and Stone (1992), section 4.4.
#include <span>

#include "flow/compiled_system.hpp"

namespace slapstick::flow {

/// Newton's law at one stop; its velocity is set, not computed: exactly -r v.
void strike(const CompiledSystem& system, int stop, double restitution, double* X);

/// Moreau's law at stops with gap = 0, any sign of their velocities.
/// @param hit  out: true for each stop of `stops` that got an impulse
/// @returns false if the problem has no solution (then X is unchanged)
bool strike_together(const CompiledSystem& system, std::span<const int> stops, double* X, std::span<bool> hit);

/// A blow from outside has pushed closed stops: those that it presses bear it, the others are let go. Moreau's law with
/// r = 0, since none of them was approached; X and `hit` as in `strike_together`.
bool bear(const CompiledSystem& system, std::span<const int> stops, double* X, std::span<bool> hit);

/// Brings all these stops to rest, separating ones too: the end of their bouncing, D P = v, with P of least norm.
void bring_to_rest(const CompiledSystem& system, std::span<const int> stops, double* X);

}  // namespace slapstick::flow
