/// Where orbits die out, grow without bound, change in several places together, or jump.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "families.hpp"

namespace slapstick::test {
namespace {

using orbit::CurveEnd, orbit::Jump, orbit::Occurrence, orbit::Passage, orbit::Sliding, orbit::SpecialType;

const orbit::SpecialPoint* find_near(const orbit::Branch& branch, SpecialType type, double near, double within) {
  for (const orbit::SpecialPoint& point : branch.special)
    if (point.type == type && std::abs(point.value - near) < within) return &point;
  return nullptr;
}

/// A mass on dry ground that is pushed with an amplitude below friction stays where it is. From above, slips shrink to
/// nothing like a square root, and the equations become singular before they are gone; steps fall elsewhere from each
/// start.
TEST(DyingMotion, EndsWhereTheForceIsFriction) {
  const Posed both("coulomb-oscillator", {}, {"amplitude", "static_friction", "omega"}, {1.0, 0.2, 0.8});
  struct Case {
    double start, from, to;
  };
  for (const Case& c : {Case{1.0, 0.05, 1.0}, Case{0.25, 0.05, 1.0}, Case{0.22, 0.15, 0.25}, Case{0.3622, 0.19, 0.7},
                        Case{0.598, 0.1, 1.0}}) {
    const Posed posed("coulomb-oscillator", {}, {"amplitude"}, {c.start});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = c.from, .to = c.to});
    EXPECT_FALSE(branch.failed()) << ended(branch);
    const orbit::SpecialPoint* death = find_near(branch, SpecialType::SL, 0.2, 1e-3);
    ASSERT_NE(death, nullptr) << c.start;
    EXPECT_NEAR(death->value, 0.2, death->error) << c.start;
    EXPECT_LT(death->error, 2e-15) << c.start;  // some roundings of the holding force, whose rate by the amplitude is 1
    const std::vector<double> rates =
        orbit::sensitivity(both.family, {death->value, 0.2, 0.8}, *death);  // the amplitude is static friction's
    EXPECT_NEAR(rates[0], 1.0, 1e-13) << c.start;
    EXPECT_NEAR(rates[1], 0.0, 1e-13) << c.start;
    EXPECT_EQ(death->passage, Passage::family);
    EXPECT_GT(branch.points.front().orbit.parameter(), 0.2);
    for (const orbit::Solution& point : branch.points) EXPECT_TRUE(point.isolated()) << point.orbit.parameter();
  }
}

/// Where the model ends before the motion dies nothing is known of a death.
TEST(DyingMotion, IsNotSaidToEndWhereThereIsNoModel) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "edge-before-death.toml", {}, {"amplitude"}, {0.22});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.15, .to = 0.25});
  EXPECT_EQ(branch.down.kind, orbit::BranchEnd::Kind::no_model) << ended(branch);
  EXPECT_EQ(find_near(branch, SpecialType::SL, 0.2, 1e-3), nullptr);
  EXPECT_GT(branch.points.front().orbit.parameter(), 0.2002);
}

/// Where static friction rises above kinetic friction slips keep some length, and die in a jump where the force no more
/// comes to static friction. Stuck masses are off the middle by the square of what parts the two frictions: the place
/// is static friction's all the same, to that side.
TEST(DyingMotion, MovesWithStaticFrictionAlone) {
  const auto place = [](double static_friction) {
    const Posed posed("coulomb-oscillator", {{"static_friction", static_friction}, {"kinetic_friction", 0.2}},
                      {"amplitude"}, {0.3});
    const auto first = posed.settled();
    if (!first) throw std::runtime_error("no orbit");
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.1999, .to = 0.31});
    const orbit::SpecialPoint* death = find_near(branch, SpecialType::SL, static_friction, 1e-4);
    if (death == nullptr) throw std::runtime_error("no death");
    return *death;
  };
  const Posed apart("coulomb-oscillator", {}, {"amplitude", "static_friction", "kinetic_friction"}, {0.3, 0.2, 0.2});
  const orbit::SpecialPoint death = place(0.2);
  const auto rates = orbit::sensitivities(apart.family, {death.value, 0.2, 0.2}, death);
  EXPECT_NEAR(rates[0].value, 1.0, 1e-13);
  EXPECT_NEAR(rates[1].value, 0.0, 1e-13);
  EXPECT_EQ(rates[0].known, orbit::Known::from_one_side);
  EXPECT_EQ(rates[1].known, orbit::Known::from_one_side);
  const auto slope = [&](double h) { return (place(0.2 + h).value - death.value) / h; };
  EXPECT_NEAR(2.0 * slope(5e-4) - slope(1e-3), rates[0].value, 1e-4);
  const Posed other("coulomb-oscillator", {{"omega", 1.04115}, {"static_friction", 0.741426}}, {"amplitude"}, {0.811});
  const Posed both("coulomb-oscillator", {{"omega", 1.04115}}, {"amplitude", "static_friction"}, {0.811, 0.741426});
  const auto second = other.settled();
  ASSERT_TRUE(second);
  const orbit::Branch again = orbit::follow(*other.problem, second->orbit, {.from = 0.53, .to = 0.84344});
  const orbit::SpecialPoint* same = find_near(again, SpecialType::SL, 0.741426, 1e-6);
  ASSERT_NE(same, nullptr);
  EXPECT_NEAR(same->value, 0.741426, same->error);
  EXPECT_NEAR(orbit::sensitivity(both.family, {same->value, 0.741426}, *same).front(), 1.0, 1e-13);
}

/// A hammer that only just reaches its tool, which dry friction holds anywhere in an interval: behind the graze it is
/// one of a family. Blows ever weaker leave the tool where its spring's force is friction, so that the hammer's
/// amplitude is the gap and that displacement.
TEST(DyingMotion, OfAnImpactLeavesAHeldToolAnywhere) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", {{"gap", 0.004}, {"ratio", 1.0}}, {"frequency"},
                    {21.5});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 21.4, .to = 23.2});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  const auto graze = std::ranges::find(branch.special, SpecialType::GR, &orbit::SpecialPoint::type);
  ASSERT_NE(graze, branch.special.end()) << ended(branch);
  EXPECT_EQ(graze->passage, Passage::family);
  const double omega = 2.0 * std::numbers::pi * graze->value;
  const double amplitude = 120.0 / std::hypot(6000.0 - 1.5 * omega * omega, 12.0 * omega);
  EXPECT_NEAR(amplitude, 0.004 + 30.0 / 40000.0, 1e-16);  // some roundings of its size
  EXPECT_LT(graze->error, 1e-12);
  const Posed both(SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", {{"ratio", 1.0}}, {"frequency", "gap", "kinetic", "e"},
                   {graze->value, 0.004, 30.0, 0.5});
  const auto rates = orbit::sensitivity(both.family, {graze->value, 0.004, 30.0, 0.5}, *graze);
  const double d = 6000.0 - 1.5 * omega * omega;  // amplitude = 120 / hypot(d, 12 omega)
  const double by_frequency =
      -amplitude / (d * d + 144.0 * omega * omega) * (144.0 - 3.0 * d) * omega * 2.0 * std::numbers::pi;
  EXPECT_NEAR(rates[0] * by_frequency, 1.0, 1e-11);
  EXPECT_NEAR(rates[1] * by_frequency, 1.0 / 40000.0, 1e-15);
  EXPECT_NEAR(rates[2], 0.0, 1e-11);
}

/// As kinetic friction comes to static friction a stick-slip cycle on two belts shrinks to nothing, and its margins to
/// rounding: no change there, at the end of what the model admits, is one.
TEST(DyingMotion, AtTheEndOfTheRangeIsTheEndOfTheRange) {
  const Posed posed("two-blocks-on-belt", {}, {"kinetic_friction"}, {0.8});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.7, .to = 1.0});
  EXPECT_EQ(ended(branch).substr(ended(branch).find("up")), "up: range");
  EXPECT_EQ(find_near(branch, SpecialType::SL, 1.0, 1e-5), nullptr);
}

/// Without damping the response grows without bound as the frequency comes to the natural one. Steps that are parts of
/// the orbit's size never end.
TEST(GrowingMotion, EndsAtResonance) {
  const Posed posed("coulomb-oscillator", {}, {"omega"}, {0.8});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch =
      orbit::follow(*posed.problem, first->orbit, {.from = 0.6, .to = 1.5, .most_points = 2000});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  EXPECT_NE(ended(branch).find("grows without bound as omega nears"), std::string::npos) << ended(branch);
  EXPECT_NEAR(branch.points.back().orbit.parameter(), 1.0, 1e-5);
}

/// Both half periods of a symmetric orbit change at one value of the parameter, where besides a multiplier is 1. There
/// a slip lasts one natural period: its free part comes back to itself, so that release and stop are mirror images if
/// the forced part's velocity is the same at both. With the force cos(theta) that is theta = pi / 2 - pi omega at
/// release, displacement cos(theta) / (1 - omega^2). The holding force there is friction if omega^2 sin(pi
/// omega) / (1 - omega^2) = friction.
TEST(SymmetricChange, IsPassedFromBothSides) {
  const auto excess = [](double omega) {
    return omega * omega * std::sin(std::numbers::pi * omega) / (1.0 - omega * omega) - 0.2;
  };
  double below = 0.4, above = 0.43;
  while (above - below > 1e-15) {
    const double middle = 0.5 * (below + above);
    (excess(middle) < 0.0 ? below : above) = middle;
  }
  for (const double start : {0.4, 0.45}) {
    const Posed posed("coulomb-oscillator", {}, {"omega"}, {start});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.35, .to = 0.48});
    EXPECT_FALSE(branch.failed()) << ended(branch);
    EXPECT_EQ(branch.special.size(), 2U);
    const orbit::SpecialPoint* change = find_near(branch, SpecialType::SL, below, 2e-10);
    ASSERT_NE(change, nullptr) << start;
    EXPECT_EQ(change->death.has_value(), start > below) << start;  // where legs die, and where they are born
    if (start > below) {
      EXPECT_NEAR(change->value, below, change->error + 1e-15);  // and the bisection's last interval
    }
    EXPECT_NE(find_near(branch, SpecialType::SL, 0.428345977046, 1e-11), nullptr) << start;
  }
}

/// Static friction above kinetic friction: a velocity that comes to zero is held. No orbit begins where an unstable one
/// comes to that.
TEST(Discontinuity, IsAJump) {
  const Posed posed("two-blocks-on-belt", {}, {"belt_speed"}, {0.1});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.095, .to = 1.0});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  const orbit::SpecialPoint* jump = find_near(branch, SpecialType::SL, 0.12578768958, 1e-9);
  ASSERT_NE(jump, nullptr) << ended(branch);
  ASSERT_TRUE(jump->jump);
  EXPECT_EQ(jump->jump->kind, Jump::Kind::departs);
  EXPECT_FALSE(branch.points.back().stable());
  EXPECT_LT(branch.points.size(), 300U) << "without forcing instants are measured by the cycle";
}

/// A damper of exactly zero makes other guards than one beside it.
TEST(EdgeOfAModel, IsNoEndOfABranch) {
  const Posed posed("bilinear-oscillator", {}, {"contact_damping"}, {0.0});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.0, .to = 1.0});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  EXPECT_NE(find_near(branch, SpecialType::PD, 0.077614611, 1e-8), nullptr);
}

/// Where static friction exceeds kinetic friction, an unstable orbit ends where a reversal would stick, where a stick
/// would let go, and where a stick is missed: it is said to be a jump, not a failure of the search.
TEST(Jump, OfAnUnstableOrbitIsTold) {
  struct Case {
    const char* model;
    Overrides values;
    const char* parameter;
    double start, from, to;
    std::size_t jumps;
  };
  const Overrides belts = {{"belt_speed", 0.08853344821736771},
                           {"coupling", 1.1330223939008},
                           {"kinetic_friction", 0.6273306109798724},
                           {"static_friction", 1.169402214178631}};
  for (const Case& c :
       {Case{SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", {{"gap", 0.004}}, "frequency", 22.3, 22.25, 22.6, 1},
        Case{"two-blocks-on-belt", belts, "friction_ratio", 1.4074746946586065, 0.469, 4.222, 2}}) {
    const Posed posed(c.model, c.values, {c.parameter}, {c.start});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = c.from, .to = c.to});
    EXPECT_FALSE(branch.failed()) << ended(branch);
    const auto jumps = std::ranges::count(branch.special, Passage::jump, &orbit::SpecialPoint::passage);
    EXPECT_EQ(static_cast<std::size_t>(jumps), c.jumps) << ended(branch);
  }
}

/// A stable orbit that ends leaves the motion near by, in another sequence or with other periods: the table says on
/// what it settles, as `classify` does from its state just behind.
TEST(Jump, OfAStableOrbitSaysWhereTo) {
  struct Case {
    double preload, start;
    std::vector<std::pair<double, const char*>> jumps;
  };
  for (const Case& c : {Case{150.0, 9.0, {{7.3382725387, "2-4-II"}, {9.2354849281, "1-1-II"}}},
                        Case{150.0, 6.7, {{6.3867752888, "2-2-II"}, {6.7735538127, "3-3-II"}}},
                        Case{100.0, 8.0, {{6.8995088154, "8-16-II"}, {9.7191269489, "1-1-II"}}}}) {
    const Posed posed(SLAPSTICK_ORBIT_MODELS "vibrating-screen.toml", {{"preload", c.preload}}, {"frequency"},
                      {c.start});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 4.0, .to = 25.0});
    EXPECT_FALSE(branch.failed()) << ended(branch);
    for (const auto& [value, label] : c.jumps) {
      const orbit::SpecialPoint* jump = find_near(branch, SpecialType::SL, value, 1e-9);
      ASSERT_NE(jump, nullptr) << value << ' ' << ended(branch);
      ASSERT_TRUE(jump->jump);
      EXPECT_EQ(jump->jump->label, label) << value;
    }
  }
}

}  // namespace
}  // namespace slapstick::test
