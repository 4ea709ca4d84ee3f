/// Zeros and extremes of polynomials on [0, 1], and the quadrature: against closed forms.
#include "event/polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "quantity/quadrature.hpp"

namespace slapstick::test {
namespace {

using event::Polynomial;

Polynomial with_zeros(const std::vector<double>& zeros) {
  Polynomial f;
  f.a[0] = 1.0;
  for (const double zero : zeros) {
    ++f.degree;
    for (int j = f.degree; j > 0; --j)
      f.a[static_cast<std::size_t>(j)] = f.a[static_cast<std::size_t>(j) - 1] - zero * f.a[static_cast<std::size_t>(j)];
    f.a[0] *= -zero;
  }
  return f;
}

TEST(Polynomial, NoZeroIsMissedHoweverNearTheNextOne) {
  for (const double apart : {0.3, 1e-3, 1e-6}) {
    const std::vector<double> zeros = {0.1, 0.4, 0.4 + apart, 0.95, 1.5, -0.5};
    const Polynomial f = with_zeros(zeros);
    std::vector<double> found;
    event::possible_zeros(f, event::Bernstein(f), 0.0, 1.0, 0x1p-53 * f.size(), [&](double x) { found.push_back(x); });
    for (std::size_t k = 0; k < 4; ++k) {
      double nearest = 1.0;
      for (const double x : found) nearest = std::min(nearest, std::abs(x - zeros[k]));
      EXPECT_LT(nearest, apart < 1e-5 ? 1e-5 : 1e-9) << zeros[k] << " apart " << apart;
    }
  }
}

TEST(Polynomial, TheGreatestValueIsThatBetweenTheEnds) {
  Polynomial f = with_zeros({0.0, 1.0});  // x (x - 1): least at 1/2
  double least = INFINITY, at = 0.0;
  event::possible_extremes(f, [&](double x, double value) {
    if (value < least) least = value, at = x;
  });
  EXPECT_EQ(least, -0.25);
  EXPECT_NEAR(at, 0.5, 1e-12);
}

/// A velocity that comes to rest at the end of a step: the slope of its square has a zero there, within rounding on
/// either side.
TEST(Polynomial, AnExtremeBeforeAnEndAtRestIsNotMissed) {
  int missed = 0;
  for (int k = 1; k <= 200; ++k) {
    const double place = k / 201.0;
    Polynomial f;  // its slope is (x - place) (x - 1) (x + 1.7) (x - 2.3) up to rounding
    const Polynomial slope = with_zeros({place, 1.0, -1.7, 2.3});
    f.degree = slope.degree + 1;
    for (int j = 1; j <= f.degree; ++j) f.a[static_cast<std::size_t>(j)] = slope.a[static_cast<std::size_t>(j) - 1] / j;
    double nearest = 1.0;
    event::possible_extremes(f,
                             [&](double, double value) { nearest = std::min(nearest, std::abs(value - f.at(place))); });
    missed += nearest > 0x1p-50 * f.size();
  }
  EXPECT_EQ(missed, 0);
}

/// integral x^k = 1 / (k + 1) to degree 31, and no further.
TEST(Quadrature, IsExactToDegree31AndNoFurther) {
  const auto error = [](int k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < quantity::nodes; ++i)
      sum += quantity::gauss().weight[i] * std::pow(quantity::gauss().x[i], k);
    return std::abs(sum * (k + 1) - 1.0);
  };
  for (int k = 0; k <= 31; ++k) EXPECT_LT(error(k), 4e-15) << k;
  EXPECT_GT(error(60), 1e-12);
}

TEST(Quadrature, OfTenRadiansIsExactToRounding) {
  double sum = 0.0;
  for (std::size_t i = 0; i < quantity::nodes; ++i)
    sum += quantity::gauss().weight[i] * std::cos(10.0 * quantity::gauss().x[i]);
  EXPECT_NEAR(sum, std::sin(10.0) / 10.0, 1e-15);
}

}  // namespace
}  // namespace slapstick::test
