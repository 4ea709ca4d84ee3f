/// Coefficients of normal forms against the orbits and tori that they foretell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "beside.hpp"
#include "flow/contact_state.hpp"

namespace slapstick::test {
namespace {

TEST(NormalForm, ForetellsTheSizeOfADoubledOrbit) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.7});
  const orbit::Branch branch = branch_of(posed, 2.6, 2.9);
  const orbit::SpecialPoint& point = only(branch, SpecialType::PD);
  EXPECT_EQ(sentence(point.normal_form), "supercritical");  // the paper's 2-2-I is an attractor
  expect_doubled_as_foretold(posed, point, 4e-4);
}

/// Legs of stick, multipliers that are exactly zero.
TEST(NormalForm, ForetellsTheSizeOfADoubledOrbitThatSticks) {
  const Posed posed("vibro-impact", {{"static_friction", 0.5}, {"kinetic_friction", 0.5}, {"restitution", 0.9}},
                    {"omega"}, {4.2});
  const orbit::Branch branch = branch_of(posed, 4.1, 4.4);
  const orbit::SpecialPoint& point = only(branch, SpecialType::PD);
  ASSERT_TRUE(point.solution.sticking);
  ASSERT_EQ(point.solution.multipliers.back(), 0.0);
  expect_doubled_as_foretold(posed, point, 1e-4);
}

TEST(NormalForm, ForetellsTheSizeOfADoubledOrbitOfOneMass) {
  const Posed posed("shaken-table", {{"restitution", 0.5}}, {"acceleration"}, {1.4});
  const orbit::Branch branch = branch_of(posed, 1.3, 1.6);
  expect_doubled_as_foretold(posed, only(branch, SpecialType::PD), 4e-4);
}

/// Multiplying q by a number multiplies the coefficient by the square of its size: no trace of a normalisation is left.
TEST(NormalForm, IsHomogeneousInTheEigenvector) {
  const Posed posed("vibro-impact", {}, {"omega"}, {9.0});
  const orbit::Branch branch = branch_of(posed, 8.9, 9.6);
  const Beside beside(posed, only(branch, SpecialType::NS), 0);
  orbit::Critical longer = beside.direction;
  const Complex factor = std::polar(1.7, 0.9);
  longer.q *= factor;
  longer.p /= factor;
  const orbit::Estimate scaled = orbit::coefficient(SpecialType::NS, beside.map, longer);
  EXPECT_NEAR(scaled.value, 1.7 * 1.7 * beside.form.value, 1e-6 * std::abs(scaled.value));
  EXPECT_LT(beside.form.error, 1e-6 * std::abs(beside.form.value));
}

TEST(NormalForm, OfAFoldIsTheRateAtWhichItsMultipliersPart) {
  const Posed posed("gear-pair", {}, {"omega"}, {1.0});
  const orbit::Branch branch = branch_of(posed, 0.69, 1.05, 0.005);
  expect_parting_as_foretold(posed, branch, only(branch, SpecialType::LP));
}

/// Motions beside an orbit with an NS, seen at the phase of its map.
struct Circling {
  Circling(const Beside& of, double value)
      : beside(of),
        orbit(of.at(value)),
        centre(of.state(orbit)),
        system(of.problem.family().model(orbit.values)),
        foretold(std::sqrt((1.0 - std::abs(of.multiplier(orbit))) / of.form.value)) {}

  /// Mean of |z|^2 over some cycles of a motion that starts with |z| = radius, after some more, in units of what is
  /// foretold.
  [[nodiscard]] double mean(double radius, long after, long over) const {
    const VectorXd away = 2.0 * radius * foretold * beside.direction.q.real();
    const VectorXd start = centre + beside.problem.translations().representative(away.cwiseProduct(beside.map.sizes()));
    const double whole = std::floor(beside.map.phase()), fraction = beside.map.phase() - whole;
    Motion motion(system, flow::user_state(system, start), {static_cast<std::int64_t>(whole), fraction});
    double sum = 0.0;
    for (long k = 1; k <= after + over; ++k) {
      const Instant end{static_cast<std::int64_t>(whole) + k * orbit.shape.n, fraction};
      while (motion.advance(end) == Outcome::event) {
      }
      const Complex z = beside.apart(flow::contact_state(motion), centre);
      if (k > after) sum += std::norm(z);
    }
    return sum / static_cast<double>(over) / (foretold * foretold);
  }

  const Beside& beside;
  orbit::Orbit orbit;
  VectorXd centre;
  System system;
  double foretold;
};

/// The torus behind a supercritical point, by simulation at two distances; what is left to first order is taken out.
TEST(NormalForm, ForetellsTheRadiusOfAStableTorus) {
  const Posed posed("vibro-impact", {}, {"omega"}, {4.8});
  const orbit::Branch branch = branch_of(posed, 4.79, 4.81);
  const orbit::SpecialPoint& point = only(branch, SpecialType::NS);
  ASSERT_EQ(sentence(point.normal_form), "supercritical");
  EXPECT_NEAR(point.rotation, 0.41521, 1e-5);
  const Beside beside(
      posed, point, orbit::freest_leg(orbit::ModeSet(posed.family, point.solution.orbit.values), point.solution.orbit));
  const double away = 1e-4;
  const double far = Circling(beside, point.value + away).mean(0.7, 16'000, 8'000),
               near = Circling(beside, point.value + 0.5 * away).mean(0.7, 32'000, 8'000);
  EXPECT_NEAR(far, 1.0, 0.01);
  EXPECT_NEAR(2.0 * near - far, 1.0, 3e-4);
}

/// An unstable torus around a stable orbit, before a subcritical point: motions inside come back to the orbit, motions
/// outside leave.
TEST(NormalForm, ForetellsWhereMotionsLeaveASubcriticalTorus) {
  const Posed posed("vibro-impact", {}, {"omega"}, {9.0});
  const orbit::Branch branch = branch_of(posed, 8.9, 9.6);
  const orbit::SpecialPoint& point = only(branch, SpecialType::NS);
  ASSERT_EQ(sentence(point.normal_form), "subcritical");
  const Beside beside(
      posed, point, orbit::freest_leg(orbit::ModeSet(posed.family, point.solution.orbit.values), point.solution.orbit));
  const Circling circling(beside, point.value - 1e-4);
  EXPECT_LT(circling.mean(0.95, 5'000, 1'000), circling.mean(0.95, 0, 1'000));
  EXPECT_GT(circling.mean(1.05, 5'000, 1'000), circling.mean(1.05, 0, 1'000));
}

/// Where a mass is lost to a graze right beside a doubling the map bends within 1e-4 of its size: the step must follow.
TEST(NormalForm, SaysHowGoodItIsBesideAGraze) {
  const Posed posed("impact-oscillator", {}, {"clearance"}, {0.3});
  const orbit::Branch branch = branch_of(posed, 0.3, 1.0);
  const orbit::SpecialPoint& point = only(branch, SpecialType::PD);
  ASSERT_TRUE(point.normal_form.coefficient) << sentence(point.normal_form);
  EXPECT_LT(point.normal_form.error, 1e-3 * std::abs(*point.normal_form.coefficient));
  expect_doubled_as_foretold(posed, point, 1e-7);
}

/// Two free half swings of an orbit are equally long up to rounding: in which of them q is measured must not depend on
/// where the branch began.
TEST(NormalForm, IsTheSameFromEveryStart) {
  std::vector<double> coefficients;
  for (const double start : {7.0, 6.96, 6.9}) {
    const Posed posed(SLAPSTICK_ORBIT_MODELS "vibrating-screen.toml", {}, {"frequency"}, {start});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 6.5, .to = 8.0});
    const auto fold = std::ranges::find(branch.special, orbit::SpecialType::LP, &orbit::SpecialPoint::type);
    ASSERT_NE(fold, branch.special.end()) << ended(branch);
    coefficients.push_back(fold->normal_form.coefficient.value_or(std::nan("")));
  }
  EXPECT_GT(coefficients[0], 0.0);
  EXPECT_NEAR(coefficients[1], coefficients[0], 1e-6 * coefficients[0]);
  EXPECT_NEAR(coefficients[2], coefficients[0], 1e-6 * coefficients[0]);
}

}  // namespace
}  // namespace slapstick::test
