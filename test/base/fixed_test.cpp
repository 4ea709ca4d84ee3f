/// Functions by fixed operations: their stated errors, against MPFR.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "base/elementary.hpp"
#include "base/mpfr_number.hpp"
#include "base/phase.hpp"

namespace slapstick {
namespace {

using testing::Number;
using testing::squares;
using testing::ulps;
using Exact = int (*)(mpfr_t, const mpfr_t, mpfr_rnd_t);

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double stated = 0.5 + 0x1p-21;  // ulps, elementary.hpp

/// The greatest error of f over numbers that `draw` gives.
template <class Draw>
double worst(double (*f)(double), Exact exact, Draw draw) {
  std::mt19937_64 random(11);
  double most = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double x = draw(random);
    const Number argument(x);
    Number value;
    exact(value.value, argument.value, MPFR_RNDN);
    const double error = ulps(f(x), value);
    most = error > most || std::isnan(error) ? error : most;
  }
  return most;
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

/// Of either sign, all binades from 2^low to 2^high alike.
double spread(std::mt19937_64& random, double low, double high) {
  const double size = std::ldexp(uniform(random, 1.0, 2.0), static_cast<int>(uniform(random, low, high)));
  return random() % 2 == 0 ? size : -size;
}

struct Case {
  const char* name;
  double (*f)(double);
  Exact exact;
  double low, high, low_binade, high_binade;  ///< uniform between, and binades up to the domain's end
};

TEST(Elementary, IsWithinTheStatedErrorFarAndNear) {
  for (const Case& c : std::initializer_list<Case>{{"exp", fixed::exp, mpfr_exp, -700, 700, -60, 9},
                                                   {"sin", fixed::sin, mpfr_sin, -10, 10, -1000, 1023},
                                                   {"cos", fixed::cos, mpfr_cos, -10, 10, -1000, 1023},
                                                   {"tan", fixed::tan, mpfr_tan, -10, 10, -1000, 1023},
                                                   {"asin", fixed::asin, mpfr_asin, -1, 1, -1000, -1},
                                                   {"acos", fixed::acos, mpfr_acos, -1, 1, -60, -1},
                                                   {"atan", fixed::atan, mpfr_atan, -3, 3, -1000, 1023},
                                                   {"sinh", fixed::sinh, mpfr_sinh, -710, 710, -1000, 3},
                                                   {"cosh", fixed::cosh, mpfr_cosh, -710, 710, -60, 3},
                                                   {"tanh", fixed::tanh, mpfr_tanh, -3, 3, -1000, 10},
                                                   {"asinh", fixed::asinh, mpfr_asinh, -3, 3, -1000, 1023},
                                                   {"atanh", fixed::atanh, mpfr_atanh, -1, 1, -1000, -1}}) {
    EXPECT_LE(worst(c.f, c.exact, [&](auto& random) { return uniform(random, c.low, c.high); }), stated) << c.name;
    EXPECT_LE(worst(c.f, c.exact, [&](auto& random) { return spread(random, c.low_binade, c.high_binade); }), stated)
        << c.name;
  }
}

TEST(Elementary, LogarithmsAreExactNearOneAndAtPowers) {
  const auto positive = [](auto& random) { return std::abs(spread(random, -1022, 1023)); };
  const auto near_one = [](auto& random) { return 1.0 + spread(random, -52, -3); };
  for (const auto& draw : {std::function<double(std::mt19937_64&)>(positive), {near_one}}) {
    EXPECT_LE(worst(fixed::ln, mpfr_log, draw), stated);
    EXPECT_LE(worst(fixed::log2, mpfr_log2, draw), stated);
    EXPECT_LE(worst(fixed::log10, mpfr_log10, draw), stated);
  }
  const auto above_one = [](auto& random) { return 1.0 + std::abs(spread(random, -52, 1000)); };
  EXPECT_LE(worst(fixed::acosh, mpfr_acosh, above_one), stated);
  for (int k = -1000; k <= 1000; ++k) EXPECT_EQ(fixed::log2(std::ldexp(1.0, k)), k);
  double ten = 1.0;
  for (int k = 0; k <= 22; ++k, ten *= 10.0) EXPECT_EQ(fixed::log10(ten), k);
}

TEST(Elementary, PowersAndAnglesOfTwoNumbers) {
  std::mt19937_64 random(12);
  Number value;
  for (int i = 0; i < 8000; ++i) {
    const double x = std::abs(spread(random, -40, 40)),
                 y = i % 2 == 0 ? uniform(random, -20, 20) : std::round(uniform(random, -20, 20));
    mpfr_pow(value.value, Number(x).value, Number(y).value, MPFR_RNDN);
    if (std::isnormal(value.rounded())) {
      EXPECT_LE(ulps(fixed::power(x, y), value), stated) << x << " " << y;
    }
    const double a = spread(random, -300, 300), b = spread(random, -300, 300);
    mpfr_atan2(value.value, Number(a).value, Number(b).value, MPFR_RNDN);
    EXPECT_LE(ulps(fixed::atan2(a, b), value), stated) << a << " " << b;
    mpfr_cbrt(value.value, Number(x).value, MPFR_RNDN);
    EXPECT_LE(ulps(fixed::cube_root(x), value), 4.0) << x;
  }
}

/// The double nearest to a multiple of pi / 2: its cosine is 2^-62.
TEST(Elementary, ReductionKeepsItsDigitsAtTheWorstArgument) {
  const double x = std::ldexp(6381956970095103.0, 797);
  Number value;
  mpfr_cos(value.value, Number(x).value, MPFR_RNDN);
  ASSERT_LT(std::abs(value.rounded()), 0x1p-60);
  EXPECT_LE(ulps(fixed::cos(x), value), stated);
}

TEST(Elementary, EndsOfTheDomainsAreThoseOfC) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), tiny = 0x1p-1074;
  const double numbers[] = {0.0, -0.0, 1.0,   -1.0,   2.0,  -2.0,  3.0,      -3.0,      0.5, -0.5,
                            1e3, -1e3, 1e300, -1e300, tiny, -tiny, infinite, -infinite, none};
  const auto same = [](double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b)) ||
           std::abs(a - b) <= 0x1p-51 * std::abs(b);
  };
  for (const double x : numbers) {
    EXPECT_TRUE(same(fixed::exp(x), std::exp(x))) << x;
    EXPECT_TRUE(same(fixed::ln(x), std::log(x))) << x;
    EXPECT_TRUE(same(fixed::sin(x), std::sin(x)) && same(fixed::cos(x), std::cos(x)) &&
                same(fixed::tan(x), std::tan(x)))
        << x;
    EXPECT_TRUE(same(fixed::asin(x), std::asin(x)) && same(fixed::acos(x), std::acos(x)) &&
                same(fixed::atan(x), std::atan(x)))
        << x;
    EXPECT_TRUE(same(fixed::sinh(x), std::sinh(x)) && same(fixed::cosh(x), std::cosh(x)) &&
                same(fixed::tanh(x), std::tanh(x)))
        << x;
    EXPECT_TRUE(same(fixed::asinh(x), std::asinh(x)) && same(fixed::acosh(x), std::acosh(x)) &&
                same(fixed::atanh(x), std::atanh(x)))
        << x;
    for (const double y : numbers) {
      EXPECT_TRUE(same(fixed::power(x, y), std::pow(x, y))) << x << " " << y << " " << fixed::power(x, y);
      EXPECT_TRUE(same(fixed::atan2(x, y), std::atan2(x, y))) << x << " " << y << " " << fixed::atan2(x, y);
    }
  }
}

TEST(Phase, IsWithinTheStatedErrorAndTurnsExactly) {
  std::mt19937_64 random(13);
  Number turn, angle, sine, cosine;
  mpfr_const_pi(turn.value, MPFR_RNDN);
  mpfr_mul_2ui(turn.value, turn.value, 1, MPFR_RNDN);
  for (int i = 0; i < 60000; ++i) {
    const double t = i % 3 == 0   ? uniform(random, 0.0, 1.0)
                     : i % 3 == 1 ? uniform(random, 0.11, 0.14)
                                  : std::abs(spread(random, -60, -3));
    mpfr_mul_d(angle.value, turn.value, t, MPFR_RNDN);
    mpfr_sin_cos(sine.value, cosine.value, angle.value, MPFR_RNDN);
    const auto [c, s] = of_turns(t);
    ASSERT_LE(ulps(c, cosine), 0.86) << t;
    ASSERT_LE(ulps(s, sine), 0.86) << t;
    const double eighth = 0.125 * t;  // the symmetries of a mirrored machine, wherever adding turns is exact
    const auto [c1, s1] = of_turns(std::ldexp(std::round(std::ldexp(eighth, 40)), -40) + 0.5);
    const auto [c0, s0] = of_turns(std::ldexp(std::round(std::ldexp(eighth, 40)), -40));
    ASSERT_TRUE(c1 == -c0 && s1 == -s0) << t;
  }
  for (const double t : {0.0, 0.25, 0.5, 0.75, 3.0, -0.75}) {
    const double quarter = 4.0 * (t - std::floor(t));
    EXPECT_EQ(of_turns(t).cosine, quarter == 0.0 ? 1.0 : quarter == 2.0 ? -1.0 : 0.0) << t;
    EXPECT_EQ(of_turns(t).sine, quarter == 1.0 ? 1.0 : quarter == 3.0 ? -1.0 : 0.0) << t;
  }
}

TEST(DoubleDouble, OperationsKeepTheirBounds) {  // also where the leading parts cancel
  std::mt19937_64 random(14);
  Number exact;
  for (int i = 0; i < 20000; ++i) {
    const double near = i % 2 == 0 ? spread(random, -30, 30) : 0.0;
    const DoubleDouble x = quick_two_sum(spread(random, -3, 3), uniform(random, -1, 1) * 0x1p-57);
    const DoubleDouble y = near != 0.0 ? quick_two_sum(near, near * uniform(random, -1, 1) * 0x1p-53)
                                       : quick_two_sum(-x.hi, x.lo * uniform(random, -2, 2));
    const Number p(x), q(y), d(y.hi);
    mpfr_add(exact.value, p.value, q.value, MPFR_RNDN);
    EXPECT_LE(squares(x + y, exact), 3.01);
    mpfr_add(exact.value, p.value, d.value, MPFR_RNDN);
    EXPECT_LE(squares(x + y.hi, exact), 2.01);
    mpfr_mul(exact.value, p.value, q.value, MPFR_RNDN);
    EXPECT_LE(squares(x * y, exact), 7.01);
    mpfr_mul(exact.value, p.value, d.value, MPFR_RNDN);
    EXPECT_LE(squares(x * y.hi, exact), 1.51);
    mpfr_div(exact.value, p.value, q.value, MPFR_RNDN);
    EXPECT_LE(squares(x / y, exact), 15.01);
    mpfr_div(exact.value, p.value, d.value, MPFR_RNDN);
    EXPECT_LE(squares(x / y.hi, exact), 3.01);
    mpfr_abs(exact.value, p.value, MPFR_RNDN);
    mpfr_sqrt(exact.value, exact.value, MPFR_RNDN);
    EXPECT_LE(squares(sqrt(abs(x)), exact), 3.13);
    const DoubleDouble product = two_product(x.hi, y.hi), sum = two_sum(x.hi, y.hi);
    mpfr_mul_d(exact.value, d.value, x.hi, MPFR_RNDN);
    EXPECT_EQ(squares(product, exact), 0.0);
    mpfr_add_d(exact.value, d.value, x.hi, MPFR_RNDN);
    EXPECT_EQ(squares(sum, exact), 0.0);
  }
}

}  // namespace
}  // namespace slapstick
