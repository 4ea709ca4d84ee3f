/// Cases of shared/cases.json that one stop and one friction contact can run. Each check names the case's id; numbers and
/// tolerances are the file's.
#include <gtest/gtest.h>

#include <numbers>

#include "flow/runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;
using testing::run;

double time_of(const Event& event, const Motion& motion) { return testing::seconds(event, motion); }

/// x'' + 2 z x' + x = cos(w t), x <= clearance.
Model cosine_oscillator(double clearance, double r, double w, double z) {
  Model m = oracle::oscillator_with_stop(clearance, r, 1.0, w, 2 * z);
  m.forces[0].phase = pi / 2;
  return m;
}

TEST(Impact, I1FreeSpringWithAStopAtRestPosition) {
  const System system(oracle::oscillator_with_stop(0.0, 0.7, 0.0, 1.0, 0.1));
  Motion motion(system, {0.0, -1.0});
  const auto events = run(motion, 40.0);
  ASSERT_GT(events.size(), 5u);
  EXPECT_NEAR(events[0].w, 0.8544678930067564, 1e-9) << "I1.03";
  for (std::size_t i = 1; i < 5; ++i)
    EXPECT_NEAR(time_of(events[i], motion) - time_of(events[i - 1], motion), 3.1455270228880017, 1e-9) << "I1.01";
}

TEST(Impact, I2BallDroppedOnTheFloor) {
  Model m = oracle::ball(0.8);
  m.forces[0].amplitude = -9.81;
  const System system(m);
  Motion motion(system, {1.0, 0.0});
  const auto events = run(motion, 10.0);
  EXPECT_NEAR(events.front().time.seconds(1.0), 0.4515236409857309, 1e-10) << "I2.01";
  EXPECT_EQ(name(events.back().kind), "chatter");
  EXPECT_NEAR(events.back().time.seconds(1.0), 4.063712768871579, 1e-12) << "I2.03 asks for 1e-6";
}

TEST(Impact, I3PreloadedSpring) {
  Model m = oracle::oscillator_with_stop(0.0, 0.6);
  m.stops = {{"stop", ground, 0, -1.0, 0.6}};  // x >= 1
  const System system(m);
  Motion motion(system, {1.0, 2.0});
  const auto events = run(motion, 40.0);
  EXPECT_NEAR(time_of(events.front(), motion), 2.214297435588181, 1e-10) << "I3.01";
  EXPECT_EQ(name(events.back().kind), "chatter");
  EXPECT_NEAR(time_of(events.back(), motion), 7.311706543507938, 1e-12) << "I3.03 asks for 1e-6";
}

TEST(Impact, I4PeriodicOrbitInClosedForm) {
  struct Case {
    const char* id;
    double r, w, clearance, z, speed;
    int n;
  };
  for (const Case& c : {Case{"I4.09", 0.8, 2.2, 0.1, 0.05, 1.125731087829907, 1},
                        Case{"I4.17", 0.6, 1.9, -0.2, 0.02, 1.7834056394146196, 1}}) {
    const System system(cosine_oscillator(c.clearance, c.r, c.w, c.z));
    Motion motion(system, {c.clearance - 0.5, 0.0});
    run(motion, 400 * system.period());
    for (const Event& event : run(motion, 4 * system.period())) EXPECT_NEAR(event.w, c.speed, 1e-8) << c.id;
  }
}

TEST(Impact, I6GrazingDeviationGrowsLikeTheSquareRoot) {
  const double w = 0.8, z = 0.1, r = 0.7, a = 1 - w * w, b = 2 * z * w;
  const double G = 1 / std::sqrt(a * a + b * b), phase = std::atan2(b, a);
  EXPECT_NEAR(G, 2.538365412834048, 1e-12) << "I6.01";
  const double expected[][2] = {
      {1e-2, -0.23350135923084814}, {1e-4, -0.02337293697011197}, {1e-6, -0.0023373164868683077}};
  for (const auto& [d, deviation] : expected) {
    const System system(cosine_oscillator(G - d, r, w, z));
    const double start = phase - 0.3;  // angle w t, shortly before the maximum of G cos(w t - phase)
    Motion motion(system, {G * std::cos(start - phase), -w * G * std::sin(start - phase)},
                  Instant{}.plus(start / (2 * pi)));
    ASSERT_EQ(motion.advance({2, 0.0}), Outcome::event);
    ASSERT_EQ(motion.advance(testing::after(motion, 1.0)), Outcome::reached_end);
    const double angle = 2 * pi * (static_cast<double>(motion.time().period) + motion.time().fraction);
    EXPECT_NEAR(motion.state()[0] - G * std::cos(angle - phase), deviation, 1e-8) << "I6.03-07, d = " << d;
  }
}

TEST(Impact, I8BallOnAShakenTable) {
  const double cases[][2] = {{1.5, 3.5662167369280175}, {2.0, 4.658851475711561}, {3.0, 5.967608007806392}};
  for (const auto& [gamma, flight] : cases) {
    Model m = oracle::ball(0.5);
    m.omega = 1.0;
    m.forces.push_back({0, 1, gamma, 0.0});
    const System system(m);
    Motion motion(system, {0.0, 0.0});
    ASSERT_EQ(motion.advance({2, 0.0}), Outcome::event);
    EXPECT_EQ(name(motion.event().kind), "release");
    const double take_off = time_of(motion.event(), motion);
    EXPECT_NEAR(std::sin(take_off), 1 / gamma, 1e-14);
    ASSERT_EQ(motion.advance({3, 0.0}), Outcome::event);
    EXPECT_NEAR(time_of(motion.event(), motion) - take_off, flight, 1e-9) << "I8.01-05, Gam = " << gamma;
  }
  Model m = oracle::ball(0.5);
  m.omega = 1.0;
  m.forces.push_back({0, 1, 0.9, 0.0});
  const System system(m);
  Motion motion(system, {0.0, 1.0});
  for (int i = 0; i < 10; ++i) motion.advance({9, 0.0});
  EXPECT_NEAR(time_of(motion.event(), motion), 6.301927254598174, 1e-8) << "I8.09";
}

TEST(Impact, I11TwoMassesWithoutFriction) {
  Model m = oracle::vibro_impact(2.2);
  m.frictions.clear();
  const System system(m);
  Motion motion(system, {-0.5, 0, 0, 0});
  run(motion, 400 * system.period());
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(motion.advance(testing::after(motion, 100.0)), Outcome::event);
    EXPECT_NEAR(motion.event().w, 2.0780532108622527, 1e-9) << "I11.01";
    EXPECT_NEAR(motion.before()[0], -0.10797117334285887, 1e-8) << "I11.03";
  }
}

TEST(Friction, F1AndF2FreeVibration) {
  const System system(oracle::friction_oscillator(1.2, 1.0));
  Motion motion(system, {10.5, 0.0});
  std::vector<double> turns;
  while (motion.advance({99, 0.0}) == Outcome::event) turns.push_back(motion.state()[0]);
  ASSERT_EQ(turns.size(), 5u) << "F1.07";
  EXPECT_NEAR(turns[0], -8.5, 1e-9) << "F1.01";
  EXPECT_NEAR(turns[2], -4.5, 1e-9) << "F1.03";
  EXPECT_NEAR(turns[4], -0.5, 1e-9) << "F1.05";

  Model damped = oracle::friction_oscillator(0.3, 0.3);
  damped.dampers[0].coefficient = 0.2;
  const System viscous(damped);
  Motion decay(viscous, {10.0, 0.0});
  turns.clear();
  while (decay.advance({99, 0.0}) == Outcome::event) turns.push_back(std::abs(decay.state()[0]));
  EXPECT_NEAR(turns[0], 6.7737018585904085, 1e-9) << "F2.01";
  EXPECT_NEAR(turns[2], 2.7051795641859027, 1e-9) << "F2.03";
  EXPECT_NEAR(turns[4], 0.5415309335164276, 1e-9) << "F2.05";
  EXPECT_NEAR(time_of(decay.event(), decay), 18.944516501989657, 1e-8) << "F2.07";
}

TEST(Friction, F4GrowsAtResonance) {
  const System system(oracle::friction_oscillator(0.6, 0.6, -1.0, 1.0));
  Motion motion(system, {5.0, 0.0});
  for (int i = 1; i <= 10; ++i) {
    ASSERT_EQ(motion.advance({99, 0.0}), Outcome::event);
    EXPECT_NEAR(std::abs(motion.state()[0]), 5 + i * (pi / 2 - 1.2), i == 1 || i == 10 ? 1e-12 : 1e-8)
        << "F4.01, F4.03";
  }
  EXPECT_NEAR(std::abs(motion.state()[0]), 8.707963267948966, 1e-8) << "F4.03";
}

TEST(Friction, F5RigidBlockOnAShakenFloor) {
  Model m = oracle::friction_oscillator(0.7, 0.7, 1.0, 1.0);
  m.springs.clear();
  const System system(m);
  Motion motion(system, {0.0, 0.0});
  ASSERT_EQ(motion.advance({1, 0.0}), Outcome::event);
  EXPECT_NEAR(time_of(motion.event(), motion), 0.775397496610753, 1e-8) << "F5.05";
  const double start = motion.state()[0];
  ASSERT_EQ(motion.advance({1, 0.0}), Outcome::event);
  EXPECT_EQ(name(motion.event().kind), "stick");
  EXPECT_NEAR(motion.state()[0] - start, 0.4324939397237739, 1e-8) << "F5.07";
}

TEST(Friction, F6MassOnABelt) {
  const double cases[][5] = {{1.5, 1.0, 0.5, 6.71238898038469, 0.5}, {1.0, 0.4, 1.0, 6.402346306638418, -0.2}};
  for (const auto& [f_s, f_k, v, period, x] : cases) {
    Model m = oracle::friction_oscillator(f_s, f_k);
    m.frictions[0].belt_speed = v;
    const System system(m);
    Motion motion(system, {0.0, v});
    motion.advance({99, 0.0});
    motion.advance({99, 0.0});
    EXPECT_EQ(name(motion.event().kind), "stick");
    EXPECT_NEAR(motion.state()[0], x, 1e-8) << "F6.03, F6.09";
    const double stuck = time_of(motion.event(), motion);
    motion.advance({99, 0.0});
    motion.advance({99, 0.0});
    EXPECT_NEAR(time_of(motion.event(), motion) - stuck, period, 1e-8) << "F6.01, F6.07";
  }
}

TEST(Friction, F7AndF8TwoBlocks) {
  Model m;
  m.coordinates = {{"x1", 1.0}, {"x2", 2.0}};
  m.frictions = {{"between", 0, 1, 0.0, 0.5, 0.5}};
  const System blocks(m);
  Motion motion(blocks, {0, 3, 0, 0});
  ASSERT_EQ(motion.advance({99, 0.0}), Outcome::event);
  EXPECT_NEAR(motion.time().seconds(1.0), 4.0, 1e-9) << "F7.01";
  EXPECT_NEAR(motion.state()[0] - motion.state()[2], 6.0, 1e-9) << "F7.03";

  m.coordinates[1].mass = 3.0;
  m.springs = {{0, 1, 3.0}};
  m.frictions[0].static_friction = m.frictions[0].kinetic_friction = 0.6;
  const System pair(m);
  Motion swing(pair, {2.3, 0.25, 0, 0.25});
  const double stops[] = {1.9, 1.5, 1.1, 0.7, 0.3};
  for (const double stop : stops) {
    EXPECT_NE(swing.mode_id(), -1);
    ASSERT_EQ(swing.advance({99, 0.0}), Outcome::event);
    EXPECT_NEAR(std::abs(swing.state()[0] - swing.state()[2]), stop, 1e-9) << "F8.01-05";
  }
  EXPECT_NEAR(swing.state()[1], 0.25, 1e-12);
}

TEST(Friction, F10TwoStopsPerCycle) {
  const double cases[][3] = {
      {0.5, 0.55, 1.2812387984957834}, {0.7, 0.75, 1.4244902270603976}, {0.4, 0.7, 0.9495673616414488}};
  for (const auto& [w, f, amplitude] : cases) {
    Model m = oracle::friction_oscillator(f, f, 1.0, w);
    m.forces[0].phase = pi / 2;
    const System system(m);
    Motion motion(system, {0.5, 0.0});
    run(motion, 60 * system.period());
    int sticks = 0;
    const Instant end = testing::after(motion, 2 * system.period());
    while (motion.advance(end) == Outcome::event) {
      if (motion.event().kind != EventKind::stick) continue;
      ++sticks;
      EXPECT_NEAR(std::abs(motion.state()[0]), amplitude, 1e-8) << "F10, w = " << w;
    }
    EXPECT_EQ(sticks, 4) << "F10, w = " << w;
  }
}

TEST(Friction, F11NumberOfStopsPerCycle) {
  struct Case {
    double w, f;
    int sticks;
    double largest;
  };
  for (const Case& c : {Case{0.3, 0.3, 2, 0.876309952328388}, Case{0.1, 0.15, 4, 0.9087858254476928},
                        Case{0.1, 0.04, 4, 0.9596246676974738}}) {
    Model m = oracle::friction_oscillator(c.f, c.f, 1.0, c.w);
    m.forces[0].phase = pi / 2;
    const System system(m);
    Motion motion(system, {0.5, 0.0});
    run(motion, 80 * system.period());
    int sticks = 0;
    double largest = 0.0;
    const Instant end = testing::after(motion, system.period());
    while (motion.advance(end) == Outcome::event) {
      sticks += motion.event().kind == EventKind::stick;
      if (motion.event().kind == EventKind::stick) largest = std::max(largest, std::abs(motion.state()[0]));
    }
    EXPECT_EQ(sticks, c.sticks) << "F11, w = " << c.w << " f = " << c.f;
    // The file's number at w = 0.3 is its simulation's, off by 1.4e-6 (its two runs differ by 1e-7): the 50-digit oracle has 0.8763086.
    EXPECT_NEAR(largest, c.largest, c.w == 0.3 ? 2e-6 : 1e-6) << "F11, w = " << c.w << " f = " << c.f;
  }
}

}  // namespace
}  // namespace slapstick
