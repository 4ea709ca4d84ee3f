/// Computes sine, cosine, tangent and their inverses in double-doubles.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/double_double.hpp"
#include "base/elementary.hpp"

namespace slapstick::fixed {
namespace {

constexpr double no_angle = std::numeric_limits<double>::quiet_NaN();
constexpr DoubleDouble half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// 64 zeros, then the binary digits of 2 / pi.
constexpr auto two_over_pi = std::to_array<std::uint64_t>(
    {0x0000000000000000, 0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
     0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41,
     0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7,
     0x4f463f669e5fea2d, 0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab,
     0xf0cfbc209af4361d, 0xa9e391615ee61b08});

/// x = quadrant pi/2 + angle, |angle| <= pi/4.
struct Reduced {
  int quadrant;
  DoubleDouble angle;
};

/// Eight digits of base 2^32, the most significant first: P / 2^254 modulo 4.
using Digits = std::array<std::uint64_t, 8>;

/// |x| 2 / pi modulo 4 (Payne and Hanek 1983), |x| = M 2^e: digits of 2 / pi that count multiples of 4 are left out,
/// and 254 behind the point kept. What is cut off is below 2^-201, and no double from 0.785 on is within 2^-62 of a
/// multiple of pi / 2 (Kahan; Muller, Elementary Functions, 2016, section 11.3).
Digits quarters(double x) {
  int e = 0;
  const double mantissa = std::frexp(std::abs(x), &e);
  const auto M = static_cast<std::uint64_t>(std::ldexp(mantissa, 53));
  const auto from = static_cast<std::size_t>(e - 53 - 2 + 64);
  const auto digit = [&](std::size_t i) {  // 32 bits of the table from bit `from` + 32 i on
    const std::size_t bit = from + 32 * i, word = bit / 64, skip = bit % 64;
    const std::uint64_t upper = two_over_pi[word] << skip;
    return (skip == 0 ? upper : upper | two_over_pi[word + 1] >> (64 - skip)) >> 32;
  };
  const std::uint64_t low = M & 0xffffffff, high = M >> 32;
  Digits product{};
  std::uint64_t carry = 0, before = 0;  // the digit behind, of which `high` takes its part
  for (std::size_t i = 8; i-- > 0;) {
    const std::uint64_t here = digit(i), a = here * low, b = before * high;
    const std::uint64_t sum = (a & 0xffffffff) + (b & 0xffffffff) + (carry & 0xffffffff);
    carry = (a >> 32) + (b >> 32) + (carry >> 32) + (sum >> 32);
    product[i] = sum & 0xffffffff;
    before = here;
  }
  return product;
}

Reduced reduced(double x) {
  if (std::abs(x) <= 0.785) return {0, x};
  Digits P = quarters(x);
  const int quadrant = static_cast<int>(((P[0] >> 29) + 1) >> 1);  // to the nearest
  const bool below = (P[0] >> 29 & 1) != 0;                        // the rest is taken from the next multiple
  P[0] = below ? P[0] | 0xc0000000 : P[0] & 0x3fffffff;
  if (below)
    for (std::uint64_t& digit : P) digit = ~digit & 0xffffffff;  // 2^-254 less than it should be
  DoubleDouble rest = 0.0;
  for (int i = 0; i < 8; ++i) rest = rest + std::ldexp(static_cast<double>(P[i]), 2 - 32 * (i + 1));
  const double sign = (x < 0.0) == below ? 1.0 : -1.0;
  return {x < 0.0 ? -quadrant : quadrant, rest * half_pi * sign};
}

/// (-1)^k first! / (2k + first)!
constexpr std::array<DoubleDouble, 15> alternating_terms(int first) {
  std::array<DoubleDouble, 15> terms{1.0};
  for (int k = 1; k < 15; ++k) terms[k] = -terms[k - 1] / ((2.0 * k + first) * (2.0 * k + first - 1.0));
  return terms;
}
constexpr auto cosine_terms = alternating_terms(0), sine_terms = alternating_terms(1);

/// Sums of their products with r^(2k), |r| <= 0.79: below 2^-113 from k = 13 on. Side by side: each waits for itself.
struct Alternating {
  DoubleDouble cosine = cosine_terms.back(), sine = sine_terms.back();
  explicit Alternating(DoubleDouble r) {
    const DoubleDouble square = r * r;
    for (std::size_t k = cosine_terms.size() - 1; k-- > 0;) {
      cosine = cosine * square + cosine_terms[k];
      sine = sine * square + sine_terms[k];
    }
    sine *= r;
  }
};

/// The sine of quarter turns and an angle, of which both are known.
DoubleDouble sine(int quadrant, const Alternating& angle) {
  const DoubleDouble value = (quadrant & 1) == 0 ? angle.sine : angle.cosine;
  return (quadrant & 2) == 0 ? value : -value;
}

/// arctan t, 0 <= t <= 1: three times the half angle, t / (1 + sqrt(1 + t^2)) <= tan(pi / 32), whose power 35 is below
/// 2^-117.
DoubleDouble arctangent(DoubleDouble t) {
  for (int k = 0; k < 3; ++k) t = t / (sqrt(t * t + 1.0) + 1.0);
  const DoubleDouble square = t * t;
  DoubleDouble sum = 0.0;
  for (int n = 33; n > 0; n -= 2) sum = DoubleDouble(1.0) / n - sum * square;
  return 8.0 * (t * sum);
}

/// The angle of the point (x, y), finite and not both zero, in [0, pi], for y >= 0.
DoubleDouble angle_of(DoubleDouble y, DoubleDouble x) {
  const DoubleDouble width = abs(x);
  const DoubleDouble acute = width < y ? half_pi - arctangent(width / y) : arctangent(y / width);
  return x.hi < 0.0 ? 2.0 * half_pi - acute : acute;
}

/// sqrt(1 - x^2), |x| <= 1.
DoubleDouble other_leg(double x) { return sqrt(two_sum(1.0, -x) * two_sum(1.0, x)); }

}  // namespace

double sin(double x) { return cosine_sine(x).sine; }

double cos(double x) { return cosine_sine(x).cosine; }

CosineSineOf cosine_sine(double x) {
  if (x == 0.0) return {1.0, x};
  if (!std::isfinite(x)) return {no_angle, no_angle};
  const Reduced r = reduced(x);
  const Alternating both(r.angle);
  return {sine(r.quadrant + 1, both).hi, sine(r.quadrant, both).hi};
}

double tan(double x) {
  if (x == 0.0 || !std::isfinite(x)) return x == 0.0 ? x : no_angle;
  const Reduced r = reduced(x);
  const Alternating both(r.angle);
  return (sine(r.quadrant, both) / sine(r.quadrant + 1, both)).hi;
}

double asin(double x) {
  if (!(std::abs(x) <= 1.0)) return no_angle;
  return std::abs(x) < 0x1p-40 ? x : std::copysign(angle_of(std::abs(x), other_leg(x)).hi, x);
}

double acos(double x) { return std::abs(x) <= 1.0 ? angle_of(other_leg(x), x).hi : no_angle; }

double atan(double x) { return x == 0.0 || std::isnan(x) ? x : atan2(x, 1.0); }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return no_angle;
  if (std::isinf(x) || std::isinf(y)) {  // the corner that the point goes to
    y = std::isinf(y) ? std::copysign(1.0, y) : std::copysign(0.0, y);
    x = std::isinf(x) ? std::copysign(1.0, x) : 0.0;
  }
  if (y == 0.0) return std::copysign(std::signbit(x) ? 2.0 * half_pi.hi : 0.0, y);
  int above = 0, beside = 0;
  std::frexp(y, &above);
  std::frexp(x, &beside);
  if (x != 0.0 && beside - above > 60 && x > 0.0) return y / x;  // the quotient is its own angle
  const int most = x == 0.0 || above > beside ? above : beside;
  return std::copysign(angle_of(std::ldexp(std::abs(y), -most), std::ldexp(x, -most)).hi, y);
}

}  // namespace slapstick::fixed
