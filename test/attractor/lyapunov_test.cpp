/// Lyapunov exponents against closed forms, multipliers of cycles, published values and the sum rule.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "attractor/paper_system.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

using test::paper_model;
using test::paper_start;

Model oscillator(double omega) {
  Model model;
  model.name = "oscillator";
  model.omega = omega;
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  model.dampers = {{0, ground, 2.0 * 0.05}};
  model.forces = {{0, 1, 1.0, 0.0}};
  return model;
}

TEST(Lyapunov, OfALinearOscillatorAreTheRealPartsOfItsEigenvalues) {
  const LyapunovExponents found = lyapunov(System(oscillator(0.7)), {1.0, 0.0}, {.most_periods = 2000});
  ASSERT_EQ(found.per_period.size(), 2u);
  for (const double exponent : found.per_period) EXPECT_NEAR(exponent / found.period, -0.05, 2e-4);
  EXPECT_NEAR(found.sum / found.period, -0.1, 1e-13);
  EXPECT_EQ(found.dimension, 0.0);
}

/// Each impact of a cycle takes r^2 of the area beside what the damper takes.
TEST(Lyapunov, TheSumIsDampingAndTwiceTheLogarithmOfTheRestitutionAtEachImpact) {
  const double restitution = 0.7;
  Model model = oscillator(2.1);
  model.stops = {{"wall", 0, ground, 0.1, restitution}};
  const System system(model);
  const Classification cycle = classify(system, {0.0, 0.0});
  ASSERT_EQ(cycle.attractor, Attractor::periodic);
  const LyapunovExponents found = lyapunov(system, cycle.state, {.transient_periods = 0, .most_periods = 20 * cycle.n});
  const double each = 2.0 * std::log(restitution) * static_cast<double>(cycle.p) / cycle.n;
  EXPECT_NEAR(found.sum, -0.1 * system.period() + each, 1e-12);
}

/// Two routes: eigenvalues of the cycle's Jacobian, and a frame carried along.
TEST(Lyapunov, OfACycleAreTheLogarithmsOfItsMultipliers) {
  for (const double omega : {2.2, 3.5, 2.85, 6.5}) {
    const System system(paper_model({.omega = omega}));
    const Classification cycle = classify(system, paper_start);
    ASSERT_EQ(cycle.attractor, Attractor::periodic) << omega;
    const LyapunovExponents found =
        lyapunov(system, cycle.state, {.transient_periods = 200, .most_periods = 4000 * cycle.n / 2});
    ASSERT_EQ(found.per_period.size(), cycle.multipliers.size());
    for (std::size_t i = 0; i < cycle.multipliers.size(); ++i)
      EXPECT_NEAR(found.per_period[i], std::log(std::abs(cycle.multipliers[i])) / cycle.n, 2e-3) << omega << " " << i;
    EXPECT_TRUE(found.sum_rule_holds()) << omega << ": " << found.sum - found.contraction << " of " << found.rounding;
  }
}

TEST(Lyapunov, AreMinusInfinityWhereStickAndChatterForgetADirection) {
  for (const auto& [omega, lost] : {std::pair(1.5, 1), std::pair(0.552, 2)}) {
    const LyapunovExponents found = lyapunov(System(paper_model({.omega = omega})), paper_start, {.most_periods = 400});
    EXPECT_EQ(std::count(found.per_period.begin(), found.per_period.end(), -INFINITY), lost) << omega;
    EXPECT_TRUE(found.sum_rule_holds());
    const Classification cycle = classify(System(paper_model({.omega = omega})), paper_start);
    EXPECT_NEAR(found.per_period[0], std::log(std::abs(cycle.multipliers[0])) / cycle.n, 1e-2) << omega;
  }
}

TEST(Lyapunov, TheSumRuleHoldsOnEveryForcedBuiltInModel) {
  for (const std::string& name : builtin_models()) {
    const ModelDefinition model = load_model(name);
    const LyapunovExponents found =
        lyapunov(System(model.build()), model.start(), {.transient_periods = 100, .most_periods = 200});
    EXPECT_TRUE(found.sum_rule_holds()) << name << ": " << found.sum << " and " << found.contraction << ", rounding "
                                        << found.rounding;
    if (std::isfinite(found.sum)) {
      EXPECT_LT(found.rounding, 1e-6) << name << ": the bound is empty";
    }
  }
}

/// A running sum of doubles and a guessed rounding once made the rule fail after 20 000 periods.
TEST(Lyapunov, TheSumRuleHoldsForLongRuns) {
  const ModelDefinition model = load_model("impact-oscillator");
  const LyapunovExponents found = lyapunov(System(model.build()), model.start(), {.most_periods = 20'000});
  EXPECT_TRUE(std::isfinite(found.sum));
  EXPECT_TRUE(found.sum_rule_holds()) << found.sum - found.contraction << " of " << found.rounding;
  EXPECT_LT(found.rounding, 1e-9);
}

/// The motion sticks before it is chaotic, and does not afterwards: nothing is forgotten for good.
TEST(Lyapunov, WhatTheTransientForgetsCounts) {
  const System system(paper_model({.omega = 5.09}));
  Motion motion(system, paper_start);
  long sticks = 0;
  while (motion.advance({500, 0.0}) == Outcome::event) sticks += motion.event().kind == EventKind::stick;
  ASSERT_GT(sticks, 0);
  const LyapunovExponents found = lyapunov(system, paper_start, {.most_periods = 4000});
  EXPECT_TRUE(std::isfinite(found.sum));
  EXPECT_TRUE(found.sum_rule_holds()) << found.sum - found.contraction << " of " << found.rounding;
  EXPECT_GT(found.dimension, 3.0);
}

/// Of a cycle without forcing one exponent is zero, and rounding must not make its dimension 0.
TEST(Lyapunov, TheDimensionOfALimitCycleIsOne) {
  for (const double speed : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    const ModelDefinition model = load_model("belt");
    const System system(model.build({{"belt_speed", speed}}));
    EXPECT_EQ(lyapunov(system, model.start({{"belt_speed", speed}}), {.most_periods = 2000}).dimension, 1.0) << speed;
  }
}

/// A perturbed motion beside it, brought back to a distance of 1e-8 after every period.
TEST(Lyapunov, TheLargestIsTheRateAtWhichTwoMotionsPart) {
  const System system(paper_model({.omega = 6.69}));
  Motion motion(system, paper_start);
  while (motion.advance({500, 0.0}) == Outcome::event) {
  }
  State here = motion.state();
  constexpr double apart = 1e-8;
  constexpr int periods = 4000;
  State beside = here;
  beside[0] -= apart;
  double growth = 0.0;
  for (int k = 0; k < periods; ++k) {
    Motion a(system, here), b(system, beside);
    while (a.advance({1, 0.0}) == Outcome::event) {
    }
    while (b.advance({1, 0.0}) == Outcome::event) {
    }
    here = a.state(), beside = b.state();
    double distance = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) distance += (beside[i] - here[i]) * (beside[i] - here[i]);
    distance = std::sqrt(distance);
    growth += std::log(distance / apart);
    for (std::size_t i = 0; i < here.size(); ++i) beside[i] = here[i] + (beside[i] - here[i]) * apart / distance;
  }
  const LyapunovExponents found = lyapunov(system, paper_start, {.most_periods = periods});
  EXPECT_NEAR(growth / periods, found.per_period[0], 4.0 * found.errors[0]);
}

TEST(Lyapunov, EndsAsSoonAsTheErrorsAreSmall) {
  const System system(paper_model({.omega = 2.2}));
  const LyapunovExponents found = lyapunov(system, paper_start, {.most_periods = 100'000, .error = 1e-3});
  EXPECT_TRUE(found.reached);
  EXPECT_LT(found.periods, 50'000);
  for (const double error : found.errors) EXPECT_LE(error, 1e-3);
  EXPECT_FALSE(lyapunov(system, paper_start, {.most_periods = 2000, .error = 1e-9}).reached);
}

TEST(Lyapunov, TheDimensionIsThatOfKaplanAndYorke) {
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension({0.5, -1.0}), 1.5);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension({0.3, 0.0, -0.6}), 2.5);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension({-0.1, -INFINITY}), 0.0);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension({0.1, -INFINITY}), 1.0);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension({0.0, 0.0}), 2.0);
}

}  // namespace
}  // namespace slapstick
