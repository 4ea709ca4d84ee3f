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
/// Together they move to both sides.
TEST(Sensitivity, ByAParameterAtItsBoundIsFromTheSideThatThereIs) {
  const double friction = load_model("vibro-impact").values({}).at("static_friction");
  const orbit::Branch branch = branch_at("vibro-impact", {}, 2.5, 2.2, 4.0);
  ASSERT_FALSE(branch.special.empty());
  const orbit::SpecialPoint& point = branch.special.front();
  const double h = 1e-4;
  const auto moved = [&](const Overrides& to) {
    return nearest(branch_at("vibro-impact", to, 2.5, 2.2, 4.0), point.type, point.value).value;
  };
  const auto rate = [&](const Overrides& fixed, const std::string& by) {
    const Posed posed("vibro-impact", fixed, {"omega", by}, {2.5, friction});
    return orbit::sensitivities(posed.family, {point.value, friction}, point, 1.8).at(0);
  };
  const Overrides kinetic = {{"kinetic_friction", friction}};
  const auto apart = [&](double by) {
    return moved({{"static_friction", friction + by}, {"kinetic_friction", friction}});
  };
  const orbit::Sensitivity alone = rate(kinetic, "static_friction");
  EXPECT_EQ(alone.known, orbit::Known::from_one_side);
  const double beside = (4.0 * apart(h) - apart(2.0 * h) - 3.0 * point.value) / (2.0 * h);
  EXPECT_NEAR(alone.value, beside, 1e-4 * std::max(1.0, std::abs(beside)));
  const orbit::Sensitivity both = rate({}, "static_friction");  // kinetic friction follows it
  EXPECT_EQ(both.known, orbit::Known::from_both_sides);
  const double across =
      (moved({{"static_friction", friction + h}}) - moved({{"static_friction", friction - h}})) / (2.0 * h);
  EXPECT_NEAR(both.value, across, 1e-4 * std::max(1.0, std::abs(across)));
}

/// A fold beside a crossing leaves no orbits at the same parameter on one side of it: the crossing is followed by
/// arclength.
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
