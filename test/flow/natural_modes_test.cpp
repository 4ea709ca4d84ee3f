/// Natural frequencies and damping against closed forms.
#include "slapstick/flow/natural_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

std::vector<NaturalMode> modes_of(const std::string& text) {
  const ModelDefinition definition = ModelDefinition::parse(text, "test");
  const System system(definition.build());
  return natural_modes(system, sliding_states(system, definition.start()));
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

std::string number(double value) {
  std::ostringstream text;
  text << std::setprecision(17) << value;
  return text.str();
}

/// omega_j^2 = 2 (k / m) (1 - cos(j pi / n)), j = 0 .. n-1, of a free chain; its translation is exact, twice.
TEST(NaturalModes, OfAFreeChainAreExactInAnyUnits) {
  constexpr int n = 5;
  for (const double k : {1e-16, 1e-8, 1.0, 1e6, 1e12}) {
    std::string text = "name = \"chain\"\n";
    for (int i = 1; i <= n; ++i) text += "[[coordinate]]\nname = \"q" + std::to_string(i) + "\"\nmass = 1e-3\n";
    for (int i = 1; i < n; ++i)
      text += "[[spring]]\nbetween = [\"q" + std::to_string(i) + "\", \"q" + std::to_string(i + 1) +
              "\"]\nstiffness = " + number(k) + "\n";
    const auto modes = modes_of(text);
    ASSERT_EQ(modes.size(), static_cast<std::size_t>(n + 1)) << k;
    for (const NaturalMode& mode : modes) EXPECT_EQ(mode.decay, 0.0) << k;
    for (const std::size_t i : {0U, 1U}) {
      EXPECT_EQ(modes[i].frequency, 0.0);
      for (const auto& part : modes[i].shape) EXPECT_NEAR(std::abs(part - 1.0), 0.0, 1e-14);
    }
    for (int j = 1; j < n; ++j) {
      const double omega = 2.0 * std::sqrt(k / 1e-3) * std::sin(j * std::numbers::pi / (2.0 * n));
      EXPECT_NEAR(modes[static_cast<std::size_t>(j + 1)].frequency / omega, 1.0, 1e-14) << k << ", " << j;
    }
  }
}

/// lambda^2 m + lambda c + k = 0: the slow root is k / c (1 + k m / c^2), and k m / c^2 is 1e-9.
TEST(NaturalModes, ThatAreSlowBesideFastOnesKeepTheirDigits) {
  const std::string heavy = "name = \"over\"\n[[coordinate]]\nname = \"x\"\nmass = 1e-3\n" + damper(1e3);
  for (const double k : {1.0, -1.0}) {
    const auto modes = modes_of(heavy + "[[spring]]\nbetween = [\"x\", \"ground\"]\nstiffness = " + number(k) + "\n");
    ASSERT_EQ(modes.size(), 2U);
    const double slow = k / 1e3 * (1.0 + 1e-9 * k), fast = 1e6 - slow;
    const auto& [first, second] = std::pair(modes[0], modes[1]);
    EXPECT_NEAR(std::min(first.decay, second.decay) / slow, 1.0, 1e-14);
    EXPECT_NEAR(std::max(first.decay, second.decay) / fast, 1.0, 1e-14);
  }
}

/// A node of 1e-6 that a contact of 1e8 holds to a body: the body's frequency is that of both together.
/// Two orders of the coordinates, and one answer.
TEST(NaturalModes, OfABodyAreNotSpoiltByAStiffContact) {
  for (const char* growth : {"0.5", "-0.5"}) {
    std::array<NaturalMode, 2> slow;
    for (const bool first : {true, false}) {
      const std::string x = "[[coordinate]]\nname = \"x\"\nmass = 1\n",
                        node = "[[coordinate]]\nname = \"node\"\nmass = 1e-6\n";
      const auto modes = modes_of("name = \"stiff\"\n" + (first ? x + node : node + x) +
                                  "[[spring]]\nbetween = [\"x\", \"ground\"]\nstiffness = 1\n" +
                                  "[[damper]]\nbetween = [\"x\", \"ground\"]\nfeeds = true\ncoefficient = " + growth +
                                  "\n" + "[[spring]]\nbetween = [\"node\", \"x\"]\nstiffness = 1e8\n");
      ASSERT_EQ(modes.size(), 2U);
      slow[first ? 0 : 1] = modes[0];
    }
    const double mass = 1.0 + 1e-6;
    constexpr double known = 1e8 * 0x1p-53;  // what the sum of both springs leaves of the weak one
    EXPECT_NEAR(slow[0].frequency, 1.0 / std::sqrt(mass), known);
    EXPECT_NEAR(slow[0].decay, std::stod(growth) / (2.0 * mass), known);
    EXPECT_NEAR(slow[0].frequency, slow[1].frequency, known);
    EXPECT_NEAR(slow[0].decay, slow[1].decay, known);
  }
}

/// What has no damper neither decays nor grows, whatever rounding says.
TEST(NaturalModes, WithoutDampersDoNotGrow) {
  const ModelDefinition brake = load_model("mode-coupling-brake");
  for (const double friction : {0.05, 0.15, 0.25, 0.35}) {
    for (const double stiffer : {1.0, 1e6, 1e12}) {
      Overrides values{{"friction", friction}};
      for (const char* k : {"k1", "k2", "k3"}) values[k] = stiffer * brake.values().at(k);
      const System system(brake.build(values));
      for (const NaturalMode& mode : natural_modes(system, sliding_states(system, brake.start(values), {}, {"belt"})))
        EXPECT_EQ(mode.decay, 0.0) << friction << ", " << stiffer;
    }
  }
}

/// N = -1 + 3 x at x = 0, whatever the compliant stop did before it was opened.
TEST(NaturalModes, OfAContactWithoutLoadAreThoseWithoutIt) {
  const ModelDefinition definition = ModelDefinition::parse(
      "name = \"n\"\n[[coordinate]]\nname = \"x\"\nmass = 1\n[[coordinate]]\nname = \"y\"\nmass = 1\n"
      "[[spring]]\nbetween = [\"x\", \"ground\"]\nstiffness = 1\n"
      "[[spring]]\nbetween = [\"y\", \"ground\"]\nstiffness = 4\n"
      "[[compliant_stop]]\nname = \"q\"\nbetween = [\"y\", \"ground\"]\nclearance = 0.1\nstiffness = 50\n"
      "[[friction]]\nname = \"f\"\nbetween = [\"x\", \"ground\"]\nstatic = 0.2\n"
      "normal_force = { constant = -1, compliant_stop = \"q\", x = 3 }\n",
      "test");
  const System system(definition.build());
  const auto frequency = [&](const State& state, const std::vector<std::string>& closed) {
    return natural_modes(system, sliding_states(system, state, {}, closed)).at(0).frequency;
  };
  EXPECT_NEAR(frequency({0.0, 0.0, 0.0, 0.0}, {}), 1.0, 1e-14);
  EXPECT_NEAR(frequency({0.0, 0.0, 0.15, 0.0}, {}), 1.0, 1e-14);
  EXPECT_NEAR(frequency({0.0, -1.0, 0.15, 0.0}, {}), 1.0, 1e-14);
  EXPECT_NEAR(frequency({1.0, 1.0, 0.0, 0.0}, {}), std::sqrt(1.6), 1e-14);  // k + 0.2 * 3
  EXPECT_NEAR(frequency({0.0, 1.0, 0.0, 0.0}, {"q"}), std::sqrt(1.6), 1e-14);
}

/// Falling friction: the slope 0.4 of the friction exceeds the damping 0.2.
TEST(NaturalModes, OfFallingFrictionGrow) {
  const ModelDefinition squeal = load_model("falling-friction");
  const System system(squeal.build());
  const auto modes = natural_modes(system, sliding_states(system, {0.8, 0.0}));
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].decay, -0.1, 1e-14);
}

TEST(NaturalModes, TakeTheSlopeOfThePieceAtTheState) {
  const ModelDefinition definition = ModelDefinition::parse(
      body("[[spring]]\nbetween = [\"x\", \"ground\"]\ncharacteristic = [[-1, -2], [1, 2], [2, 10]]\n[start]\nx = 0\n"),
      "test");
  const auto frequency_at = [&](double x) {
    const System system(definition.build());
    return natural_modes(system, sliding_states(system, {x, 0.0})).at(0).frequency;
  };
  EXPECT_NEAR(frequency_at(0.0), 1.0, 1e-14);  // slope 2
  EXPECT_NEAR(frequency_at(1.5), 2.0, 1e-14);  // slope 8
}

std::string body(const std::string& name, double mass) {
  return "[[coordinate]]\nname = \"" + name + "\"\nmass = " + std::to_string(mass) + "\n";
}
std::string link(const std::string& kind, const std::string& a, const std::string& b, const std::string& more) {
  return "[[" + kind + "]]\nbetween = [\"" + a + "\", \"" + b + "\"]\n" + more + "\n";
}

/// Three bodies in a row between springs and dampers, with a contact of each kind between neighbours.
struct Row {
  System system = System(
      ModelDefinition::parse(
          "name = \"row\"\n" + body("a", 1) + body("b", 2) + body("c", 3) +
              link("spring", "a", "ground", "stiffness = 5") + link("spring", "b", "a", "stiffness = 7") +
              link("spring", "c", "b", "stiffness = 11") + link("damper", "b", "ground", "coefficient = 0.3") +
              link("friction", "b", "a", "name = \"pad\"\nstatic = 1") +
              link("friction", "c", "a", "name = \"arm\"\nstatic = 1") +
              link("stop", "c", "b", "name = \"tooth\"\nclearance = 1\nrestitution = 1") +
              link("compliant_stop", "c", "ground", "name = \"buffer\"\nclearance = 1\nstiffness = 13\ndamping = 0.2"),
          "test")
          .build());
  std::vector<NaturalMode> modes(const std::vector<std::string>& stuck, const std::vector<std::string>& closed) const {
    return natural_modes(system, sliding_states(system, State(6, 0.0), stuck, closed));
  }
};

/// (lambda^2 M + lambda C + K) phi = 0, written out for the row: another route than the eigenvalues of A.
double residual(const NaturalMode& mode, double buffer) {
  using Number = std::complex<double>;
  const double omega = 2 * std::numbers::pi * mode.cycles();
  const Number s(-mode.decay, omega), a = mode.shape[0], b = mode.shape[1], c = mode.shape[2];
  const Number on_a = s * s * a + 5.0 * a + 7.0 * (a - b);
  const Number on_b = 2.0 * s * s * b + 7.0 * (b - a) + 11.0 * (b - c) + 0.3 * s * b;
  const Number on_c = 3.0 * s * s * c + 11.0 * (c - b) + buffer * (13.0 + 0.2 * s) * c;
  return std::max({std::abs(on_a), std::abs(on_b), std::abs(on_c)});
}

TEST(NaturalModes, HaveShapesThatSolveTheEquations) {
  const Row row;
  for (const bool on : {false, true}) {
    const auto modes = row.modes({}, on ? std::vector<std::string>{"buffer"} : std::vector<std::string>{});
    ASSERT_EQ(modes.size(), 3u);
    for (const NaturalMode& mode : modes) {
      EXPECT_LT(residual(mode, on ? 1.0 : 0.0), 1e-12);
      double largest = 0.0;
      for (const auto& part : mode.shape) largest = std::max(largest, std::abs(part));
      EXPECT_EQ(largest, 1.0);
    }
  }
}

/// Contacts that hold make one body of two; a loop of them holds no more than its independent rows.
TEST(NaturalModes, OfHeldContactsAreThoseOfTheBodiesTheyMake) {
  const Row row;
  const auto expect_one_body = [&](const std::vector<NaturalMode>& modes) {  // 6 x'' + 0.3 x' + 5 x
    ASSERT_EQ(modes.size(), 1u);
    EXPECT_NEAR(modes[0].frequency, std::sqrt(5.0 / 6.0), 1e-14);
    EXPECT_NEAR(modes[0].decay, 0.3 / 12.0, 1e-14);
    for (const auto& part : modes[0].shape) EXPECT_LT(std::abs(part - 1.0), 1e-14);
  };
  expect_one_body(row.modes({"pad"}, {"tooth"}));
  expect_one_body(row.modes({"pad", "arm"}, {}));
  expect_one_body(row.modes({"pad", "arm"}, {"tooth"}));
  const auto two = row.modes({}, {"tooth"});  // a, and b with c
  ASSERT_EQ(two.size(), 2u);
  for (const NaturalMode& mode : two) EXPECT_EQ(mode.shape[1], mode.shape[2]);
  const double product = two[0].frequency * two[1].frequency;  // det K / det M
  EXPECT_NEAR(product * product, (12.0 * 7.0 - 49.0) / 5.0, 1e-12);
}

TEST(NaturalModes, RefuseNamesOfNoSuchContact) {
  const Row row;
  EXPECT_THROW((void)row.modes({"tooth"}, {}), InputError);
  EXPECT_THROW((void)row.modes({}, {"pad"}), InputError);
}

/// The two frequencies of the sliding brake meet at mu = 3 sqrt(3) / 11, and one mode grows beyond.
TEST(NaturalModes, OfASlidingBrakeFlutterFromTheClosedFormOn) {
  const ModelDefinition brake = load_model("mode-coupling-brake");
  const auto at = [&](double mu) {
    const Overrides values{{"friction", mu}};
    const System system(brake.build(values));
    return natural_modes(system, sliding_states(system, brake.start(values), {}, {"belt"}));
  };
  const double critical = 3 * std::sqrt(3.0) / 11;
  for (const NaturalMode& mode : at(critical * (1 - 1e-6))) EXPECT_LT(std::abs(mode.decay), 1e-11);
  const auto beyond = at(critical * (1 + 1e-6));
  ASSERT_EQ(beyond.size(), 2u);
  EXPECT_LT(beyond[0].decay, -1e-4);
  EXPECT_NEAR(beyond[0].decay, -beyond[1].decay, 1e-10);
}

}  // namespace
}  // namespace slapstick
