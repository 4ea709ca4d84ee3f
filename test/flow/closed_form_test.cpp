/// One coordinate and a stop, where everything is known in closed form. More of this kind is in ../catalogue.
#include <gtest/gtest.h>

#include <numbers>

#include "flow/compiled_system.hpp"
#include "flow/runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;
using testing::kinds;
using testing::run;

/// x = sin t towards a wall at b.
struct SineTowardsWall {
  explicit SineTowardsWall(double b, double restitution = 0.5)
      : system(oracle::oscillator_with_stop(b, restitution)), motion(system, {0.0, 1.0}) {}
  System system;
  Motion motion;
};

TEST(Start, ContactWithAClearanceThatRoundsIsNoFailure) {  // 0.3 - 0.1 != 0.2
  Model m = oracle::vibro_impact(1.5);
  for (const double clearance : {0.1, 0.2, 0.3, 0.7}) {
    m.stops[0].clearance = clearance;
    for (const double x2 : {0.0, 0.1, 0.3, -0.7, 1e3}) {
      const double x1 = x2 + clearance;
      if (clearance - (x1 - x2) < 0.0) continue;  // refused as a violated stop
      const System system(m);
      for (const double v : {-1.0, 0.0, 1.0}) {
        Motion motion(system, {x1, v, x2, 0.0});
        EXPECT_NO_THROW(run(motion, 3.0, 100)) << clearance << " " << x2 << " " << v;
      }
    }
  }
}

TEST(Impact, TimesAreThoseOfTheSineWithItsNewAmplitude) {
  SineTowardsWall sine(0.5);
  const auto events = run(sine.motion, 20.0);
  ASSERT_GE(events.size(), 3u);
  // Speed v at the wall: back after 2 pi - 2 atan2(v, b) with the same speed, then v -> v / 2.
  double t = std::asin(0.5), v = std::cos(t);
  for (const Event& event : events) {
    EXPECT_EQ(name(event.kind), "impact");
    EXPECT_NEAR(testing::seconds(event, sine.motion), t, 1e-13);
    EXPECT_NEAR(event.w, v, 1e-14);
    v *= 0.5;
    t += 2 * pi - 2 * std::atan2(v, 0.5);
  }
}

TEST(
    Impact,
    AtTheVeryEndOfAWindowIsFoundOnceAndInItsPlace) {  // constant speed: the window's end lies anywhere within the noise
  Model model;
  model.name = "glider";
  model.coordinates = {{"x", 1.0}};
  model.stops = {{"wall", 0, ground, 0.0, 0.5}};
  const double H = System(model).compiled().mode(0).window();
  for (int windows = 1; windows <= 3; ++windows) {
    for (int ulps = -6; ulps <= 6; ++ulps) {
      const double distance = windows * H * (1.0 + ulps * 0x1p-52);
      const System system(model);
      Motion motion(system, {-distance, 1.0});
      const auto events = run(motion, 20.0);
      ASSERT_EQ(kinds(events), "impact") << windows << " " << ulps;
      EXPECT_NEAR(testing::seconds(events[0], motion), distance, 4e-15 * distance);
      EXPECT_EQ(events[0].w, 1.0);
    }
  }
}

}  // namespace
}  // namespace slapstick
