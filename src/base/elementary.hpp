#pragma once
/// The elementary functions, the same bits on every machine: of + - x /, square root and exact operations (floor, scaling by powers of two) alone.
///
/// Each is computed as a double-double and rounded once. Its relative error before that is below 2^-80, so that the result is the nearest double but
/// where the true value is within 2^-27 of an ulp of the middle between two: error below (1/2 + 2^-27) ulp. Where the result is subnormal it is
/// rounded twice: below 1 ulp. Special values are those of C (Annex F). A call costs about a microsecond: they are for models and formulas, not for windows.
///
/// Sources of the error (elementary.cpp): double_double.hpp bounds each operation by 15 u^2 < 2^-102, a Horner's rule of 30 steps by 2^-96, the series are
/// cut below 2^-108. Largest is that of x^y: an error of 2^-96 in ln x times |y ln x| <= 746, 2^-86.
namespace slapstick::fixed {

double exp(double x);
double ln(double x);
double log2(double x);
double log10(double x);
double power(double x, double y);
/// The cube root of x >= 0, to 4 ulps.
double cube_root(double x);

double sin(double x);
double cos(double x);
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
