/// Sections against closed forms, and against the event list of the same motion.
#include <gtest/gtest.h>

#include <cmath>

#include "section/run_impacts.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/section/stroboscopic_section.hpp"

extern long allocations;  // count_allocations.cpp

namespace slapstick {
namespace {

/// A ball above a floor at 0, gravity 1: without forcing the period is 1.
Model ball(double restitution) {
  Model model;
  model.name = "ball";
  model.coordinates = {{"x", 1.0}};
  model.forces = {{0, 0, -1.0, 0.0}};
  model.stops = {{"floor", ground, 0, 0.0, restitution}};
  return model;
}

Model paper(double omega) {
  Model model;
  model.name = "paper";
  model.coordinates = {{"x1", 1.0}, {"x2", 10.0}};
  model.springs = {{0, 1, 1.0}, {1, ground, 5.0}};
  model.dampers = {{0, 1, 0.2}, {1, ground, 1.0}};
  model.forces = {{0, 1, 1.0, 0.0}};
  model.frictions = {{"friction", 0, 1, 0.0, 0.15, 0.15}};
  model.stops = {{"stop", 0, 1, 0.0, 0.8}};
  model.omega = omega;
  return model;
}

const State rest{-0.5, 0.0, 0.0, 0.0};

TEST(ImpactSection, FlightsOfAnElasticBallAreItsPeriod) {
  const System system(ball(1.0));
  ImpactSection section(Motion(system, {0.5, 0.0}));  // falls for 1, then bounces every 2
  SectionPoint point;
  ASSERT_TRUE(section.next({100, 0.0}, point));
  EXPECT_NEAR(point.time.seconds(1.0), 1.0, 1e-14);
  EXPECT_NEAR(point.w, 1.0, 1e-14);
  EXPECT_TRUE(std::isnan(point.flight)) << "no impact before: the flight is not known";
  EXPECT_TRUE(std::isnan(point.sliding));
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(section.next({100, 0.0}, point));
    EXPECT_NEAR(point.flight, 2.0, 1e-13);
    EXPECT_EQ(point.sliding, 0.0) << "there is no friction contact";
    EXPECT_NEAR(point.state[1], -1.0, 1e-13) << "the state just before, not after";
  }
}

TEST(ImpactSection, EndWithoutAnImpactLeavesThePointAloneAndTheMotionThere) {
  const System system(ball(1.0));
  ImpactSection section(Motion(system, {0.5, 0.0}));
  SectionPoint point;
  point.w = 7.0;
  EXPECT_FALSE(section.next({0, 0.75}, point));
  EXPECT_EQ(point.w, 7.0);
  EXPECT_EQ(section.motion().time(), (Instant{0, 0.75}));
  EXPECT_TRUE(section.next({2, 0.0}, point)) << "the section goes on after a cut";
}

TEST(ImpactSection, SlidingTimeIsTheFlightLessTheStickPhases) {
  const System system(paper(1.5));  // 1-1-II: one impact and one stick phase per period
  ImpactSection section(Motion(system, rest));
  SectionPoint point;
  while (section.next({300, 0.0}, point)) {
  }
  double stuck = 0.0;
  Instant stick_begin;
  section.watch([&](const Motion& motion) {
    const Event& event = motion.event();
    if (event.kind == EventKind::stick) stick_begin = event.time;
    if (event.kind == EventKind::release) stuck = event.time.since(stick_begin);
  });
  ASSERT_TRUE(section.next({400, 0.0}, point));
  ASSERT_TRUE(section.next({400, 0.0}, point));
  EXPECT_NEAR(point.flight, 1.0, 1e-9);
  EXPECT_GT(stuck, 0.001);
  EXPECT_NEAR(point.sliding, point.flight - stuck, 1e-14);
  EXPECT_EQ(section.between().sticks, 1);
  EXPECT_EQ(section.between().releases, 1);
  EXPECT_EQ(section.between().chatters, 0);
}

TEST(ImpactSection, SlidingWithoutStickIsTheWholeFlight) {
  const System system(paper(2.2));
  ImpactSection section(Motion(system, rest));
  SectionPoint point;
  while (section.next({300, 0.0}, point)) {
  }
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(section.next({400, 0.0}, point));
    EXPECT_NEAR(point.flight, 1.0, 1e-9);
    EXPECT_NEAR(point.sliding, point.flight, 1e-14);
    EXPECT_EQ(section.between().sticks, 0);
    EXPECT_EQ(point.phase, point.time.fraction);
  }
}

TEST(ImpactSection, FlightAfterACompleteChatterBeginsAtItsLimit) {
  const System system(paper(0.552));
  ImpactSection section(Motion(system, rest));
  SectionPoint point;
  Instant limit;
  long chatters = 0;
  section.watch([&](const Motion& motion) {
    if (motion.event().kind == EventKind::chatter) limit = motion.event().time;
  });
  while (section.next({60, 0.0}, point)) {
    if (section.between().chatters == 0) continue;
    ++chatters;
    EXPECT_EQ(point.flight, point.time.since(limit));
  }
  EXPECT_GE(chatters, 20);
}

TEST(ImpactSection, ACopyGoesOnWithTheSameBits) {
  const System system(paper(4.9));
  ImpactSection section(Motion(system, rest));
  SectionPoint a, b;
  while (section.next({100, 0.0}, a)) {
  }
  ImpactSection copy = section;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(section.next({400, 0.0}, a));
    ASSERT_TRUE(copy.next({400, 0.0}, b));
    ASSERT_EQ(a.time, b.time);
    ASSERT_EQ(a.w, b.w);
    ASSERT_EQ(a.flight, b.flight);
    ASSERT_EQ(a.state, b.state);
  }
}

TEST(ImpactSection, NoAllocationPerPoint) {
  const System system(paper(2.2));
  ImpactSection section(Motion(system, rest));
  SectionPoint point;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(section.next({100, 0.0}, point));  // the modes are built as they are met
  const long before = allocations;
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(section.next({100, 0.0}, point));
  EXPECT_EQ(allocations, before);
}

TEST(StroboscopicSection, EveryPeriodOnceAtExactlyThePhase) {
  const System system(paper(2.2));
  for (const double phase : {0.0, 0.25, 0.9}) {
    StroboscopicSection section(Motion(system, rest), phase);
    StroboscopicPoint point;
    for (int i = 0; i < 20; ++i) {
      section.next(point);
      EXPECT_EQ(point.time, (Instant{phase > 0.0 ? i : i + 1, phase}));
      EXPECT_EQ(point.state.size(), 4U);
    }
  }
}

TEST(StroboscopicSection, AgreesWithAnUncutMotionOfTheSamePeriodicOrbit) {
  const System system(paper(2.2));
  StroboscopicSection section(Motion(system, rest), 0.5);
  StroboscopicPoint point;
  for (int i = 0; i < 300; ++i) section.next(point);
  const State fixed = point.state;
  section.next(point);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(point.state[i], fixed[i], 1e-11);
  Motion motion(system, rest);
  while (motion.advance({400, 0.5}) == Outcome::event) {
  }
  const State uncut = motion.state();
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(uncut[i], fixed[i], 1e-11);
}

TEST(StroboscopicSection, RefusesAModelWithoutForcingAndAPhaseOutsideThePeriod) {
  const System unforced(ball(0.5)), forced(paper(2.2));
  EXPECT_THROW(StroboscopicSection(Motion(unforced, {0.5, 0.0}), 0.0), InputError);
  EXPECT_THROW(StroboscopicSection(Motion(forced, rest), 1.0), InputError);
  EXPECT_THROW(StroboscopicSection(Motion(forced, rest), -0.1), InputError);
  EXPECT_THROW(StroboscopicSection(Motion(forced, rest), std::nan("")), InputError);
}

TEST(Stage, EndsLaterThanNowWhateverTheFractionRoundsTo) {
  for (const double omega : {3e-7, 1e-7, 7e-8, 2e-4, 2.0}) {
    const System system(paper(omega));
    const double most = std::max(1.0, 1e6 / system.windows_per_period());
    Instant now;
    for (int i = 0; i < 5000; ++i) {
      const Instant next = next_stage(system, now, {1 << 30, 0.5});
      ASSERT_GT(next, now) << omega;
      ASSERT_LE(next.since(now), most * (1.0 + 1e-9)) << omega;
      now = next;
    }
    EXPECT_EQ(next_stage(system, {2, 0.25}, {2, 0.25000001}), (Instant{2, 0.25000001}));
  }
}

TEST(Stage, AStopIsSeenBeforeTheEnd) {
  const System system(paper(1e-6));
  const std::atomic<bool> stop = true;
  Motion motion(system, rest);
  EXPECT_FALSE(run_to(motion, {1'000'000, 0.0}, &stop, [] {}));
  EXPECT_LT(motion.counters().windows, 3'000'000);
  ImpactSection section(Motion(system, rest));
  EXPECT_FALSE(run_impacts(section, {1'000'000, 0.0}, &stop, [](const SectionPoint&) { return true; }));
  StroboscopicPoint point;
  EXPECT_FALSE(StroboscopicSection(Motion(system, rest), 0.5).next(point, &stop));
}

}  // namespace
}  // namespace slapstick
