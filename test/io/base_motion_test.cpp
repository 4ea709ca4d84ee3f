/// A [[base]] is exactly the forces that its springs and dampers pass on.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/refusal.hpp"
#include "io/same_model.hpp"

namespace slapstick {
namespace {

const std::string head =
    "name = 'm'\nomega = 'w'\n[parameters]\nw = 2\namplitude = 0.25\n"
    "[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'x2'\nmass = 1\n";
constexpr int next = 12;  // the line after `head`
const std::string shaker =
    "[[base]]\nname = 'shaker'\nharmonics = [{ amplitude = 'amplitude', phase = 0.5 },"
    " { amplitude = 3, harmonic = 2 }, { amplitude = 7, harmonic = 0 }]\n";  // 3 lines

/// All forces on a coordinate at time t; harmonic 0 is a constant.
double force_at(const Model& model, int coordinate, double t) {
  double sum = 0.0;
  for (const auto& force : model.forces)
    if (force.coordinate == coordinate)
      sum += force.amplitude * (force.harmonic == 0 ? 1.0 : std::sin(force.harmonic * model.omega * t + force.phase));
  return sum;
}

TEST(Base, springs_and_dampers_pass_on_its_motion) {
  const auto text = head + shaker + "[[spring]]\nbetween = ['x1', 'shaker']\nstiffness = 10\n" +
                    "[[damper]]\nbetween = ['shaker', 'x2']\ncoefficient = 4\n" +
                    "[[force]]\non = 'x2'\namplitude = 1\n";
  const auto definition = ModelDefinition::parse(text, "f.toml");
  const auto model = definition.build({{"w", 1.5}});
  ASSERT_EQ(model.springs.size(), 1U);
  EXPECT_TRUE(model.springs[0].a == 0 && model.springs[0].b == ground && model.springs[0].stiffness == 10);
  EXPECT_TRUE(model.dampers[0].a == ground && model.dampers[0].b == 1 && model.dampers[0].coefficient == 4);
  const double w = 1.5;
  for (double t = 0.0; t < 9.0; t += 0.7) {
    const double x = 0.25 * std::sin(w * t + 0.5) + 3 * std::sin(2 * w * t) + 7;
    const double v = 0.25 * w * std::cos(w * t + 0.5) + 3 * 2 * w * std::cos(2 * w * t);
    EXPECT_NEAR(force_at(model, 0, t), 10 * x, 1e-12);
    EXPECT_NEAR(force_at(model, 1, t), 4 * v + std::sin(w * t), 1e-12);
  }
  const auto printed = definition.to_toml({{"w", 1.5}});
  const auto again = ModelDefinition::parse(printed, "g.toml");
  EXPECT_EQ(again.to_toml(), printed);
  expect_same(again.build(), model);
}

TEST(Base, refusals_say_what_to_write_instead) {
  const auto base = [](const std::string& more) { return refusal(head + shaker + more); };
  const auto at = [](int line) { return "f.toml:" + std::to_string(line) + ": "; };
  EXPECT_EQ(base(""), at(next) +
                          "base 'shaker': no spring or damper is attached to it and no coordinate measured from it, so "
                          "it moves nothing");
  const std::string measured =
      " would depend on time. Measure the coordinates from the base: base = \"shaker\" in [[coordinate]]";
  const std::string pair = "its sides move with the ground and with 'shaker': ";
  const std::string between = "name = 's'\nbetween = ['x1', 'shaker']\n";
  for (const std::string kind : {"stop", "friction", "compliant_stop"})
    EXPECT_EQ(base("[[" + kind + "]]\n" + between),
              at(next + 5) + kind + " 's': between: " + pair + "the gap or the sliding" + measured);
  EXPECT_EQ(base("[[spring]]\nbetween = ['x1', 'shaker']\ncharacteristic = [[0, 0], [1, 1], [2, 3]]\n"),
            at(next + 5) + "spring 1: characteristic: " + pair + "the corners" + measured);
  EXPECT_EQ(base("[[force]]\non = 'shaker'\namplitude = 1\n"),
            at(next + 4) + "force 1: on: 'shaker' is a base: its motion is given, a force cannot change it");
  EXPECT_EQ(base("[[spring]]\nbetween = ['ground', 'shaker']\nstiffness = 1\n"),
            at(next + 4) + "spring 1: between: neither end is a coordinate, so it moves nothing");
  EXPECT_EQ(base("[[spring]]\nbetween = ['x1', 'shakr']\nstiffness = 1\n"),
            at(next + 4) + "spring 1: between: unknown coordinate 'shakr'; did you mean 'shaker'?");
  const auto huge = base("[[damper]]\nbetween = ['x1', 'shaker']\ncoefficient = 1e50\n");
  EXPECT_TRUE(huge.starts_with(at(next + 3) + "damper 1: with its base's motion, as a force: amplitude = 1.2")) << huge;
  const auto named = [](const std::string& name) {
    return refusal(head + "[[base]]\nname = '" + name + "'\nharmonics = [{ amplitude = 1 }]\n");
  };
  EXPECT_EQ(named("x1"), at(next) + "base 'x1': name 'x1' is used twice");
  EXPECT_EQ(named("v2"), at(next) + "base 'v2': name 'v2' is used twice");
  EXPECT_EQ(named("amplitude"), at(next) + "base 'amplitude': a parameter has this name");
  EXPECT_EQ(named("ground"),
            at(next) + "base 'ground': this name is reserved (it is a column of tables, or the surroundings)");
  EXPECT_EQ(named("sin"), at(next) + "base 'sin': a function or constant has this name");
}

TEST(Base, harmonics_are_checked_one_by_one) {
  const auto with = [](const std::string& harmonics) {
    return refusal(head + "[[base]]\nname = 'b'\nharmonics = " + harmonics +
                   "\n[[spring]]\nbetween = ['x1', 'b']\nstiffness = 1\n");
  };
  const std::string at = "f.toml:14: base 'b': harmonics";
  EXPECT_EQ(with("[{ amplitude = 1, harmonic = 3, phase = 'pi' }]"), "accepted");
  EXPECT_EQ(with("[]"), at + ": nothing is in it");
  EXPECT_EQ(with("3"), at + ": expected a list, found a number");
  EXPECT_EQ(with("[{ phase = 1 }]"), at + " 1: 'amplitude' is missing");
  EXPECT_EQ(with("[{ amplitude = 1 }, { amplitude = 1, phse = 2 }]"),
            at + " 2: unknown key 'phse'; did you mean 'phase'?");
  EXPECT_EQ(with("[{ amplitude = 1, harmonic = 0.5 }]"),
            at + " 1: harmonic = 0.5 is not a whole number in [0, 1000000]");
  EXPECT_EQ(with("[{ amplitude = '1 / (w - 2)' }]"),
            at + " 1: amplitude: expression '1 / (w - 2)': its value is inf with w = 2");
}

}  // namespace
}  // namespace slapstick
