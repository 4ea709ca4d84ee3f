#pragma once
/// Cosine and sine of a phase: a fixed sequence of + - x, so that every processor and C library has the same bits.
///
/// With t the phase in turns, less whole quarters (exact), |t| <= 1/8:
///     2 pi t = y + y1    to 2^-104,             y^2 = z + z1    exactly,
///     sin = y + (y z S(z) + (y1 (1 - z/2) - y z1/6)),
///     cos = (1 - z/2) + (z^2 C(z) + r - y y1 - z1/2),     r what 1 - z/2 was rounded by, exactly,
/// S and C the polynomials of fdlibm (Sun Microsystems 1993): y + y z S and 1 - z/2 + z^2 C are within 2^-58 of sin y
/// and cos y. The other errors, u = 2^-53, to first order:
///   - sin: S has 1.1 u, two products and one sum u each, of |sin y - y| <= 0.0784: 0.32 u in all. With the
///     polynomial's 0.03 u and half an ulp of the last sum that is 0.85 ulp where |sin| >= 1/2, an ulp being u. Below,
///     an ulp is at least u |sin| and |sin y - y| / |sin y| <= 0.048: less.
///   - cos: C has 1.1 u, two products and three sums u each, of z^2 C <= 0.0159: 0.10 u in all. With the polynomial's
///     0.03 u and half an ulp of the last sum that is 0.63 ulp: an ulp is u.
/// What is of second order, and the terms of y1 that are left out (y1 y^4 / 24), are below 0.01 u together. Either is
/// within 0.86 ulp of the true value. test/base/fixed_test.cpp measures it against MPFR.

namespace slapstick {

struct CosineSine {
  double cosine, sine;
};

/// @param turns  any finite number; its whole part does not matter
CosineSine of_turns(double turns);

}  // namespace slapstick
