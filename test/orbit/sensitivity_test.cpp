/// Sensitivities of special points where one side is missing or a fold is next to the point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"

namespace slapstick::test {
namespace {

using orbit::SpecialType;

/// A branch's point of a type nearest to a value.
const orbit::SpecialPoint& nearest(const orbit::Branch& branch, SpecialType type, double value) {
  const orbit::SpecialPoint* best = nullptr;
  for (const orbit::SpecialPoint& point : branch.special)
    if (point.type == type && (best == nullptr || std::abs(point.value - value) < std::abs(best->value - value)))
      best = &point;
  if (best == nullptr) throw std::runtime_error("the branch has no such point");
  return *best;
}

orbit::Branch branch_at(const std::string& model, const Overrides& fixed, double at, double from, double to) {
  const Posed posed(model, fixed, {"omega"}, {at});
  const auto first = posed.settled(0, 3000);
  if (!first) throw std::runtime_error("no orbit");
  return orbit::follow(*posed.problem, first->orbit, {.from = from, .to = to});
}

/// Static friction cannot be less than kinetic friction: where they are equal there is a model to one side only.
TEST(Sensitivity, ByAParameterAtItsBoundIsFromTheSideThatThereIs) {
  const orbit::Branch branch = branch_at("vibro-impact", {}, 2.5, 2.2, 4.0);
  const orbit::SpecialPoint& point = branch.special.front();
  ASSERT_FALSE(branch.special.empty());
  const Posed posed("vibro-impact", {}, {"omega", "static_friction"},
                    {2.5, load_model("vibro-impact").values({}).at("static_friction")});
  const auto rates = orbit::sensitivities(posed.family, {point.value, posed.values[1]}, point, 1.8);
  ASSERT_EQ(rates.size(), 1U);
  EXPECT_EQ(rates[0].known, orbit::Known::from_one_side);
  const double h = 1e-4;
  const auto moved = [&](double by) {
    const orbit::Branch other = branch_at("vibro-impact", {{"static_friction", posed.values[1] + by}}, 2.5, 2.2, 4.0);
    return nearest(other, point.type, point.value).value;
  };
  const double beside = (4.0 * moved(h) - moved(2.0 * h) - 3.0 * point.value) / (2.0 * h);
  EXPECT_NEAR(rates[0].value, beside, 1e-4 * std::max(1.0, std::abs(beside)));
}

/// A fold beside a crossing leaves no orbits at the same parameter on one side of it: the crossing is followed by arclength.
TEST(Sensitivity, OfACrossingNextToAFoldIsKnown) {
  const orbit::Branch branch = branch_at("impact-absorber", {}, 0.9, 0.88, 0.92);
  const orbit::SpecialPoint& point = nearest(branch, SpecialType::BP, 0.9031889677889662);
  ASSERT_NEAR(point.value, 0.9031889677889662, 1e-9);
  const double r = load_model("impact-absorber").values({}).at("restitution");
  const Posed both("impact-absorber", {}, {"omega", "restitution"}, {0.9, r});
  const auto rates = orbit::sensitivities(both.family, {point.value, r}, point, 0.04);
  EXPECT_EQ(rates.at(0).known, orbit::Known::from_both_sides);
  EXPECT_NEAR(rates.at(0).value, 0.03096608, 1e-7);  // central differences of whole branches, by an independent search
}

}  // namespace
}  // namespace slapstick::test
