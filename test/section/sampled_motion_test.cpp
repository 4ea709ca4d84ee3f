/// Samples must lie on the trajectory, be where they are due, and leave the events alone.
#include "slapstick/section/sampled_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "flow/engine.hpp"

namespace slapstick {
namespace {

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

TEST(SampledMotion, SamplesOfABallAreItsParabolas) {
  const System system(ball(1.0));
  SampledMotion run(Motion(system, {0.5, 0.0}), 16);  // impacts at 1, 3, 5, ..
  int samples = 0;
  for (;;) {
    const auto item = run.next({20, 0.0});
    if (item == SampledMotion::Item::end) break;
    if (item == SampledMotion::Item::event) continue;
    const double t = samples / 16.0;
    ASSERT_EQ(run.sample().time.seconds(1.0), t);
    const double s = t <= 1.0 ? t : std::remainder(t, 2.0);  // from the last top
    ASSERT_NEAR(run.sample().state[0], 0.5 - 0.5 * s * s, 1e-13) << t;
    ++samples;
  }
  EXPECT_EQ(samples, 20 * 16 + 1) << "both ends are sampled";
}

/// Neither the place of a sample in a flight without an event nor the forcing's phase there is summed up.
TEST(SampledMotion, SamplesOfALongFlightAreTheMotion) {
  Model model;
  model.name = "linear";
  model.omega = 0.5623;
  model.coordinates = {{"x", 0.5705}};
  model.springs = {{0, ground, 1.207}};
  model.dampers = {{0, ground, 0.2715}};
  model.forces = {{0, 1, 0.742, 0.0}};
  const System system(model);
  SampledMotion run(Motion(system, {0.0, 0.0}), 1);
  while (run.next({3000, 0.0}) != SampledMotion::Item::end) continue;
  State there(2);
  run.motion().state(there);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(run.sample().state[i], there[i], 1e-11) << i;
}

TEST(SampledMotion, SampleAtTheInstantOfAnEventComesBeforeIt) {
  const System system(ball(0.5));
  SampledMotion run(Motion(system, {0.5, 0.0}), 1);
  ASSERT_EQ(run.next({5, 0.0}), SampledMotion::Item::sample);
  ASSERT_EQ(run.next({5, 0.0}), SampledMotion::Item::sample);
  EXPECT_NEAR(run.sample().state[1], -1.0, 1e-14);
  EXPECT_EQ(run.next({5, 0.0}), SampledMotion::Item::event);
}

TEST(SampledMotion, EventsAreTheSameBitsWithAnyNumberOfSamples) {
  const System system(paper(4.9));
  const auto events = [&](int samples) {
    SampledMotion run(Motion(system, {-0.5, 0.0, 0.0, 0.0}), samples);
    std::vector<Instant> times;
    for (auto item = run.next({200, 0.0}); item != SampledMotion::Item::end; item = run.next({200, 0.0}))
      if (item == SampledMotion::Item::event) times.push_back(run.motion().event().time);
    return times;
  };
  const auto plain = events(0);
  EXPECT_GT(plain.size(), 100U);
  EXPECT_EQ(events(7), plain);
  EXPECT_EQ(events(200), plain);
}

/// Continuity: between neighbouring samples of one mode the displacement changes as the velocities say (trapezoid).
TEST(SampledMotion, SamplesFitTogetherInEveryMode) {
  for (const double omega : {0.552, 1.5, 2.2, 4.9}) {
    const System system(paper(omega));
    constexpr int per_period = 400;
    SampledMotion run(Motion(system, {-0.5, 0.0, 0.0, 0.0}), per_period);
    SampledMotion::Sample last;
    const double h = system.period() / per_period;
    bool undisturbed = false;
    long samples = 0;
    for (auto item = run.next({40, 0.0}); item != SampledMotion::Item::end; item = run.next({40, 0.0})) {
      if (item == SampledMotion::Item::event) {
        undisturbed = false;
        continue;
      }
      const auto& now = run.sample();
      if (undisturbed) {
        for (int i = 0; i < 4; i += 2)
          ASSERT_NEAR(now.state[i] - last.state[i], 0.5 * h * (now.state[i + 1] + last.state[i + 1]), h * h * h)
              << omega << " " << samples;
      }
      undisturbed = true;
      last = now;
      ++samples;
    }
    EXPECT_EQ(samples, 40 * per_period + 1);
  }
}

TEST(SampledMotion, SamplesOnlyFromAnInstantOnAreTheSame) {
  const System system(paper(4.9));
  SampledMotion all(Motion(system, {-0.5, 0.0, 0.0, 0.0}), 10),
      late(Motion(system, {-0.5, 0.0, 0.0, 0.0}), 10, {18, 0.05});
  std::vector<State> expected, found;
  for (auto item = all.next({20, 0.0}); item != SampledMotion::Item::end; item = all.next({20, 0.0}))
    if (item == SampledMotion::Item::sample && all.sample().time >= Instant{18, 0.1})
      expected.push_back(all.sample().state);
  for (auto item = late.next({20, 0.0}); item != SampledMotion::Item::end; item = late.next({20, 0.0}))
    if (item == SampledMotion::Item::sample) found.push_back(late.sample().state);
  EXPECT_EQ(expected.size(), 20U);
  EXPECT_EQ(found, expected);
}

/// Never reaches its stop.
System flight_without_end() {
  Model model = paper(1.3);
  model.frictions.clear();
  model.stops[0].clearance = 100.0;
  return System(model);
}

/// Each sample once began at the flight's start again: four times the work for twice the time.
TEST(SampledMotion, AFlightWithoutEventsIsSteppedThroughOnce) {
  const System system = flight_without_end();
  for (const int periods : {50, 400}) {
    SampledMotion run(Motion(system, {-0.5, 0.0, 0.0, 0.0}), 20);
    long samples = 0;
    while (run.next({periods, 0.0}) == SampledMotion::Item::sample) ++samples;
    EXPECT_EQ(samples, 20 * periods + 1);
    EXPECT_GT(run.motion().counters().windows, 2 * periods);
    EXPECT_LE(run.motion().engine().sampled_windows(), run.motion().counters().windows);
  }
}

TEST(SampledMotion, AStateDoesNotDependOnTheStatesReadBefore) {
  const System system = flight_without_end();
  Motion motion(system, {-0.5, 0.0, 0.0, 0.0});
  ASSERT_EQ(motion.advance({60, 0.0}), Outcome::reached_end);
  const Motion unread = motion;
  State state(4);
  const auto at = [&](const Motion& from, double s) {
    from.sample(s, state);
    return state;
  };
  for (const bool back : {false, true}) {
    for (int i = 0; i <= 100; ++i) {
      const double s = motion.segment().duration * (back ? 100 - i : i) / 100;
      EXPECT_EQ(at(motion, s), at(Motion(unread), s)) << i << " " << back;
    }
  }
}

TEST(SampledMotion, AfterACutStatesAreThoseOfTheNewSegment) {
  const System system = flight_without_end();
  Motion motion(system, {-0.5, 0.0, 0.0, 0.0});
  State before(4), after(4);
  ASSERT_EQ(motion.advance({7, 0.0}), Outcome::reached_end);
  motion.sample(motion.segment().duration, before);
  ASSERT_EQ(motion.advance({9, 0.0}), Outcome::reached_end);
  motion.sample(0.0, after);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(after[i], before[i], 1e-13) << i;  // rounding of some thirty windows
}

/// The pair touches its stop and approaches: the impact is due, and turns the direction of slip at once.
TEST(SampledMotion, StartsInTheModeAfterAnImpactThatIsDue) {
  const System system(paper(2.2));
  for (const int periods : {0, 1}) {
    SampledMotion run(Motion(system, {0.0, 1.0, 0.0, 0.0}), 4);
    ASSERT_EQ(run.next({periods, 0.0}), SampledMotion::Item::sample);
    EXPECT_EQ(system.mode_name(run.sample().mode), "slip-") << periods;
  }
}

TEST(SampledMotion, OfNoLengthIsInTheModeThatStarts) {
  const System system(paper(2.2));
  const auto mode = [&](const State& start) {
    SampledMotion run(Motion(system, start), 4);
    EXPECT_EQ(run.next({}), SampledMotion::Item::sample);
    return system.mode_name(run.sample().mode);
  };
  EXPECT_EQ(mode({-0.1, 1.0, 0.0, 0.0}), "slip+");
  EXPECT_EQ(mode({-0.1, -1.0, 0.0, 0.0}), "slip-");
  EXPECT_EQ(mode({-0.1, 0.0, 0.0, 0.0}), "stick");
}

TEST(SampledMotion, StartsAtTheFirstMultipleFromItsOwnInstant) {
  const System system(paper(2.2));
  SampledMotion run(Motion(system, {-0.5, 0.0, 0.0, 0.0}, Instant{3, 0.3}), 4);
  ASSERT_EQ(run.next({4, 0.0}), SampledMotion::Item::sample);
  EXPECT_EQ(run.sample().time, (Instant{3, 0.5}));
}

}  // namespace
}  // namespace slapstick
