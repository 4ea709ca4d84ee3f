#pragma once
/// The certified root kernel: the first zero of one guard polynomial on one window. Knows no mechanics.
///
/// A guard h is positive while its mode lasts. On a window it is the polynomial sum a_n x^n, x in [0, 1], plus an error
/// (rounding of the coefficients, rounding of the evaluation, remainder of the series) that is at most
///     noise(x) = noise_0 + noise_1 x + noise_2 x^2.
/// The kernel never samples for sign changes. Every step rests on a bound:
///   - all Bernstein coefficients above the noise: h > 0 on the whole window (convex hull property);
///   - h'' >= m on the window (m: least Bernstein coefficient of h''): then h(x + d) >= h + h' d + m d^2 / 2, and the first
///     positive zero of the parabola is not past the first zero of h;
///   - near a graze, h'' >= kappa > 0 on an interval that is proven to hold exactly one minimum.
/// The reasoning is written out in docs/certainty.md.
#include "slapstick/event/window.hpp"

namespace slapstick::event {

enum class RootKind {
  none,      ///< no zero in (0, x_end]
  crossing,  ///< h > 0 before x, a certified change of sign at x
  graze,     ///< h > 0 before x; its minimum at x is zero within the noise, so touch and miss cannot be told apart
  restart    ///< h > 0 before x, and x is too close to the window's end to decide: start a new window at x
};

struct Root {
  RootKind kind = RootKind::none;
  double x = 0.0;
  bool falls = false;  ///< h' < 0 is proven on the whole window (only ever set with a crossing)
};

/// What the kernel needs to know of a guard on a window.
struct GuardWindow {
  Coefficients taylor;     ///< a_n
  Coefficients bernstein;  ///< Bernstein coefficients of the same polynomial on [0, 1]
  double noise_0 = 0.0, noise_1 = 0.0, noise_2 = 0.0;
  /// The start is a zero of this order: a_0 = ... = a_{order-1} = 0 (the caller has set them) and a_order > 0, by at least eight times
  /// its own rounding error.
  int order = 0;
};

/// True if the Bernstein coefficients prove h > 0 on (0, 1]: those from `order` on exceed `noise`. Costs 24 comparisons.
bool excluded(const Coefficients& bernstein, double noise, int order);

/// The first zero of the guard in (0, x_end], 0 < x_end <= 1.
/// Cost: about five evaluations for a simple zero, two to four for a certified miss. `evaluations` is increased by them.
Root first_root(const GuardWindow& guard, double x_end, long& evaluations);

}  // namespace slapstick::event
