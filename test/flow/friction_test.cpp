/// Stick and slip where everything is known in closed form. More of this kind is in ../catalogue.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "flow/runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;
using testing::kinds;
using testing::run;

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

/// A mass on a spring, a belt and a stop without loss, thrown back from the stop at the belt's speed V. The friction
/// force f is constant until the mass returns, with speed V: impact and rest on the belt are one instant. About
/// x_e = f / k it turns, half way, at tan(omega t) = V / (omega (x_e - c)).
void expect_a_tie_in_every_period(double mass, double k, double clearance, double V, double f,
                                  const std::string& what) {
  Model m;
  m.coordinates = {{"x", mass}};
  m.springs = {{0, ground, k}};
  m.stops = {{"stop", 0, ground, clearance, 1.0}};
  m.frictions = {{"belt", 0, ground, V, f, f}};
  const double omega = std::sqrt(k / mass), period = 2 / omega * std::atan(V / (omega * (f / k - clearance)));
  const System system(m);
  Motion motion(system, {clearance, -V});
  std::vector<Event> impacts;
  ASSERT_NO_THROW({
    for (const Event& event : run(motion, 30.5 * period, 200))
      if (event.kind == EventKind::impact) impacts.push_back(event);
  }) << what;
  ASSERT_EQ(impacts.size(), 30u) << what;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const double last = i == 0 ? 0.0 : impacts[i - 1].time.seconds(1.0);
    EXPECT_NEAR(impacts[i].time.seconds(1.0) - last, period, 1e-13) << what << ", impact " << i;
    EXPECT_NEAR(impacts[i].w, V, 1e-13) << what << ", impact " << i;
  }
}

TEST(Belt, AndAStopReachedAtOneInstantAreNoContradiction) {  // once: no contact mode fits the state
  expect_a_tie_in_every_period(0.17124686427156324, 0.34154041508023231, -0.18307678537821065, 0.45203658507510858,
                               0.38331977699285313, "14225");
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 500; ++i) {
    const double k = uniform(0.1, 3), f = uniform(0.1, 1), clearance = uniform(-0.9, 0.9) * f / k;
    expect_a_tie_in_every_period(uniform(0.1, 2), k, clearance, uniform(0.1, 1), f, std::to_string(i));
  }
}

TEST(Belt,
     AStateReadBackInStickContinuesInStick) {  // v_a - v_b = V is not kept to the last bit by the user's coordinates
  Model m;
  m.coordinates = {{"x", 1.0}, {"y", 10.0}};
  m.springs = {{0, ground, 1.0}, {1, ground, 3.0}};
  m.omega = 0.7;
  m.forces = {{1, 1, 0.3, 0.0}};
  m.frictions = {{"belt", 0, 1, 0.1, 0.5, 0.05}};
  const System system(m);
  Motion motion(system, {0.0, 0.1, 0.0, 0.0});
  int restarts = 0;
  for (int i = 1; i < 200; ++i) {
    run(motion, 0.01 * i * system.period() - motion.time().seconds(system.period()));
    if (system.mode_name(motion.mode_id()) != "stick") continue;
    ++restarts;
    Motion on = motion, restarted(system, motion.state(), motion.time());
    ASSERT_EQ(system.mode_name(restarted.mode_id()), "stick") << i;
    const auto expected = run(on, 10.0), found = run(restarted, 10.0);
    ASSERT_EQ(kinds(found), kinds(expected)) << i;
    for (std::size_t j = 0; j < expected.size(); ++j)
      EXPECT_NEAR(found[j].time.since(expected[j].time), 0.0, 1e-13) << i << ", event " << j;
  }
  EXPECT_GE(restarts, 100);
}

TEST(Slip, ThatCreepsTowardsItsZeroIsSearchedFewTimes) {
  Model m;  // masses of 2e-3 and 5e2, and friction that comes to rest and lets go within 1e-3 of a period
  m.coordinates = {{"x1", 0.0017332283217004506}, {"x2", 0.0039333630232647292}, {"x3", 457.95131399973957}};
  m.springs = {{0, ground, 3.4825570255875533},
               {1, 0, 0.88056883707497768},
               {1, ground, 0.97245783044993872},
               {2, 1, 6.996831867723583},
               {2, ground, 1.0410901251824638}};
  m.dampers = {{0, ground, 0.55512516330613548}, {1, 0, 0.22366581675343911}};
  m.forces = {{2, 2, 1.7880855259250834, 5.2742711351597524}};
  m.stops = {{"stop", ground, 1, 0.0, 0.0}};
  m.frictions = {{"rub", 0, 1, 0.0, 0.66967615987839291, 0.66967615987839291}};
  m.omega = 1.5747412361281237;
  const State start = {0.74525366330332576, 0.0, 0.63587401069578298, 0.32283253183112137, 0.21923737530500431,
                       -0.74607559244929089};
  const System system(m);
  Motion motion(system, start);
  for (int i = 1; i <= 1000; ++i) {
    run(motion, 1e-3 * i * system.period() - motion.time().seconds(system.period()), 1000);
    ASSERT_LE(motion.counters().evaluations, 1000) << "at phase " << 1e-3 * i;
  }
  EXPECT_LE(static_cast<double>(motion.counters().windows), 1.1 * system.windows_per_period());
}

}  // namespace
}  // namespace slapstick
