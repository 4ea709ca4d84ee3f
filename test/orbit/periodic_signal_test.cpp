/// Cycles under signals that repeat with the forcing: closed forms, Fourier series, two routes to multipliers and
/// derivatives, and branches on which an event passes a point of the signal.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "driven.hpp"

namespace slapstick::test {
namespace {

using std::numbers::pi;

const std::string parameters =
    "[parameters.omega]\nvalue = 2\n[parameters.duty]\nvalue = 0.5\n[parameters.size]\nvalue = 1\n";
const std::string oscillator = "name = 'm'\nomega = 'omega'\n" + parameters +
                               "[[coordinate]]\nname = 'x'\nmass = 1\n"
                               "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n";
const std::string damper = "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.1\n";
const std::string wall = "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\nrestitution = 0.8\n";

std::string push(const std::string& signal) {
  return "[[signal]]\nname = 'push'\n" + signal + "[[force]]\non = 'x'\nsignal = 'push'\namplitude = 'size'\n";
}

/// x'' + c x' + x = +1, then -1: half a period later the motion is its opposite, x(T/2) = e + Phi (x_0 - e) = -x_0 with
/// e = (1, 0) and Phi the free motion over half a period.
TEST(PeriodicSignal, OfASquareHasTheClosedFormOfTwoHalves) {
  const Driven square(oscillator + damper + push("shape = 'square'\n"), {}, {});
  ASSERT_TRUE(square.orbit);
  const double c = 0.1, T = pi, s = 0.5 * T, w = std::sqrt(1.0 - 0.25 * c * c), decay = std::exp(-0.5 * c * s);
  Eigen::Matrix2d Phi;
  Phi << std::cos(w * s) + 0.5 * c / w * std::sin(w * s), std::sin(w * s) / w, -std::sin(w * s) / w,
      std::cos(w * s) - 0.5 * c / w * std::sin(w * s);
  Phi *= decay;
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d expected = -(one + Phi).inverse() * (one - Phi) * Eigen::Vector2d(1.0, 0.0);
  const State found = orbit::at_phase_zero(*square.problem, square.orbit->orbit);
  EXPECT_NEAR(found[0], expected[0], 1e-13);
  EXPECT_NEAR(found[1], expected[1], 1e-13);
  for (const auto& multiplier : square.orbit->multipliers) EXPECT_NEAR(std::abs(multiplier), decay * decay, 1e-13);
  EXPECT_TRUE(square.orbit->is_motion) << square.orbit->why;
}

/// A triangle is the sum of 8 / (pi n)^2 cos n theta over odd n: its response has the mean square that Parseval gives.
TEST(PeriodicSignal, OfATriangleHasTheMeanSquareOfItsFourierSeries) {
  const Driven triangle(oscillator + damper + push("shape = 'triangle'\n"), {}, {});
  ASSERT_TRUE(triangle.orbit);
  double mean_square = 0.0;
  for (int n = 1; n < 2001; n += 2) {
    const double w = 2.0 * n, force = 8.0 / (pi * pi * n * n);
    mean_square += 0.5 * force * force / ((1.0 - w * w) * (1.0 - w * w) + 0.01 * w * w);
  }
  EXPECT_NEAR(statistic(triangle.of("x").of.front(), "rms"), std::sqrt(mean_square), 1e-13);
}

/// Three rounds in a period are three times the forcing frequency.
TEST(PeriodicSignal, OfThreeRoundsIsThatOfThreeTimesTheFrequency) {
  const std::string round =
      "points = [[0, 0.3], [0.1, 1], [0.2, 1], [0.2, -1], [0.333333333333333, 0.3]]\n"
      "repeats = true\nin_periods = true\n";
  const Driven thrice(oscillator + damper + wall + push(round), {"omega"}, {0.7});
  const std::string once =
      "points = [[0, 0.3], [0.3, 1], [0.6, 1], [0.6, -1], [1, 0.3]]\nrepeats = true\nin_periods = true\n";
  const Driven quick(oscillator + damper + wall + push(once), {"omega"}, {2.1});
  ASSERT_TRUE(thrice.orbit && quick.orbit);
  const State a = orbit::at_phase_zero(*thrice.problem, thrice.orbit->orbit);
  const State b = orbit::at_phase_zero(*quick.problem, quick.orbit->orbit);
  EXPECT_NEAR(a[0], b[0], 1e-12);
  EXPECT_NEAR(a[1], b[1], 1e-12);
}

/// A line that is as long as its period has its ends half a period apart: which round an instant is in is not rounding.
TEST(PeriodicSignal, OfASawtoothDoesNotDependOnItsPhase) {
  for (const char* phase : {"0", "0.7", "2", "2.5", "3", "6"}) {
    const Driven saw(oscillator + damper + push("shape = 'sawtooth'\nphase = " + std::string(phase) + "\n"), {}, {});
    ASSERT_TRUE(saw.orbit) << phase;
    double mean_square = 0.0;  // of the sum of +-2 / (pi n) sin n theta
    for (int n = 1; n < 20001; ++n) {
      const double w = 2.0 * n, force = 2.0 / (pi * n);
      mean_square += 0.5 * force * force / ((1.0 - w * w) * (1.0 - w * w) + 0.01 * w * w);
    }
    EXPECT_NEAR(statistic(saw.of("x").of.front(), "rms"), std::sqrt(mean_square), 1e-12) << phase;
  }
}

/// Two equal halves of a signal have their points at the same instants: the derivative by both duties is shared.
TEST(PeriodicSignal, HasDerivativesWhereTwoSignalsHaveAPointAtOneInstant) {
  const auto half = [](const std::string& name, const std::string& duty) {
    return "[[signal]]\nname = '" + name + "'\nshape = 'square'\nduty = '" + duty +
           "'\n[[force]]\non = 'x'\nsignal = '" + name + "'\namplitude = 0.5\n";
  };
  const std::string second = "[parameters.late]\nvalue = 0.5\n";
  const Driven one(oscillator + damper + wall + push("shape = 'square'\nduty = 'duty'\n"), {"duty"}, {0.5});
  const Driven two(oscillator + second + damper + wall + half("a", "duty") + half("b", "late"), {"duty", "late"},
                   {0.5, 0.5});
  ASSERT_TRUE(one.orbit && two.orbit);
  const auto rates = [](const Driven& of) { return measure_rates(*of.problem, of.orbit->orbit, {of.quantity("x")}); };
  const Statistics whole = one.of("x").of.front(), halves = two.of("x").of.front();
  const double expected = 0.5 * statistic_rate(whole, rates(one)[0].of.front(), "rms");
  EXPECT_NEAR(statistic_rate(halves, rates(two)[0].of.front(), "rms"), expected, 1e-9 * std::abs(expected));
  EXPECT_NEAR(statistic_rate(halves, rates(two)[1].of.front(), "rms"), expected, 1e-9 * std::abs(expected));
}

/// Derivatives by the shape, the size and the frequency, where an impact is near a step.
TEST(PeriodicSignal, HasDerivativesThatAreDifferences) {
  const std::string text = oscillator + damper + wall +
                           push(
                               "points = [[0, 1], ['duty', 1], ['duty', -1], [1, -0.4]]\n"
                               "repeats = true\nin_periods = true\n");
  const std::vector<std::string> names = {"omega", "duty", "size"};
  const std::vector<double> at = {2.0, 0.52, 1.0};
  const Driven middle(text, names, at);
  ASSERT_TRUE(middle.orbit);
  ASSERT_EQ(middle.orbit->label, "1-1-I");
  const Quantity x = middle.quantity("x");
  const Statistics value = middle.of("x").of.front();
  const std::vector<Measured> rates = measure_rates(*middle.problem, middle.orbit->orbit, {x});
  for (std::size_t j = 0; j < names.size(); ++j) {
    const double difference = middle.difference(j, 1e-5, x, "mean");
    EXPECT_NEAR(statistic_rate(value, rates[j].of.front(), "mean"), difference, 1e-6 * std::abs(difference))
        << names[j];
  }
}

/// An impact passes the step of a square: the branch has a coincidence there, where the impact's phase is the duty, and
/// goes on. On both sides the multipliers are those of the motion's own tangents.
TEST(PeriodicSignal, LetsABranchThroughWhereAnEventPassesAPoint) {
  const std::string text = oscillator + damper + wall + push("shape = 'square'\nduty = 'duty'\n");
  const Driven first(text, {"duty"}, {0.5});
  ASSERT_TRUE(first.orbit);
  const orbit::Branch branch = orbit::follow(*first.problem, first.orbit->orbit, {.from = 0.45, .to = 0.65});
  const auto passes = std::find_if(branch.special.begin(), branch.special.end(), [](const orbit::SpecialPoint& point) {
    return point.type == orbit::SpecialType::CO;
  });
  ASSERT_NE(passes, branch.special.end());
  EXPECT_EQ(passes->passage, orbit::Passage::persistence);
  const auto events = orbit::events(*first.problem, passes->solution.orbit);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].t - std::floor(events[0].t), passes->value, 1e-9);
  EXPECT_EQ(branch.points.front().orbit.parameter(), 0.45);
  EXPECT_EQ(branch.points.back().orbit.parameter(), 0.65);
  for (const double duty : {0.5, 0.6}) {
    const Driven one(text, {"duty"}, {duty});
    const Classification seen = classify(one.system, one.start);
    ASSERT_TRUE(one.orbit);
    EXPECT_EQ(one.orbit->label, seen.label);
    ASSERT_EQ(one.orbit->multipliers.size(), seen.multipliers.size());
    for (std::size_t i = 0; i < seen.multipliers.size(); ++i)
      EXPECT_NEAR(std::abs(one.orbit->multipliers[i] - seen.multipliers[i]), 0.0, 1e-10);
  }
}

/// A step that leaves the limit of a dry contact behind lets it go at its instant.
TEST(PeriodicSignal, LetsADryContactGoAtItsStep) {
  const std::string pad = "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.6\nkinetic = 0.3\n";
  const Driven stepped(oscillator + pad + damper + push("shape = 'square'\nduty = 0.7\nhigh = 0.5\nlow = -0.9\n"),
                       {"size"}, {1.0});
  ASSERT_TRUE(stepped.orbit);
  EXPECT_TRUE(stepped.orbit->is_motion) << stepped.orbit->why;
  EXPECT_EQ(classify(stepped.system, stepped.start).label, stepped.orbit->label);
  const auto released = [](const Driven& of, const orbit::Orbit& cycle) {
    std::vector<double> phases;
    for (const orbit::EventOfOrbit& event : orbit::events(*of.problem, cycle))
      if (event.kind == EventKind::release) phases.push_back(event.t - std::floor(event.t));
    return phases;
  };
  const std::vector<double> phases = released(stepped, stepped.orbit->orbit);
  ASSERT_FALSE(phases.empty());
  EXPECT_NEAR(phases.front(), 0.7, 1e-14);
}

/// .. as long as the force behind the step exceeds the limit: a free mass under steps of size s, -s against a limit of
/// 0.6 is let go while s > 0.6. There its branch has a special point, and behind it the mass sticks for ever.
TEST(PeriodicSignal, LetsADryContactGoWhileTheStepExceedsTheLimit) {
  const std::string pad = "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.6\nkinetic = 0.3\n";
  const std::string blows =
      "points = [[0, 0.5], [0.3, 0.5], [0.3, 1], [0.4, 1], [0.4, 0.3], [0.7, 0.3], [0.7, -1], [0.8, -1], "
      "[0.8, 0.5], [1, 0.5]]\nrepeats = true\nin_periods = true\n";
  const std::string mass = "name = 'm'\nomega = 0.628\n" + parameters + "[[coordinate]]\nname = 'x'\nmass = 1\n";
  const Driven stepped(mass + pad + push(blows), {"size"}, {1.0});
  ASSERT_TRUE(stepped.orbit);
  const orbit::Branch branch = orbit::follow(*stepped.problem, stepped.orbit->orbit, {.from = 0.5, .to = 1.0});
  const auto stays = std::find_if(branch.special.begin(), branch.special.end(), [](const orbit::SpecialPoint& point) {
    return point.type == orbit::SpecialType::SL && point.margin.kind == orbit::UsedMargin::Kind::no_stick;
  });
  ASSERT_NE(stays, branch.special.end());
  EXPECT_NEAR(stays->value, 0.6, 1e-12);
  EXPECT_EQ(branch.points.front().orbit.parameter(), 0.5);
}

/// A ball under weight 1 that a push of 1 + a lifts for the part D of each period T. It lands at
/// V = D sqrt(a^2 + a) and comes to rest V (1 + r) / (1 - r) later. So its chatter's limit meets the next step where
///     T = D (1 + a + (1 + r) / (1 - r) sqrt(a^2 + a)),
/// and the ball is not lifted at all where a = 0. An orbit of one impact that comes with the step has
///     r (E - D a) / (1 + r) + a (D^2 / 2 + D E) = E^2 / 2,   E = T - D.
constexpr double lifted_for = 0.3, bounces_by = 0.3;

Driven lifted_ball(double size) {
  return Driven("name = 'ball'\nomega = 6.283185307179586\n" + parameters +
                    "[[coordinate]]\nname = 'x'\nmass = 1\n[[force]]\non = 'x'\nharmonic = 0\namplitude = -1\n"
                    "[[stop]]\nname = 'floor'\nbetween = ['ground', 'x']\nclearance = 0\nrestitution = 0.3\n" +
                    push("shape = 'square'\nduty = 0.3\nlow = 0\n"),
                {"size"}, {size});
}

/// The a at which the chatter's limit meets the step.
double limit_meets_step() {
  const auto late = [](double a) {
    return lifted_for * (1 + a + (1 + bounces_by) / (1 - bounces_by) * std::sqrt(a * a + a)) - 1.0;
  };
  double low = 0.1, high = 2.0;
  while (0.5 * (low + high) > low && 0.5 * (low + high) < high)
    (late(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  return low;
}

/// Where the limit meets the step infinitely many changes gather, and the branch goes on through them: it does not run
/// back over itself. In the other sense it comes to where nothing lifts the ball.
TEST(PeriodicSignal, LetsABranchThroughWhereAChattersLimitMeetsAStep) {
  const Driven ball = lifted_ball(1.5);
  ASSERT_TRUE(ball.orbit);
  ASSERT_EQ(ball.orbit->label, "1-inf-II");
  const orbit::Branch branch = orbit::follow(*ball.problem, ball.orbit->orbit, {.from = 0.5, .to = 2.5});
  EXPECT_EQ(branch.points.front().orbit.parameter(), 0.5);
  EXPECT_EQ(branch.points.back().orbit.parameter(), 2.5);
  const auto first = [&](orbit::SpecialType type) {
    return std::ranges::find(branch.special, type, &orbit::SpecialPoint::type);
  };
  const auto lifts = first(orbit::SpecialType::GR), meets = first(orbit::SpecialType::CH);
  ASSERT_NE(lifts, branch.special.end());
  ASSERT_NE(meets, branch.special.end());
  EXPECT_NEAR(lifts->value, 1.0, 1e-12);
  EXPECT_NEAR(meets->value, 1.0 + limit_meets_step(), 1e-13);
  EXPECT_LE(meets->error, 1e-12);
  const orbit::SpecialPoint& last = branch.special.back();
  const double E = 1.0 - lifted_for, r = bounces_by;
  const double a =
      (0.5 * E * E - r * E / (1 + r)) / (0.5 * lifted_for * lifted_for + lifted_for * E - r * lifted_for / (1 + r));
  EXPECT_EQ(last.type, orbit::SpecialType::CO);
  EXPECT_NEAR(last.value, 1.0 + a, 1e-12);
}

/// The same places from the other side, from an orbit of one impact.
TEST(PeriodicSignal, HasItsOnsetOfChatterAtAStepFromEitherSide) {
  const Driven ball = lifted_ball(2.4);
  const auto is_meant = [](const orbit::Solution& one) { return one.label == "1-1-I"; };
  const auto search = orbit::search(*ball.problem, ball.system, ball.start, {.enough = is_meant});
  const auto found = std::ranges::find_if(search.orbits, is_meant);
  ASSERT_NE(found, search.orbits.end());
  const orbit::Branch branch = orbit::follow(*ball.problem, found->orbit, {.from = 1.3, .to = 2.5});
  const auto meets = std::ranges::find(branch.special, orbit::SpecialType::CH, &orbit::SpecialPoint::type);
  ASSERT_NE(meets, branch.special.end());
  EXPECT_NEAR(meets->value, 1.0 + limit_meets_step(), std::max(1e-12, 2.0 * meets->error));
  EXPECT_LE(meets->error, 1e-11);
  EXPECT_EQ(branch.points.front().label, "1-inf-II");
}

}  // namespace
}  // namespace slapstick::test
