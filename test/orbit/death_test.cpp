/// A death and the same point from its other side, where no leg dies: two systems of equations, one place, one rate.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "families.hpp"

namespace slapstick::test {
namespace {

/// What dies, on a branch of a model that is followed from both of its ends.
struct Case {
  std::string what, model, parameter;
  double start, from, to;
  std::string other;  ///< a parameter by which the place moves
};

const Case cases[] = {
    {"a reversal's slip before a stick", "vibro-impact", "omega", 1.4, 1.3, 1.6, "mass_ratio"},
    {"the same between two stops", "spool", "frequency", 255.0, 255.0, 265.0, "mean"},
    {"a slip within a stick", "coulomb-oscillator", "omega", 0.3, 0.25, 0.3, "amplitude"},
    {"a contact of a compliant stop", "gear-pair", "omega", 1.3, 1.2, 1.6, "load"},
    {"the same in a longer cycle", "bilinear-oscillator", "clearance", 0.0, -0.36, 0.01, "omega"},
    {"a line crossed, a turn, the line crossed back", "bump-stop", "omega", 1.3, 1.15, 1.3, "amplitude"},
};

class Deaths : public testing::TestWithParam<Case> {
 protected:
  /// The branch from both of its ends: each point is come to from either side.
  [[nodiscard]] static std::vector<orbit::Branch> branches() {
    const Case& c = GetParam();
    const Posed posed(c.model, {}, {c.parameter}, {c.start});
    const auto first = posed.settled();
    if (!first) throw std::runtime_error("no orbit");
    const orbit::ContinuationOptions options{.from = c.from, .to = c.to};
    const orbit::Branch whole = orbit::follow(*posed.problem, first->orbit, options);
    return {orbit::follow(*posed.problem, whole.points.front().orbit, options),
            orbit::follow(*posed.problem, whole.points.back().orbit, options)};
  }
  [[nodiscard]] static double rate(const orbit::SpecialPoint& point) {
    const Case& c = GetParam();
    const double present = load_model(c.model).values({}).at(c.other);
    const Posed both(c.model, {}, {c.parameter, c.other}, {point.value, present});
    return orbit::sensitivity(both.family, {point.value, present}, point, c.to - c.from).at(0);
  }
  static void expect_alike(const orbit::SpecialPoint& death, const orbit::SpecialPoint& other) {
    EXPECT_LT(death.error, 1e-13 * std::abs(death.value));
    EXPECT_NEAR(death.value, other.value, death.error + other.error);
    const double exact = rate(death);
    EXPECT_NEAR(exact, rate(other), 1e-6 * std::abs(exact)) << "differences of orbits";
  }
};

TEST_P(Deaths, AreWhereTheOtherSideSaysAndMoveAsItSays) {
  const std::vector<orbit::Branch> all = branches();
  int compared = 0;
  for (const auto& [with, without] : {std::pair(&all[0], &all[1]), std::pair(&all[1], &all[0])})
    for (const orbit::SpecialPoint& death : with->special)
      for (const orbit::SpecialPoint& other : without->special) {
        if (!death.death || other.death || std::abs(other.value - death.value) > 1e-9 * std::abs(death.value)) continue;
        ++compared;
        expect_alike(death, other);
      }
  EXPECT_GT(compared, 0) << GetParam().what;
}

INSTANTIATE_TEST_SUITE_P(OfLegs, Deaths, testing::ValuesIn(cases),
                         [](const auto& info) { return "case_" + std::to_string(info.index); });

}  // namespace
}  // namespace slapstick::test
