/// Normal forms of cycles without forcing: the map is from just after an event to just after it a cycle later, and the
/// period is free.
#include <gtest/gtest.h>

#include "beside.hpp"
#include "flow/contact_state.hpp"
#include "orbit/record.hpp"

namespace slapstick::test {
namespace {

const std::string hammer = std::string(SLAPSTICK_ORBIT_MODELS) + "belt-hammer.toml";

/// Without forcing no instant is special: a cycle begun at another event is the same cycle.
TEST(AutonomousNormalForm, IsOfACycleThatMayBeginAnywhere) {
  const Posed posed("two-blocks-on-belt", {}, {"friction_ratio"}, {1.5});
  const auto found = posed.settled(0, 3000);
  ASSERT_TRUE(found);
  for (std::size_t leg = 0; leg < found->orbit.legs(); ++leg) {
    orbit::Orbit turned = found->orbit;
    orbit::rotate(turned, leg);
    turned.x[0] *= 1.0 + 1e-6;
    const auto again = orbit::refine(*posed.problem, turned);
    ASSERT_TRUE(again) << leg;
    EXPECT_NEAR(again->t.back(), found->cycle, 1e-10);
  }
}

/// Two blocks on a belt, sliding and sticking in turn: unstable doubled cycles live where the simple one is stable.
TEST(AutonomousNormalForm, ForetellsTheSizeOfADoubledCycle) {
  const Posed posed("two-blocks-on-belt", {}, {"friction_ratio"}, {1.5});
  const orbit::Branch branch = branch_of(posed, 1.46, 1.51);
  const orbit::SpecialPoint& point = only(branch, SpecialType::PD);
  EXPECT_EQ(sentence(point.normal_form), "subcritical");
  expect_doubled_as_foretold(posed, point, 4e-5, 1000.0);
}

/// Sliding, sticking and an impact; the doubled cycles are stable.
TEST(AutonomousNormalForm, ForetellsTheSizeOfADoubledCycleWithImpacts) {
  const Posed posed(hammer, {{"clearance", 0.8}}, {"belt_speed"}, {0.4});
  const orbit::Branch branch = branch_of(posed, 0.24, 0.45, 0.01);
  const orbit::SpecialPoint& point = only(branch, SpecialType::PD);
  EXPECT_EQ(sentence(point.normal_form), "supercritical");
  expect_doubled_as_foretold(posed, point, -1e-5, 1000.0);
}

TEST(AutonomousNormalForm, OfAFoldIsTheRateAtWhichItsMultipliersPart) {
  const Posed posed(hammer, {{"belt_speed", 0.4}}, {"clearance"}, {0.8});
  const orbit::Branch branch = branch_of(posed, 0.38, 0.81, 0.002);
  expect_parting_as_foretold(posed, branch, only(branch, SpecialType::LP));
}

/// A motion beside a cycle, seen each time it has come past the cycle's first event.
struct Returning {
  Returning(const Beside& of, double value)
      : beside(of), orbit(of.at(value)), system(of.problem.family().model(orbit.values)) {}

  /// Mean of |z|^2 over `over` cycles from the start, and from the `after`-th on, from |z| = radius, in units of what
  /// is foretold.
  [[nodiscard]] std::pair<double, double> means(double radius, long after, long over) const {
    const double foretold = std::sqrt((1.0 - std::abs(beside.multiplier(orbit))) / beside.form.value);
    const VectorXd away = 2.0 * radius * foretold * beside.direction.q.real();
    VectorXd start = orbit.x[0] + away.cwiseProduct(beside.map.sizes());
    start[0] = 0.0;  // on the stop
    Motion motion(system, flow::user_state(system, start));
    double first = 0.0, last = 0.0;
    orbit::EventReader reader(motion, 0);
    for (long k = 1; k <= after + over; ++k) {
      std::optional<orbit::Seen> seen;
      for (std::size_t leg = 0; leg < orbit.legs(); ++leg) {
        seen = reader.next(motion.time().plus(100.0));
        if (!seen || !(seen->leg == orbit.shape.legs[leg])) throw std::runtime_error("other events than the cycle's");
      }
      const double square = std::norm(beside.apart(seen->x, orbit.x[0])) / (foretold * foretold);
      if (k <= over) first += square / static_cast<double>(over);
      if (k > after) last += square / static_cast<double>(over);
    }
    return {first, last};
  }

  const Beside& beside;
  orbit::Orbit orbit;
  System system;
};

/// Before a subcritical point: motions inside the unstable torus come back to the cycle, motions outside leave.
TEST(AutonomousNormalForm, ForetellsWhereMotionsLeaveASubcriticalTorus) {
  const Posed posed(hammer, {}, {"coupling"}, {0.3});
  const orbit::Branch branch = branch_of(posed, 0.15, 0.31, 0.01);
  const orbit::SpecialPoint& point = only(branch, SpecialType::NS);
  ASSERT_TRUE(point.normal_form.coefficient) << sentence(point.normal_form);
  ASSERT_EQ(sentence(point.normal_form), "subcritical");
  std::size_t leg = 0;  // the one that begins with the impact
  const auto& legs = point.solution.orbit.shape.legs;
  while (legs[(leg + legs.size() - 1) % legs.size()].strikes.empty()) ++leg;
  const Beside beside(posed, point, leg);
  const Returning returning(beside, point.value + 1e-5);
  ASSERT_LT(std::abs(beside.multiplier(returning.orbit)), 1.0);
  const auto inside = returning.means(0.95, 4000, 500), outside = returning.means(1.05, 4000, 500);
  EXPECT_LT(inside.second, inside.first);
  EXPECT_GT(outside.second, outside.first);
  EXPECT_NEAR(inside.first, 0.95 * 0.95, 0.1);
}

}  // namespace
}  // namespace slapstick::test
