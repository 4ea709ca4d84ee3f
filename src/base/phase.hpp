#pragma once
/// Cosine and sine of a phase: a fixed sequence of + - x, so that every processor and C library has the same bits.
///
/// With t the phase in turns, less whole quarters (exact), |t| <= 1/8:   2 pi t = y + y1,   y^2 = z + z1   (exact, or to 2^-104), and
///     sin = y + (y z S(z) + (y1 (1 - z/2) - y z1/6)),      cos = (1 - z/2) + (z^2 C(z) + rounding of (1 - z/2) - y y1 - z1/2),
/// S and C the polynomials of fdlibm (Sun Microsystems 1993), which are within 2^-58 of (sin y - y) / y^3 y^2 and (cos y - 1 + y^2/2).
/// Error, u = 2^-53, all sums of roundings of first order:
///   - sin: S 1.1 u, two products and one sum u each, of |sin y - y| <= 0.0784: 0.32 u; S itself 0.03 u; the last sum half an ulp. An ulp is u where
///     |sin| >= 1/2, and below |sin y - y| / |y| falls as y^2 / 6: at most 0.86 ulp.
///   - cos: C 1.1 u, two products and three sums u each, of z^2 C <= 0.0159: 0.10 u; C itself 0.03 u; the last sum half an ulp; an ulp is u: at most 0.64 ulp.
/// test/base/phase_test.cpp measures both against MPFR.

namespace slapstick {

struct CosineSine {
  double cosine, sine;
};

/// @param turns  any finite number; its whole part does not matter
CosineSine of_turns(double turns);

}  // namespace slapstick
