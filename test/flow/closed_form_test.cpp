/// One coordinate and a stop, where everything is known in closed form: grazes, starts on the stop, retriggers.
/// Case numbers K are those of shared/reliability.md, section 2.
#include <gtest/gtest.h>

#include <numbers>

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

TEST(Graze, ExactTouchIsReportedOnceWithoutImpulse) {  // K1
  SineTowardsWall sine(1.0);
  const auto events = run(sine.motion, 6.0);
  ASSERT_EQ(kinds(events), "graze");
  EXPECT_NEAR(testing::seconds(events[0], sine.motion), pi / 2, 1e-7);  // located as the minimum of the gap
  EXPECT_EQ(sine.motion.counters().grazes, 1);
  EXPECT_NEAR(sine.motion.state()[0], std::sin(6.0), 1e-7);
  EXPECT_NEAR(sine.motion.state()[1], std::cos(6.0), 1e-7);
}

TEST(Graze, NearHitIsAnImpactDownToTheNoise) {  // K2
  int grazes = 0;
  for (int k = 7; k <= 52; ++k) {
    const double delta = std::ldexp(1.0, -k);
    SineTowardsWall sine(1.0 - delta);
    const auto events = run(sine.motion, 2.0, 1);
    ASSERT_EQ(events.size(), 1u) << "missed at 2^-" << k;
    if (events[0].kind == EventKind::graze) {
      ++grazes;
      EXPECT_GE(k, 45) << "undecided far above the noise";
      continue;
    }
    ASSERT_EQ(kinds(events), "impact") << k;
    EXPECT_EQ(grazes, 0) << "a graze above, an impact below";
    // v = sqrt(2 delta - delta^2); with the noise e of the gap, v^2 is known to 2 e.
    const double speed = std::sqrt(2 * delta - delta * delta);
    EXPECT_NEAR(events[0].w, speed, 4e-15 / speed) << k;
    EXPECT_NEAR(testing::seconds(events[0], sine.motion), std::asin(1 - delta), 8e-15 / speed) << k;
  }
  EXPECT_LE(grazes, 8);
}

TEST(Graze, NearHitAtDecimalDepths) {  // K2: delta = 1e-10 has v = 1.414e-5
  for (int k = 2; k <= 13; ++k) {
    const double b = 1.0 - std::pow(10.0, -k), delta = 1.0 - b;
    SineTowardsWall sine(b);
    const auto events = run(sine.motion, 2.0, 1);
    ASSERT_EQ(kinds(events), "impact") << k;
    const double speed = std::sqrt(2 * delta - delta * delta);
    EXPECT_NEAR(events[0].w, speed, 4e-15 / speed) << k;
  }
}

TEST(Graze, NearMissIsPassedDownToTheNoise) {  // K3
  for (int k = 7; k <= 52; ++k) {
    SineTowardsWall sine(1.0 + std::ldexp(1.0, -k));
    const std::string found = kinds(run(sine.motion, 6.0));
    if (k <= 44)
      EXPECT_EQ(found, "") << k;
    else
      EXPECT_TRUE(found.empty() || found == "graze") << k << " " << found;
    EXPECT_NEAR(sine.motion.state()[0], std::sin(6.0), 1e-7);
  }
}

TEST(Graze, TwoContactsInOneWindowGiveTheFirst) {  // K4: same result for any internal step
  for (const double step : {100.0, 1.0, 0.1, 0.013}) {
    SineTowardsWall sine(1.0 - 1e-6);
    Event first;
    for (double t = step;; t += step) {
      if (sine.motion.advance(Instant{}.plus(t / sine.system.period())) == Outcome::event) {
        first = sine.motion.event();
        break;
      }
      ASSERT_LT(t, 200.0);
    }
    EXPECT_EQ(name(first.kind), "impact") << step;
    EXPECT_NEAR(testing::seconds(first, sine.motion), std::asin(1 - 1e-6), 1e-11) << step;
  }
}

/// What happens within `time` of a start on the stop, and the velocity then.
std::string from_contact(const Model& model, double v, double time, double& velocity) {
  const System system(model);
  Motion motion(system, {model.stops[0].clearance, v});
  const std::string found = kinds(run(motion, time));
  velocity = motion.state()[1];
  return found;
}

TEST(Start, OnTheStopIsDecidedByTheFirstDerivativeThatDoesNotVanish) {  // K6
  double v = 0.0;
  EXPECT_EQ(from_contact(oracle::oscillator_with_stop(0.75), -1.0, 0.125, v), "");  // leaves
  EXPECT_LT(v, -0.9);
  EXPECT_EQ(from_contact(oracle::oscillator_with_stop(0.75), 1.0, 0.125, v), "impact");
  EXPECT_NEAR(v, -0.5, 0.15);
  EXPECT_EQ(from_contact(oracle::oscillator_with_stop(0.75), 0.0, 0.125, v), "");  // x'' = -0.75: leaves
  EXPECT_LT(v, -0.08);
  EXPECT_EQ(from_contact(oracle::oscillator_with_stop(-0.75), 0.0, 8.0, v), "");  // pressed for good
  EXPECT_EQ(v, 0.0);
  EXPECT_EQ(from_contact(oracle::oscillator_with_stop(0.0, 0.5, -1.0), 0.0, 0.125, v), "");  // x''' = -1: leaves
  EXPECT_LT(v, 0.0);
  EXPECT_EQ(from_contact(oracle::oscillator_with_stop(0.0, 0.5, 1.0), 0.0, 0.125, v), "");  // x''' = 1: pressed
  EXPECT_EQ(v, 0.0);
}

TEST(Start, ImpactAtOnceIsReportedAtTheStartAndOnce) {  // K6
  const System system(oracle::oscillator_with_stop(0.75));
  Motion motion(system, {0.75, 1.0}, Instant{3, 0.25});
  ASSERT_EQ(motion.advance(Instant{3, 0.26}), Outcome::event);
  EXPECT_EQ(motion.event().time, (Instant{3, 0.25}));
  EXPECT_EQ(motion.event().w, 1.0);
  EXPECT_EQ(motion.before()[1], 1.0);
  EXPECT_EQ(motion.state()[1], -0.5);
  EXPECT_EQ(motion.advance(Instant{3, 0.26}), Outcome::reached_end);
}

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

TEST(Impact, NextEventIsStrictlyLater) {  // K7
  for (const double r : {0.08, 0.5, 1 - 0x1p-53}) {
    SineTowardsWall sine(0.5, r);
    const auto events = run(sine.motion, 60.0, 200);
    ASSERT_GT(events.size(), 5u);
    for (std::size_t i = 1; i < events.size(); ++i) EXPECT_GT(events[i].time, events[i - 1].time) << r;
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

Model unstopped(Model model) {
  model.stops.clear();
  return model;
}

TEST(Flow, ResonanceGrowsLinearly) {  // K27
  const System system(unstopped(oracle::oscillator_with_stop(0.0, 0.5, 1.0, 1.0)));
  for (const double t :
       {1.0, 10.0, 100.0, 1000.0}) {  // one segment of hundreds of windows: its time is no sum of roundings
    Motion motion(system, {0.0, 0.0});
    const Instant end = Instant{}.plus(t / system.period());
    motion.advance(end);
    const oracle::Real s = 2 * oracle::pi() * (oracle::Real(end.period) + oracle::Real(end.fraction));
    EXPECT_NEAR(motion.state()[0], ((sin(s) - s * cos(s)) / 2).convert_to<double>(), 2e-16 * t * (1 + t)) << t;
  }
}

TEST(Flow, NearResonanceIsAsGood) {  // K28
  double worst = 0.0;
  for (int k = 1; k <= 52; ++k) {
    const Model model = unstopped(oracle::oscillator_with_stop(0.0, 0.5, 1.0, 1.0 + std::ldexp(1.0, -k)));
    const System system(model);
    Motion motion(system, {0.0, 0.0});
    // From rest, x = (sin(w t) - w sin t) / (1 - w^2).
    const Instant end = Instant{}.plus(100.0 / system.period());
    const oracle::Real w(model.omega);
    const oracle::Real t = 2 * oracle::pi() / w * (oracle::Real(end.period) + oracle::Real(end.fraction));
    motion.advance(end);
    const oracle::Real exact = (sin(w * t) - w * sin(t)) / (1 - w * w);
    worst = std::max(worst, abs(oracle::Real(motion.state()[0]) - exact).convert_to<double>());
  }
  EXPECT_LE(worst, 1e-13 * 101);
  std::printf("near resonance: largest error %.1e\n", worst);
}

TEST(Flow, CriticalDampingAndItsNeighbours) {  // K29, K30
  double worst = 0.0;
  for (int k = 1; k <= 53; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const double zeta = k == 53 ? 1.0 : 1.0 + sign * std::ldexp(1.0, -k);
      const Model model = unstopped(oracle::oscillator_with_stop(0.0, 0.5, 0.0, 1.0, 2 * zeta));
      const System system(model);
      Motion motion(system, {1.0, 1.0});
      oracle::Oracle exact(model, {1.0, 1.0});
      motion.advance(Instant{0, 0.375});
      exact.run(exact.period() * oracle::Real(0.375));
      worst = std::max(worst, abs(oracle::Real(motion.state()[0]) - exact.state()[0]).convert_to<double>());
    }
  }
  EXPECT_LE(worst, 2e-15);
  std::printf("near critical damping: largest error %.1e\n", worst);
}

TEST(Flow, StartAtALargePeriodHasTheSameBits) {  // K33
  const System system(oracle::vibro_impact(4.801));
  Motion near(system, {-0.5, 0, 0, 0}, Instant{0, 0.375});
  const std::int64_t far_away = 1'000'000'000'000;
  Motion far(system, {-0.5, 0, 0, 0}, Instant{far_away, 0.375});
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(near.advance({100'000, 0.0}), far.advance({far_away + 100'000, 0.0}));
    ASSERT_EQ(near.event().kind, far.event().kind);
    ASSERT_EQ(near.event().time.fraction, far.event().time.fraction);
    ASSERT_EQ(near.event().time.period + far_away, far.event().time.period);
    ASSERT_EQ(near.state(), far.state());
  }
}

TEST(
    Impact,
    AtTheVeryEndOfAWindowIsFoundOnceAndInItsPlace) {  // constant speed: the window's end lies anywhere within the noise
  Model model;
  model.name = "glider";
  model.coordinates = {{"x", 1.0}};
  model.stops = {{"wall", 0, ground, 0.0, 0.5}};
  const double H = System(model).mode(0).window();
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
