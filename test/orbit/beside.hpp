#pragma once
/// Orbits beside a special point, against what its normal form foretells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "continuation/normal_form.hpp"
#include "families.hpp"

namespace slapstick::test {

using Eigen::VectorXd;
using orbit::SpecialType;
using Complex = std::complex<double>;

/// The branch through the orbit that the model settles on.
inline orbit::Branch branch_of(const Posed& posed, double from, double to, double step = 0.02) {
  const auto first = posed.settled(0, 3000);
  if (!first) throw std::runtime_error("the motion does not settle");
  return orbit::follow(*posed.problem, first->orbit, {.from = from, .to = to, .longest_step = step});
}

inline const orbit::SpecialPoint& only(const orbit::Branch& branch, SpecialType type) {
  const auto found = std::ranges::find_if(branch.special, [&](const orbit::SpecialPoint& point) {
    return point.type == type && point.occurrence != orbit::Occurrence::end_of_doubled;
  });
  if (found == branch.special.end()) throw std::runtime_error("the branch has no such point: " + ended(branch));
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
    guess.parameter() = value;
    const auto found = orbit::refine(problem, guess);
    if (!found) throw std::runtime_error("no orbit beside the special point");
    return *found;
  }
  /// The critical multiplier of an orbit beside the point.
  [[nodiscard]] Complex multiplier(const orbit::Orbit& orbit) const {
    const auto all = orbit::describe(problem, orbit, nullptr).multipliers;
    return *std::ranges::min_element(all, {}, [&](Complex mu) { return std::abs(mu - target()); });
  }
  [[nodiscard]] VectorXd state(const orbit::Orbit& orbit) const {  // at the map's phase; without forcing at its start
    if (orbit.shape.n == 0) return orbit.x[0];
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

/// A branch's orbit at a value of the parameter.
inline orbit::Orbit orbit_at(const orbit::Problem& problem, const orbit::Branch& branch, double value) {
  for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) {
    const orbit::Orbit &a = branch.points[i].orbit, &b = branch.points[i + 1].orbit;
    const double part = (value - a.parameter()) / (b.parameter() - a.parameter());
    if (!(part >= 0.0 && part <= 1.0) || !(a.shape.legs == b.shape.legs)) continue;
    orbit::Orbit guess = a;
    guess.parameter() = value;
    for (std::size_t k = 0; k < a.legs(); ++k) guess.x[k] += part * (b.x[k] - a.x[k]);
    for (std::size_t k = 0; k <= a.legs(); ++k) guess.t[k] += part * (b.t[k] - a.t[k]);
    if (const auto found = orbit::refine(problem, guess)) return *found;
  }
  throw std::runtime_error("the branch does not come there: " + ended(branch));
}

/// s^2 of the doubled orbit so far behind a PD, divided by what the coefficient says.
/// @param wider  the branch is followed on by this many times that distance: so near its birth, arclength must measure
/// the orbit, not the parameter
inline double doubled_ratio(const Beside& beside, std::size_t leg, double value, double wider) {
  const orbit::Orbit& born = beside.point.born.at(0);
  const double end = value + wider * (value - beside.point.value);
  const double from = std::min(born.parameter(), end), to = std::max(born.parameter(), end);
  orbit::Orbit first = orbit_at(beside.problem, orbit::follow(beside.problem, born, {.from = from, .to = to}), value);
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

/// Exact orbits of twice the period, at two distances: what is left to first order in the distance is taken out. Seen
/// from legs of slip and of stick, whose eigenvectors have other lengths, the coefficient foretells the same orbit.
inline void expect_doubled_as_foretold(const Posed& posed, const orbit::SpecialPoint& point, double away,
                                       double wider = 0.0) {
  ASSERT_TRUE(point.normal_form.coefficient) << sentence(point.normal_form);
  EXPECT_EQ(sentence(point.normal_form), *point.normal_form.coefficient > 0.0 ? "supercritical" : "subcritical");
  for (std::size_t leg = 0; leg < point.solution.orbit.legs(); ++leg) {
    const Beside beside(posed, point, leg);
    const double far = doubled_ratio(beside, leg, point.value + away, wider),
                 near = doubled_ratio(beside, leg, point.value + 0.5 * away, wider);
    EXPECT_NEAR(far, 1.0, 0.1) << leg;
    EXPECT_NEAR(2.0 * near - far, 1.0, 1e-3) << leg;
  }
}

/// At a fold two orbits meet; their multipliers leave 1 by 2 a times how far they leave one another.
inline void expect_parting_as_foretold(const Posed& posed, const orbit::Branch& branch,
                                       const orbit::SpecialPoint& point) {
  ASSERT_TRUE(point.normal_form.coefficient) << sentence(point.normal_form);
  const Beside beside(posed, point, 0);
  // Of the orbits beside the fold, nearer ones: the distance of the two is that of the parameter's root.
  constexpr double nearer = 0.25;
  const orbit::Orbit& fold = point.solution.orbit;
  const double value =
      fold.parameter() + nearer * nearer * (branch.points.at(point.after).orbit.parameter() - fold.parameter());
  const auto towards = [&](std::size_t index) {
    orbit::Orbit orbit = branch.points.at(index).orbit;
    for (std::size_t i = 0; i < orbit.legs(); ++i) orbit.x[i] = fold.x[i] + nearer * (orbit.x[i] - fold.x[i]);
    for (std::size_t i = 0; i < orbit.t.size(); ++i) orbit.t[i] = fold.t[i] + nearer * (orbit.t[i] - fold.t[i]);
    orbit.parameter() = value;
    return orbit::refine(*posed.problem, orbit);
  };
  const auto lower = towards(point.after), upper = towards(point.after + 1);
  ASSERT_TRUE(lower && upper);
  const double xi = std::abs(beside.apart(beside.state(*lower), beside.state(*upper)));
  const double part = std::abs(beside.multiplier(*lower) - beside.multiplier(*upper));
  ASSERT_GT(xi, 1e-4);  // the orbits are two
  EXPECT_NEAR(part / (2.0 * beside.form.value * xi), 1.0, 2e-3);
}

}  // namespace slapstick::test
