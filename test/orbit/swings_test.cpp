/// Small swings within large ones: sliders that begin and cease to slip in several places of a cycle, and together.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "followed.hpp"

namespace slapstick::test {
namespace {

/// A mass on a spring and a damper, with two sliders and a force of two harmonics: small swings within large ones.
struct Swings {
  double omega = 0.7, damping = 0.1, force = 0.5;
  int harmonic = 3;
  double k_a = 0.5, f_a = 0.025, k_b = 0.5, f_b = 0.025;
  std::string pad = {};  ///< [[friction]] or nothing

  [[nodiscard]] ModelDefinition definition() const {
    const auto number = [](double value) { return std::to_string(value); };
    const auto slider = [&](const std::string& name, double k, double limit) {
      return "[[jenkins]]\nname = '" + name + "'\nbetween = ['x', 'ground']\nstiffness = " + number(k) +
             "\nlimit = " + number(limit) + "\n";
    };
    return ModelDefinition::parse(
        "name = 'm'\nomega = " + number(omega) + "\n[parameters]\nsmall = 1\nlarge = " + number(force) +
            "\n[[coordinate]]\nname = 'x'\nmass = 1\n[[force]]\non = 'x'\namplitude = 'large'\n"
            "[[force]]\non = 'x'\namplitude = 'small'\nharmonic = " +
            std::to_string(harmonic) +
            "\n[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[damper]]\nbetween = ['x', 'ground']\n"
            "coefficient = " +
            number(damping) + "\n" + (k_a > 0.0 ? slider("a", k_a, f_a) : "") +
            (k_b > 0.0 ? slider("b", k_b, f_b) : "") + pad,
        "swings.toml");
  }
};

/// Two sliders of one pair with the same limit and stiffness are one slider: in small swings that they cease to follow
/// both change at once.
TEST(SmallSwings, OfTwoEqualSlidersIsThatOfOne) {
  const orbit::Branch one = followed(Swings{.k_a = 1.0, .f_a = 0.05, .k_b = 0.0}.definition(), "small", 1.2, 1.0, 1.4);
  const orbit::Branch two = followed(Swings{}.definition(), "small", 1.2, 1.0, 1.4);
  EXPECT_FALSE(two.failed()) << orbit::ended(two);
  ASSERT_EQ(one.special.size(), 2U);
  ASSERT_EQ(two.special.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(two.special[k].value, one.special[k].value, 1e-12);
    EXPECT_EQ(two.special[k].passage, orbit::Passage::persistence);
    EXPECT_EQ(one.special[k].passage, orbit::Passage::persistence);
  }
}

/// Where the small swing of one slider dies, it begins to slip at the same instant as another one that has the same
/// f / k.
TEST(SmallSwings, PassesWhereTwoSlidersBeginToSlipTogether) {
  const Swings swings{.omega = 0.5, .damping = 0.6, .harmonic = 5, .k_a = 1.0, .f_a = 0.05, .k_b = 1.139, .f_b = 0.097};
  const orbit::Branch down = followed(swings.definition(), "small", 0.8, 0.4, 0.9);
  EXPECT_FALSE(down.failed()) << orbit::ended(down);
  EXPECT_EQ(down.down.kind, orbit::BranchEnd::Kind::range);
  ASSERT_EQ(down.special.size(), 3U);
  const std::array known = {0.49613519412, 0.661255787621, 0.842689741769};  // from below, too
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(down.special[k].value, known[k], 1e-11);
    EXPECT_EQ(down.special[k].passage, orbit::Passage::persistence) << k;
  }
}

/// A slider that comes to rest as its pair does, which dry friction then holds, turns back without an event of its own.
TEST(SmallSwings, BeginsWhereThePairItselfComesToRest) {
  const Swings swings{.omega = 0.8,
                      .k_a = 0.5,
                      .f_a = 0.2,
                      .k_b = 0.0,
                      .pad = "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.3\nkinetic = 0.3\n"};
  const ModelDefinition definition = swings.definition();
  const auto first = settled(definition, {{"large", 0.6}, {"small", 0.0}});
  ASSERT_TRUE(first);
  orbit::Orbit start = first->orbit;
  start.values = {0.6};
  const auto problem = orbit::pose(definition.family({"large"}, {{"small", 0.0}}), {0.6});
  const orbit::Branch branch = orbit::follow(*problem, start, {.from = 0.1, .to = 1.0});
  EXPECT_FALSE(branch.failed()) << orbit::ended(branch);
  ASSERT_FALSE(branch.special.empty());
  EXPECT_NEAR(branch.special[0].value, 0.3, 1e-9);  // where the force no more exceeds friction
  EXPECT_TRUE(std::ranges::any_of(branch.points, [](const orbit::Solution& point) { return point.family == 1; }));
}

/// A border is one of motions only as long as no other swing is wider: the slider would slip there first.
TEST(SmallSwings, ABorderThatAnotherSwingHasPassedIsNoMotion) {
  const Swings swings{.damping = 0.2, .k_a = 1.0, .f_a = 0.3, .k_b = 0.0};
  const ModelDefinition definition = swings.definition();
  const Overrides small = {{"small", 0.3}};
  const auto first = settled(definition, {{"large", 0.8}, {"small", 0.3}});
  ASSERT_TRUE(first);
  orbit::Orbit start = first->orbit;
  start.values = {0.8};
  const auto posed = orbit::pose(definition.family({"large"}, small), {0.8});
  const orbit::Branch branch = orbit::follow(*posed, start, {.from = 0.1, .to = 1.0});
  const auto border = std::ranges::find(branch.special, orbit::Passage::family, &orbit::SpecialPoint::passage);
  ASSERT_NE(border, branch.special.end()) << orbit::ended(branch);
  orbit::SpecialPoint point = *border;
  point.solution.orbit.values = {point.value, 0.3};
  const auto problem = orbit::pose(definition.family({"large", "small"}), point.solution.orbit.values);
  const orbit::Curve curve =
      orbit::locus(*problem, point, {.from = -1.5, .to = 1.5, .second_from = -3.0, .second_to = 3.0});
  EXPECT_FALSE(curve.failed());
  int passed = 0;
  for (const orbit::CurvePoint& there : curve.points) {
    const orbit::Range x = orbit::ranges(*problem, there.solution.orbit)[0];
    const bool wider = x.most - x.least > 2.0 * swings.f_a / swings.k_a + 1e-9;
    EXPECT_EQ(there.solution.is_motion, !wider) << there.values[0] << ", " << there.values[1];
    passed += wider ? 1 : 0;
  }
  EXPECT_GT(passed, 20);
  EXPECT_TRUE(std::ranges::any_of(
      curve.met, [](const orbit::CurveEvent& event) { return event.met[0].kind == orbit::Meeting::Kind::margin; }));
}

/// Where two touches of a held body become one, the border goes on by other touches: its curve ends.
TEST(SmallSwings, ABorderEndsWhereItsTouchesMerge) {
  const Swings swings{.omega = 0.7,
                      .damping = 0.0,
                      .k_a = 0.0,
                      .k_b = 0.0,
                      .pad =
                          "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.35\n"
                          "kinetic = 0.35\n"};
  const ModelDefinition definition = swings.definition();
  const orbit::Branch branch = [&] {
    const auto first = settled(definition, {{"large", 0.5}, {"small", 0.0}});
    if (!first) throw std::runtime_error("no orbit");
    orbit::Orbit start = first->orbit;
    start.values = {0.5};
    const auto posed = orbit::pose(definition.family({"large"}, {{"small", 0.0}}), {0.5});
    return orbit::follow(*posed, start, {.from = 0.1, .to = 1.0});
  }();
  ASSERT_FALSE(branch.special.empty());
  orbit::SpecialPoint point = branch.special.front();
  EXPECT_NEAR(point.value, 0.35, 1e-14);
  point.solution.orbit.values = {point.value, 0.0};
  const auto problem = orbit::pose(definition.family({"large", "small"}), point.solution.orbit.values);
  const orbit::Curve curve =
      orbit::locus(*problem, point, {.from = 0.02, .to = 1.5, .second_from = -1.0, .second_to = 1.0});
  // The force a sin t + b sin 3t is flat at its greatest where a = 9 b: with a - b = 0.35 at b = 0.04375.
  EXPECT_EQ(curve.up.kind, orbit::CurveEnd::Kind::no_step);
  EXPECT_LT(curve.points.back().values[1], 0.04375);
  EXPECT_GT(curve.points.back().values[1], 0.03);
  for (const orbit::CurvePoint& there : curve.points) {
    EXPECT_TRUE(there.solution.is_motion);
    EXPECT_NEAR(there.values[0] - there.values[1], 0.35, 1e-13);
  }
}

/// Where the small swing of one slider dies, it and another one begin to slip in the other order.
TEST(SmallSwings, PassWhereTwoSlidersChangePlaces) {
  std::string text =
      "name = 'm'\nomega = 'omega'\n[parameters]\nomega = 0.9\n[[coordinate]]\nname = 'x'\nmass = 1.034\n"
      "[[force]]\non = 'x'\namplitude = 0.9546\n[[force]]\non = 'x'\namplitude = -0.1156\nharmonic = 2\nphase = "
      "0.4505\n"
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 0.5216\n[[damper]]\nbetween = ['x', 'ground']\n"
      "coefficient = 0.09129\n";
  for (const auto& [name, values] : {std::pair{"a", "stiffness = 0.6096\nlimit = 0.8501\n"},
                                     {"b", "stiffness = 1.465\nlimit = 0.3959\n"},
                                     {"c", "stiffness = 0.3275\nlimit = 0.04515\n"}})
    text += std::string("[[jenkins]]\nname = '") + name + "'\nbetween = ['x', 'ground']\n" + values;
  const ModelDefinition definition =
      ModelDefinition::parse(text + "[start]\ns_a = -0.8479\ns_b = -0.1394\ns_c = -0.0847\n", "three.toml");
  const orbit::Branch branch = followed(definition, "omega", 0.9, 0.55, 0.91);
  EXPECT_FALSE(branch.failed()) << orbit::ended(branch);
  ASSERT_EQ(branch.special.size(), 3U);
  EXPECT_EQ(branch.special[0].passage, orbit::Passage::persistence);
  EXPECT_EQ(branch.special[2].passage, orbit::Passage::family);
  EXPECT_NEAR(branch.special[0].value, 0.565787871805, 1e-11);
  EXPECT_LT(branch.points.front().orbit.parameter(), 0.5502);
}

}  // namespace
}  // namespace slapstick::test
