/// Long runs without an event, and quasi-static ones, lose no phase. SLAPSTICK_CAMPAIGN=N runs N times as many periods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flow/runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

TEST(LongRun, WithoutAnyEventKeepsThePhase) {  // windows follow one another, and no event sets the clock
  const double omega = 2.2, damping = 0.1;
  const System system(oracle::oscillator_with_stop(2.0, 0.5, 1.0, omega, damping));
  Motion motion(system, {0.0, 0.0});
  const std::int64_t periods = 100'000 * testing::campaign();
  ASSERT_EQ(motion.advance({periods, 0.25}), Outcome::reached_end);
  // x = Im exp(i omega t) / (1 - omega^2 + i damping omega), at omega t = pi / 2.
  // A window of 0.93 forgets 0.045 of its rounding (4 u), so 1e-14 at most stands; a clock of steps would have lost
  // 2e-11.
  const double a = 1 - omega * omega, b = damping * omega;
  EXPECT_NEAR(motion.state()[0], a / (a * a + b * b), 1e-14);
  EXPECT_NEAR(motion.state()[1], omega * b / (a * a + b * b), 1e-14);
}

TEST(LongRun, OfAQuasiStaticMotionReleasesOnceAndOnTime) {  // was doubled when the phase drifted within a stick
  for (const double omega : {1e-3, 1e-5, 1e-6}) {
    Model model = oracle::friction_oscillator(0.2, 0.2, 0.25, omega);
    model.dampers[0].coefficient = 2.0;  // so that it does not ripple about its slow motion, and stick again
    const System system(model);
    Motion motion(system, {0.0, 0.0});
    ASSERT_EQ(motion.advance({1, 0.0}), Outcome::event);
    EXPECT_EQ(name(motion.event().kind), "release");
    EXPECT_NEAR(motion.event().time.fraction, std::asin(0.8) / (2 * std::numbers::pi), 1e-15) << omega;
    // Slipping is slow: x = 0.25 sin - 0.2 apart from a start of the order of omega. The mass sticks near the force's
    // maximum.
    ASSERT_EQ(motion.advance({1, 0.0}), Outcome::event);
    EXPECT_EQ(name(motion.event().kind), "stick");
    EXPECT_NEAR(motion.event().time.fraction, 0.25, 2 * omega);
    EXPECT_NEAR(motion.state()[0], 0.05, 2 * omega);
    EXPECT_LE(100 * motion.counters().evaluations, 101 * motion.counters().windows + 10000)
        << "tiny steps over a slow guard";
  }
}

TEST(LongRun, CountsItsWorkAsExpected) {  // a change in the work done is noticed
  const System system(oracle::vibro_impact(2.2));
  Motion motion(system, {-0.5, 0, 0, 0});
  while (motion.advance({1000, 0.0}) == Outcome::event) {
  }
  const Counters& counters = motion.counters();
  EXPECT_EQ(counters.grazes, 0);
  EXPECT_NEAR(static_cast<double>(counters.impacts), 1000, 5);
  EXPECT_LE(counters.windows, 4 * counters.segments);
  EXPECT_LE(counters.evaluations, 8 * counters.events);
}

}  // namespace
}  // namespace slapstick
