#pragma once
/// First zero of a polynomial on [0, 1], in 50 digits, including zeros that only touch.
#include <optional>

#include "oracle/real.hpp"

namespace slapstick::oracle {

/// p(s) = sum_k p[k] s^k.
using Polynomial = Vector;

[[nodiscard]] Real evaluate(const Polynomial& p, const Real& s);
[[nodiscard]] Real derivative(const Polynomial& p, const Real& s);
/// sum_k |p[k]|, a bound of |p| on [0, 1].
[[nodiscard]] Real magnitude(const Polynomial& p);

struct Root {
  Real s;
  bool touch = false;  ///< a minimum within `tolerance` of zero; the polynomial does not change its sign there
};

/// The first zero of p on [0, 1], where p is positive before 0.
///
/// Method: bisection of the interval until the sums of |p[k]| prove one of: no zero; p monotone; p convex or concave.
/// Then the zero (or the minimum) is unique and safeguarded Newton iteration finds it. A touch is reported if
/// `report_touch`, else passed over. A zero closer to 1 than `tolerance` can tell is left to the polynomial of the next
/// step, where it may lie a rounding before 0 and s < 0 is returned.
/// @return s to about 1e-47 relative for a crossing; a touch is located as the zero of p', equally sharp.
[[nodiscard]] std::optional<Root> first_root(const Polynomial& p, const Real& tolerance, bool report_touch);

}  // namespace slapstick::oracle
