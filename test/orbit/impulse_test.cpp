/// Cycles under blows that come back with the forcing: a closed form, energy, and two routes to multipliers and
/// derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "driven.hpp"
#include "slapstick/quantity/cycle_energy.hpp"

namespace slapstick::test {
namespace {

using std::numbers::pi;

const std::string oscillator =
    "name = 'm'\nomega = 'omega'\n[parameters.omega]\nvalue = 2\n[parameters.size]\nvalue = 1\n"
    "[parameters.late]\nvalue = 0.7\n"
    "[[coordinate]]\nname = 'x'\nmass = 1\n[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n"
    "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.1\n";
const std::string blow = "[[impulse]]\nname = 'hammer'\non = 'x'\nmomentum = 'size'\nphase = 'late'\n";
const std::string wall = "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\nrestitution = 0.8\n";
const std::string pad = "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.5\nkinetic = 0.2\n";

/// Just behind the blow x = sum over both roots k of P / (k_1 - k_2) / (1 - exp(k T)), so that after a period of free
/// motion and a jump by P of the velocity it is there again.
TEST(PeriodicImpulse, HasTheClosedFormOfAGeometricSeries) {
  const Driven struck(oscillator + blow, {}, {});
  ASSERT_TRUE(struck.orbit);
  EXPECT_TRUE(struck.orbit->is_motion) << struck.orbit->why;
  const double T = pi, late = 0.7 / 2.0, to_zero = T - late;
  const std::complex<double> k(-0.05, std::sqrt(1.0 - 0.0025));
  const std::complex<double> mode = std::exp(k * to_zero) / ((k - std::conj(k)) * (1.0 - std::exp(k * T)));
  const State found = orbit::at_phase_zero(*struck.problem, struck.orbit->orbit);
  EXPECT_NEAR(found[0], 2.0 * mode.real(), 1e-13);
  EXPECT_NEAR(found[1], 2.0 * (k * mode).real(), 1e-13);
}

/// What comes in by p (v- + v+) / 2 is what damper, friction and impacts take.
TEST(PeriodicImpulse, BringsWhatDampersFrictionAndImpactsTake) {
  for (const std::string& contacts : {std::string(), pad, wall, pad + wall}) {
    const Driven struck(oscillator + contacts + blow, {}, {});
    ASSERT_TRUE(struck.orbit) << contacts;
    const CycleEnergy energy = cycle_energy(*struck.problem, struck.orbit->orbit);
    EXPECT_GT(energy.input, 0.01) << contacts;
    EXPECT_NEAR(energy.balance(), 0.0, 1e-13 * energy.input) << contacts;
  }
}

/// Newton's equations and the motion's own tangents.
TEST(PeriodicImpulse, HasTheMultipliersOfTheMotion) {
  for (const std::string& contacts : {std::string(), pad, wall, pad + wall}) {
    const Driven struck(oscillator + contacts + blow, {}, {});
    const Classification seen = classify(struck.system, struck.start);
    ASSERT_TRUE(struck.orbit) << contacts;
    EXPECT_TRUE(struck.orbit->is_motion) << struck.orbit->why;
    EXPECT_EQ(struck.orbit->label, seen.label) << contacts;
    ASSERT_EQ(struck.orbit->multipliers.size(), seen.multipliers.size()) << contacts;
    for (std::size_t i = 0; i < seen.multipliers.size(); ++i)
      EXPECT_NEAR(std::abs(struck.orbit->multipliers[i] - seen.multipliers[i]), 0.0, 1e-10) << contacts;
  }
}

/// By the frequency, the momentum and the phase.
TEST(PeriodicImpulse, HasDerivativesThatAreDifferences) {
  const std::vector<std::string> names = {"omega", "size", "late"};
  const std::vector<double> at = {2.0, 1.0, 0.7};
  const std::string other = "[[force]]\non = 'x'\namplitude = 0.3\n";
  for (const std::string& contacts : {std::string(), wall}) {
    const Driven struck(oscillator + contacts + other + blow, names, at);
    ASSERT_TRUE(struck.orbit) << contacts;
    for (const char* name : {"x", "power_in"}) {
      const Quantity of = struck.quantity(name);
      const Statistics value = struck.of(name).of.front();
      const std::vector<Measured> rates = measure_rates(*struck.problem, struck.orbit->orbit, {of});
      for (std::size_t j = 0; j < names.size(); ++j) {
        const double difference = struck.difference(j, 1e-5, of, "mean");
        EXPECT_NEAR(statistic_rate(value, rates[j].of.front(), "mean"), difference, 1e-6 * std::abs(difference) + 1e-9)
            << contacts << name << names[j];
      }
    }
  }
}

/// A branch over the momentum goes through 0, where the orbit is that of the other push: all is linear.
TEST(PeriodicImpulse, IsFollowedThroughNothing) {
  const std::string other = "[[force]]\non = 'x'\namplitude = 1\n";
  const Driven struck(oscillator + other + blow, {"size"}, {0.5});
  ASSERT_TRUE(struck.orbit);
  const orbit::Branch branch = orbit::follow(*struck.problem, struck.orbit->orbit, {.from = -0.5, .to = 0.5});
  EXPECT_EQ(branch.points.front().orbit.parameter(), -0.5);
  EXPECT_EQ(branch.points.back().orbit.parameter(), 0.5);
  EXPECT_TRUE(branch.special.empty());
  const auto at = [&](double size) { return Driven(oscillator + other + blow, {"size"}, {size}); };
  const Driven below = at(-0.5), none = at(0.0), above = at(0.5);
  const Driven without(oscillator + other, {}, {});
  ASSERT_TRUE(none.orbit && below.orbit && without.orbit);
  const auto state = [](const Driven& of, const orbit::Orbit& orbit) {
    return orbit::at_phase_zero(*of.problem, orbit);
  };
  const State first = state(below, branch.points.front().orbit), last = state(above, branch.points.back().orbit),
              middle = state(none, none.orbit->orbit), alone = state(without, without.orbit->orbit);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(middle[i], alone[i], 1e-13);
    EXPECT_NEAR(first[i] + last[i], 2.0 * middle[i], 1e-12);
    EXPECT_GT(std::abs(last[i] - first[i]), 0.1);
  }
}

/// Half a period from a blow its signal has a point at which nothing happens.
/// An impact that passes it is no change of events.
TEST(PeriodicImpulse, HasNothingHalfAPeriodFromItsBlow) {
  const Driven struck(
      "name = 'm'\nomega = 'omega'\n[parameters.omega]\nvalue = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n"
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n"
      "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.2\n"
      "[[impulse]]\nname = 'blow'\non = 'x'\nmomentum = -1\nphase = 0\n"
      "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.3\nrestitution = 0.5\n",
      {"omega"}, {1.1});
  ASSERT_TRUE(struck.orbit);
  const orbit::Branch branch = orbit::follow(*struck.problem, struck.orbit->orbit, {.from = 0.75, .to = 1.2});
  EXPECT_TRUE(branch.special.empty());
  EXPECT_EQ(branch.points.front().orbit.parameter(), 0.75);
  EXPECT_EQ(branch.points.back().orbit.parameter(), 1.2);
  const auto phase_of_impact = [&](const orbit::Orbit& orbit) {
    const auto events = orbit::events(*struck.problem, orbit);
    return events.empty() ? -1.0 : events[0].t - std::floor(events[0].t);
  };
  EXPECT_LT(phase_of_impact(branch.points.front().orbit), 0.5);
  EXPECT_GT(phase_of_impact(branch.points.back().orbit), 0.5);
}

const std::string table =
    "name = 'm'\nomega = 'omega'\n[parameters.omega]\nvalue = 2\n[parameters.size]\nvalue = 1\n"
    "[parameters.late]\nvalue = 0.5\n"
    "[[signal]]\nname = 's'\npoints = [[0, 0], ['late', 'size'], [1, 0]]\nrepeats = true\nin_periods = true\n"
    "[[base]]\nname = 'table'\nsignal = 's'\n"
    "[[coordinate]]\nname = 'x'\nmass = 1\nbase = 'table'\n"
    "[[force]]\non = 'x'\nharmonic = 0\namplitude = -0.8\n"
    "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.1\n"
    "[[stop]]\nname = 'top'\nbetween = ['table', 'x']\nclearance = 0\nrestitution = 0.4\n";

/// A ball on a table that moves by straight lines: what the inertia brings is what damper and impacts take; Newton's
/// equations and the motion's own tangents; derivatives against differences.
TEST(WallOfASignal, HasCyclesWithAllThatBelongsToThem) {
  const std::vector<std::string> names = {"omega", "size", "late"};
  const std::vector<double> at = {2.0, 1.0, 0.5};
  const Driven ball(table, names, at);
  const Classification seen = classify(ball.system, ball.start);
  ASSERT_TRUE(ball.orbit);
  EXPECT_TRUE(ball.orbit->is_motion) << ball.orbit->why;
  EXPECT_EQ(ball.orbit->label, seen.label);
  ASSERT_EQ(ball.orbit->multipliers.size(), seen.multipliers.size());
  for (std::size_t i = 0; i < seen.multipliers.size(); ++i)
    EXPECT_NEAR(std::abs(ball.orbit->multipliers[i] - seen.multipliers[i]), 0.0, 1e-10);
  const CycleEnergy energy = cycle_energy(*ball.problem, ball.orbit->orbit);
  EXPECT_NEAR(energy.balance(), 0.0, 1e-12 * std::abs(energy.impacts.front()));
  for (const char* name : {"x", "power_in", "F_top"}) {
    const Quantity of = ball.quantity(name);
    const std::vector<Measured> rates = measure_rates(*ball.problem, ball.orbit->orbit, {of});
    for (std::size_t j = 0; j < names.size(); ++j) {
      const double difference = ball.difference(j, 1e-5, of, "mean");
      EXPECT_NEAR(statistic_rate(ball.of(name).of.front(), rates[j].of.front(), "mean"), difference,
                  1e-6 * std::abs(difference) + 1e-9)
          << name << names[j];
    }
  }
}

/// A body that a closed stop holds, is blown against it and off it: both have derivatives.
TEST(PeriodicImpulse, OnAClosedStopHasDerivatives) {
  const std::string pressed = "[[force]]\non = 'x'\nharmonic = 0\namplitude = 0.6\n",
                    off = "[[impulse]]\nname = 'off'\non = 'x'\nmomentum = '-size'\nphase = 'late'\n",
                    on = "[[impulse]]\nname = 'on'\non = 'x'\nmomentum = 'size'\nphase = 'late - 0.5'\n",
                    dead = "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\nrestitution = 0\n";
  const Driven held(oscillator + pressed + dead + off + on, {"omega", "size"}, {0.5, 0.4});
  ASSERT_TRUE(held.orbit);
  EXPECT_TRUE(held.orbit->is_motion) << held.orbit->why;
  for (const char* name : {"x", "power_in", "a", "F_wall"}) {
    const Quantity of = held.quantity(name);
    const std::vector<Measured> rates = measure_rates(*held.problem, held.orbit->orbit, {of});
    for (std::size_t j = 0; j < 2; ++j) {
      const double difference = held.difference(j, 1e-5, of, "rms");
      EXPECT_NEAR(statistic_rate(held.of(name).of.front(), rates[j].of.front(), "rms"), difference,
                  1e-6 * std::abs(difference) + 1e-8)
          << name << j;
    }
  }
}

/// Blows at one instant are one blow, on what sticks and on a stop that is closed, also where they oppose each other.
TEST(PeriodicImpulse, AtOneInstantIsTheSum) {
  const auto blows = [](const std::string& first, const std::string& second) {
    const auto one = [](const std::string& name, const std::string& momentum) {
      return "[[impulse]]\nname = '" + name + "'\non = 'x'\nmomentum = '" + momentum + "'\nphase = 0.7\n";
    };
    return one("first", first) + (second.empty() ? "" : one("second", second));
  };
  const std::string held =
      "[[force]]\non = 'x'\nharmonic = 0\namplitude = 0.6\n"
      "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\nrestitution = 0\n";
  struct Case {
    std::string contacts, first, second, sum;
    double omega;
  };
  for (const Case& one :
       {Case{"", "0.3 * size", "0.7", "0.3 * size + 0.7", 2.0},
        Case{pad, "0.01 * size", "0.8", "0.01 * size + 0.8", 2.0}, Case{held, "size", "-1.8", "size - 1.8", 0.5},
        Case{held, "0.2 * size", "0.4", "0.2 * size + 0.4", 0.5}}) {
    const Driven two(oscillator + one.contacts + blows(one.first, one.second), {"size"}, {1.0});
    const Driven whole(oscillator + one.contacts + blows(one.sum, ""), {"size"}, {1.0});
    ASSERT_TRUE(two.orbit && whole.orbit) << one.contacts << one.first;
    for (const char* name : {"x", "v", "power_in"}) {
      EXPECT_NEAR(two.of(name).of.front().rms, whole.of(name).of.front().rms, 1e-12)
          << one.contacts << one.first << name;
      const auto rate = [&](const Driven& of) {
        return measure_rates(*of.problem, of.orbit->orbit, {of.quantity(name)}).front().of.front().rms;
      };
      EXPECT_NEAR(rate(two), rate(whole), 1e-10) << one.contacts << one.first << name;
    }
  }
}

/// A hammer at the instant at which the table turns: the mean force on the table is the weight, less the blows.
TEST(WallOfASignal, MayTurnAtTheInstantOfABlow) {
  const std::string hammer = "[[impulse]]\nname = 'hammer'\non = 'x'\nmomentum = 'blow'\nphase = 0\n";
  for (const char* blow : {"1e-4", "-0.05", "0.3"}) {
    std::string text = table + hammer;
    text.replace(text.find("'blow'"), 6, blow);
    const Driven ball(text, {"omega"}, {2.0});
    ASSERT_TRUE(ball.orbit) << blow;
    const double damped = 0.1 * statistic(ball.of("v").of.front(), "mean");
    EXPECT_NEAR(statistic(ball.of("F_top").of.front(), "mean"), 0.8 + damped - std::stod(blow) * 2.0 / (2.0 * pi),
                1e-12)
        << blow;
  }
}

}  // namespace
}  // namespace slapstick::test
