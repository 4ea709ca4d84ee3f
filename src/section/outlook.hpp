#pragma once
/// What a motion does in the mode that it is in if no event comes, and a proof that none comes.
///
/// Modulo translations, in the numbers y that the mode does not hold, y' = Q (y - y_0) + s with y_0 the state now.
///
/// *Conserved.* For a left null vector w of Q, w y grows at the constant rate w s. If that is not zero the motion goes
/// away: it has no state of rest. (If nothing else depends on w y, a guard that does not fall at this rate is
/// bounded as below.) Else w y is conserved, and the motion stays where w (y - y_0) = 0 for all w; there the same is
/// asked again, until the matrix that is left is regular. (The momentum of a free group of bodies is such a w: its
/// drift is tau (tau' M v) / (tau' M tau), tau its translation.)
/// *Limit.* In that subspace one state y* is at rest: what the motion comes to, or swings about.
/// *Amplitudes.* y - y* = sum_k a_k v_k e^(lambda_k t) by the eigenvectors of what is left.
///
/// *No event.* A guard is h(t) = h* + sum_k a_k e^(lambda_k t), so that h(t) >= sum_j c_j e^(sigma_j t) with c_j = h*
/// at sigma = 0, c_j = a_k for a real lambda_k with a_k > 0, and c_j = -|a_k| otherwise. Let C_j = c_1 + .. + c_j be
/// the sums in the order of falling sigma. By Abel's summation
///     sum_j c_j e^(sigma_j t) = sum_j C_j (e^(sigma_j t) - e^(sigma_(j+1) t)) + C_last e^(sigma_last t),
/// a sum that is not negative for any t >= 0 if no C_j is. This covers decay towards a rest on this side of the guard,
/// swings without loss, a slow approach to a rest on the guard, and growth away from it.
///
/// Eigenvalues are known to 8 N u |Q| / |w_k v_k| (w_k, v_k of length one), Q balanced first, so that a double zero has
/// its square root of u and units do not count. Within that a real part is zero; an exponent counts as that much more
/// where its term is negative, and less where it is positive.
#include <complex>
#include <vector>

#include "flow/translations.hpp"

namespace slapstick::section {

struct Outlook {
  bool no_event = false;   ///< is proven
  bool goes_away = false;  ///< by a constant force or speed: there is no state of rest
  bool grows = false;      ///< exponentially
  bool drawn = false;      ///< all that is not conserved decays
  /// Nothing grows, but something swings for ever, or a displaced motion would go away at a constant speed.
  bool neutral = false;
  Eigen::VectorXd here, rest;  ///< contact states, representatives of their classes: now, and y*
  Eigen::VectorXd amplitude;   ///< of each number about `rest`, from now on
  Eigen::VectorXd rate;        ///< of `rest` along each translation, per unit of time
  /// Of what is not conserved, per unit of time, largest real part first.
  std::vector<std::complex<double>> eigenvalues;
  int family = 0;  ///< dimensions of the continuum of states of rest
};

/// Cost: O(N^3) for N numbers, some ten microseconds for one body.
[[nodiscard]] Outlook outlook(const flow::Translations& translations, const Motion& motion);

}  // namespace slapstick::section
