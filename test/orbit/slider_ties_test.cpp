/// Sliders whose events come at one instant, in each cycle or because a motion has drawn them there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "followed.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"

namespace slapstick::test {
namespace {

std::string number(double value) { return std::to_string(value); }

std::string link(const std::string& kind, const std::string& body, const std::string& keys) {
  return "[[" + kind + "]]\nbetween = ['" + body + "', 'ground']\n" + keys + "\n";
}

std::string slider(const std::string& name, const std::string& body, double stiffness, double limit) {
  return link("jenkins", body,
              "name = '" + name + "'\nstiffness = " + number(stiffness) + "\nlimit = " + number(limit));
}

/// Unit bodies side by side with a spring between neighbours: each on a spring, a damper and a slider, under one force.
struct Row {
  int bodies = 2;
  double coupling = 0.5, force = 1.0, phase = 0.0;

  [[nodiscard]] ModelDefinition definition() const {
    std::string text = "name = 'row'\nomega = 'omega'\n[parameters]\nomega = 0.7\n";
    for (int i = 0; i < bodies; ++i) {
      const std::string body = "x" + std::to_string(i);
      text += "[[coordinate]]\nname = '" + body + "'\nmass = 1\n";
      text += "[[force]]\non = '" + body + "'\namplitude = " + number(force) + "\n";
      text += link("spring", body, "stiffness = 1") + link("damper", body, "coefficient = 0.3");
      text += slider("s" + std::to_string(i), body, 1.0, 0.4);
      if (i > 0)
        text += "[[spring]]\nbetween = ['x" + std::to_string(i - 1) + "', '" + body +
                "']\nstiffness = " + number(coupling) + "\n";
    }
    return ModelDefinition::parse(text, "row.toml");
  }
};

/// Equal bodies that move alike are as one body, whose slider turns and slips alone. The state of a symmetric motion
/// differs by rounding from body to body: that is no order of events.
TEST(SliderTies, OfEqualBodiesAreAsOneBody) {
  const orbit::Branch one = followed(Row{.bodies = 1}.definition(), "omega", 0.7, 0.4, 1.6);
  const orbit::Branch two = followed(Row{.bodies = 2}.definition(), "omega", 0.7, 0.4, 1.6);
  EXPECT_FALSE(two.failed()) << orbit::ended(two);
  EXPECT_EQ(two.special.size(), one.special.size());
  EXPECT_EQ(two.down.kind, orbit::BranchEnd::Kind::range);
  EXPECT_EQ(two.up.kind, orbit::BranchEnd::Kind::range);
}

TEST(SliderTies, OfEqualBodiesBeginAndCeaseToSlipAsOfOneBody) {
  const orbit::Branch one = followed(Row{.bodies = 1, .force = 0.2}.definition(), "omega", 0.7, 0.4, 1.6);
  const orbit::Branch two = followed(Row{.bodies = 2, .force = 0.2}.definition(), "omega", 0.7, 0.4, 1.6);
  EXPECT_FALSE(two.failed()) << orbit::ended(two);
  ASSERT_EQ(one.special.size(), 2U);
  ASSERT_EQ(two.special.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(two.special[k].value, one.special[k].value, 1e-12);
    EXPECT_EQ(two.special[k].passage, one.special[k].passage) << k;
  }
}

/// The multipliers of many equal bodies are those of one, each once for each body: a large machine is flown by other
/// operators than a small one.
TEST(SliderTies, LeaveTheMultipliersOfEqualMachinesThoseOfOne) {
  const ModelDefinition single = Row{.bodies = 1, .phase = 2.0}.definition(),
                        many = Row{.bodies = 7, .coupling = 0.0, .phase = 2.0}.definition();
  const Classification one = classify(System(single.build()), single.start());
  const Classification all = classify(System(many.build()), many.start());
  ASSERT_EQ(one.multipliers.size(), 3U);
  ASSERT_EQ(all.multipliers.size(), 21U);
  EXPECT_GT(std::abs(one.multipliers[0]), 1e-3);
  for (std::size_t i = 0; i < 21; ++i) {
    const auto near = std::ranges::min(one.multipliers, {}, [&](auto mu) { return std::abs(mu - all.multipliers[i]); });
    EXPECT_LT(std::abs(near - all.multipliers[i]), 1e-10) << i;
    const auto same = [&](auto mu) { return std::abs(mu - near) < 1e-10; };
    EXPECT_EQ(std::ranges::count_if(all.multipliers, same), 7 * std::ranges::count_if(one.multipliers, same)) << i;
  }
}

/// .. and so are Lyapunov exponents, for which tangents are made anew on the way.
TEST(SliderTies, LeaveTheExponentsOfEqualMachinesThoseOfOne) {
  const ModelDefinition single = Row{.bodies = 1}.definition(), many = Row{.bodies = 7, .coupling = 0.0}.definition();
  const LyapunovOptions options{.transient_periods = 100, .most_periods = 50};
  const double one = lyapunov(System(single.build()), single.start(), options).per_period[0];
  const LyapunovExponents all = lyapunov(System(many.build()), many.start(), options);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(all.per_period[i], one, 1e-9) << i;
}

/// The window of a mode does not shrink with the number of sliders that slip in it: nothing depends on where they are.
TEST(SliderTies, OfManyParallelSlidersCostNoShorterWindows) {
  const auto joint = [](int sliders) {
    std::string text =
        "name = 'joint'\nomega = 1.3\n[[coordinate]]\nname = 'x'\nmass = 1\n[[force]]\non = 'x'\n"
        "amplitude = 1\n" +
        link("spring", "x", "stiffness = 1") + link("damper", "x", "coefficient = 0.2");
    for (int i = 0; i < sliders; ++i) text += slider("e" + std::to_string(i), "x", 1.0 / sliders, 0.3 / sliders);
    return ModelDefinition::parse(text, "joint.toml");
  };
  const System one(joint(1).build()), many(joint(25).build());
  EXPECT_LT(many.windows_per_period(), 2.0 * one.windows_per_period());
  EXPECT_EQ(classify(many, joint(25).start()).label, classify(one, joint(1).start()).label);
}

/// A small swing closes where it began, and two sliders that turned there together begin to slip at one instant again.
/// Which of them a search sees first is rounding, and may be another one in the next cycle.
TEST(SliderTies, HaveOneOrderInAllCycles) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 'omega'\n[parameters]\nomega = 0.5\n[[coordinate]]\nname = 'x'\nmass = 1.034\n"
      "[[force]]\non = 'x'\namplitude = 0.9546\n[[force]]\non = 'x'\namplitude = -0.1156\nharmonic = 2\nphase = "
      "0.4505\n" +
          link("spring", "x", "stiffness = 0.5216") + link("damper", "x", "coefficient = 0.09129") +
          slider("a", "x", 0.6096, 0.8501) + slider("b", "x", 1.465, 0.3959) + slider("c", "x", 0.3275, 0.04515) +
          "[start]\ns_a = -0.8479\ns_b = -0.1394\ns_c = -0.0847\n",
      "m.toml");
  EXPECT_TRUE(settled(definition, {{"omega", 0.4345}}));
  const orbit::Branch down = followed(definition, "omega", 0.45, 0.42, 0.46),
                      up = followed(definition, "omega", 0.425, 0.42, 0.46);
  for (const orbit::Branch* branch : {&down, &up}) {
    EXPECT_FALSE(branch->failed()) << orbit::ended(*branch);
    ASSERT_EQ(branch->special.size(), 2U);
    EXPECT_NEAR(branch->special[1].value, 0.4345900909, 1e-10);
    for (const orbit::SpecialPoint& point : branch->special) EXPECT_EQ(point.passage, orbit::Passage::persistence);
  }
}

/// A small swing dies out: two sliders cease to turn and to slip at one instant, twice in each cycle.
TEST(SliderTies, SmallSwingsDieOutAtOnePlaceFromEachStart) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 0.7294\n[parameters]\namplitude = 1\n[[coordinate]]\nname = 'x'\nmass = 0.935\n"
      "[[force]]\non = 'x'\namplitude = 'amplitude'\n[[force]]\non = 'x'\namplitude = 0.8725\nharmonic = 5\n" +
          link("spring", "x", "stiffness = 1.227") + link("damper", "x", "coefficient = 0.1045") +
          slider("a", "x", 0.5, 0.429) + slider("b", "x", 0.5, 0.4),
      "m.toml");
  const auto branch_from = [&](double start, double step) {
    const auto first = settled(definition, {{"amplitude", start}});
    orbit::Orbit from = first.value().orbit;
    from.values = {start};
    return orbit::follow(*orbit::pose(definition.family({"amplitude"}), {start}), from,
                         {.from = 1.5, .to = 1.8, .step = step, .longest_step = step});
  };
  const orbit::Branch a = branch_from(1.6, 0.1), b = branch_from(1.7, 0.3);
  for (const orbit::Branch* branch : {&a, &b}) {
    EXPECT_FALSE(branch->failed()) << orbit::ended(*branch);
    ASSERT_EQ(branch->special.size(), 2U);
    EXPECT_EQ(branch->special[1].passage, orbit::Passage::persistence);
  }
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(a.special[i].value, b.special[i].value, 1e-12) << i;
}

/// A motion that grows draws a slider along until it is just not drawn along any more. The cycle touches the limit and
/// is a cycle: the slider rests.
TEST(SliderTies, SliderThatWasDrawnToItsLimitRestsThere) {
  for (const bool held : {false, true}) {
    const std::string pad = held ? "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.02\n"
                                   "kinetic = 0.02\n"
                                 : "";
    const auto definition = ModelDefinition::parse(
        "name = 'm'\nomega = 1.1\n[[coordinate]]\nname = 'x'\nmass = 1\n[[force]]\non = 'x'\namplitude = 0.15\n" +
            link("spring", "x", "stiffness = 0.8") + link("damper", "x", "coefficient = 0.4") +
            slider("slips", "x", 0.3, 0.05) + slider("drawn", "x", 0.5, 0.2) + "[start]\ns_drawn = -1.2\n" + pad,
        "m.toml");
    const auto found = settled(definition, {});
    const Classification seen = classify(System(definition.build()), definition.start());
    ASSERT_TRUE(found) << held;
    EXPECT_EQ(found->label, seen.label);
  }
}

/// A body between a slider and a wall, pressed onto the wall.
ModelDefinition beside_a_wall(double omega, double limit, double press, double restitution) {
  const std::string force = "[[force]]\non = 'x'\namplitude = ";
  return ModelDefinition::parse(
      "name = 'm'\nomega = " + number(omega) + "\n[[coordinate]]\nname = 'x'\nmass = 1\n" + force + "1\n" + force +
          number(press) + "\nharmonic = 0\n" + link("spring", "x", "stiffness = 1") +
          link("damper", "x", "coefficient = 0.2") +
          link("stop", "x", "name = 'wall'\nclearance = 0.6\nrestitution = " + number(restitution)) +
          slider("s", "x", 0.3, limit),
      "m.toml");
}

/// The first impact of a cycle has drawn the slider to its limit at the wall. At the second one the slider is just at
/// the limit, and the body turns back: no corner, though rounding may put the limit before the wall.
TEST(SliderTies, ImpactWhereASliderIsJustAtItsLimitMovesNoSlider) {
  const System system(beside_a_wall(1.3, 0.12, 0.8, 0.6).build());
  Motion motion(system, State(4, 0.0));
  run_to(motion, Instant{40, 0.0}, nullptr, [] {});
  int corners = 0, impacts = 0;
  run_to(motion, Instant{60, 0.0}, nullptr, [&] {
    corners += motion.event().kind == EventKind::corner ? 1 : 0;
    impacts += motion.event().kind == EventKind::impact ? 1 : 0;
  });
  EXPECT_EQ(impacts, 40);
  EXPECT_EQ(corners, 80);  // begins to slip and rests again, both ways
}

/// The many short flights make the equations hardly solvable in directions that are no family's.
TEST(SliderTies, ChatterBesideASliderThatRestsIsOfAFamily) {
  for (const double limit : {0.3, 0.6}) {
    const auto found = settled(beside_a_wall(0.8, limit, 0.6, 0.3), {});
    ASSERT_TRUE(found) << limit;
    EXPECT_TRUE(found->chatter);
    EXPECT_EQ(found->family, 1) << limit;
  }
}

/// Bodies that move alike, with springs between neighbours. In the cycle to which the motion comes no slider slips, and
/// all have been drawn until they just touch their limits.
ModelDefinition touching(int bodies) {
  std::string text = "name = 'm'\nomega = 0.5623\n";
  for (int i = 0; i < bodies; ++i) {
    const std::string body = "x" + std::to_string(i), force = "[[force]]\non = '" + body + "'\namplitude = ";
    text += "[[coordinate]]\nname = '" + body + "'\nmass = 0.5705\n" + force + "0.742\n" + force +
            "0.3655\nharmonic = 2\nphase = 4.576\n" + force + "0.7297\nharmonic = 0\n" +
            link("spring", body, "stiffness = 1.207") + link("damper", body, "coefficient = 0.2715") +
            slider("j" + std::to_string(i), body, 0.5, 0.4);
    if (i > 0) text += "[[spring]]\nbetween = ['x" + std::to_string(i - 1) + "', '" + body + "']\nstiffness = 0.2\n";
  }
  return ModelDefinition::parse(text, "m.toml");
}

/// Rounding would say in each cycle anew which of them slips. The determinant of each body's cycle is exp(-c T / m).
TEST(SliderTies, OrbitOfSlidersThatOnlyTouchTheirLimitsIsOfAFamilyOfThem) {
  const double pi = std::acos(-1.0), inner = std::exp(-0.5 * 0.2715 / 0.5705 * 2.0 * pi / 0.5623);
  for (const int bodies : {1, 2, 4}) {
    const auto definition = touching(bodies);
    const auto found = settled(definition, {});
    const Classification seen = classify(System(definition.build()), definition.start());
    ASSERT_TRUE(found) << bodies;
    EXPECT_EQ(found->family, bodies);
    EXPECT_EQ(seen.family, bodies);
    for (const auto& multipliers : {found->multipliers, seen.multipliers}) {
      ASSERT_EQ(multipliers.size(), 3U * static_cast<std::size_t>(bodies));
      for (std::size_t i = 0; i < multipliers.size(); ++i)
        EXPECT_NEAR(std::abs(multipliers[i]), i < static_cast<std::size_t>(bodies) ? 1.0 : inner, 1e-8) << i;
    }
  }
}

/// At resonance slips shrink slowly as the swing grows. What is left of them when a cycle is seen is no slip of the
/// cycle; and a cycle that begins just as its sliders turn begins at rest.
TEST(SliderTies, SlidersThatShrinkingSlipsHaveDrawnRestInTheCycle) {
  struct Machine {
    double force, damping;
    std::vector<double> limits, starts;
  };
  for (const Machine& machine :
       {Machine{1.0, 0.1, {5.07}, {6.34}}, Machine{1.0, 0.05, {8.09, 8.09, 8.09}, {18.2, 18.2, 18.2}},
        Machine{0.78, 0.005, {63.92, 51.03, 75.88}, {-157.9, 2.0, 17.9}}}) {
    const int count = static_cast<int>(machine.limits.size());
    std::string text =
        "name = 'm'\nomega = " + number(std::sqrt(1.0 + 0.4 * count)) +
        "\n[[coordinate]]\nname = 'x'\nmass = 1\n[[force]]\non = 'x'\namplitude = " + number(machine.force) + "\n" +
        link("spring", "x", "stiffness = 1") + link("damper", "x", "coefficient = " + number(machine.damping));
    std::string start = "[start]\n";
    for (int i = 0; i < count; ++i) {
      const std::string name = "s" + std::to_string(i);
      text += slider(name, "x", 0.4, machine.limits[static_cast<std::size_t>(i)]);
      start += "s_" + name + " = " + number(machine.starts[static_cast<std::size_t>(i)]) + "\n";
    }
    const auto definition = ModelDefinition::parse(text + start, "m.toml");
    const auto found = settled(definition, {});
    const Classification seen = classify(System(definition.build()), definition.start());
    ASSERT_TRUE(found) << count;
    EXPECT_EQ(found->family, count);
    EXPECT_EQ(seen.family, count);
    const double inner = std::exp(-0.5 * machine.damping * 2.0 * std::acos(-1.0) / std::sqrt(1.0 + 0.4 * count));
    for (const auto& multipliers : {found->multipliers, seen.multipliers})
      for (std::size_t i = 0; i < multipliers.size(); ++i)
        EXPECT_NEAR(std::abs(multipliers[i]), i < static_cast<std::size_t>(count) ? 1.0 : inner, 1e-7) << i;
  }
}

/// A touch is no event: behind the transient nothing is told at all.
TEST(SliderTies, SlidersThatTouchTheirLimitsHaveNoEvent) {
  const auto definition = touching(2);
  const System system(definition.build());
  Motion motion(system, definition.start());
  while (motion.advance({100, 0.0}) == Outcome::event) continue;
  EXPECT_EQ(motion.advance({2000, 0.0}), Outcome::reached_end);
}

/// Of one pair, and beside friction that holds now and then.
TEST(SliderTies, SlidersOfOnePairThatTouchTheirLimitsAreAFamily) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 2\n[[coordinate]]\nname = 'x'\nmass = 1.3\n[[force]]\non = 'x'\namplitude = 0.4\n"
      "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.1\nkinetic = 0.1\n" +
          link("spring", "x", "stiffness = 2") + link("damper", "x", "coefficient = 0.3") + slider("a", "x", 4, 0.4) +
          slider("b", "x", 3, 0.3) + "[start]\nx = 0.3\n",
      "m.toml");
  const Classification seen = classify(System(definition.build()), definition.start());
  EXPECT_EQ(seen.label, "1-0-I");
  EXPECT_EQ(seen.family, 2);
}

}  // namespace
}  // namespace slapstick::test
