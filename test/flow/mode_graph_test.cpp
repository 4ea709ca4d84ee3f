/// The mode graph where runs do not lead: states that no mode may start from, and derivatives that are known to vanish.
#include "flow/mode_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "flow/compiled_system.hpp"
#include "mode/mode.hpp"
#include "flow/runs.hpp"

namespace slapstick {
namespace {

/// A mass that rubs on the floor and another on its wall.
Model mass_on_a_floor_and_mass_at_a_wall(double load) {
  Model m;
  m.coordinates = {{"x", 1.0}, {"y", 1.0}};
  m.forces = {{0, 1, load, 0.0}};
  m.omega = 1.0;
  m.frictions = {{"floor", 0, ground, 0.0, 1.0, 0.5}};
  m.stops = {{"wall", 1, ground, 0.0, 0.5}};
  return m;
}

/// X of a user's state at a phase.
std::vector<double> entered(const System& system, const State& state, double phase) {
  std::vector<double> X(static_cast<std::size_t>(system.compiled().frame().size()));
  system.compiled().frame().enter(state.data(), X.data());
  system.compiled().frame().set_phase(phase, X.data());
  return X;
}

std::vector<double> sizes(std::vector<double> X) {
  for (double& x : X) x = std::abs(x);
  return X;
}

TEST(ModeGraph,
     AStateThatStillHasItsImpactBeforeItIsGivenNoMode) {  // .. instead of one that would let it pass the wall
  const System system(mass_on_a_floor_and_mass_at_a_wall(0.5));
  std::vector<int> orders(16);
  for (const double speed :
       {1.0, 1e-300, 0.0}) {  // at the wall, the other mass at rest: slips and stick are tried in vain
    const auto X = entered(system, {0.0, 0.0, 0.0, speed}, 0.0);
    const ModeId id = flow::select_mode(system.compiled(), X.data(), sizes(X).data(), orders);
    EXPECT_EQ(id<0, speed> 0.0) << speed;
  }
}

TEST(
    ModeGraph,
    WhatIsKnownToVanishIsNotJudgedByItsRounding) {  // a graze of a force: value and slope are zero, its state is not exact
  const System system(mass_on_a_floor_and_mass_at_a_wall(1.0));
  auto X = entered(system, {0.0, 0.0, -1.0, 0.0}, 0.25);
  mode::ContactStates states = system.states(0);
  states.frictions[0] = mode::FrictionState::stick;
  const mode::Mode& stuck = system.compiled().mode(system.mode_id(states));
  int above = 0;
  while (stuck.guards()[static_cast<std::size_t>(above)].kind != mode::GuardKind::stick_above) ++above;
  const auto order = [&](int known) { return flow::start_order(stuck, above, X.data(), sizes(X).data(), known); };
  EXPECT_EQ(order(0), 2);  // 1 - sin(pi / 2 + t)
  X[static_cast<std::size_t>(system.compiled().frame().one())] -= 0x1p-40;
  EXPECT_EQ(order(0), flow::negative);
  EXPECT_EQ(order(2), 2);
}

TEST(Stick, HoldsAForceThatOnlyTouchesItsLimit) {  // |f0| <= f_s, however often it is reached
  Model m = mass_on_a_floor_and_mass_at_a_wall(1.0);
  const System system(m);
  Motion motion(system, {0.0, 0.0, -1.0, 0.0});
  int touches = 0;
  for (const Event& event : testing::run(motion, 20.0 * system.period())) {
    EXPECT_EQ(event.kind, EventKind::graze);
    ++touches;
  }
  EXPECT_EQ(touches, 40);  // at both ends of the force in every period
  EXPECT_EQ(motion.state()[0], 0.0);
}

/// Static and kinetic friction 1, a load that exceeds it by k roundings: whether it holds rounding cannot say, but some mode must be found.
TEST(Stick, OrSlipUnderALoadThatExceedsFrictionByRoundings) {  // was: no contact mode fits the state
  for (int k = -3; k <= 200; ++k) {
    Model m;
    m.coordinates = {{"x", 1.0}};
    m.forces = {{0, 0, 1.0 + k * 0x1p-52, 0.0}};
    m.frictions = {{"floor", 0, ground, 0.0, 1.0, 1.0}};
    const System system(m);
    Motion motion(system, {0.0, 0.0});
    ASSERT_NO_THROW(testing::run(motion, 3.0)) << k;
    const double exact = 0.5 * 9.0 * std::max(k, 0) * 0x1p-52;
    EXPECT_NEAR(motion.state()[0], exact, 0.5 * 9.0 * 64 * 0x1p-52) << k;  // 64 roundings of a force are none
  }
}

/// The same of a spring that is stretched so far: what moves turns half way, and stays.
TEST(Stick, OrSlipUnderASpringThatExceedsFrictionByRoundings) {
  for (int k = -3; k <= 400; ++k) {
    Model m;
    m.coordinates = {{"x", 1.0}};
    m.springs = {{0, ground, 1.0}};
    m.frictions = {{"floor", 0, ground, 0.0, 1.0, 1.0}};
    const System system(m);
    const double start = -1.0 - k * 0x1p-52;
    Motion motion(system, {start, 0.0});
    ASSERT_NO_THROW(testing::run(motion, 100.0)) << k;
    EXPECT_GE(motion.state()[0], start) << k;
    EXPECT_LE(motion.state()[0], std::max(start, -1.0 + k * 0x1p-52) + 64 * 0x1p-52) << k;
    EXPECT_EQ(motion.state()[1], 0.0) << k;
  }
}

}  // namespace
}  // namespace slapstick
