/// Orbits that are known in closed form: impact speeds, multipliers, folds and doublings.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "families.hpp"

namespace slapstick::test {
namespace {

using std::numbers::pi;

const orbit::SpecialPoint* find(const orbit::Branch& branch, orbit::SpecialType type) {
  for (const orbit::SpecialPoint& point : branch.special)
    if (point.type == type) return &point;
  return nullptr;
}

/// x'' + x = cos(w t), x <= sigma: the 1-1 orbit is an ellipse (Shaw and Holmes 1983; cases.json I4).
TEST(ImpactOscillator, OneImpactOrbitHasTheSpeedOfItsEllipse) {
  const Posed posed("impact-oscillator", {{"damping_ratio", 0.0}, {"omega", 2.0}}, {}, {});
  const auto found = posed.settled();
  ASSERT_TRUE(found);
  const auto events = orbit::events(*posed.problem, found->orbit);
  ASSERT_EQ(events.size(), 1U);
  const double speed = 2.0 * 2.0 / (1.0 - 0.8) / 3.0;  // (2 w / (1 - r)) / |1 - w^2|, sigma = 0
  EXPECT_NEAR(events[0].w, speed, 1e-12 * speed);
  for (const auto& multiplier : found->multipliers) EXPECT_NEAR(std::abs(multiplier), 0.8, 1e-12);
}

/// Period doubling where 1 + tr + r^2 = 0, tr = -2 r cos T + (1 + r) (cos(ph) - sigma) / V sin T (I5): solved here by bisection.
double doubling_frequency(double r) {
  const auto f = [&](double w) {
    const double T = 2.0 * pi / w, c = (1.0 + r) / 2.0 / std::tan(pi / w), e = (1.0 - r) / (2.0 * w);
    const double V = 1.0 / std::abs(1.0 - w * w) / std::hypot(c, e);  // sigma = 0
    const double a0 = c * V * (1.0 - w * w);                          // cos(ph)
    const double trace = -2.0 * r * std::cos(T) + (1.0 + r) * a0 / V * std::sin(T);
    return 1.0 + trace + r * r;
  };
  double a = 2.5, b = 2.8;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (a + b);
    ((f(a) > 0.0) == (f(middle) > 0.0) ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

TEST(ImpactOscillator, DoublesWhereTheTraceSaysSo) {
  const Posed posed("impact-oscillator", {{"damping_ratio", 0.0}}, {"omega"}, {2.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 2.1, .to = 2.7});
  const orbit::SpecialPoint* pd = find(branch, orbit::SpecialType::PD);
  ASSERT_NE(pd, nullptr);
  EXPECT_NEAR(pd->value, doubling_frequency(0.8), 1e-10);
  EXPECT_NEAR(pd->value, 2.653347727855323, 1e-10);  // I5.01
}

/// Linear response meets the stop where its amplitude is the clearance: A = d sqrt((k - w^2)^2 + (c w)^2) (COCO's impact oscillator).
TEST(ImpactOscillator, GrazesWhereItsAmplitudeIsTheClearance) {
  const Posed posed("impact-oscillator", {{"damping_ratio", 0.05}, {"omega", 1.0}, {"clearance", 1.0}}, {"cosine"}, {0.05});
  const auto first = posed.settled(1, 2000);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->impacts, 0);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.01, .to = 0.12});
  const orbit::SpecialPoint* graze = find(branch, orbit::SpecialType::GR);
  ASSERT_NE(graze, nullptr);
  EXPECT_NEAR(graze->value, 0.1, 1e-12);
}

/// The ball on a shaking table (I7): fold at Gamma cos t0 = n pi (1 - r) / (1 + r), doubling at the square root of both squares.
TEST(ShakenTable, FoldsAndDoublesAsTheExactMap) {
  const double r = 0.5, fold = pi * (1.0 - r) / (1.0 + r), half = 2.0 * (1.0 + r * r) / ((1.0 + r) * (1.0 + r));
  const Posed posed("shaken-table", {{"restitution", r}}, {"acceleration"}, {1.2});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 1.0, .to = 1.6});
  const orbit::SpecialPoint* lp = find(branch, orbit::SpecialType::LP);
  const orbit::SpecialPoint* pd = find(branch, orbit::SpecialType::PD);
  ASSERT_NE(lp, nullptr);
  ASSERT_NE(pd, nullptr);
  EXPECT_NEAR(lp->value, fold, 1e-10);
  EXPECT_NEAR(pd->value, std::hypot(fold, half), 1e-10);
}

}  // namespace
}  // namespace slapstick::test
