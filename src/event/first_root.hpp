#pragma once
/// The certified root kernel: the first zero of one guard on one window. Knows no mechanics.
///
/// A guard h is positive while its mode lasts. On a window it is sum a_n x^n, x in [0, 1], and if the window starts at
/// a zero of h of order p (an event just happened), that zero is divided out: the kernel sees g = h / x^p, which has
/// the signs and zeros of h on (0, 1]. The kernel never samples for sign changes. Every step rests on a bound:
///   - the hull of g (event/hull.hpp) is above its error: g > 0 on the whole window;
///   - g'' >= m on an interval: then g(x + d) >= g + g' d + m d^2 / 2 on it, and the first zero of g is not before the
///     parabola's;
///   - g'' <= M: the same from above proves that g falls through zero;
///   - where g cannot be told from its rounding error, the kernel walks on in steps too short for g to leave that band
///     unseen, until g is certainly below it (a crossing) or above it again (a graze).
/// The reasoning is written out in docs/developers/proofs.md.
#include "event/hull.hpp"

namespace slapstick::event {

enum class RootKind {
  none,      ///< g > 0 on (0, x_end]
  crossing,  ///< g > 0 before x, certainly negative behind it
  /// g > 0 before x and behind it; its minimum at x is zero within the noise, so touch and miss cannot be told apart
  graze,
  /// start a new window at x: g is zero within the noise at this one's end, and still clear of it at x; or a walk in
  /// the noise was long
  restart
};

struct Root {
  RootKind kind = RootKind::none;
  double x = 0.0;
  bool falls = false;     ///< g' < 0 is proven on the whole window (only ever set with a crossing)
  bool doubtful = false;  ///< found within the noise, from the first zero or touch of the band on
  bool lingers =
      false;  ///< with none: g is within eight times its noise from start to end; judge it anew in the next window
};

/// What the kernel needs to know of a guard on a window.
struct GuardWindow {
  Coefficients taylor;  ///< a_p, a_{p+1}, ..; a_p > 0 by at least eight times its noise
  Hull hull;            ///< of g
};

/// The first zero of g in (0, x_end], 0 < x_end <= 1. What it finds before x_end does not depend on x_end.
/// Cost: two evaluations for a zero of a guard that falls, two to four for a certified miss. `evaluations` is increased
/// by them.
Root first_root(const GuardWindow& guard, double x_end, long& evaluations);

}  // namespace slapstick::event
