/// Stick and slip where everything is known in closed form. Case numbers K are those of shared/reliability.md, section 2.
#include <gtest/gtest.h>

#include <numbers>

#include "flow/runs.hpp"
#include "oracle/models.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;
using testing::kinds;
using testing::run;

TEST(Friction, ContactAndReversalTogetherAreOneTouchWithoutImpulse) {  // K5
  for (const double shift : {0.0, 0x1p-50, -0x1p-50, 0x1p-53, -0x1p-53, 1e-12, -1e-12}) {
    Model m = oracle::friction_oscillator(0.125, 0.125);
    m.stops = {{"wall", 0, ground, 0.75 * (1 + shift), 0.5}};
    const System system(m);
    Motion motion(system, {-1.0, 0.0});
    motion.advance(Instant{}.plus(3.3 / system.period()));
    const Event event = motion.event();
    EXPECT_TRUE(event.kind == EventKind::graze || event.kind == EventKind::slip_minus || event.w < 1e-5)
        << name(event.kind) << " " << event.w;
    EXPECT_NEAR(testing::seconds(event, motion), pi, 1e-5);
    run(motion, 2 * pi - motion.time().seconds(system.period()));  // turns at -0.5
    EXPECT_NEAR(motion.state()[0], -0.5, 1e-5) << shift;
    EXPECT_NEAR(motion.state()[1], 0.0, 1e-5) << shift;
  }
}

TEST(Friction,
     ContactAndReversalTogetherThenPushedOn) {  // the gap may be a rounding below zero when the pair sticks there
  for (int k = -40; k <= 40; ++k) {
    Model m = oracle::friction_oscillator(1.0, 0.125, 1.5, 0.25);
    m.springs[0].stiffness = 1.0 + 0.01 * k;  // moves the turning point through many roundings
    const System free_system(m);
    Motion scout(free_system, {-1.0, 0.0});
    if (scout.advance(Instant{}.plus(1.0)) != Outcome::event) continue;
    while (scout.event().kind != EventKind::stick && scout.advance(Instant{2, 0.0}) == Outcome::event) {
    }
    for (const double shift : {0.0, 0x1p-53, -0x1p-53, 0x1p-52, -0x1p-52}) {
      m.stops = {{"wall", 0, ground, scout.state()[0] * (1 + shift), 0.5}};
      if (m.stops[0].clearance < -1.0) continue;
      const System system(m);
      Motion motion(system, {-1.0, 0.0});
      EXPECT_NO_THROW(run(motion, 3 * system.period(), 1000)) << k << " " << shift;
      EXPECT_LE(motion.state()[0], m.stops[0].clearance * (1 + 1e-15));
    }
  }
}

TEST(Friction, CoulombDecayLosesTwoFrictionPerHalfPeriodOfPi) {  // K14
  const System system(oracle::friction_oscillator(0.1, 0.1));
  Motion motion(system, {1.0, 0.0});
  const auto events = run(motion, 100.0);
  ASSERT_EQ(kinds(events), "slip+ slip- slip+ slip- stick");
  for (std::size_t i = 0; i < events.size(); ++i)
    EXPECT_NEAR(testing::seconds(events[i], motion), static_cast<double>(i + 1) * pi, 2e-14);
  EXPECT_NEAR(std::abs(motion.state()[0]), 0.0, 1e-15);
}

TEST(Friction, StickAtATurningPointWithEqualityIsStick) {  // K13
  const System system(oracle::friction_oscillator(0.125, 0.125));
  Motion motion(system, {1.125, 0.0});
  const double turns[] = {-0.875, 0.625, -0.375, 0.125};
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(motion.advance({100, 0.0}), Outcome::event);
    EXPECT_NEAR(motion.state()[0], turns[i], 1e-15);
    EXPECT_NEAR(testing::seconds(motion.event(), motion), (i + 1) * pi, 4e-15 * (i + 1));
    EXPECT_EQ(name(motion.event().kind), i == 3 ? "stick" : i % 2 == 0 ? "slip+" : "slip-");
  }
  EXPECT_EQ(motion.advance({100, 0.0}), Outcome::reached_end);
}

TEST(Friction, JustBeyondEqualityItSlipsOn) {  // K13: x0 = 1.125 + 2^-40
  const System system(oracle::friction_oscillator(0.125, 0.125));
  Motion motion(system, {1.125 + 0x1p-40, 0.0});
  EXPECT_EQ(kinds(run(motion, 30.0)), "slip+ slip- slip+ slip- stick");
  EXPECT_NEAR(motion.state()[0], 0.125 - 0x1p-40, 1e-15);
}

TEST(Friction, ForceThatOnlyTouchesTheLimitDoesNotRelease) {  // K12
  const System system(oracle::friction_oscillator(0.125, 0.125, 0.125, 1.0));
  Motion motion(system, {0.0, 0.0});
  for (const Event& event : run(motion, 100.0)) EXPECT_EQ(name(event.kind), "graze");
  EXPECT_NEAR(motion.state()[0], 0.0, 1e-15);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "stick");
  EXPECT_GT(motion.counters().grazes, 10);
}

TEST(Friction, ForceOneUlpBeyondTheLimitReleasesOrIsFlagged) {  // K12
  const System system(oracle::friction_oscillator(0.125, 0.125, 0.125 + 0x1p-55, 1.0));
  Motion motion(system, {0.0, 0.0});
  const auto events = run(motion, 2.0);
  ASSERT_FALSE(events.empty());
  EXPECT_TRUE(events[0].kind == EventKind::release || events[0].kind == EventKind::graze);
  EXPECT_NEAR(testing::seconds(events[0], motion), pi / 2, 1e-6);
}

TEST(Friction, ReleaseTimeNearTangencyIsTheArcsine) {
  for (int k = 2; k <= 30; ++k) {
    const double amplitude = 0.125 * (1 + std::ldexp(1.0, -k));
    const System system(oracle::friction_oscillator(0.125, 0.125, amplitude, 1.0));
    Motion motion(system, {0.0, 0.0});
    const auto events = run(motion, 2.0, 1);
    ASSERT_EQ(kinds(events), "release") << k;
    EXPECT_NEAR(testing::seconds(events[0], motion), std::asin(0.125 / amplitude),
                2e-15 * std::sqrt(std::ldexp(1.0, k)) + 1e-15)
        << k;
  }
}

TEST(Friction, AccelerationJumpsWhereStaticExceedsKinetic) {  // K15
  const double f_s = 0.2, f_k = 0.1, A = 0.5;
  const System system(oracle::friction_oscillator(f_s, f_k, A, 0.5));
  Motion motion(system, {0.0, 0.0});
  ASSERT_EQ(motion.advance({1, 0.0}), Outcome::event);
  EXPECT_EQ(name(motion.event().kind), "release");
  EXPECT_NEAR(testing::seconds(motion.event(), motion), std::asin(f_s / A) / 0.5, 1e-15);
  const double h = 1e-4;
  motion.advance(motion.time().plus(h / system.period()));
  EXPECT_NEAR(motion.state()[1] / h, f_s - f_k, 1e-4);
}

TEST(Friction, WithoutFrictionThereIsNoStick) {  // K16
  Model rough = oracle::vibro_impact(1.5), smooth = rough;
  rough.frictions[0].static_friction = rough.frictions[0].kinetic_friction = 0.0;
  smooth.frictions.clear();
  const System a(rough), b(smooth);
  Motion with(a, {-0.5, 0, 0, 0}), without(b, {-0.5, 0, 0, 0});
  std::vector<Event> impacts;
  for (const Event& event : run(with, 60.0)) {
    EXPECT_NE(event.kind, EventKind::stick);
    if (event.kind == EventKind::impact) impacts.push_back(event);
  }
  const auto expected = run(without, 60.0);
  ASSERT_EQ(impacts.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(impacts[i].time.since(expected[i].time), 0.0, 1e-12);
}

TEST(Friction, StaticBelowKineticIsRefused) {  // K17
  EXPECT_THROW(System(oracle::friction_oscillator(0.1, 0.2)), InputError);
}

TEST(Belt, CycleIsTheClosedForm) {  // case F6: T = 2 pi - 2 atan(D / v0) + 2 D / v0
  Model m = oracle::friction_oscillator(1.5, 1.0);
  m.frictions[0].belt_speed = 0.5;
  const System system(m);
  Motion motion(system, {0.0, 0.0});
  const auto events = run(motion, 80.0);
  ASSERT_GE(events.size(), 8u);
  const double D = 0.5, period = 2 * pi - 2 * std::atan(D / 0.5) + 2 * D / 0.5;
  for (std::size_t i = 2; i + 2 < events.size(); ++i) {
    EXPECT_EQ(events[i + 2].kind, events[i].kind);
    EXPECT_NEAR(events[i + 2].time.since(events[i].time) * system.period(), period, 1e-13);
  }
}

TEST(ClosedStop, HoldsHoweverLargeTheForceAndReleasesAtMinusStaticFriction) {  // K10, K11
  const Model model = oracle::vibro_impact(0.552);
  const System system(model);
  Motion motion(system, {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(system.mode_name(motion.mode_id()), "stick|closed");
  oracle::Oracle exact(model, {0.0, 0.0, 0.0, 0.0});
  const auto expected = exact.next(oracle::Real(20));
  ASSERT_EQ(motion.advance({2, 0.0}), Outcome::event);  // the first event: no ping-pong of release and impact before
  EXPECT_EQ(name(motion.event().kind), "release");
  EXPECT_EQ(motion.event().contact, 0);
  EXPECT_NEAR(testing::seconds(motion.event(), motion), expected->time.convert_to<double>(), 1e-14);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "slip-");
}

TEST(Stick, HasNoGapEventOfItsOwnPairAndOneOfAThirdBody) {  // K9
  const System paper(oracle::vibro_impact(1.5));
  const mode::Mode& stick = paper.mode(paper.mode_id({{mode::StopState::open}, {mode::FrictionState::stick}}));
  for (const mode::Guard& guard : stick.guards()) EXPECT_NE(guard.kind, mode::GuardKind::gap);

  Model m;  // two blocks stuck on each other are pressed against a wall that stops the first one only
  m.coordinates = {{"x1", 1.0}, {"x2", 2.0}};
  m.forces = {{0, 0, 1.0, 0.0}};
  m.frictions = {{"blocks", 0, 1, 0.0, 0.75, 0.75}};
  m.stops = {{"wall", 0, ground, 1.0, 0.5}};
  const System system(m);
  Motion motion(system, {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(system.mode_name(motion.mode_id()), "stick");
  ASSERT_EQ(motion.advance({20, 0.0}), Outcome::event);
  EXPECT_EQ(name(motion.event().kind), "impact");
  EXPECT_NEAR(motion.time().seconds(1.0), std::sqrt(6.0), 1e-14);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "slip-");
  const auto rest = run(motion, 40.0);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "stick|closed") << kinds(rest).substr(0, 200);
}

}  // namespace
}  // namespace slapstick
