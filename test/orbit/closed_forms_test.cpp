/// Orbits that are known in closed form: impact speeds, multipliers, folds and doublings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
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

/// Period doubling where 1 + tr + r^2 = 0, tr = -2 r cos T + (1 + r) (cos(ph) - sigma) / V sin T (I5): solved here by
/// bisection.
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

/// Linear response meets the stop where its amplitude is the clearance: A = d sqrt((k - w^2)^2 + (c w)^2) (COCO's
/// impact oscillator).
TEST(ImpactOscillator, GrazesWhereItsAmplitudeIsTheClearance) {
  const Posed posed("impact-oscillator", {{"damping_ratio", 0.05}, {"omega", 1.0}, {"clearance", 1.0}}, {"cosine"},
                    {0.05});
  const auto first = posed.settled(1, 2000);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->impacts, 0);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.01, .to = 0.12});
  const orbit::SpecialPoint* graze = find(branch, orbit::SpecialType::GR);
  ASSERT_NE(graze, nullptr);
  EXPECT_NEAR(graze->value, 0.1, 1e-12);
}

/// The ball on a shaking table (I7): fold at Gamma cos t0 = n pi (1 - r) / (1 + r), doubling at the square root of both
/// squares.
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

double doubling_of_ball(double r) {
  const double fold = pi * (1.0 - r) / (1.0 + r), half = 2.0 * (1.0 + r * r) / ((1.0 + r) * (1.0 + r));
  return std::hypot(fold, half);
}

/// The doubled orbit doubles at 1.66713066 (I7.11; no closed form, computed there from the exact map).
TEST(ShakenTable, DoublesOnceMore) {
  const Posed posed("shaken-table", {{"restitution", 0.5}}, {"acceleration"}, {1.2});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::ContinuationOptions options{.from = 1.1, .to = 1.7};
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, options);
  const orbit::SpecialPoint* pd = find(branch, orbit::SpecialType::PD);
  ASSERT_NE(pd, nullptr);
  ASSERT_EQ(pd->born.size(), 1U);
  const orbit::Branch second = orbit::follow(*posed.problem, pd->born.front(), options);
  std::vector<double> values;
  for (const orbit::SpecialPoint& point : second.special)
    if (point.type == orbit::SpecialType::PD) values.push_back(point.value);
  ASSERT_EQ(values.size(), 2U);  // where it is born, and where it doubles
  EXPECT_NEAR(values[0], doubling_of_ball(0.5), 1e-9);
  EXPECT_NEAR(values[1], 1.6671306607739012, 1e-9);
}

/// d Gamma_PD / d r of the formula against the implicit derivative.
TEST(ShakenTable, SensitivityIsTheFormulasDerivative) {
  const Posed posed("shaken-table", {{"restitution", 0.5}}, {"acceleration"}, {1.2});
  const Posed both("shaken-table", {}, {"acceleration", "restitution"}, {1.2, 0.5});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 1.0, .to = 1.6});
  const double h = 1e-4;
  const auto fold = [](double r) { return pi * (1.0 - r) / (1.0 + r); };
  std::vector<orbit::SpecialPoint> special = branch.special;
  const auto pd = std::ranges::find(branch.special, orbit::SpecialType::PD, &orbit::SpecialPoint::type);
  ASSERT_NE(pd, branch.special.end());
  const orbit::Branch doubled = orbit::follow(*posed.problem, pd->born.at(0), {.from = 1.0, .to = 1.6});
  const auto birth =
      std::ranges::find(doubled.special, orbit::Occurrence::end_of_doubled, &orbit::SpecialPoint::occurrence);
  ASSERT_NE(birth, doubled.special.end());
  special.push_back(*birth);  // the same point, as the doubled orbit sees it
  for (const orbit::SpecialPoint& point : special) {
    const auto formula = point.type == orbit::SpecialType::PD ? std::function<double(double)>(doubling_of_ball)
                                                              : std::function<double(double)>(fold);
    const double exact =
        (8.0 * (formula(0.5 + h) - formula(0.5 - h)) - formula(0.5 + 2.0 * h) + formula(0.5 - 2.0 * h)) / (12.0 * h);
    EXPECT_NEAR(orbit::sensitivity(both.family, {point.value, 0.5}, point).front(), exact, 1e-6) << name(point.type);
  }
}

/// Every point of the PD and LP curves over the restitution lies on the formula.
TEST(ShakenTable, CurvesAreTheFormulas) {
  const Posed posed("shaken-table", {{"restitution", 0.5}}, {"acceleration"}, {1.2});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 1.0, .to = 1.6});
  for (orbit::SpecialPoint point : branch.special) {
    const Posed both("shaken-table", {}, {"acceleration", "restitution"}, {point.value, 0.5});
    point.solution.orbit.values = both.values;
    const orbit::Curve curve =
        orbit::locus(*both.problem, point, {.from = 0.5, .to = 3.0, .second_from = 0.3, .second_to = 0.7});
    EXPECT_FALSE(curve.failed()) << ended(curve);
    EXPECT_GT(curve.points.size(), 20U);
    for (const orbit::CurvePoint& on : curve.points) {
      const double r = on.values[1], fold = pi * (1.0 - r) / (1.0 + r);
      EXPECT_NEAR(on.values[0], point.type == orbit::SpecialType::PD ? doubling_of_ball(r) : fold, 1e-8)
          << name(point.type) << " r = " << r;
    }
  }
}

/// Den Hartog (1931): without stick x = f - f cos t + b sin t + V cos(w t + ph) on the way down, b = -f sin
/// T / (1 + cos T), sin ph = b / (V w). The motion without stick lasts until the velocity touches zero on the way.
double largest_velocity_down(double w, double f) {
  const double T = pi / w, V = 1.0 / (1.0 - w * w), b = -f * std::sin(T) / (1.0 + std::cos(T)),
               ph = std::asin(b / (V * w));
  double largest = -INFINITY;
  const auto v = [&](double t) { return f * std::sin(t) + b * std::cos(t) - V * w * std::sin(w * t + ph); };
  for (int i = 200; i < 19800; ++i) {
    const double t = T * i / 20000.0, h = T / 20000.0;
    if (v(t) < v(t - h) || v(t) < v(t + h)) continue;
    double a = t - h, c = t + h;  // golden section
    for (int k = 0; k < 100; ++k) {
      const double p = c - 0.6180339887498949 * (c - a), q = a + 0.6180339887498949 * (c - a);
      (v(p) > v(q) ? c : a) = v(p) > v(q) ? q : p;
    }
    largest = std::max(largest, v(0.5 * (a + c)));
  }
  return largest;
}

TEST(CoulombOscillator, BeginsToStickWhereDenHartogsMotionStops) {
  const Posed posed("coulomb-oscillator", {{"damping_ratio", 0.0}}, {"omega"}, {0.8});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.422, .to = 0.9});
  const orbit::SpecialPoint* last = nullptr;  // the nearest below 0.8
  for (const orbit::SpecialPoint& point : branch.special)
    if (point.type == orbit::SpecialType::SL) last = &point;
  ASSERT_NE(last, nullptr);
  double a = 0.42, b = 0.5;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (a + b);
    (largest_velocity_down(middle, 0.2) > 0.0 ? a : b) = middle;
  }
  EXPECT_NEAR(last->value, 0.5 * (a + b), 1e-9);
}

/// While friction holds the frame of stick-slip-impact, its mass grazes the stop at V^2 = 2
/// clearance / (1 + 1 / sqrt((1 - 4 omega^2)^2 + (2 c omega)^2)). There the unstable orbit with impacts, whose slips
/// after them shrink to nothing with their speed, meets the one without, whichever parameter is followed.
TEST(StickSlipImpact, GrazesWhereTheHeldFrameSays) {
  constexpr double drive = 0.9, damping = 0.04, omega = 0.92, clearance = 0.5;
  const auto response = [](double w) {
    return 1.0 + 1.0 / std::sqrt(std::pow(1.0 - 4.0 * w * w, 2) + std::pow(2.0 * damping * w, 2));
  };
  double below = 1.0, above = 1.3;  // of omega, where the response falls
  while (above - below > 1e-15) {
    const double middle = 0.5 * (below + above);
    (drive * drive * response(middle) > 2.0 * clearance ? below : above) = middle;
  }
  struct Case {
    std::string parameter;
    double start, from, to, graze;
  };
  const std::vector<Case> cases = {
      {"drive", drive, 0.6, 1.0, std::sqrt(2.0 * clearance / response(omega))},
      {"drive", 0.7, 0.6, 1.0, std::sqrt(2.0 * clearance / response(omega))},  // without impacts
      {"clearance", clearance, 0.4, 0.7, 0.5 * drive * drive * response(omega)},
      {"omega", omega, 0.8, 1.3, below}};
  for (const Case& c : cases) {
    const Posed posed("stick-slip-impact", {}, {c.parameter}, {c.start});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = c.from, .to = c.to});
    EXPECT_FALSE(branch.failed()) << c.parameter << ": " << ended(branch);
    const auto graze = std::ranges::find_if(branch.special, [&](const orbit::SpecialPoint& point) {
      return point.type == orbit::SpecialType::GR && std::abs(point.value - c.graze) < 1e-10;
    });
    ASSERT_NE(graze, branch.special.end()) << c.parameter << ": " << c.graze;
    EXPECT_NEAR(graze->value, c.graze, graze->error + 1e-15) << c.parameter;  // and the closed form's own rounding
    EXPECT_TRUE(std::ranges::any_of(branch.points, [](const orbit::Solution& point) {
      return point.label == "1-0-II";
    })) << c.parameter;
    if (c.start == 0.7) continue;  // where no leg dies
    ASSERT_TRUE(graze->death) << c.parameter;
    EXPECT_LT(graze->error, 1e-14) << c.parameter;
    if (c.parameter != "drive") continue;  // V is a root of the clearance, and neither impacts nor slips are left
    const Posed others("stick-slip-impact", {}, {"drive", "clearance", "restitution", "friction"},
                       {drive, 0.5, 0.8, 3.17});
    const auto rates = orbit::sensitivity(others.family, {graze->value, 0.5, 0.8, 3.17}, *graze);
    EXPECT_NEAR(rates[0], graze->value / (2.0 * clearance), 1e-13);
    EXPECT_NEAR(rates[1], 0.0, 1e-13);
    EXPECT_NEAR(rates[2], 0.0, 1e-13);
  }
}

}  // namespace
}  // namespace slapstick::test
