/// Cycles that nothing drives, stable or not: closed forms, energy, and what lies on both sides of one that repels.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "families.hpp"
#include "orbit/equations.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/orbit/find.hpp"
#include "slapstick/quantity/cycle_energy.hpp"

namespace slapstick::test {
namespace {

using std::numbers::pi;

std::string plain(std::string_view option) { return std::string(option); }

/// x'' - 2 z x' + x = -f sgn(x'): the damper feeds, friction takes. With R = exp(pi z / sqrt(1 - z^2)) half a cycle
/// leads from an amplitude A to (A - f) R - f, which is A for A = f (R + 1) / (R - 1).
struct FedOscillator {
  double z = 0.05, f = 0.3;
  Model model;
  std::shared_ptr<const orbit::Problem> problem;
  double R = std::exp(pi * z / std::sqrt(1.0 - z * z));
  double A = f * (R + 1.0) / (R - 1.0);

  FedOscillator() {
    model.name = "fed-oscillator";
    model.coordinates = {{.name = "x", .mass = 1.0}};
    Spring spring;
    spring.a = 0, spring.b = ground, spring.stiffness = 1.0;
    model.springs = {spring};
    Damper damper;
    damper.a = 0, damper.b = ground, damper.coefficient = -2.0 * z, damper.feeds = true;
    model.dampers = {damper};
    FrictionContact friction;
    friction.name = "pad";
    friction.a = 0, friction.b = ground, friction.static_friction = f, friction.kinetic_friction = f;
    model.frictions = {friction};
    problem = orbit::pose(constant_family(model), {});
  }

  [[nodiscard]] orbit::Chosen find(const orbit::OrbitWish& wish) const {
    return find_orbit(*problem, System(model), {0.5 * A, 0.0}, wish, nullptr, plain);
  }
};

TEST(FreeCycle, TheCycleThatANegativeDamperFeedsHasItsAmplitudeAndMultiplier) {
  const FedOscillator fed;
  const orbit::Chosen found = fed.find({.stable = false});
  ASSERT_TRUE(found.orbit);
  EXPECT_EQ(found.orbit->label, "free-0-I");
  EXPECT_TRUE(found.orbit->is_motion);
  EXPECT_NEAR(found.orbit->cycle, 2.0 * pi / std::sqrt(1.0 - fed.z * fed.z), 1e-11);
  ASSERT_EQ(found.orbit->multipliers.size(), 1U);
  EXPECT_NEAR(found.orbit->multipliers[0].real(), fed.R * fed.R, 1e-10);
  EXPECT_NEAR(orbit::ranges(*fed.problem, found.orbit->orbit)[0].most, fed.A, 1e-10 * fed.A);
  EXPECT_TRUE(orbit::symmetric(*fed.problem, found.orbit->orbit));
}

TEST(FreeCycle, WhatTheDamperFeedsIsWhatFrictionTakes) {
  const FedOscillator fed;
  const orbit::Chosen found = fed.find({.orbit = "1-0-I", .stable = false});
  ASSERT_TRUE(found.orbit);
  const CycleEnergy energy = cycle_energy(*fed.problem, found.orbit->orbit);
  const double taken = 4.0 * fed.f * fed.A;  // f times the way
  EXPECT_NEAR(energy.friction.at(0), taken, 1e-11 * taken);
  EXPECT_NEAR(energy.damping, -taken, 1e-11 * taken);
  EXPECT_EQ(energy.input, 0.0);
  EXPECT_NEAR(energy.balance(), 0.0, 1e-11 * taken);
}

TEST(FreeCycle, ItRepelsWhatIsInsideToRestAndWhatIsOutsideForEver) {
  const FedOscillator fed;
  const System system(fed.model);
  EXPECT_EQ(classify(system, {0.99 * fed.A, 0.0}).attractor, Attractor::equilibrium);
  Motion motion(system, {1.01 * fed.A, 0.0});
  while (motion.advance({100, 0.0}) == Outcome::event) {
  }
  EXPECT_GT(std::abs(motion.state()[0]) + std::abs(motion.state()[1]), 1.1 * fed.A);
}

/// Without a transient an orbit at the state is meant, though a motion beside it comes to rest, or grows beyond all
/// bounds.
TEST(FreeCycle, IsFoundFromAStateOnItThoughItRepels) {
  const FedOscillator fed;
  for (const double beside : {-1e-4, 1e-4}) {
    const orbit::Chosen found =
        find_orbit(*fed.problem, System(fed.model), {(1.0 + beside) * fed.A, 0.0}, {.transient = 0}, nullptr, plain);
    ASSERT_TRUE(found.orbit);
    EXPECT_FALSE(found.orbit->stable());
    EXPECT_FALSE(found.settles);
    EXPECT_NEAR(orbit::ranges(*fed.problem, found.orbit->orbit)[0].most, fed.A, 1e-10 * fed.A);
  }
}

/// Beyond fast_speed the friction is constant and sliding stable; large oscillations come to where it falls. Between
/// sliding and stick-slip there is a cycle that repels.
TEST(FreeCycle, BetweenStableSlidingAndStickSlipThereIsOneThatRepels) {
  const Overrides values = {{"belt_speed", 1.2}, {"damping_ratio", 0.05}, {"static_friction", 1.0}};
  const Posed posed("falling-friction", values, {}, {});
  const State start = {0.6, 0.0};
  const orbit::Chosen found = find_orbit(*posed.problem, posed.system, start, {.stable = false}, nullptr, plain);
  ASSERT_TRUE(found.orbit);
  EXPECT_EQ(found.orbit->label, "free-0-I");
  EXPECT_GT(std::abs(found.orbit->multipliers.at(0)), 1.0);
  const State at = orbit::at_phase_zero(*posed.problem, found.orbit->orbit);
  const auto scaled = [&](double by) { return State{0.6 + by * (at[0] - 0.6), by * at[1]}; };
  EXPECT_EQ(classify(posed.system, scaled(0.97)).label, "equilibrium");
  EXPECT_EQ(classify(posed.system, scaled(1.03)).label, "free-0-II");
}

TEST(FreeCycle, SearchesFindWhatMotionsSettleOnByItsClass) {
  const Posed posed("falling-friction", {}, {}, {});
  for (const char* wish : {"1", "1-0", "1-0-II", "free-0-II", ""}) {
    const orbit::Chosen found =
        find_orbit(*posed.problem, posed.system, posed.start(), {.orbit = wish}, nullptr, plain);
    ASSERT_TRUE(found.orbit) << wish;
    EXPECT_EQ(found.orbit->label, "free-0-II") << wish;
    EXPECT_TRUE(found.settles) << wish;
    EXPECT_EQ(orbit::returns(found.orbit->orbit.shape), 1) << wish;
  }
  EXPECT_THROW(
      (void)find_orbit(*posed.problem, posed.system, posed.start(), {.orbit = "3-7-I", .starts = 2}, nullptr, plain),
      std::runtime_error);
}

TEST(FreeCycle, TheNearestIsMeasuredAlongTheCycle) {
  const FedOscillator fed;
  const orbit::Chosen found = fed.find({.stable = false});
  ASSERT_TRUE(found.orbit);
  EXPECT_NEAR(orbit::distance(*fed.problem, found.orbit->orbit, {fed.A, 0.0}), 0.0, 0.05 * fed.A);
  EXPECT_NEAR(orbit::distance(*fed.problem, found.orbit->orbit, {fed.A + 1.0, 0.0}), 1.0, 0.05 * fed.A);
}

/// What one names the other finds.
TEST(FreeCycle, ClassifyAndOrbitAgree) {
  for (const char* name : {"belt", "falling-friction", "pressed-block", "drill-string", "two-blocks-on-belt"}) {
    const Posed posed(name, {}, {}, {});
    const Classification named = classify(posed.system, posed.start());
    const auto found = posed.settled();
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(named.label, found->label) << name;
    EXPECT_EQ(named.n, orbit::returns(found->orbit.shape)) << name;
    EXPECT_NEAR(named.period, found->cycle, 1e-9 * found->cycle) << name;
    ASSERT_EQ(named.multipliers.size(), found->multipliers.size()) << name;
    EXPECT_NEAR(std::abs(named.multipliers[0]), std::abs(found->multipliers[0]), 1e-7) << name;
  }
}

/// A branch over the amplitude keeps the clock: at amplitude zero it has the state of rest as its orbit of one period.
TEST(FreeCycle, ABranchOverTheAmplitudeStartsAtAmplitudeZero) {
  const Posed posed("bilinear-oscillator", {{"damping_ratio", 0.1}, {"clearance", 2.0}}, {"amplitude"}, {0.0});
  EXPECT_FALSE(posed.problem->free());
  const auto found = posed.settled();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->label, "1-0-I");
}

}  // namespace
}  // namespace slapstick::test
