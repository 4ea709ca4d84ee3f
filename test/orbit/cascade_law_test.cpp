/// The law of a cascade: its rates against the bounce map itself, its limits against sequences that are made of the
/// law, onsets against the simulator.
#include "change/cascade_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "families.hpp"

namespace slapstick::test {
namespace {

using orbit::SpecialType;

/// v t - a t^2 / 2 + j t^3 / 6 flown until the gap closes, in numbers with units: the state after the impact.
struct Pressed {
  double a, v;
};
Pressed bounced(Pressed from, double j, double r) {
  double t = 0.0, end = 1.5 * from.a / j;  // the gap's second zero: before the graze at sigma = 3/2
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (t + end);
    (from.v - from.a * middle / 2.0 + j * middle * middle / 6.0 > 0.0 ? t : end) = middle;
  }
  return {from.a - j * t, -r * (from.v - from.a * t + j * t * t / 2.0)};
}

TEST(CascadeLaw, HasTheFixedPointOfTheBounceMap) {
  const double j = 3.0;
  for (const double r : {0.1, 0.3, 0.5, 0.7, 0.9, 0.95}) {
    const orbit::BounceRates rates = orbit::bounce_rates(r);
    const double w = rates.sigma / 2.0 - rates.sigma * rates.sigma / 6.0;
    const auto image = [&](double of) {
      const Pressed after = bounced({2.0, of * 4.0 / j}, j, r);
      return j * after.v / (after.a * after.a);
    };
    EXPECT_NEAR(image(w), w, 1e-12) << r;
    EXPECT_NEAR(bounced({2.0, w * 4.0 / j}, j, r).a, 2.0 * rates.mu, 1e-12) << r;
    const double h = 1e-5 * w;
    EXPECT_NEAR((image(w + h) - image(w - h)) / (2.0 * h), rates.lambda, 1e-7 * rates.lambda) << r;
  }
}

/// Whatever the coefficients of the law's terms, the limit lies within the stated error, which is soon less than the
/// distance that is left.
TEST(CascadeLaw, StatesAnErrorThatHoldsForEveryRestitution) {
  std::mt19937 random(20);
  std::normal_distribution<double> normal;
  for (const double r : {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}) {
    const std::vector<double> rates = orbit::cascade_rates(r, 14);
    ASSERT_TRUE(std::ranges::is_sorted(rates, std::greater<>()));
    int outside = 0, far_outside = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      std::vector<double> weights(rates.size(), 1.0);
      for (std::size_t k = 1; k < weights.size(); ++k) weights[k] = normal(random);
      const int last = 6 + trial % 18;
      std::vector<double> places, errors(8, 1e-13);
      for (int i = 0; i < 8; ++i) {
        double place = 1e-13 * std::clamp(normal(random), -1.0, 1.0);
        for (std::size_t k = 0; k < rates.size(); ++k) place += weights[k] * std::pow(rates[k], last + 8 - i);
        places.push_back(place);
      }
      const auto limit = orbit::limit_by_rates(places, errors, {rates.begin(), rates.begin() + 8});
      ASSERT_TRUE(limit);
      outside += std::abs(limit->value) > limit->error ? 1 : 0;
      far_outside += std::abs(limit->value) > 3.0 * limit->error ? 1 : 0;
    }
    EXPECT_LE(outside, 10) << r;  // in a hundredth of all, where terms cancel in three differences at once
    EXPECT_EQ(far_outside, 0) << r;
  }
}

/// With both rates three grazes say more than a hundred times as much as with one.
TEST(CascadeLaw, TakesOutBothRates) {
  const orbit::BounceRates rates = orbit::bounce_rates(0.5);
  std::vector<double> places;
  for (int n = 12; n > 4; --n) places.push_back(2.0 + std::pow(rates.lambda, -n) - 0.7 * std::pow(rates.mu, 2 * n));
  const auto limit = orbit::limit_by_rates(places, std::vector<double>(8, 1e-15), orbit::cascade_rates(0.5, 8));
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->value, 2.0, 1e-13);
  EXPECT_LT(limit->error, 1e-12);
}

/// D_{n+1} = K 2^(n/3) D_n^(4/3): after four places the limit is known far better than the last of them.
TEST(CascadeLaw, WithFrictionOnThePairGathersFasterThanAnySeries) {
  std::vector<double> places;
  double distance = 0.02, K = 0.5;
  for (int n = 0; n < 6; ++n) {
    places.insert(places.begin(), 1.0 - distance);
    distance = K * std::pow(2.0, n / 3.0) * std::pow(distance, 4.0 / 3.0);
  }
  const auto limit = orbit::limit_with_friction(places);
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->value, 1.0, 1e-9 * std::abs(places[0] - 1.0));
  EXPECT_FALSE(orbit::limit_with_friction({1.0, 1.1, 1.2, 1.3}));  // no cascade
}

}  // namespace
}  // namespace slapstick::test
