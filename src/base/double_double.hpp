#pragma once
/// Numbers of about 106 bits: unevaluated sums hi + lo of two doubles, |lo| <= ulp(hi) / 2, by + - x / alone.
///
/// `long double` has 53, 64 or 113 bits, as the platform likes; this has the same bits everywhere. The error-free
/// transformations are those of Knuth (two_sum) and Dekker and Veltkamp (quick_two_sum, two_product); the operations
/// and their bounds, relative to the result, u = 2^-53, are from Joldes, Muller and Popescu, "Tight and rigorous error
/// bounds for basic building blocks of double-word arithmetic", ACM TOMS 44 (2017):
///     x + y                 3 u^2 + 13 u^3        x + double       2 u^2
///     x y                   7 u^2                 x double         3/2 u^2 + 4 u^3
///     x / y                 15 u^2 + 56 u^3       x / double       3 u^2
///     sqrt x                25/8 u^2              (Lefevre, Louvet, Muller, Picot, Rideau, ACM TOMS 49 (2023))
/// The bounds hold as long as no product is below 2^-960 or above 2^996; below, a product loses at most 2^-1070 more.
#include <cmath>

namespace slapstick {

struct DoubleDouble {
  double hi = 0.0, lo = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double x) : hi(x) {}  // NOLINT(google-explicit-constructor): a double is one
  constexpr DoubleDouble(double h, double l) : hi(h), lo(l) {}
  constexpr explicit operator double() const { return hi; }
};

/// a + b = hi + lo exactly.
constexpr DoubleDouble two_sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}

/// The same for |a| >= |b| or a = 0.
constexpr DoubleDouble quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// The upper 26 bits of a, and the rest.
constexpr DoubleDouble split(double a) {
  const double c = 0x8000001p0 * a, upper = c - (c - a);
  return {upper, a - upper};
}

/// a b = hi + lo exactly, from the halves of a and b.
constexpr DoubleDouble two_product(double a, DoubleDouble half_a, double b, DoubleDouble half_b) {
  const double p = a * b;
  return {p, ((half_a.hi * half_b.hi - p) + half_a.hi * half_b.lo + half_a.lo * half_b.hi) + half_a.lo * half_b.lo};
}
constexpr DoubleDouble two_product(double a, double b) { return two_product(a, split(a), b, split(b)); }

constexpr DoubleDouble operator-(DoubleDouble x) { return {-x.hi, -x.lo}; }

constexpr DoubleDouble operator+(DoubleDouble x, DoubleDouble y) {
  const DoubleDouble s = two_sum(x.hi, y.hi), t = two_sum(x.lo, y.lo), v = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(v.hi, t.lo + v.lo);
}
constexpr DoubleDouble operator+(DoubleDouble x, double y) {
  const DoubleDouble s = two_sum(x.hi, y);
  return quick_two_sum(s.hi, x.lo + s.lo);
}
constexpr DoubleDouble operator+(double x, DoubleDouble y) { return y + x; }
constexpr DoubleDouble operator-(DoubleDouble x, DoubleDouble y) { return x + -y; }

constexpr DoubleDouble operator*(DoubleDouble x, DoubleDouble y) {
  const DoubleDouble c = two_product(x.hi, y.hi);
  return quick_two_sum(c.hi, c.lo + (x.hi * y.lo + x.lo * y.hi));
}
constexpr DoubleDouble operator*(DoubleDouble x, double y) {
  const DoubleDouble c = two_product(x.hi, y), t = quick_two_sum(c.hi, x.lo * y);
  return quick_two_sum(t.hi, t.lo + c.lo);
}
constexpr DoubleDouble operator*(double x, DoubleDouble y) { return y * x; }

constexpr DoubleDouble operator/(DoubleDouble x, double y) {
  const double quotient = x.hi / y;
  const DoubleDouble p = two_product(quotient, y);
  return quick_two_sum(quotient, (((x.hi - p.hi) - p.lo) + x.lo) / y);
}
constexpr DoubleDouble operator/(DoubleDouble x, DoubleDouble y) {
  const double quotient = x.hi / y.hi;
  const DoubleDouble p = y * quotient;
  return quick_two_sum(quotient, ((x.hi - p.hi) + (x.lo - p.lo)) / y.hi);
}

constexpr DoubleDouble& operator+=(DoubleDouble& x, DoubleDouble y) { return x = x + y; }
constexpr DoubleDouble& operator*=(DoubleDouble& x, DoubleDouble y) { return x = x * y; }
constexpr DoubleDouble& operator/=(DoubleDouble& x, double y) { return x = x / y; }

constexpr bool operator<(DoubleDouble x, DoubleDouble y) { return x.hi < y.hi || (x.hi == y.hi && x.lo < y.lo); }
constexpr bool operator>(DoubleDouble x, DoubleDouble y) { return y < x; }
constexpr bool operator==(DoubleDouble x, DoubleDouble y) { return x.hi == y.hi && x.lo == y.lo; }

constexpr DoubleDouble abs(DoubleDouble x) { return x.hi < 0.0 ? -x : x; }

/// For x >= 0.
inline DoubleDouble sqrt(DoubleDouble x) {
  if (!(x.hi > 0.0)) return {std::sqrt(x.hi)};
  const double root = std::sqrt(x.hi);
  const DoubleDouble square = two_product(root, root);
  return quick_two_sum(root, ((x.hi - square.hi) - square.lo + x.lo) / (2.0 * root));
}

}  // namespace slapstick
