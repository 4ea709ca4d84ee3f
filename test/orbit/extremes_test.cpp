/// Extremes of coordinates over a cycle: against closed forms, and against dense samples.
#include "orbit/extremes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "families.hpp"

namespace slapstick::test {
namespace {

using Eigen::VectorXd;

/// x'' + 2 zeta x' + x = cos(omega t) without a contact in reach: |x| <= 1 / |1 - omega^2 + 2 i zeta omega|.
TEST(Extremes, OfALinearOscillatorAreItsAmplitudes) {
  for (const double omega : {0.01, 0.3, 1.0, 7.0}) {
    const Posed posed("impact-oscillator", {{"clearance", 100.0}}, {"omega"}, {omega});
    const auto found = posed.settled();
    ASSERT_TRUE(found) << omega;
    const orbit::ModeSet set(posed.family, {omega});
    const auto all = orbit::extremes(set, found->orbit, orbit::coordinate_functionals(set.frame()));
    const double zeta = 0.1, amplitude = 1.0 / std::hypot(1.0 - omega * omega, 2.0 * zeta * omega);
    EXPECT_NEAR(all[0].most.value, amplitude, 1e-12 * amplitude) << omega;
    EXPECT_NEAR(all[0].least.value, -amplitude, 1e-12 * amplitude) << omega;
    const double terms =
        std::max(1.0, omega) * amplitude;  // of which the velocity is the sum: the oscillator's own rate is 1
    EXPECT_NEAR(all[1].largest(), omega * amplitude, 1e-12 * terms) << omega;
    const double lag = std::atan2(2.0 * zeta * omega, 1.0 - omega * omega) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(std::remainder(found->orbit.t[0] + all[0].most.at - lag, 1.0), 0.0, 1e-7) << omega;
  }
}

/// Between events the velocity is zero where a displacement is extreme, and no sample of the cycle lies outside.
TEST(Extremes, AreMissedByNoLeg) {
  for (const char* model : {"vibro-impact", "two-sided-rattle", "stick-slip-impact", "impact-absorber"}) {
    const Posed posed(model, {}, {"omega"}, {load_model(model).build({}).omega});
    const auto found = posed.settled(0, 2000);
    ASSERT_TRUE(found) << model;
    const orbit::Orbit& orbit = found->orbit;
    const orbit::ModeSet set(posed.family, orbit.values);
    const Eigen::MatrixXd rows = orbit::coordinate_functionals(set.frame());
    const auto all = orbit::extremes(set, orbit, rows);
    const Eigen::Index n = rows.rows() / 2;
    VectorXd most = VectorXd::Constant(rows.rows(), -INFINITY);
    for (std::size_t leg = 0; leg < orbit.legs(); ++leg) {
      constexpr int samples = 400;
      for (int k = 0; k <= samples; ++k)
        most = most.cwiseMax(rows * orbit::state_within(set, orbit, leg, orbit.duration(leg) * k / samples));
    }
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const orbit::Extreme& extreme = all[static_cast<std::size_t>(i)].most;
      const double range = all[static_cast<std::size_t>(i)].range();
      EXPECT_GE(extreme.value, most[i] - 1e-13 * range) << model << i;
      EXPECT_LE(extreme.value, most[i] + 1e-3 * range) << model << i;
      const VectorXd there = rows * orbit::state_within(set, orbit, extreme.leg, extreme.at);
      EXPECT_NEAR(there[i], extreme.value, 1e-12 * range) << model << i;
      const bool within = extreme.at > 0.0 && extreme.at < orbit.duration(extreme.leg);
      if (i >= n || !within) continue;
      EXPECT_NEAR(there[i + n], 0.0, 1e-6 * all[static_cast<std::size_t>(i + n)].range()) << model << i;
    }
  }
}

}  // namespace
}  // namespace slapstick::test
