/// The least value of the guard that ends a leg, beside a graze: by a motion in closed form.
#include "orbit/margins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "families.hpp"
#include "orbit/equations.hpp"

namespace slapstick::test {
namespace {

using orbit::Test, orbit::TestValue;

/// x'' + x = cos 2 t from x = -1/3 at rest: x = -cos(2 t) / 3, so that the gap is clearance + cos(2 t) / 3. The leg
/// ends after `periods` by the gap's zero, or by what stands for it.
struct GrazingLeg {
  double least, least_at, speed;

  GrazingLeg(double clearance, double periods) {
    const Posed posed("impact-oscillator", {{"damping_ratio", 0.0}, {"clearance", clearance}}, {"omega"}, {2.0});
    orbit::Leg leg;
    leg.states.stops = {mode::StopState::open};
    leg.strikes = {{1U, false}};
    orbit::Orbit orbit;
    orbit.shape.legs = {leg};
    orbit.shape.n = 1;
    orbit.values = {2.0};
    orbit.x = {Eigen::Vector2d(-1.0 / 3.0 - clearance, 0.0)};  // minus the gap, and the velocity
    orbit.t = {0.0, periods};
    for (const TestValue& test : test_values(orbit::ModeSet(posed.problem->family(), orbit.values), orbit)) {
      if (test.test == Test::guard && test.kind == mode::GuardKind::gap) least = test.value, least_at = test.at;
      if (test.test == Test::speed) speed = test.value;
    }
  }
};

/// On a curve of grazes the instant and the slope of the zero are rounding, to either side. No least value is made of
/// that.
TEST(MarginAtAGraze, TheSlopeAtTheEndDecidesAlone) {
  for (const double aside : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0})
    for (const double sign : {-1.0, 1.0}) {
      const GrazingLeg leg(1.0 / 3.0, 0.5 + sign * aside);
      EXPECT_EQ(leg.least, INFINITY) << sign * aside;
      EXPECT_NEAR(leg.speed, 2.0 / 3.0 * std::sin(2.0 * std::numbers::pi * (0.5 + sign * aside)), 1e-14);
    }
}

/// A zero that is passed and comes again is not the end: the gap was below zero before, and by how much.
TEST(MarginAtAGraze, AnEarlierMinimumCounts) {
  for (const double clearance : {0.3, 0.33, 0.333333})
    for (const double end : {1.4, 1.5 - 1e-9, 1.5 + 1e-9, 1.6}) {
      const GrazingLeg leg(clearance, end);
      EXPECT_NEAR(leg.least, clearance - 1.0 / 3.0, 1e-14) << clearance << ' ' << end;
      EXPECT_NEAR(leg.least_at, 0.5, 1e-7);
    }
}

}  // namespace
}  // namespace slapstick::test
