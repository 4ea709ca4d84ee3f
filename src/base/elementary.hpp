#pragma once
/// The elementary functions, the same bits on every machine: of + - x /, square root and exact operations (floor,
/// scaling by powers of two) alone.
///
/// Each is computed as a double-double and rounded once. Its relative error before that is below 2^-75, so that the
/// result is within (1/2 + 2^-21) ulp of the true value. Where the result is subnormal it is rounded twice: below 1
/// ulp. Special values are those of C (Annex F). A call costs about a microsecond: these are for models and formulas,
/// not for windows.
///
/// Where the error comes from: an operation of double_double.hpp has at most 15 u^2 < 2^-102, Horner's rule with 30
/// falling terms less than 2^-98, and the series are cut below 2^-108. These grow by 746 = most |y ln x| in x^y, to
/// 2^-88. In acosh x, the logarithm of a number near 1, only the errors of operations grow, by 2^26 at most.
/// test/base/fixed_test.cpp compares with MPFR.
namespace slapstick::fixed {

double exp(double x);
double ln(double x);
double log2(double x);
double log10(double x);
double power(double x, double y);
/// The cube root of x >= 0, to 4 ulps (measured). For lengths of steps, which need no digits.
double cube_root(double x);

double sin(double x);
double cos(double x);
/// Both, for the price of one.
struct CosineSineOf {
  double cosine, sine;
};
CosineSineOf cosine_sine(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);

double sinh(double x);
double cosh(double x);
double tanh(double x);
double asinh(double x);
double acosh(double x);
double atanh(double x);

}  // namespace slapstick::fixed
