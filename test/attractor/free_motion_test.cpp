/// Classes of motions that nothing drives: cycles with a period of their own, states of rest, families.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;

Classification at(const std::string& name, const Overrides& values = {}, const ClassifyOptions& options = {}) {
  const ModelDefinition definition = load_model(name);
  return classify(System(definition.build(values)), definition.start(values), options);
}

Classification from(const std::string& name, const Overrides& values, const State& start) {
  return classify(System(load_model(name).build(values)), start);
}

TEST(FreeMotion, StickSlipOnABeltHasThePeriodOfItsClosedForm) {
  for (const double speed : {0.2, 0.5, 0.9}) {
    const Classification found = at("belt", {{"belt_speed", speed}});
    EXPECT_EQ(found.label, "free-0-II");
    EXPECT_EQ(found.attractor, Attractor::periodic);
    EXPECT_EQ(found.n, 1);
    const double D = 0.5;
    EXPECT_NEAR(found.period, 2.0 * pi - 2.0 * std::atan(D / speed) + 2.0 * D / speed, 1e-12 * found.period);
    ASSERT_EQ(found.multipliers.size(), 1U);  // the one along the motion is left out; stick forgets the other
    EXPECT_LT(std::abs(found.multipliers[0]), 1e-12);
  }
}

/// x'' + (2 d - s) x' + x = const. below the corner, s the slope by which the friction falls.
TEST(FreeMotion, SteadySlidingIsARestWithTheEigenvaluesOfItsSlope) {
  const double damping = 0.3, slope = 0.4, rate = 0.5 * (2.0 * damping - slope);
  const Classification found = at("falling-friction", {{"damping_ratio", damping}});
  EXPECT_EQ(found.attractor, Attractor::equilibrium);
  EXPECT_EQ(found.label, "equilibrium");
  ASSERT_EQ(found.eigenvalues.size(), 2U);
  EXPECT_NEAR(found.eigenvalues[0].real(), -rate, 1e-12);
  EXPECT_NEAR(found.eigenvalues[0].imag(), std::sqrt(1.0 - rate * rate), 1e-12);
  EXPECT_NEAR(found.exponent, -rate, 1e-12);
  EXPECT_NEAR(found.state[0], 1.0 - slope * 0.5, 1e-12);
  EXPECT_NEAR(found.state[1], 0.0, 1e-12);
  EXPECT_FALSE(found.sticking);
}

TEST(FreeMotion, WhereTheSlopeIsGreaterThanTheDampingSlidingIsLeftForStickSlip) {
  EXPECT_EQ(at("falling-friction", {{"damping_ratio", 0.19}}).label, "free-0-II");
  EXPECT_EQ(at("falling-friction", {{"damping_ratio", 0.21}}).label, "equilibrium");
}

TEST(FreeMotion, ABallComesToRestOnTheFloor) {
  const Classification found = at("bouncing-ball");
  EXPECT_EQ(found.attractor, Attractor::equilibrium);
  EXPECT_EQ(found.state[0], 0.0);
  EXPECT_EQ(found.state[1], 0.0);
  EXPECT_TRUE(found.sticking);
  EXPECT_TRUE(found.eigenvalues.empty());
  EXPECT_EQ(found.family, 0);  // a closed stop holds it in one place
}

TEST(FreeMotion, SlidingWithoutDampingIsOneOfAFamilyOfClosedCurves) {
  const Classification found =
      from("belt", {{"static_friction", 1.0}, {"kinetic_friction", 1.0}, {"belt_speed", 1.0}}, {1.2, 0.0});
  EXPECT_EQ(found.attractor, Attractor::family);
  ASSERT_EQ(found.eigenvalues.size(), 2U);
  EXPECT_NEAR(found.eigenvalues[0].real(), 0.0, 1e-12);
  EXPECT_NEAR(found.eigenvalues[0].imag(), 1.0, 1e-12);
}

TEST(FreeMotion, ADriveOfAmplitudeZeroChangesNothing) {
  const ModelDefinition definition = load_model("belt");
  Model model = definition.build({});
  model.omega = 3.0;
  Force none;
  none.coordinate = 0;
  none.harmonic = 1;
  none.amplitude = 0.0;
  model.forces.push_back(none);
  const Classification free = at("belt"), clocked = classify(System(model), definition.start({}));
  EXPECT_EQ(clocked.label, free.label);
  EXPECT_EQ(clocked.n, free.n);
  EXPECT_NEAR(clocked.period, free.period, 1e-12 * free.period);
}

/// Two routes: the multipliers' exponent, and the exponents of a tangent frame, of which one is the 0 along the motion.
TEST(FreeMotion, TheExponentOfACycleIsThatOfItsTangents) {
  const Classification found = at("two-blocks-on-belt");
  ASSERT_EQ(found.attractor, Attractor::periodic);
  const System system(load_model("two-blocks-on-belt").build({}));
  const LyapunovExponents all = lyapunov(system, found.state, {.transient_periods = 0, .most_periods = 20'000});
  EXPECT_NEAR(all.per_period[0], 0.0, 1e-3);
  EXPECT_NEAR(all.per_period[1], found.exponent, 1e-2 * std::abs(found.exponent) + 1e-3);
}

TEST(FreeMotion, AMassThatTouchesItsStopAtRestComesToRestOnABorder) {
  const Classification found =
      from("bilinear-oscillator", {{"amplitude", 0.0}, {"clearance", 0.0}, {"damping_ratio", 0.05}}, {0.7, 0.0});
  EXPECT_EQ(found.attractor, Attractor::equilibrium);
  EXPECT_TRUE(found.eigenvalues.empty());
  EXPECT_NEAR(found.state[0], 0.0, 1e-9);
}

TEST(FreeMotion, TheTransientIsCountedInReturns) {
  const Classification found = at("belt", {{"belt_speed", 0.05}}, {.transient_periods = 30});
  EXPECT_EQ(found.label, "free-0-II");
  EXPECT_GE(found.periods_used, 30);
  EXPECT_LT(found.periods_used, 60);
}

TEST(FreeMotion, WhatTheStartOfItsOwnCycleGivesIsTheSameCycle) {
  const Classification first = at("pressed-block");
  ASSERT_EQ(first.attractor, Attractor::periodic);
  const Classification again =
      classify(System(load_model("pressed-block").build({})), first.state, {.transient_periods = 0});
  EXPECT_EQ(again.label, first.label);
  EXPECT_NEAR(again.period, first.period, 1e-11 * first.period);
}

/// A self-excited machine rattles at first, and then never again, while other events go on: its section of rattling
/// flights is left. To wait for the next one would take for ever.
TEST(FreeMotion, FlightsThatDoNotComeAgainAreNotWaitedFor) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\n[[coordinate]]\nname = 'x1'\nmass = 1.930731669885431\n[[coordinate]]\nname = 'x2'\n"
      "mass = 2.871651280982863\n[[coordinate]]\nname = 'x3'\nmass = 1.5676844907811835\n"
      "[[spring]]\nbetween = ['x1', 'ground']\nstiffness = 2.9001421323735324\n"
      "[[spring]]\nbetween = ['x2', 'x1']\nstiffness = 1.2493427574673333\n"
      "[[spring]]\nbetween = ['x3', 'x2']\nstiffness = 0.39568914643436087\n"
      "[[damper]]\nname = 'bent'\nbetween = ['x1', 'x2']\nslope_below = 0.02443942111136736\n"
      "slope_above = 0.31002088302908515\ncharacteristic = [[-0.38586943076475355, 0.014937698100133179], "
      "[-0.10577100245189425, -0.098870939172618], [0.10583268025240697, -0.2826347011453787]]\n"
      "[[jenkins]]\nname = 'joint'\nbetween = ['x2', 'ground']\nstiffness = 1.5197416606626448\n"
      "limit = 1.126874574027191\n"
      "[[compliant_stop]]\nname = 'stop'\nbetween = ['x3', 'x1']\ntwo_sided = true\nclearance = 1.950200344485567\n"
      "clearance_lower = 1.3219607127896513\nstiffness = 2.351074722403058\ndamping = 0.4021584752118968\nlaw = "
      "'pulls'\n"
      "[start]\nx1 = -1.4625430235503951\nv1 = 0.6471045636640735\nx2 = 1.3897349477489307\nv2 = 0.8274456085504798\n"
      "x3 = 0.7285033009517554\nv3 = 0.7298367551507685\n",
      "m.toml");
  for (const int transient : {1, 50, 500}) {
    const Classification found =
        classify(System(definition.build()), definition.start(), {.transient_periods = transient});
    EXPECT_EQ(found.label, "free-0-I") << transient;
    EXPECT_EQ(found.attractor, Attractor::family) << transient;
  }
}

}  // namespace
}  // namespace slapstick
