/// What motions without further events are: rest, steady sliding, rotation, drift, swings, growth; and the proof.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "section/outlook.hpp"
#include "slapstick/attractor/classify.hpp"

namespace slapstick {
namespace {

/// m x'' + c x' + k x = 0 with a stop at a distance.
Model stopped_oscillator(double damping, double clearance, double restitution = 0.5) {
  Model model;
  model.name = "one";
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  if (damping != 0.0) model.dampers = {{0, ground, damping}};
  model.stops = {{"wall", 0, ground, clearance, restitution}};
  return model;
}

/// Two masses with a spring and a damper between them, and nothing to hold them.
Model pair(double first, double second, double stiffness, double damping) {
  Model model;
  model.name = "pair";
  model.coordinates = {{"p", first}, {"q", second}};
  model.springs = {{0, 1, stiffness}};
  if (damping != 0.0) model.dampers = {{0, 1, damping}};
  return model;
}

TEST(Rest, ADampedPairThatNothingHoldsComesToRestWhateverItsMasses) {
  for (const double first : {1.0, 1e-6, 3e5})
    for (const double stiffness : {1000.0, 1e-3, 7e8}) {
      const double damping = 0.1 * std::sqrt(stiffness * first);
      const Classification found = classify(System(pair(first, 2.0, stiffness, damping)), {0.0, 0.0, 0.01, 0.0});
      EXPECT_EQ(found.attractor, Attractor::equilibrium) << first << ' ' << stiffness;
      EXPECT_EQ(found.drift, (std::vector<double>{0.0, 0.0})) << first << ' ' << stiffness;
      ASSERT_EQ(found.eigenvalues.size(), 2U);  // the conserved momentum is left out
      const double mass = first * 2.0 / (first + 2.0), rate = 0.5 * damping / mass;
      EXPECT_NEAR(found.eigenvalues[0].real() + found.eigenvalues[1].real(), -2.0 * rate, 1e-9 * rate);
      EXPECT_NEAR(found.state[2] - found.state[0], 0.0, 1e-14);
    }
}

TEST(Rest, TheDriftOfAFreeGroupIsItsMomentumOverItsMass) {
  for (const double damping : {0.0, 1.0}) {
    const Classification found = classify(System(pair(1.0, 2.0, 1000.0, damping)), {0.0, 0.3, 0.01, 0.1});
    ASSERT_EQ(found.drift.size(), 2U);
    for (const double drift : found.drift) EXPECT_NEAR(drift, (0.3 + 0.2) / 3.0, 1e-12) << damping;
    EXPECT_EQ(found.attractor, damping > 0.0 ? Attractor::equilibrium : Attractor::family);
  }
}

/// Energy k (2 a - b)^2 / 2: free along tau = (1, 2).
TEST(Rest, TheDriftOfGearsIsThatOfTheirFreeTranslation) {
  Model model;
  model.name = "gears";
  model.coordinates = {{"a", 0.3}, {"b", 1.7}};
  model.stiffness = {4.0 * 50.0, -2.0 * 50.0, -2.0 * 50.0, 50.0};
  const double va = 0.4, vb = -0.1, speed = (0.3 * va + 2.0 * 1.7 * vb) / (0.3 + 4.0 * 1.7);
  for (const bool damped : {false, true}) {
    if (damped) model.damping = {4.0 * 0.2, -2.0 * 0.2, -2.0 * 0.2, 0.2};
    const Classification found = classify(System(model), {0.0, va, 0.02, vb});
    ASSERT_EQ(found.drift.size(), 2U);
    EXPECT_NEAR(found.drift[0], speed, 1e-12);
    EXPECT_NEAR(found.drift[1], 2.0 * speed, 1e-12);
    EXPECT_EQ(found.attractor, damped ? Attractor::equilibrium : Attractor::family);
  }
}

/// Two groups, each with a momentum of its own.
TEST(Rest, TwoFreeGroupsDriftEachForItself) {
  Model model = pair(1.0, 2.0, 1000.0, 1.0);
  model.coordinates.push_back({"r", 4.0});
  model.coordinates.push_back({"s", 0.5});
  model.springs.push_back({2, 3, 30.0});
  model.dampers.push_back({2, 3, 0.2});
  const Classification found = classify(System(model), {0.0, 0.3, 0.0, 0.0, 0.0, 0.0, 0.01, -0.9});
  EXPECT_EQ(found.attractor, Attractor::equilibrium);
  ASSERT_EQ(found.drift.size(), 4U);
  EXPECT_NEAR(found.drift[0], 0.1, 1e-12);
  EXPECT_NEAR(found.drift[1], 0.1, 1e-12);
  EXPECT_NEAR(found.drift[2], -0.1, 1e-12);
  EXPECT_NEAR(found.drift[3], -0.1, 1e-12);
}

/// A motor drives a load in oil over a shaft: torque / oil is the speed, in every unit of time.
TEST(Rest, SteadyRotationHasTheSpeedOfItsClosedFormInEveryUnit) {
  for (const double second : {1.0, 1e3, 1e-4}) {
    Model model;
    model.name = "drive";
    model.coordinates = {{"motor", 0.1 * second * second}, {"load", second * second}};
    model.springs = {{0, 1, 50.0}};
    model.dampers = {{0, 1, 0.2 * second}, {1, ground, 0.5 * second}};
    model.forces = {{0, 0, 1.0, 0.0}};
    const Classification found = classify(System(model), {0.0, 0.0, 0.0, 0.0});
    EXPECT_EQ(found.attractor, Attractor::equilibrium) << second;
    ASSERT_EQ(found.drift.size(), 2U);
    EXPECT_NEAR(found.drift[1] * second, 2.0, 1e-9) << second;
    ASSERT_EQ(found.eigenvalues.size(), 3U);
    EXPECT_LT(found.eigenvalues[0].real(), 0.0);
  }
}

TEST(Rest, AStopThatIsNeverReachedChangesNothing) {
  for (const double clearance : {0.2, 1.0, 1e4})
    for (const double damping : {0.1, 2.0, 5.0}) {  // 2: critical, a double eigenvalue
      const Classification found = classify(System(stopped_oscillator(damping, clearance)), {0.1, 0.0});
      EXPECT_EQ(found.attractor, Attractor::equilibrium) << clearance << ' ' << damping;
      ASSERT_EQ(found.eigenvalues.size(), 2U);
      EXPECT_NEAR(found.eigenvalues[0].real() + found.eigenvalues[1].real(), -damping, 1e-6);
      EXPECT_LE(found.approach, 1.0);
    }
}

/// x = -e^{-t} (..) creeps up to the stop at x = 0 and never reaches it.
TEST(Rest, AMassThatCreepsUpToItsStopHasNoEvent) {
  const Classification found = classify(System(stopped_oscillator(3.0, 0.0)), {-1.0, 0.0});
  EXPECT_EQ(found.attractor, Attractor::equilibrium);
  EXPECT_NEAR(found.state[0], 0.0, 1e-15);
}

TEST(Rest, SwingsWithoutLossAreOneOfAFamilyWhereTheyMissTheStopAndACycleWhereTheyMeetIt) {
  const Classification misses = classify(System(stopped_oscillator(0.0, 1.0, 1.0)), {0.999, 0.0});
  EXPECT_EQ(misses.attractor, Attractor::family);
  ASSERT_EQ(misses.eigenvalues.size(), 2U);
  EXPECT_NEAR(misses.eigenvalues[0].imag(), 1.0, 1e-14);
  const double speed = 1.5;
  const Classification meets = classify(System(stopped_oscillator(0.0, 1.0, 1.0)), {0.0, speed});
  EXPECT_EQ(meets.label, "free-1-I");
  EXPECT_NEAR(meets.period, 2.0 * (std::numbers::pi / 2.0 + std::asin(1.0 / speed)), 1e-9);
}

/// A state that is zero by chance says nothing of the size of a motion: the piecewise linear oscillator without loss.
TEST(Rest, AFreeOscillatorMayPassThroughZero) {
  Model model;
  model.name = "one";
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  const double k = 30.0, v = 1.5, gap = 1.0;
  model.compliant_stops = {{"above", 0, ground, gap, k, 0.0}, {"below", ground, 0, gap, k, 0.0}};
  // x = v sin t up to the gap; then about x_0 = k gap / (1 + k) with the rate sqrt(1 + k).
  const double speed = std::sqrt(v * v - gap * gap), rate = std::sqrt(1.0 + k), beyond = gap - k * gap / (1.0 + k);
  const double contact = 2.0 * std::atan2(speed / rate, beyond) / rate;
  const Classification found = classify(System(model), {0.0, v});
  EXPECT_NEAR(found.period, 2.0 * (2.0 * std::asin(gap / v) + contact), 1e-9);
}

TEST(Rest, WhatGrowsIsSaidToGrow) {
  Model model = stopped_oscillator(0.0, 1.0);
  model.damping = {-1.0};
  const Classification bounced = classify(System(model), {0.0, 3.0});
  EXPECT_EQ(bounced.attractor, Attractor::undecided);
  EXPECT_EQ(bounced.doubt, Doubt::growth);
  model.stops.clear();
  EXPECT_EQ(classify(System(model), {0.0, 1e-3}).doubt, Doubt::growth);
  model.damping.clear();
  model.springs.clear();
  model.forces = {{0, 0, 1.0, 0.0}};
  EXPECT_EQ(classify(System(model), {0.0, 0.0}).doubt, Doubt::growth);
}

/// Two blocks that part after their collision: at constant speeds, which no stop ends.
TEST(Rest, BlocksThatPartGoAwayForEver) {
  Model model;
  model.name = "blocks";
  model.coordinates = {{"a", 1.0}, {"b", 2.0}};
  model.stops = {{"bump", 0, 1, 0.0, 0.5}};
  EXPECT_EQ(classify(System(model), {-1.0, 1.0, 0.0, 0.0}).doubt, Doubt::growth);
}

/// Stick on a belt forgets all that differs, through a friction law of 67 corners as through one of a few.
TEST(Rest, ACycleOfManyEventsIsNamedAsOneOfFew) {
  for (const int corners : {3, 33}) {
    const double belt = 1.5, widest = 3.3;
    Model model;
    model.name = "squeal";
    model.coordinates = {{"x", 1.0}};
    model.springs = {{0, ground, 1.0}};
    model.dampers = {{0, ground, 0.1}};
    model.frictions = {{"pad", 0, ground, belt, 1.0, 1.0}};
    Characteristic falling;
    falling.name = "stribeck";
    falling.over = Characteristic::Over::velocity;
    for (int i = -corners; i <= corners; ++i) {
      const double w = widest * i / corners;
      const double less = 0.5 * (1.0 - std::exp(-2.0 * std::abs(w)));
      falling.corners.push_back({belt + w, w > 0.0 ? -less : less});
    }
    model.characteristics = {falling};
    const Classification found = classify(System(model), {2.0, 2.0});
    EXPECT_EQ(found.label, "free-0-II") << corners;
    EXPECT_EQ(found.exponent, -INFINITY) << corners;
  }
}

/// A proof is kept: random chains with stops, and what is said to have no event has none for long. And it comes: a
/// damped chain whose rest is on this side of all stops is proven at last.
TEST(Outlook, WhatIsProvenToHaveNoEventHasNone) {
  std::mt19937_64 random(38);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int proven = 0, at_once = 0, hit = 0;
  for (int machine = 0; machine < 200; ++machine) {
    Model model;
    model.name = "chain";
    const int n = 1 + static_cast<int>(3.0 * unit(random));
    for (int i = 0; i < n; ++i) {
      model.coordinates.push_back({"x" + std::to_string(i), std::pow(10.0, 2.0 * unit(random) - 1.0)});
      model.springs.push_back({i, i + 1 < n ? i + 1 : ground, std::pow(10.0, 2.0 * unit(random) - 1.0)});
      if (unit(random) < 0.7) model.dampers.push_back({i, i + 1 < n ? i + 1 : ground, unit(random)});
      model.stops.push_back({"s" + std::to_string(i), i, ground, 0.1 + unit(random), 0.5});
    }
    State start;
    for (int i = 0; i < n; ++i) start.insert(start.end(), {0.2 * unit(random) - 0.15, unit(random) - 0.5});
    const System system(model);
    const flow::Translations translations(system);
    Motion motion(system, start);
    for (int k = 0; k < 60; ++k) {
      if (!section::outlook(translations, motion).no_event) {
        hit += motion.advance(motion.time().plus(1.0)) == Outcome::event;
        continue;
      }
      ++proven;
      at_once += k == 0;
      EXPECT_EQ(motion.advance(motion.time().plus(2000.0)), Outcome::reached_end) << machine;
      break;
    }
  }
  EXPECT_GT(proven, 120);
  EXPECT_GT(at_once, 10);
  EXPECT_GT(hit, 50);
}

/// Two free masses that have met at a stop drift on together. Whichever of two stops of the pair the file names first,
/// what may be displaced is the place of both, and no more.
TEST(Rest, AStopOfAPairHoldsWhicheverOfThePairComesFirst) {
  Model model = pair(1.0, 1.0, 0.0, 0.0);
  model.springs.clear();
  const Stop near{"near", 0, 1, 1.0, 0.0}, far{"far", 1, 0, 2.0, 0.0};
  for (const std::vector<Stop>& stops : {std::vector{near, far}, std::vector{far, near}})
    for (const double speed : {1.0, -1.0}) {
      model.stops = stops;
      const Classification found = classify(System(model), {0.0, speed, 0.0, 0.0});
      EXPECT_EQ(found.attractor, Attractor::equilibrium);
      EXPECT_EQ(found.family, 1) << stops[0].name << ' ' << speed;
      EXPECT_TRUE(found.eigenvalues.empty());
      ASSERT_EQ(found.drift.size(), 2U);
      EXPECT_NEAR(found.drift[0], 0.5 * speed, 1e-12);
    }
}

/// A loop of contacts: each of two masses may meet a wall, and one pushes the other. Held together they are one
/// oscillator of mass 2, stiffness 2 and damping 2 c, whichever of the three contacts comes first.
TEST(Rest, AContactThatClosesALoopHoldsItsPair) {
  constexpr double c = 0.3;
  Model model = pair(1.0, 1.0, 0.0, 0.0);
  model.springs = {{0, ground, 1.0}, {1, ground, 1.0}};
  model.dampers = {{0, ground, c}, {1, ground, c}};
  model.forces = {{0, 0, 1.0, 0.0}, {1, 0, -1.0, 0.0}};
  const Stop first{"first", 0, ground, 1.5, 0.0}, second{"second", ground, 1, 1.5, 0.0},
      between{"between", 0, 1, 0.0, 0.0};
  for (const std::vector<Stop>& stops : {std::vector{first, second, between}, std::vector{between, first, second},
                                         std::vector{first, between, second}}) {
    model.stops = stops;
    const Classification found = classify(System(model), {-0.2, 0.1, 0.3, 0.0});
    EXPECT_EQ(found.attractor, Attractor::equilibrium);
    EXPECT_EQ(found.family, 0);
    ASSERT_EQ(found.eigenvalues.size(), 2U) << stops[0].name;
    for (const auto& eigenvalue : found.eigenvalues) {
      EXPECT_NEAR(eigenvalue.real(), -c / 2.0, 1e-9);
      EXPECT_NEAR(std::abs(eigenvalue), 1.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace slapstick
