/// Where a branch ends in an orbit of another one, and where it goes on whichever side it comes from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "families.hpp"

namespace slapstick::test {
namespace {

using orbit::Passage, orbit::SpecialType;

const orbit::SpecialPoint* at(const orbit::Branch& branch, double value) {
  const auto there = [&](const orbit::SpecialPoint& point) { return std::abs(point.value - value) < 1e-8 * value; };
  const auto found = std::ranges::find_if(branch.special, there);
  return found == branch.special.end() ? nullptr : &*found;
}

/// The shorter orbit is found by itself: the motion settles on it, and its branch touches the stop at the same place.
TEST(Branch, EndsWhereItRunsThroughAShorterOrbitThreeTimes) {
  const Posed triple(SLAPSTICK_ORBIT_MODELS "even-harmonic.toml", {}, {"fk"}, {0.5552}),
      single(SLAPSTICK_ORBIT_MODELS "even-harmonic.toml", {}, {"fk"}, {0.6});
  const auto three = triple.settled(3), one = single.settled();
  ASSERT_TRUE(three && one);
  EXPECT_EQ(one->label, "1-2-I");
  const orbit::Branch touches = orbit::follow(*single.problem, one->orbit, {.from = 0.46, .to = 0.61});
  ASSERT_EQ(touches.special.size(), 1U) << ended(touches);
  const double graze = touches.special[0].value;
  const orbit::Branch branch = orbit::follow(*triple.problem, three->orbit, {.from = 0.4, .to = 0.6});
  const orbit::SpecialPoint* point = at(branch, graze);
  ASSERT_NE(point, nullptr) << ended(branch);
  EXPECT_EQ(point->passage, Passage::merges);
  ASSERT_FALSE(point->born.empty());
  EXPECT_EQ(orbit::class_name(point->born.front()), "1-2-I");
}

/// Two equal walls: the symmetric orbit touches both, half a period apart.
/// An orbit that touches one of them ends there, as its image does.
/// The symmetric branch goes on with an impact more at each wall.
TEST(Branch, ThatBreaksASymmetryEndsAtASymmetricGraze) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "two-walls.toml", {}, {"A"}, {2.0});
  const auto symmetric = posed.settled();
  ASSERT_TRUE(symmetric);
  const orbit::ContinuationOptions options{.from = 1.0, .to = 18.0};
  std::vector<orbit::Branch> branches = {orbit::follow(*posed.problem, symmetric->orbit, options)};
  const orbit::SpecialPoint& crossing = branches[0].special.at(0);
  ASSERT_EQ(crossing.type, SpecialType::BP);
  const orbit::SpecialPoint& graze = branches[0].special.at(1);
  EXPECT_EQ(graze.passage, Passage::fold);
  EXPECT_EQ(branches[0].points.at(graze.after + 1).impacts, 4);
  std::vector<std::size_t> images;
  ASSERT_TRUE(orbit::follow_born(*posed.problem, branches, crossing.born.at(0), options, images));
  const orbit::SpecialPoint* end = at(branches[1], graze.value);
  ASSERT_NE(end, nullptr) << ended(branches[1]);
  EXPECT_EQ(end->passage, Passage::symmetric);
  EXPECT_EQ(end, &branches[1].special.back());
}

/// Without an impact a linear system's orbit is its own image, but the model with its one stop has no images.
/// The branch without impact goes on with one, back behind a fold.
TEST(Branch, OfOneStopGoesOnBehindAnOrbitThatIsItsOwnImage) {
  const double omega = 0.5, graze = std::hypot(1.0 - omega * omega, 0.04 * omega);
  const Posed posed("impact-oscillator",
                    {{"omega", omega}, {"damping_ratio", 0.02}, {"restitution", 0.9}, {"clearance", 1.0}}, {"cosine"},
                    {1.0036 * graze});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.96 * graze, .to = 1.03 * graze});
  const orbit::SpecialPoint* point = at(branch, graze);
  ASSERT_NE(point, nullptr) << ended(branch);
  EXPECT_EQ(point->passage, Passage::fold);
  EXPECT_EQ(branch.points.front().label, "1-0-I");
}

/// An orbit without impact that comes to touch the stop is linear: its multipliers there are exp(lambda T).
/// Range and steps do not matter.
TEST(Branch, HasAtATouchTheMultipliersOfTheOrbitThere) {
  constexpr double damping = 0.1;
  const Posed posed("impact-oscillator", {{"damping_ratio", damping}, {"clearance", 2.0}}, {"omega"}, {1.6});
  const auto first = posed.settled();
  ASSERT_TRUE(first && first->impacts == 0);
  for (const double from : {1.1, 1.15}) {
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = from, .to = 2.0});
    const auto touches = [](const orbit::SpecialPoint& point) { return point.type == SpecialType::GR; };
    const auto graze = std::ranges::find_if(branch.special, touches);
    ASSERT_NE(graze, branch.special.end()) << ended(branch);
    const double omega = graze->value, x = std::hypot(1.0 - omega * omega, 2.0 * damping * omega);
    EXPECT_NEAR(2.0 * x, 1.0, 1e-9);
    const std::complex<double> lambda(-damping, std::sqrt(1.0 - damping * damping));
    ASSERT_EQ(graze->solution.multipliers.size(), 2U);
    const std::complex<double> found = graze->solution.multipliers[0],
                               expected = std::exp(lambda * 2.0 * std::numbers::pi / omega);
    EXPECT_NEAR(found.real(), expected.real(), 1e-9);
    EXPECT_NEAR(std::abs(found.imag()), std::abs(expected.imag()), 1e-9);
  }
}

/// An impact of no speed at a stop whose pair has a damper of two rates is the passage of the damper's corner.
TEST(Change, OfAnImpactIntoTheCornerOfADamperIsTheSameFromBothSides) {
  const std::string model = SLAPSTICK_ORBIT_MODELS "shock-absorber.toml";
  const orbit::ContinuationOptions options{.from = 2.1, .to = 5.0};
  const Posed below(model, {}, {"omega"}, {2.2}), above(model, {}, {"omega"}, {4.9});
  orbit::OrbitChoice without_impact;
  without_impact.n = 1;
  without_impact.p = 0;
  const auto first = below.settled(),
             last = orbit::choose(*above.problem, above.system, above.start(), without_impact).orbit;
  ASSERT_TRUE(first && last);
  const orbit::Branch up = orbit::follow(*below.problem, first->orbit, options),
                      down = orbit::follow(*above.problem, last->orbit, options);
  const auto graze = [](const orbit::Branch& branch) {
    return *std::ranges::find(branch.special, SpecialType::GR, &orbit::SpecialPoint::type);
  };
  EXPECT_NEAR(graze(up).value, graze(down).value, 1e-9) << ended(up) << "; " << ended(down);
  EXPECT_EQ(graze(up).passage, Passage::persistence);
  EXPECT_EQ(graze(down).passage, Passage::persistence);
}

/// Static friction above the kinetic one makes a stick that begins at a touch of finite length: a jump.
/// An unstable orbit near by is there on both sides, and is no orbit that begins there.
TEST(Change, IntoAStickOfFiniteLengthIsAJump) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "gear-clutch.toml", {{"T", 200.0}}, {"rpm"}, {2420.0});
  const auto first = posed.settled(1, 5000);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 2400.0, .to = 2500.0});
  const orbit::SpecialPoint* point = at(branch, 2432.54844287);
  ASSERT_NE(point, nullptr) << ended(branch);
  EXPECT_EQ(point->type, SpecialType::SL);
  EXPECT_EQ(point->passage, Passage::jump);
}

/// Two events that change places, whichever of them comes from behind.
TEST(Change, HasTheSameNameFromBothSidesWhereTwoEventsMeet) {
  for (const double start : {2.15, 2.2}) {
    const Posed posed(SLAPSTICK_ORBIT_MODELS "rubbing-corners.toml", {}, {"omega"}, {start});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 2.14, .to = 2.21});
    const orbit::SpecialPoint* meeting = at(branch, 2.18243639905);
    const orbit::SpecialPoint* touch = at(branch, 2.1873998498);
    ASSERT_TRUE(meeting && touch) << ended(branch);
    EXPECT_EQ(meeting->type, SpecialType::CO) << start;
    EXPECT_EQ(touch->type, SpecialType::GR) << start;
  }
}

}  // namespace
}  // namespace slapstick::test
