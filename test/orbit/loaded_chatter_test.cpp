/// Orbits with a complete chatter beside forces that are linear in the state: loaded friction, compliant stops, bends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/quantity/cycle_energy.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::test {
namespace {

/// A shaken ball that comes to rest once a period, and a body y beside it that never does.
const std::string shaken =
    "name = 'm'\nomega = 6.283185307179586\n[parameters]\nacceleration = 1.3\nrestitution = 0.4\nmu = 0.2\nstiff = "
    "0.5\n"
    "[[coordinate]]\nname = 'x'\nmass = 1\n[[coordinate]]\nname = 'y'\nmass = 1\n"
    "[[spring]]\nbetween = ['y', 'ground']\nstiffness = 30\n[[damper]]\nbetween = ['y', 'ground']\ncoefficient = 2\n"
    "[[force]]\non = 'y'\nharmonic = 1\namplitude = 20\nphase = 0.4\n[[force]]\non = 'x'\nharmonic = 0\namplitude = "
    "-1\n"
    "[[force]]\non = 'x'\nharmonic = 1\namplitude = 'acceleration'\n"
    "[[stop]]\nname = 'floor'\nbetween = ['ground', 'x']\nclearance = 0\nrestitution = 'restitution'\n";
const std::string on_wall = "[[friction]]\nname = 'rub'\nbetween = ['x', 'ground']\nstatic = 'mu'\nkinetic = 'mu'\n",
                  on_body = "[[friction]]\nname = 'rub'\nbetween = ['x', 'y']\nstatic = 'mu'\nkinetic = 'mu'\n",
                  layer =
                      "[[compliant_stop]]\nname = 'layer'\nbetween = ['ground', 'x']\nclearance = -0.02\n"
                      "stiffness = 'stiff'\ndamping = 0.3\n";

struct Beside {
  const char* name;
  std::string parts;
};
const std::vector<Beside> all = {
    {"load on the ball", on_wall + "normal_force = { constant = 0.7, y = 0.6 }\n"},
    {"load on another pair", on_body + "normal_force = { constant = 0.7, y = 0.6, v_y = 0.05 }\n"},
    {"layer that loads", layer + on_wall + "normal_force = { compliant_stop = 'layer' }\n"},
    {"layer of two stiffnesses",
     "[[compliant_stop]]\nname = 'layer'\nbetween = ['y', 'x']\nclearance = -0.4\n"
     "stiffness = 'stiff'\nunloading_stiffness = 0.2\n"},
    {"bend at the floor",
     "[[spring]]\nname = 'bend'\nbetween = ['x', 'ground']\ncharacteristic = [[-1, -0.2], [0, 0], [1, 'stiff']]\n"},
    {"damper that turns at rest",
     "[[damper]]\nbetween = ['x', 'ground']\ncharacteristic = [[-1, -0.8], [0, 0], [1, 'stiff']]\n"},
    {"bend",
     "[[spring]]\nname = 'bend'\nbetween = ['x', 'ground']\ncharacteristic = [[-1, -0.2], [0.05, 0.1], [1, "
     "'stiff']]\n"},
};

struct Cycle {
  Cycle(const std::string& text, const std::vector<std::string>& names, const std::vector<double>& at)
      : definition(ModelDefinition::parse(text, "f.toml")),
        family(definition.family(names, {})),
        system(family.model(at)),
        problem(orbit::pose(family, at)),
        orbit(orbit::settle(*problem, system, definition.start()).orbit) {}
  ModelDefinition definition;
  Family family;
  System system;
  std::shared_ptr<const orbit::Problem> problem;
  std::optional<orbit::Solution> orbit;
};

/// Multipliers of the orbit's equations and of the motion's tangents. Where no limit was proven they were 1e223.
TEST(LoadedChatter, HasTheMultipliersOfItsTangents) {
  for (const Beside& one : all) {
    const Cycle cycle(shaken + one.parts, {}, {});
    ASSERT_TRUE(cycle.orbit) << one.name;
    EXPECT_EQ(cycle.orbit->label, "1-inf-II") << one.name;
    EXPECT_LT(cycle.orbit->orbit.legs(), 80U) << one.name;  // summed, not followed to rounding
    const Classification seen = classify(cycle.system, cycle.definition.start());
    ASSERT_EQ(cycle.orbit->multipliers.size(), seen.multipliers.size()) << one.name;
    for (std::size_t i = 0; i < seen.multipliers.size(); ++i)
      EXPECT_NEAR(std::abs(cycle.orbit->multipliers[i]), std::abs(seen.multipliers[i]), 1e-9) << one.name;
  }
}

/// .. and the instant of its limit has derivatives that are differences, by what makes the forces too.
TEST(LoadedChatter, HasALimitWhoseDerivativesAreDifferences) {
  const std::vector<std::string> names = {"acceleration", "restitution", "mu", "stiff"};
  const std::vector<double> at = {1.3, 0.4, 0.2, 0.5};
  for (const Beside& one : all) {
    const Cycle cycle(shaken + one.parts, names, at);
    ASSERT_TRUE(cycle.orbit) << one.name;
    const auto quantity = find_quantity(quantities(cycle.system.model()), "x");
    const auto mean = [&](const orbit::Problem& problem, const orbit::Orbit& there) {
      return measure(problem, there, {quantity}).of.front().mean;
    };
    const std::vector<Measured> rates = measure_rates(*cycle.problem, cycle.orbit->orbit, {quantity});
    for (std::size_t j = 0; j < names.size(); ++j) {
      const double h = 1e-5;
      const auto beside = [&](double by) {
        orbit::Orbit guess = cycle.orbit->orbit;
        guess.values[j] += by;
        const auto problem = orbit::pose(cycle.family, guess.values);
        const auto there = orbit::refine(*problem, guess);
        EXPECT_TRUE(there) << one.name << " " << names[j];
        return there ? mean(*problem, *there) : NAN;
      };
      const double difference = (beside(h) - beside(-h)) / (2.0 * h);
      EXPECT_NEAR(rates[j].of.front().mean, difference, 1e-6 * (1e-2 + std::abs(difference)))
          << one.name << " " << names[j];
    }
  }
}

/// What comes in is lost, the tail of the chatter included: there the loaded friction bears a part of the weight.
TEST(LoadedChatter, BalancesItsEnergy) {
  for (const Beside& one : all) {
    const Cycle cycle(shaken + one.parts, {}, {});
    ASSERT_TRUE(cycle.orbit) << one.name;
    const CycleEnergy energy = cycle_energy(*cycle.problem, cycle.orbit->orbit);
    EXPECT_NEAR(energy.balance(), 0.0, 1e-10 * energy.input) << one.name;
  }
}

}  // namespace
}  // namespace slapstick::test
