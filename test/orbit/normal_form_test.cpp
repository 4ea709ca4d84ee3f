/// Coefficients of normal forms against the orbits and tori that they foretell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "attractor/cycle.hpp"
#include "families.hpp"
#include "orbit/normal_form.hpp"

namespace slapstick::test {
namespace {

using Eigen::VectorXd;
using orbit::SpecialType;
using Complex = std::complex<double>;

/// The branch through the orbit that the model settles on.
orbit::Branch branch_of(const Posed& posed, double from, double to, double step = 0.02) {
  const auto first = posed.settled(0, 3000);
  if (!first) throw std::runtime_error("the motion does not settle");
  return orbit::follow(*posed.problem, first->orbit, {.from = from, .to = to, .longest_step = step});
}

const orbit::SpecialPoint& only(const orbit::Branch& branch, SpecialType type) {
  const auto found = std::ranges::find_if(
      branch.special, [&](const orbit::SpecialPoint& point) { return point.type == type && !point.birth; });
  if (found == branch.special.end()) throw std::runtime_error("the branch has no such point: " + branch.ended);
  return *found;
}

/// A special point's map and direction, and its orbit at neighbouring values of the parameter.
struct Beside {
  Beside(const Posed& of, const orbit::SpecialPoint& special, std::size_t leg)
      : problem(*of.problem),
        point(special),
        map(problem, special.solution.orbit, leg),
        direction(orbit::critical(map.jacobian(VectorXd::Zero(map.sizes().size())), target())),
        form(orbit::coefficient(special.type, map, direction)) {}

  [[nodiscard]] Complex target() const {
    return point.type == SpecialType::NS ? std::polar(1.0, 2.0 * M_PI * point.rotation)
                                         : Complex(point.type == SpecialType::LP ? 1.0 : -1.0);
  }
  [[nodiscard]] orbit::Orbit at(double value) const {
    orbit::Orbit guess = map.orbit();
    guess.values[0] = value;
    const auto found = orbit::refine(problem, guess);
    if (!found) throw std::runtime_error("no orbit beside the special point");
    return *found;
  }
  /// The critical multiplier of an orbit beside the point.
  [[nodiscard]] Complex multiplier(const orbit::Orbit& orbit) const {
    const auto all = orbit::describe(problem, orbit, nullptr).multipliers;
    return *std::ranges::min_element(all, {}, [&](Complex mu) { return std::abs(mu - target()); });
  }
  [[nodiscard]] VectorXd state(const orbit::Orbit& orbit) const {  // at the map's phase
    const orbit::ModeSet set(problem.family(), orbit.values);
    return orbit::contact_state(set, orbit::state_within(set, orbit, 0, map.phase() - orbit.t[0]));
  }
  /// How far two states are apart along the critical direction.
  [[nodiscard]] Complex apart(const VectorXd& a, const VectorXd& b) const {
    return (direction.p * problem.translations().numbers(a - b).cwiseQuotient(map.sizes()))[0];
  }

  const orbit::Problem& problem;
  const orbit::SpecialPoint& point;
  orbit::FixedPhaseMap map;
  orbit::Critical direction;
  orbit::Estimate form;
};

/// s^2 of the doubled orbit so far behind a PD, divided by what the coefficient says.
double doubled_ratio(const Beside& beside, std::size_t leg, double value) {
  const orbit::Orbit& born = beside.point.born.at(0);
  const auto [from, to] = std::minmax(born.values[0], value);
  const orbit::Branch branch = orbit::follow(beside.problem, born, {.from = from, .to = to});
  orbit::Orbit first = (value == to ? branch.points.back() : branch.points.front()).orbit;
  if (first.values[0] != value) throw std::runtime_error("the doubled branch does not come there: " + branch.ended);
  orbit::rotate(first, leg);
  orbit::Orbit second = first;
  orbit::rotate(second, first.legs() / 2);
  for (orbit::Orbit* one : {&first, &second}) {
    const double cycles = std::round(one->t[0] - beside.map.orbit().t[0]);
    for (double& t : one->t) t -= cycles;
  }
  const double s = 0.5 * beside.apart(beside.state(first), beside.state(second)).real();
  const double mu = beside.multiplier(beside.at(value)).real();
  return s * s * beside.form.value / -(1.0 + mu);
}

/// Exact orbits of twice the period, at two distances: what is left to first order in the distance is taken out. Seen from legs of slip and of stick, whose
/// eigenvectors have other lengths, the coefficient foretells the same orbit.
void expect_doubled_as_foretold(const Posed& posed, const orbit::SpecialPoint& point, double away) {
  ASSERT_TRUE(point.normal_form.coefficient) << point.normal_form.what;
  EXPECT_EQ(point.normal_form.what, *point.normal_form.coefficient > 0.0 ? "supercritical" : "subcritical");
  for (std::size_t leg = 0; leg < point.solution.orbit.legs(); ++leg) {
    const Beside beside(posed, point, leg);
    const double far = doubled_ratio(beside, leg, point.value + away),
                 near = doubled_ratio(beside, leg, point.value + 0.5 * away);
    EXPECT_NEAR(far, 1.0, 0.1) << leg;
    EXPECT_NEAR(2.0 * near - far, 1.0, 1e-3) << leg;
  }
}

TEST(NormalForm, ForetellsTheSizeOfADoubledOrbit) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.7});
  const orbit::Branch branch = branch_of(posed, 2.6, 2.9);
  const orbit::SpecialPoint& point = only(branch, SpecialType::PD);
  EXPECT_EQ(point.normal_form.what, "supercritical");  // the paper's 2-2-I is an attractor
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

/// At a fold two orbits meet; their multipliers leave 1 by 2 a times how far they leave one another.
TEST(NormalForm, OfAFoldIsTheRateAtWhichItsMultipliersPart) {
  const Posed posed("gear-pair", {}, {"omega"}, {1.0});
  const orbit::Branch branch = branch_of(posed, 0.69, 1.05, 0.005);
  const orbit::SpecialPoint& point = only(branch, SpecialType::LP);
  ASSERT_TRUE(point.normal_form.coefficient) << point.normal_form.what;
  const Beside beside(posed, point, 0);
  orbit::Orbit lower = branch.points.at(point.after).orbit, upper = branch.points.at(point.after + 1).orbit;
  const double value = lower.values[0];
  upper.values[0] = value;
  const auto other = orbit::refine(*posed.problem, upper);
  ASSERT_TRUE(other);
  const double xi = std::abs(beside.apart(beside.state(lower), beside.state(*other)));
  const double part = std::abs(beside.multiplier(lower) - beside.multiplier(*other));
  ASSERT_GT(xi, 1e-4);  // they are two
  EXPECT_NEAR(part / (2.0 * beside.form.value * xi), 1.0, 2e-3);
}

/// Motions beside an orbit with an NS, seen at the phase of its map.
struct Circling {
  Circling(const Beside& of, double value)
      : beside(of),
        orbit(of.at(value)),
        centre(of.state(orbit)),
        system(of.problem.family().model(orbit.values)),
        foretold(std::sqrt((1.0 - std::abs(of.multiplier(orbit))) / of.form.value)) {}

  /// Mean of |z|^2 over some cycles of a motion that starts with |z| = radius, after some more, in units of what is foretold.
  [[nodiscard]] double mean(double radius, long after, long over) const {
    const VectorXd away = 2.0 * radius * foretold * beside.direction.q.real();
    const VectorXd start = centre + beside.problem.translations().representative(away.cwiseProduct(beside.map.sizes()));
    const double whole = std::floor(beside.map.phase()), fraction = beside.map.phase() - whole;
    Motion motion(system, attractor::user_state(system, start), {static_cast<std::int64_t>(whole), fraction});
    double sum = 0.0;
    for (long k = 1; k <= after + over; ++k) {
      const Instant end{static_cast<std::int64_t>(whole) + k * orbit.shape.n, fraction};
      while (motion.advance(end) == Outcome::event) {
      }
      const Complex z = beside.apart(attractor::contact_state(motion), centre);
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
  ASSERT_EQ(point.normal_form.what, "supercritical");
  EXPECT_NEAR(point.rotation, 0.41521, 1e-5);
  const Beside beside(
      posed, point, orbit::freest_leg(orbit::ModeSet(posed.family, point.solution.orbit.values), point.solution.orbit));
  const double away = 1e-4;
  const double far = Circling(beside, point.value + away).mean(0.7, 16'000, 8'000),
               near = Circling(beside, point.value + 0.5 * away).mean(0.7, 32'000, 8'000);
  EXPECT_NEAR(far, 1.0, 0.01);
  EXPECT_NEAR(2.0 * near - far, 1.0, 3e-4);
}

/// An unstable torus around a stable orbit, before a subcritical point: motions inside come back to the orbit, motions outside leave.
TEST(NormalForm, ForetellsWhereMotionsLeaveASubcriticalTorus) {
  const Posed posed("vibro-impact", {}, {"omega"}, {9.0});
  const orbit::Branch branch = branch_of(posed, 8.9, 9.6);
  const orbit::SpecialPoint& point = only(branch, SpecialType::NS);
  ASSERT_EQ(point.normal_form.what, "subcritical");
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
  ASSERT_TRUE(point.normal_form.coefficient) << point.normal_form.what;
  EXPECT_LT(point.normal_form.error, 1e-3 * std::abs(*point.normal_form.coefficient));
  expect_doubled_as_foretold(posed, point, 1e-7);
}

}  // namespace
}  // namespace slapstick::test
