#pragma once
/// Complete chatter: proof that infinitely many impacts follow in finite time, and their limit.
///
/// Just after an impact of a stop let the pair separate with speed v and let y be its displacement beyond the stop
/// (y <= 0). In flight
///     y'' = R(X) + phi   while it rises (w < 0),      y'' = R(X) - phi   while it returns (w > 0),
/// with R = row . X the acceleration without friction (R > 0 presses onto the stop), the forces of compliant stops and
/// characteristics in it, and phi = f_k N g M^{-1} g^T if a friction contact acts on the same pair. N is its normal
/// force, or 1. A contact that slips all the while, on a belt or on another pair, adds -s f_k N to R; one that may come
/// to rest may push by up to f_s N either way. Over a window of length D every component of X stays within a bound
/// Delta of its start: Delta is verified as
///     D (|A| |X| + f + |A| Delta) + J <= Delta,   J = total of the impulses still to come,
/// which bounds R and the loads: R +- phi changes by no more than delta, that of R and the sum of f_s |N - N_0|.
/// max(N, 0) changes by no more than N, so a load may end meanwhile. With a_rise in R_0 + phi +- delta and a_return in
/// R_0 - phi +- delta, consecutive speeds shrink by at least rho = r sqrt(a_return_max / a_rise_min), and all flights
/// together last at most
///     T <= v (1/a_rise + 1/sqrt(a_rise a_return))_max / (1 - rho).
/// If rho < 1, T <= D and friction cannot hold the pair off the stop (R_0 - delta > static friction), chatter is
/// proven complete. The same series with the smallest and largest accelerations encloses the limit time.
/// Here |A| is the greater of that without contact forces and that of the mode of the flight, so that compliant and
/// closed stops elsewhere are in it. Another closed stop that acts on the pair refuses the proof, since the impacts
/// strike it too. So does any other stop, rigid or compliant, that could be reached or left within Delta, as the second
/// side of a narrow clearance. So does a compliant stop on the pair whose force could leave its line.
/// A characteristic whose force is continuous may pass a corner: its force changes by no more than its steepest piece
/// makes of Delta.
///
/// Several stops that are struck at one instant and do not act on each other, as those of equal machines, are proven
/// together. Delta then has the impulses of all of them, D is the longest of theirs, and each has its own R, rho and T:
/// one limit is told if the enclosures of all of them lie within its error.
///
/// Source: docs/developers/proofs.md; Nordmark and Piiroinen (2009), Budd and Dux (1994).
#include <cmath>
#include <span>

#include "flow/compiled_system.hpp"

namespace slapstick::flow {

struct ChatterLimit {
  bool proven = false;
  double duration = 0.0;  ///< time from the impact to the limit, of several stops to the last
  double error = 0.0;     ///< bound on the error of `duration`
  /// its impacts may move a friction contact of another pair through its rest, a load through zero or a characteristic
  /// past a corner: any force is allowed for, and events of these are not told
  bool shaken = false;
};

/// No chatter is proven whose first flight begins faster than this times the acceleration R: the error of the limit
/// is about duration^2 / period.
[[nodiscard]] inline double fastest_chatter(double tolerance) { return 100.0 * std::sqrt(tolerance); }

/// Whether `prove_chatter` looks any further than at the speed.
[[nodiscard]] bool slow_enough(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X,
                               double tolerance);

/// @param here the mode of the flight that begins at X
/// @param stops just struck, none of which acts on another
/// @param X extended state just after the impacts of `stops` (gap = 0, separating).
/// @param tolerance largest acceptable error of the limit time, in time units.
/// @param scratch at least 4 m doubles.
/// @returns proven = false if chatter is not complete, or not provable from this impact on, or its limit not yet
/// known
///          to `tolerance`: the caller goes on bounce by bounce and asks again. Cost: one row product when the chatter
///          is still too high to be summed, else four products with |A|; up to 4 d where its impacts reach
///          bodies at rest through chains.
ChatterLimit prove_chatter(const CompiledSystem& system, const mode::Mode& here, std::span<const int> stops,
                           const double* X, double tolerance, std::span<double> scratch);

}  // namespace slapstick::flow
