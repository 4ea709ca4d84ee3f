/// Springs in series with sliders against closed forms: loops, response, energy, rest.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/flow/system.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::testing {
namespace {

constexpr double pi = std::numbers::pi;

ModelDefinition file(const std::string& parts) { return ModelDefinition::parse("name = 'm'\n" + parts, "f.toml"); }

const char* const body = "[[coordinate]]\nname = 'x'\nmass = 2\n";

const char* const spring = "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 5\n";

std::string element(double k, double f, const std::string& ends = "['x', 'ground']", const std::string& name = "pad") {
  return "[[jenkins]]\nname = '" + name + "'\nbetween = " + ends + "\nstiffness = " + std::to_string(k) +
         "\nlimit = " + std::to_string(f) + "\n";
}

/// A body on an element alone: it swings on the spring until F = f, slides with -f, turns, and swings on the spring.
TEST(Jenkins, ABodySlidesAndTurns) {
  const double m = 2, k = 8, f = 4, v0 = 3, omega = std::sqrt(k / m);  // 2
  const System system(file(std::string(body) + element(k, f)).build());
  Motion motion(system, {0.0, v0, 0.0, 99.0});
  const double yield = std::asin(f / k * omega / v0) / omega, v1 = v0 * std::cos(omega * yield);
  ASSERT_EQ(motion.advance(Instant{}.plus(20.0)), Outcome::event);
  EXPECT_EQ(motion.event().kind, EventKind::corner);
  EXPECT_NEAR(seconds(motion.event(), motion), yield, 1e-14);
  EXPECT_NEAR(motion.state()[1], v1, 1e-14);
  EXPECT_NEAR(motion.state()[3], v1, 1e-14);  // the slider goes as the body does
  ASSERT_EQ(motion.advance(Instant{}.plus(20.0)), Outcome::event);
  const double turn = yield + v1 * m / f, x = f / k + 0.5 * v1 * v1 * m / f;
  EXPECT_NEAR(seconds(motion.event(), motion), turn, 1e-13);
  EXPECT_NEAR(motion.state()[0], x, 1e-13);
  EXPECT_NEAR(motion.state()[2], x - f / k, 1e-13);
  EXPECT_EQ(motion.state()[3], 0.0);
  // with F = f at rest it swings on the spring about s, by f / k: the other limit is just touched
  (void)motion.advance(Instant{}.plus(turn + pi / (2.0 * omega)));
  EXPECT_NEAR(motion.state()[0], x - f / k, 1e-13);
  EXPECT_NEAR(motion.state()[1], -omega * f / k, 1e-13);
}

/// Masing's loop of two elements: of loading along F = sum min(k y, f), of unloading F = F_0 - 2 F((y_0 - y) / 2).
TEST(Jenkins, LoopsAreMasings) {
  const std::string two = element(3, 1, "['x', 'ground']", "a") + element(2, 1.6, "['x', 'ground']", "b");
  const System system(file(std::string(body) + two + "[[force]]\non = 'x'\namplitude = 0\nharmonic = 0\n").build());
  const auto load = [](double y) { return std::min(3 * y, 1.0) + std::min(2 * y, 1.6); };
  Motion motion(system, {0.0, 40.0, 0.0, 0.0, 0.0, 0.0});
  const auto force = [&](const State& s) {
    return std::clamp(3 * (s[0] - s[2]), -1.0, 1.0) + std::clamp(2 * (s[0] - s[4]), -1.6, 1.6);
  };
  double top = 0.0;
  int back = 0;
  for (int i = 1; i <= 10'000; ++i) {
    while (motion.advance(Instant{}.plus(0.01 * i)) == Outcome::event) {
    }
    const State s = motion.state();
    if (s[1] > 0.0 && back > 0) break;
    if (s[1] > 0.0) {
      EXPECT_NEAR(force(s), load(s[0]), 1e-12) << i;
      top = s[0] + s[1] * s[1] / 2.6;  // both slide: m v^2 / 2 = 2.6 (top - x)
    } else {
      EXPECT_NEAR(force(s), 2.6 - 2.0 * load(0.5 * (top - s[0])), 1e-9) << i;
      ++back;
    }
  }
  EXPECT_GT(back, 50);
}

/// What it takes in a cycle of the amplitude a is 4 f (a - f / k); what comes in is what it takes.
TEST(Jenkins, TakesTheAreaOfItsLoop) {
  const ModelDefinition model =
      file("omega = 0.9\n" + std::string(body) + "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 5\n" +
           element(3, 0.4) + "[[force]]\non = 'x'\namplitude = 2\n");
  const System system(model.build());
  const Classification found = classify(system, model.start());
  ASSERT_EQ(found.label, "1-0-I");
  ASSERT_EQ(found.multipliers.size(), 3u);
  EXPECT_LT(std::abs(found.multipliers[2]), 1e-12);  // the slider forgets
  Motion motion(system, model.start());
  while (motion.advance({300, 0.0}) == Outcome::event) {
  }
  std::vector<Quantity> of;
  for (const char* one : {"power_pad", "power_in", "x", "F_pad", "s_pad"})
    of.push_back(find_quantity(quantities(model.build()), one));
  const Measured cycle = measure(Motion(system, motion.state()), Instant{1, 0.0}, of);
  const double T = 2.0 * pi / 0.9, a = 0.5 * (cycle.of[2].greatest - cycle.of[2].least);
  EXPECT_NEAR(cycle.of[0].mean * T, 4.0 * 0.4 * (a - 0.4 / 3.0), 1e-11);
  EXPECT_NEAR(cycle.of[1].mean, cycle.of[0].mean, 1e-12);
  EXPECT_NEAR(cycle.of[3].greatest, 0.4, 1e-15);
  EXPECT_NEAR(cycle.of[3].least, -0.4, 1e-15);
  EXPECT_NEAR(cycle.of[4].greatest - cycle.of[4].least, 2.0 * (a - 0.4 / 3.0), 1e-12);
}

/// A slider that never slips is one of a family, and its element a spring.
TEST(Jenkins, OneThatNeverSlipsIsASpringOfAFamily) {
  const ModelDefinition model =
      file("omega = 0.9\n" + std::string(body) + spring + element(3, 50) +
           "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 1\n" + "[[force]]\non = 'x'\namplitude = 2\n");
  const System system(model.build());
  const Classification found = classify(system, model.start());
  EXPECT_EQ(found.label, "1-0-I");
  EXPECT_EQ(found.family, 1);
  const auto modes = natural_modes(system, sliding_states(system, model.start()));
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].frequency, 2.0, 1e-14);
}

/// A body that is let go comes to rest within what the slider holds, where it stays.
TEST(Jenkins, ABodyRestsWhereTheSliderHoldsIt) {
  const ModelDefinition model =
      file(std::string(body) + spring + element(3, 1) + "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 1\n" +
           "[[force]]\non = 'x'\namplitude = 0.5\nharmonic = 0\n[start]\nv = 0\nx = 0\n");
  State start = model.start();
  start[1] = 4.0;
  const Classification found = classify(System(model.build()), start);
  EXPECT_EQ(found.attractor, Attractor::equilibrium);
  EXPECT_EQ(found.family, 1);
}

/// A start that draws the slider beyond its limit lets it slip at once.
TEST(Jenkins, AStartBeyondTheLimitSlips) {
  const System system(file(std::string(body) + element(3, 1)).build());
  EXPECT_NEAR(Motion(system, {2.0, 0.0, 0.0, 0.0}).state()[2], 2.0 - 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(Motion(system, {-2.0, 0.0, 0.0, 0.0}).state()[2], -2.0 + 1.0 / 3.0, 1e-15);
}

/// A pair that is held at its limit rests: the slider neither slips nor is about to.
TEST(Jenkins, RestsWhereItsPairIsHeldAtTheLimit) {
  const System system(file(std::string(body) + element(3, 1) +
                           "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 2\nrestitution = 0\n"
                           "[[force]]\non = 'x'\namplitude = 5\nharmonic = 0\n")
                          .build());
  Motion motion(system, {0.0, 1.0, 0.0, 0.0});
  while (motion.advance(Instant{}.plus(50.0)) == Outcome::event) {
  }
  EXPECT_EQ(motion.state()[0], 2.0);
  EXPECT_NEAR(motion.state()[2], 2.0 - 1.0 / 3.0, 1e-15);
  EXPECT_EQ(motion.state()[3], 0.0);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "free|closed|pad:1");
}

/// Rows of pairs with ratios are inverted with rounding, which is no velocity of a slider that has turned back.
TEST(Jenkins, TurnsBackBesideAPairWithARatio) {
  for (const char* ratio : {"[1.5, 0.7]", "[1.5, 1.2]", "[1.7, -0.3]", "[1.6, 1.4]", "[1.6, -0.7]", "[1.3, -0.7]"}) {
    const ModelDefinition definition =
        file("omega = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n[[coordinate]]\nname = 'y'\nmass = 1\n" +
             element(1, 0.2, std::string("['x', 'y']\nratio = ") + ratio, "a") +
             element(3, 0.2, "['x', 'ground']", "b") + "[[force]]\non = 'y'\namplitude = 0.3\nphase = 2\n");
    const System system(definition.build());
    Motion motion(system, definition.start());
    while (motion.advance({20, 0.0}) == Outcome::event) {
    }
    EXPECT_EQ(motion.time().period, 20) << ratio;
  }
}

/// Two halves of an element begin and cease to slip at one instant, each by itself.
TEST(Jenkins, TwoHalvesAreTheWhole) {
  const auto found = [&](const std::string& parts) {
    const ModelDefinition definition =
        file("omega = 0.9\n" + std::string(body) + spring + parts + "[[force]]\non = 'x'\namplitude = 2\n");
    return classify(System(definition.build()), definition.start());
  };
  const Classification whole = found(element(3, 0.4)),
                       halves = found(element(1.5, 0.2) + element(1.5, 0.2, "['x', 'ground']", "b"));
  EXPECT_EQ(halves.label, whole.label);
  ASSERT_EQ(halves.multipliers.size(), whole.multipliers.size() + 1);
  for (std::size_t i = 0; i < whole.multipliers.size(); ++i)
    EXPECT_LT(std::abs(halves.multipliers[i] - whole.multipliers[i]), 1e-12) << i;
}

TEST(Jenkins, RefusesWhatHasNoMeaning) {
  const auto message = [&](const std::string& parts) {
    try {
      const ModelDefinition definition = file(std::string(body) + parts);
      (void)definition.build();
      (void)definition.start();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(element(0, 1)).find("jenkins 'pad': stiffness = 0 is not a positive"), std::string::npos);
  EXPECT_NE(message(element(1, -1)).find("jenkins 'pad': limit = -1 is not a positive"), std::string::npos);
  EXPECT_NE(message(element(1, 1) + "[start]\nv_s_pad = 1\n").find("'v_s_pad' follows"), std::string::npos);
  EXPECT_EQ(message(element(1, 1) + "[start]\ns_pad = 1\n"), "");
  Model model = file(std::string(body) + element(1, 1)).build();
  model.characteristics[0].slope_above = 1.0;
  EXPECT_THROW(validate(model), InputError);
  model.characteristics[0].slope_above = 0.0;
  model.dampers.push_back({1, ground, 1.0});
  EXPECT_THROW(validate(model), InputError);
}

TEST(Jenkins, ExponentsForgetWhereItSlips) {
  const ModelDefinition model =
      file("omega = 0.9\n" + std::string(body) + "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 5\n" +
           element(3, 0.4) + "[[force]]\non = 'x'\namplitude = 2\n");
  const LyapunovExponents found = lyapunov(System(model.build()), model.start(), {.most_periods = 300});
  ASSERT_EQ(found.per_period.size(), 3u);
  EXPECT_LT(found.per_period[0], 0.0);
  EXPECT_TRUE(std::isinf(found.per_period[2]));
  EXPECT_TRUE(found.sum_rule_holds());
}

}  // namespace
}  // namespace slapstick::testing
