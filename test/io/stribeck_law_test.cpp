/// The corners of Stribeck laws: how far their polylines are off, looked at point by point.
#include "io/stribeck_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace slapstick {
namespace {

double law(double x, double exponent) { return std::exp(-std::pow(x, exponent)); }

/// The largest distance of the polyline from the law in a piece, by 4000 points.
double off_in_piece(const StribeckFall& fall, std::size_t j, double exponent) {
  const double x0 = j == 0 ? 0.0 : fall.at[j - 1], g0 = j == 0 ? 1.0 : fall.left[j - 1];
  double most = 0.0;
  for (int i = 0; i <= 4000; ++i) {
    const double share = i / 4000.0, x = x0 + share * (fall.at[j] - x0);
    most = std::max(most, std::abs(g0 + share * (fall.left[j] - g0) - law(x, exponent)));
  }
  return most;
}

TEST(StribeckLaw, IsOffByWhatItSays) {
  for (const double exponent : {0.5, 0.8, 1.0, 1.5, 2.0, 3.0, 10.0}) {
    for (const int corners : {1, 2, 5, 20, 100}) {
      const StribeckFall fall = stribeck_fall(corners, exponent);
      ASSERT_EQ(fall.at.size(), static_cast<std::size_t>(corners));
      double most = fall.left.back();  // beyond the last corner, where the law goes to 0
      for (std::size_t j = 0; j < fall.at.size(); ++j) {
        EXPECT_NEAR(fall.left[j], law(fall.at[j], exponent), 1e-13);
        EXPECT_GT(fall.at[j], j == 0 ? 0.0 : fall.at[j - 1]);
        most = std::max(most, off_in_piece(fall, j, exponent));
      }
      EXPECT_NEAR(fall.error, most, 1e-4 * most) << exponent << " " << corners;
    }
  }
}

/// Twice as many corners are four times as good.
TEST(StribeckLaw, HasAnErrorOfSecondOrder) {
  for (const double exponent : {0.5, 1.0, 1.5, 2.0, 3.0}) {
    const double coarse = stribeck_fall(20, exponent).error, fine = stribeck_fall(40, exponent).error;
    EXPECT_NEAR(coarse / fine, 4.0, 0.6) << exponent;
  }
}

TEST(StribeckLaw, OfAnExponentialIsOffByNoMoreThanThePageSays) {
  for (const int corners : {1, 2, 4, 10, 20, 100}) {
    const double root = 1.0 + std::sqrt(2.0) * corners;
    EXPECT_LE(stribeck_fall(corners, 1.0).error, 1.03 / (root * root)) << corners;
  }
}

/// No piece is much better than the others: a corner more would help everywhere alike.
TEST(StribeckLaw, IsOffByTheSameInAllPieces) {
  for (const double exponent : {1.0, 2.0, 3.0}) {
    const StribeckFall fall = stribeck_fall(40, exponent);
    int good = 0;  // where the law bends neither way a chord is better
    for (std::size_t j = 0; j < fall.at.size(); ++j) good += off_in_piece(fall, j, exponent) > 0.7 * fall.error;
    EXPECT_GE(good, 34) << exponent;
  }
}

}  // namespace
}  // namespace slapstick
