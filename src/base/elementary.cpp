/// Computes exponentials, logarithms, powers and hyperbolic functions in double-doubles.
#include "base/elementary.hpp"

#include <cmath>
#include <limits>

#include "base/double_double.hpp"

namespace slapstick::fixed {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
constexpr DoubleDouble ln_2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56},
                       ln_10 = {0x1.26bb1bbb55516p+1, -0x1.f48ad494ea3e9p-53};

/// x = scaled 2^exponent.
struct Scaled {
  DoubleDouble scaled;
  int exponent;
};

double rounded(Scaled x) { return std::ldexp(x.scaled.hi, x.exponent); }
DoubleDouble times_power(Scaled x) {
  return {std::ldexp(x.scaled.hi, x.exponent), std::ldexp(x.scaled.lo, x.exponent)};
}

/// exp(x), |x| < 800: x = k ln 2 + r, |r| <= 0.35, and r^n / n! < 2^-114 from n = 24 on.
Scaled exponential(DoubleDouble x) {
  const double k = std::nearbyint(x.hi / ln_2.hi);
  const DoubleDouble r = x - ln_2 * k;
  DoubleDouble sum = 1.0;
  for (int n = 24; n > 0; --n) sum = sum * r / n + 1.0;
  return {sum, static_cast<int>(k)};
}

/// artanh s = s + s^3 / 3 + .. for |s| <= 0.18: s^45 / 45 < 2^-116.
DoubleDouble series_of_artanh(DoubleDouble s) {
  const DoubleDouble square = s * s;
  DoubleDouble sum = 0.0;
  for (int n = 43; n > 0; n -= 2) sum = sum * square + DoubleDouble(1.0) / n;
  return s * sum;
}

/// ln x = e ln 2 + 2 artanh((m - 1) / (m + 1)), x = 2^e m, m in [0.7, 1.42]; x finite and positive.
DoubleDouble logarithm(DoubleDouble x) {
  int e = 0;
  if (std::frexp(x.hi, &e) < 0.7071) --e;
  const DoubleDouble m = {std::ldexp(x.hi, -e), std::ldexp(x.lo, -e)};
  return ln_2 * e + 2.0 * series_of_artanh((m - 1.0) / (m + 1.0));
}

/// What the logarithm of any number is, in units of `unit`.
double logarithm_by(double x, DoubleDouble unit) {
  if (x > 0.0 && x < infinite) return (logarithm(x) / unit).hi;
  return x == 0.0 ? -infinite : x > 0.0 ? x : none;
}

/// e^|x| / 2 and e^-|x| / 2, |x| < 800; beyond 40 the second is too small to matter.
struct HalfExponentials {
  Scaled rising;
  DoubleDouble falling;
};
HalfExponentials half_exponentials(double x) {
  const Scaled up = exponential(std::abs(x)), down = exponential(-std::abs(x));
  return {{up.scaled, up.exponent - 1}, times_power({down.scaled, down.exponent - 1})};
}

/// sinh x for |x| <= 1/2: x^29 / 29! < 2^-131.
DoubleDouble series_of_sinh(double x) {
  const DoubleDouble square = two_product(x, x);
  DoubleDouble sum = 1.0;
  for (int n = 26; n > 0; n -= 2) sum = sum * square / (n * (n + 1.0)) + 1.0;
  return sum * x;
}

/// |x| + sqrt(x^2 + one), one = 1 or -1, for |x| < 2^100.
DoubleDouble with_root(double x, double one) { return sqrt(two_product(x, x) + one) + std::abs(x); }

bool whole(double y) { return std::floor(y) == y; }
bool odd(double y) { return whole(y) && !whole(0.5 * y); }

/// x^y where one of them is 0, infinite or not a number.
double special_power(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return none;
  const double size = std::abs(x), sign = std::signbit(x) && odd(y) ? -1.0 : 1.0;
  if (std::isinf(y)) return size == 1.0 ? 1.0 : (size > 1.0) == (y > 0.0) ? infinite : 0.0;
  return sign * ((size > 1.0) == (y > 0.0) ? infinite : 0.0);
}

}  // namespace

double exp(double x) {
  if (!(std::abs(x) < 800.0)) return x > 0.0 ? infinite : x < 0.0 ? 0.0 : none;
  return rounded(exponential(x));
}

double ln(double x) { return logarithm_by(x, 1.0); }
double log2(double x) { return logarithm_by(x, ln_2); }
double log10(double x) { return logarithm_by(x, ln_10); }

double power(double x, double y) {
  if (x == 0.0 || x == 1.0 || y == 0.0 || !std::isfinite(x) || !std::isfinite(y)) return special_power(x, y);
  if (x < 0.0 && !whole(y)) return none;
  const double sign = x < 0.0 && odd(y) ? -1.0 : 1.0;
  const DoubleDouble base = logarithm(std::abs(x));
  const double size = base.hi * y;
  if (!(std::abs(size) < 800.0)) return sign * (size > 0.0 ? infinite : 0.0);
  return sign * rounded(exponential(base * y));
}

/// x = 8^k m, m in [1/8, 1): Halley's iteration triples the digits of a chord.
double cube_root(double x) {
  if (!(x > 0.0 && x < infinite)) return x;
  int e = 0;
  std::frexp(x, &e);
  const int k = static_cast<int>(std::ceil(e / 3.0));
  const double m = std::ldexp(x, -3 * k);
  double y = 0.43 + 0.59 * m;
  for (int n = 0; n < 4; ++n) {
    const double cube = y * y * y;
    y *= (cube + 2.0 * m) / (2.0 * cube + m);
  }
  return std::ldexp(y, k);
}

double sinh(double x) {
  if (!(std::abs(x) < 800.0)) return x * infinite;
  if (std::abs(x) <= 0.5) return series_of_sinh(x).hi;
  const auto [rising, falling] = half_exponentials(x);
  return std::copysign(std::abs(x) > 40.0 ? rounded(rising) : (times_power(rising) - falling).hi, x);
}

double cosh(double x) {
  if (!(std::abs(x) < 800.0)) return std::abs(x) * infinite;
  const auto [rising, falling] = half_exponentials(x);
  return std::abs(x) > 40.0 ? rounded(rising) : (times_power(rising) + falling).hi;
}

double tanh(double x) {
  if (!(std::abs(x) <= 40.0)) return std::isnan(x) ? x : std::copysign(1.0, x);
  const auto [rising, falling] = half_exponentials(x);
  const DoubleDouble up = times_power(rising);
  const DoubleDouble sine = std::abs(x) <= 0.5 ? series_of_sinh(std::abs(x)) : up - falling;
  return std::copysign((sine / (up + falling)).hi, x);
}

/// asinh x = 2 artanh(x / (1 + sqrt(1 + x^2))).
double asinh(double x) {
  const double size = std::abs(x);
  if (!(size < infinite)) return x;
  if (size > 0x1p100) return std::copysign((logarithm(size) + ln_2).hi, x);
  if (size > 0.25) return std::copysign(logarithm(with_root(size, 1.0)).hi, x);
  return size < 0x1p-40 ? x : (2.0 * series_of_artanh(DoubleDouble(x) / (sqrt(two_product(x, x) + 1.0) + 1.0))).hi;
}

double acosh(double x) {
  if (!(x >= 1.0 && x < infinite)) return x > 0.0 && !(x < 1.0) ? x : none;
  if (x > 0x1p100) return (logarithm(x) + ln_2).hi;
  const DoubleDouble product = two_sum(x, -1.0) * two_sum(x, 1.0);
  return logarithm(sqrt(product) + x).hi;
}

double atanh(double x) {
  const double size = std::abs(x);
  if (!(size < 1.0)) return size == 1.0 ? std::copysign(infinite, x) : none;
  if (size <= 0.125) return x == 0.0 ? x : series_of_artanh(x).hi;
  return 0.5 * logarithm(two_sum(1.0, x) / two_sum(1.0, -x)).hi;
}

}  // namespace slapstick::fixed
