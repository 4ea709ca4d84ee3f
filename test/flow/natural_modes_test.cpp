/// Natural frequencies and damping against closed forms.
#include "slapstick/flow/natural_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

std::vector<NaturalMode> modes_of(const std::string& text) {
  const ModelDefinition definition = ModelDefinition::parse(text, "test");
  return natural_modes(System(definition.build()), definition.start());
}

std::string body(const std::string& more) { return "name = \"test\"\n[[coordinate]]\nname = \"x\"\nmass = 2\n" + more; }
const std::string spring = "[[spring]]\nbetween = [\"x\", \"ground\"]\nstiffness = 18\n";

std::string damper(double c) {
  return "[[damper]]\nbetween = [\"x\", \"ground\"]\ncoefficient = " + std::to_string(c) + "\n";
}

TEST(NaturalModes, OfADampedBodyAreTheTextbooks) {  // lambda^2 + (c/m) lambda + k/m = 0
  const auto modes = modes_of(body(spring + damper(3)));
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].frequency, 3.0, 1e-14);
  EXPECT_NEAR(modes[0].damping_ratio(), 3.0 / (2 * 2 * 3.0), 1e-14);
}

TEST(NaturalModes, AboveCriticalDampingDoNotOscillate) {
  const auto modes = modes_of(body(spring + damper(20)));  // lambda = -5 +- 4
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_FALSE(modes[0].oscillates());
  EXPECT_NEAR(modes[0].decay, 1.0, 1e-13);
  EXPECT_NEAR(modes[1].decay, 9.0, 1e-13);
}

TEST(NaturalModes, OfAFreeBodyHaveTheDecayZeroTwice) {
  const auto modes = modes_of(body(""));
  ASSERT_EQ(modes.size(), 2u);
  for (const NaturalMode& mode : modes) EXPECT_EQ(mode.decay, 0.0);
}

TEST(NaturalModes, OfAChainAreItsSines) {  // omega_j = 2 sin(j pi / (2 (n + 1))), clamped at both ends
  constexpr int n = 6;
  std::string text = "name = \"chain\"\n";
  for (int i = 1; i <= n; ++i) text += "[[coordinate]]\nname = \"q" + std::to_string(i) + "\"\nmass = 1\n";
  for (int i = 0; i <= n; ++i) {
    const std::string a = i == 0 ? "ground" : "q" + std::to_string(i);
    const std::string b = i == n ? "ground" : "q" + std::to_string(i + 1);
    text += "[[spring]]\nbetween = [\"" + (a == "ground" ? b : a) + "\", \"" + (a == "ground" ? a : b) +
            "\"]\nstiffness = 1\n";
  }
  const auto modes = modes_of(text);
  ASSERT_EQ(modes.size(), static_cast<std::size_t>(n));
  for (int j = 1; j <= n; ++j) {
    const NaturalMode& mode = modes[static_cast<std::size_t>(j - 1)];
    EXPECT_NEAR(mode.frequency, 2 * std::sin(j * std::numbers::pi / (2 * (n + 1))), 1e-14) << j;
    EXPECT_NEAR(mode.decay, 0.0, 1e-14) << j;
  }
}

/// Falling friction: the slope 0.4 of the friction exceeds the damping 0.2.
TEST(NaturalModes, OfFallingFrictionGrow) {
  const ModelDefinition squeal = load_model("falling-friction");
  const auto modes = natural_modes(System(squeal.build()), {0.8, 0.0});
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].decay, -0.1, 1e-14);
}

TEST(NaturalModes, TakeTheSlopeOfThePieceAtTheState) {
  const ModelDefinition definition = ModelDefinition::parse(
      body("[[spring]]\nbetween = [\"x\", \"ground\"]\ncharacteristic = [[-1, -2], [1, 2], [2, 10]]\n[start]\nx = 0\n"),
      "test");
  const auto frequency_at = [&](double x) {
    return natural_modes(System(definition.build()), {x, 0.0}).at(0).frequency;
  };
  EXPECT_NEAR(frequency_at(0.0), 1.0, 1e-14);  // slope 2
  EXPECT_NEAR(frequency_at(1.5), 2.0, 1e-14);  // slope 8
}

}  // namespace
}  // namespace slapstick
