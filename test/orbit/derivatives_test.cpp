/// The derivatives that Newton's method and the multipliers are made of, by second routes.
#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "families.hpp"
#include "orbit/path.hpp"
#include "section/return_map.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/quantity/cycle_energy.hpp"

namespace slapstick::test {
namespace {

using Eigen::VectorXd;

struct Case {
  std::string model;
  Overrides set;
  std::vector<std::string> parameters;
  std::string events;  ///< that the orbit must have, so that the case is what it is meant to be
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  out << c.model;
  for (const auto& [name, value] : c.set) out << " " << name << "=" << value;
  return out;
}

class Derivatives : public testing::TestWithParam<Case> {};

std::vector<double> present(const Case& c) {
  const auto all = load_model(c.model).values(c.set);
  std::vector<double> values;
  for (const std::string& name : c.parameters)
    values.push_back(name == "friction" ? all.at("kinetic_friction") : all.at(name));
  return values;
}

/// Multipliers of the segment form are those of the tangent flow along a motion.
TEST_P(Derivatives, MultipliersAreThoseOfTheMotion) {
  const Case& c = GetParam();
  const Posed posed(c.model, c.set, {}, {});
  if (!posed.system.model().forced()) GTEST_SKIP() << "classes count forcing periods";
  const auto solution = posed.settled();
  ASSERT_TRUE(solution);
  EXPECT_NE(describe(solution->orbit.shape, posed.system).find(c.events), std::string::npos)
      << describe(solution->orbit.shape, posed.system);
  const Classification seen = classify(posed.system, posed.start());
  ASSERT_EQ(seen.multipliers.size(), solution->multipliers.size());
  for (std::size_t i = 0; i < seen.multipliers.size(); ++i)
    EXPECT_LT(std::abs(seen.multipliers[i] - solution->multipliers[i]), 2e-7) << i;  // of double roots: half the digits
}

/// dv/dp of the solved equations, all unknowns, against orbits solved beside it: the residual alone decides those.
TEST_P(Derivatives, ByParametersAreThoseOfNeighbouringOrbits) {
  const Case& c = GetParam();
  const std::vector<double> at = present(c);
  const Posed posed(c.model, c.set, c.parameters, at);
  const auto solution = posed.settled();
  ASSERT_TRUE(solution);
  const orbit::Problem& problem = *posed.problem;
  const orbit::Orbit& orbit = solution->orbit;
  const orbit::ModeSet set(problem.family(), orbit.values);
  const orbit::Linearised linear = orbit::linearise(problem, set, orbit);
  const Eigen::Index state_columns = linear.by.cols() - problem.parameters();
  const auto solver = linear.by.leftCols(state_columns).fullPivLu();
  const VectorXd units = orbit::sizes(problem, orbit);
  for (Eigen::Index j = 0; j < problem.parameters(); ++j) {
    const VectorXd exact = -solver.solve(linear.by.col(state_columns + j));
    const auto beside = [&](double h) {
      orbit::Orbit moved = orbit;
      moved.values[static_cast<std::size_t>(j)] += h;
      const auto found = orbit::refine(problem, moved);
      EXPECT_TRUE(found) << c.parameters[static_cast<std::size_t>(j)];
      VectorXd v(state_columns);
      v.head(problem.numbers()) = problem.translations().numbers(found ? found->x[0] : moved.x[0]);
      for (std::size_t i = 0; i <= orbit.legs(); ++i) v[problem.instant_column(i)] = (found ? found->t : moved.t)[i];
      return v;
    };
    const double h = 2e-4 * std::max(0.1, std::abs(at[static_cast<std::size_t>(j)]));
    const auto difference = [&](double step) { return VectorXd((beside(step) - beside(-step)) / (2.0 * step)); };
    const VectorXd extrapolated = (64.0 * difference(0.25 * h) - 20.0 * difference(0.5 * h) + difference(h)) / 45.0;
    const VectorXd scale = units.head(state_columns);
    const double size = exact.cwiseQuotient(scale).cwiseAbs().maxCoeff();
    EXPECT_LT((exact - extrapolated).cwiseQuotient(scale).cwiseAbs().maxCoeff(), 1e-7 * std::max(1.0, size))
        << c.parameters[static_cast<std::size_t>(j)];
  }
}

const std::vector<std::string> paper = {"omega", "restitution", "friction", "clearance", "damping_ratio", "mass_ratio"};

INSTANTIATE_TEST_SUITE_P(
    Orbit, Derivatives,
    testing::Values(
        Case{"vibro-impact", {{"omega", 2.2}}, paper, "impact stop, slip+ friction"},
        Case{"vibro-impact", {{"omega", 1.5}}, paper, "stick friction, release friction"},
        Case{"impact-oscillator", {{"omega", 2.0}}, {"omega", "restitution", "clearance", "cosine"}, "impact stop"},
        Case{"coulomb-oscillator", {}, {"omega", "static_friction", "amplitude"}, "slip"},
        Case{SLAPSTICK_ORBIT_MODELS "pressed-pair.toml",
             {},
             {"omega", "preload", "press", "rate", "static_friction", "kinetic_friction", "belt_speed", "stiffness"},
             "stick pad"},
        Case{SLAPSTICK_ORBIT_MODELS "pedal.toml",
             {{"omega", 0.7}},
             {"omega", "press", "wave", "lead", "tap", "duty", "kinetic"},
             "slip- pad"},
        Case{SLAPSTICK_ORBIT_MODELS "pedal.toml",
             {{"omega", 0.45}},
             {"omega", "press", "wave", "tap", "static"},
             "stick pad"},
        Case{SLAPSTICK_ORBIT_MODELS "overrun.toml", {}, {"omega", "holds", "drag", "load", "swing"}, "slip- clutch"},
        Case{SLAPSTICK_ORBIT_MODELS "joint.toml",
             {},
             {"omega", "stiffness", "limit", "loose", "gap", "force"},
             "corner joint"},
        Case{SLAPSTICK_ORBIT_MODELS "mount.toml",
             {},
             {"omega", "stiffness", "damping", "softer", "gap", "force"},
             "impact floor"},
        Case{SLAPSTICK_ORBIT_MODELS "belt-and-pad.toml",
             {},
             {"omega", "rub", "belt_speed", "clearance", "restitution"},
             "impact pad"},
        Case{SLAPSTICK_ORBIT_MODELS "every-stop.toml",
             {},
             {"omega", "fast", "corner", "bump", "bump_damping", "grease", "edge", "outside"},
             "impact wall"},
        Case{SLAPSTICK_ORBIT_MODELS "bent.toml",
             {},
             {"omega", "corner", "force", "steep", "knee", "push", "slow", "speed", "fast"},
             "corner dry_speed"},
        Case{"drill-string", {}, {"drive_speed", "torque_fall", "fall", "string"}, "stick rock"},
        Case{"bilinear-oscillator", {}, {"omega", "stiffness_ratio", "clearance", "damping_ratio"}, "engage"}));

/// A direction that stick annihilates has the multiplier zero, not a rounding of it.
TEST(Multipliers, OfStickAreExactlyZero) {
  const Posed posed("vibro-impact", {{"omega", 1.5}}, {}, {});
  const auto solution = posed.settled();
  ASSERT_TRUE(solution);
  EXPECT_EQ(std::abs(solution->multipliers.back()), 0.0);
}

/// The period of stick-slip on a belt whose press softens the spring, and its derivatives by the parameters.
TEST(NormalForce, PeriodOfABlockThatASpringPresses) {
  const auto period = [](double mu, double v) {  // k = 1/2, preload 2, mu_s = 0.6
    const double release = 0.6 * 2.0 / (1.0 - 0.3), centre = 2.0 * mu / (1.0 - 0.5 * mu), w = std::sqrt(1.0 - 0.5 * mu);
    const double phi = std::atan(v / (w * (release - centre)));
    return (std::numbers::pi + 2.0 * phi) / w + 2.0 * (release - centre) / v;
  };
  for (const double mu : {0.3, 0.4, 0.5}) {
    const Posed posed("pressed-block", {}, {"kinetic_friction", "belt_speed"}, {mu, 0.3});
    const auto solution = posed.settled();
    ASSERT_TRUE(solution);
    EXPECT_NEAR(solution->cycle, period(mu, 0.3), 1e-13);
    const CycleEnergy energy = cycle_energy(*posed.problem, solution->orbit);
    EXPECT_GT(energy.friction[0], 0.0);
    EXPECT_LT(std::abs(energy.balance()), 1e-13 * energy.input);
  }
}

/// Friction that is pressed by another coordinate, restitution over the speed, bounded damping, zones: all balances
/// close.
TEST(Energy, OfCyclesWithEveryLawIsBalanced) {
  for (const char* file : {"pressed-pair.toml", "every-stop.toml"}) {
    const Posed posed(std::string(SLAPSTICK_ORBIT_MODELS) + file, {}, {}, {});
    const auto solution = posed.settled();
    ASSERT_TRUE(solution) << file;
    const CycleEnergy energy = cycle_energy(*posed.problem, solution->orbit);
    EXPECT_LT(std::abs(energy.balance()), 1e-12 * energy.input) << file;
  }
}

/// Energy of a cycle: what comes in goes out.
TEST(Energy, OfACycleIsBalanced) {
  for (double omega : {1.5, 2.2, 2.8}) {
    const Posed posed("vibro-impact", {{"omega", omega}}, {}, {});
    const auto solution = posed.settled();
    ASSERT_TRUE(solution);
    const CycleEnergy energy = cycle_energy(*posed.problem, solution->orbit);
    EXPECT_GT(energy.friction[0], 0.0);
    EXPECT_GT(energy.impacts[0], 0.0);
    EXPECT_LT(std::abs(energy.balance()), 1e-13 * energy.input);
  }
}

}  // namespace
}  // namespace slapstick::test
