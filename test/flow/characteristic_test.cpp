/// Piecewise-linear springs, dampers and friction against closed forms, and against the same physics written otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// One mass of 1 with the given parts.
System one_mass(const std::string& parts) {
  return System(ModelDefinition::parse("name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\n" + parts, "f.toml").build());
}

State state_after(const System& system, const State& start, double time) {
  Motion motion(system, start);
  run(motion, time);
  return motion.state();
}

const char* const trilinear =
    "[[spring]]\nbetween = ['x', 'ground']\ncharacteristic = [[-1, -1], [1, 1]]\nslope_below = 4\nslope_above = 4\n";

/// Inside a circle of radius sqrt(1 + v^2), outside an ellipse round 3/4 with frequency 2.
TEST(Characteristic, PeriodOfAFreeTrilinearSpring) {
  const double a = 1.25, outside = std::acos(0.25 / a) / 2.0;
  const double v = 2.0 * std::sqrt(a * a - 0.0625), inside = std::atan2(1.0, v);
  const System system = one_mass(trilinear);
  Motion motion(system, {2.0, 0.0});
  const std::vector<Event> events = run(motion, 4.0 * (outside + inside));
  ASSERT_EQ(kinds(events), "corner corner corner corner");
  EXPECT_NEAR(seconds(events[0], motion), outside, 1e-15);
  EXPECT_NEAR(events[0].w, -v, 1e-14);
  EXPECT_NEAR(seconds(events[1], motion), outside + 2.0 * inside, 1e-14);
  EXPECT_NEAR(motion.state()[0], 2.0, 1e-14);
  EXPECT_NEAR(motion.state()[1], 0.0, 1e-13);
}

TEST(Characteristic, EnergyOfAFreeTrilinearSpringStays) {
  const System system = one_mass(trilinear);
  const State end = state_after(system, {2.0, 0.0}, 5000.0);
  const double x = std::abs(end[0]);
  const double potential = x < 1.0 ? 0.5 * x * x : 0.5 + (x - 1.0) + 2.0 * (x - 1.0) * (x - 1.0);
  EXPECT_NEAR(0.5 * end[1] * end[1] + potential, 3.5, 1e-11);
}

/// A spring with play: the mass drifts through |x| < b at its speed, and turns in half a period of sqrt(k).
TEST(Characteristic, ASpringWithPlayDriftsThroughIt) {
  const System system = one_mass(
      "[[spring]]\nname = 'play'\nbetween = ['x', 'ground']\ncharacteristic = [[-0.5, 0], [0.5, 0]]\n"
      "slope_below = 9\nslope_above = 9\n");
  Motion motion(system, {0.0, 0.4});
  const std::vector<Event> events = run(motion, 2.0 * (1.0 / 0.4 + pi / 3.0) - 1e-3);
  ASSERT_EQ(kinds(events), "corner corner corner corner");
  const double expected[] = {1.25, 1.25 + pi / 3.0, 3.75 + pi / 3.0, 3.75 + 2.0 * pi / 3.0};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(seconds(events[static_cast<std::size_t>(i)], motion), expected[i], 1e-14);
}

/// A motion that just reaches a corner stays what it was: the force is continuous.
TEST(Characteristic, AMotionThatTouchesACornerTurnsThere) {
  const System system = one_mass(trilinear);
  for (const double reach : {1.0, 1.0 - 1e-15, 1.0 + 1e-15}) {
    const State end = state_after(system, {reach, 0.0}, 2.0 * pi);
    EXPECT_NEAR(end[0], 1.0, 1e-14) << reach;
    EXPECT_NEAR(end[1], 0.0, 1e-12) << reach;
  }
}

/// The period of a Duffing-like spring of many corners tends to that of the smooth one, with the square of the spacing.
/// x'' + x^3 = 0 from x = 1: T = 7.41629870920549 (complete elliptic integral, 4 K(1/sqrt 2)).
TEST(Characteristic, APolylineConvergesToASmoothSpringWithTheSquareOfItsSpacing) {
  const double smooth = 7.416298709205487673735401;
  std::vector<double> errors;
  for (const int pieces : {8, 16, 32}) {
    std::string points;
    for (int i = -pieces; i <= pieces; ++i) {
      const double x = static_cast<double>(i) / pieces;
      points += (points.empty() ? "[" : ", [") + std::to_string(x) + ", '(" + std::to_string(i) + "/" +
                std::to_string(pieces) + ")^3']";
    }
    const System system = one_mass("[[spring]]\nbetween = ['x', 'ground']\ncharacteristic = [" + points + "]\n");
    Motion motion(system, {1.0, 0.0});
    run(motion, smooth);
    errors.push_back(std::abs(motion.state()[1]));
  }
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.4);
  EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.2);
}

/// v' = -f(v): exponentials with another rate beyond v = 1.
TEST(Characteristic, AMassThatADamperOfTwoRatesStops) {
  const System system = one_mass(
      "[[damper]]\nname = 'valve'\nbetween = ['x', 'ground']\ncharacteristic = [[0, 0], [1, 0.5]]\nslope_above = 2\n");
  // v' = -0.5 - 2 (v - 1) above 1: v = 0.75 + 2.25 exp(-2 t) from v = 3
  const double corner = std::log(2.25 / 0.25) / 2.0;
  Motion motion(system, {0.0, 3.0});
  const std::vector<Event> events = run(motion, corner + 1.0);
  ASSERT_EQ(kinds(events), "corner");
  EXPECT_NEAR(seconds(events[0], motion), corner, 1e-15);
  EXPECT_NEAR(motion.state()[1], std::exp(-0.5), 1e-15);
  EXPECT_NEAR(motion.state()[0], 0.75 * corner + 1.125 * (1.0 - std::exp(-2.0 * corner)) + 2.0 * (1.0 - std::exp(-0.5)),
              1e-14);
}

std::string on_a_belt(double damping, double speed) {
  return "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[damper]]\nbetween = ['x', 'ground']\ncoefficient = " +
         std::to_string(damping) +
         "\n[[friction]]\nname = 'belt'\nbetween = ['x', 'ground']\nstatic = 1\n"
         "characteristic = [[0, 1], [1, 0.6], [2, 0.5]]\nbelt_speed = " +
         std::to_string(speed) + "\n";
}

/// Steady sliding loses its stability where the falling slope of the friction is larger than the damping. Beside it the
/// motion is a spiral of rate (slope - damping) / 2 as long as no corner is reached.
TEST(Characteristic, SteadySlidingIsUnstableWhereFrictionFallsFasterThanDampingRises) {
  for (const double damping : {0.3, 0.4, 0.5}) {
    const System system = one_mass(on_a_belt(damping, 0.5));
    const double rate = 0.5 * (0.4 - damping), turn = std::sqrt(1.0 - rate * rate);
    const double rest = 0.8;  // of the spring against the friction at the belt's speed
    const State end = state_after(system, {rest + 1e-3, rate * 1e-3}, 2.0 * pi / turn);
    EXPECT_NEAR(end[0] - rest, 1e-3 * std::exp(rate * 2.0 * pi / turn), 1e-14) << damping;
  }
}

/// Two blocks that static friction holds together are drawn apart by forces that kinetic friction could not bear. A
/// corner over the velocity of one of them is no reason to let go: beyond it 2 v' = 2 - 0.1 (v - 0.5).
TEST(Characteristic, ACornerDoesNotEndStick) {
  const System system(
      ModelDefinition::parse(
          "name = 'm'\n[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'x2'\nmass = 1\n"
          "[[force]]\non = 'x1'\namplitude = -1\nharmonic = 0\n[[force]]\non = 'x2'\namplitude = 3\nharmonic = 0\n"
          "[[friction]]\nname = 'pad'\nbetween = ['x1', 'x2']\nstatic = 10\nkinetic = 0\n"
          "[[damper]]\nname = 'air'\nbetween = ['x1', 'ground']\ncharacteristic = [[-1, 0], [0.5, 0]]\n"
          "slope_above = 0.1\n",
          "f.toml")
          .build());
  Motion motion(system, {0.0, 0.0, 0.0, 0.0});
  ASSERT_EQ(kinds(run(motion, 2.5)), "corner");
  EXPECT_NEAR(motion.state()[1], 0.5 + 20.0 * (1.0 - std::exp(-0.1)), 1e-14);
  EXPECT_EQ(motion.state()[1], motion.state()[3]);
}

/// Falling friction, damping below its slope: a spiral, then stick with every cycle; the belt carries the mass.
TEST(Characteristic, FallingFrictionEndsInStickSlip) {
  const System system = one_mass(on_a_belt(0.1, 0.5));
  Motion motion(system, {0.81, 0.0});
  run(motion, 400.0);
  const std::vector<Event> events = run(motion, 40.0);
  long sticks = 0, corners = 0;
  std::vector<double> releases;
  for (const Event& event : events) {
    sticks += event.kind == EventKind::stick;
    corners += event.kind == EventKind::corner;
    if (event.kind == EventKind::release) releases.push_back(seconds(event, motion));
  }
  ASSERT_GE(releases.size(), 4U);
  EXPECT_GE(sticks, 4);
  EXPECT_EQ(corners % 2, 0);
  EXPECT_NEAR(releases[2] - releases[1], releases[1] - releases[0], 1e-12);  // one period like the other, exactly
}

/// Roots of the closed forms of the pieces, to 35 digits by mpmath (docs/models/falling-friction.md has the equations).
TEST(Characteristic, PeriodOfStickSlipWithFallingFriction) {
  const ModelDefinition model = load_model("falling-friction");
  const System system(model.build());
  Motion motion(system, {1.1, 0.5});  // the belt lets go: x + 2 z v0 = f_s
  const std::vector<Event> events = run(motion, 6.713055621534054);
  ASSERT_GE(events.size(), 3U);
  const std::string all = kinds(events);
  EXPECT_NE(all.find("corner corner stick"), std::string::npos) << all;
  for (std::size_t i = 0; i + 2 < events.size(); ++i) {
    if (events[i].kind != EventKind::corner || events[i + 1].kind != EventKind::corner) continue;
    EXPECT_NEAR(seconds(events[i], motion), 1.9417596614893299, 1e-14);
    EXPECT_NEAR(seconds(events[i + 1], motion), 1.9417596614893299 + 1.5329199526238855, 2e-14);
    EXPECT_NEAR(seconds(events[i + 2], motion), 4.9137897681732285, 2e-14);
  }
  EXPECT_NEAR(motion.state()[0], 1.1, 1e-14);
}

/// The same force as a compliant stop without damping: the same motion, multipliers and class.
TEST(Characteristic, ABentSpringIsACompliantStopWithoutDamping) {
  const ModelDefinition known = load_model("bilinear-oscillator");
  const Overrides values = {{"clearance", 0.0}, {"contact_damping", 0.0}};
  const auto own = known.values(values);
  const auto number = [&](const char* name) { return shown(own.at(name)); };
  const ModelDefinition bent = ModelDefinition::parse(
      "name = 'bent'\nomega = " + number("omega") +
          "\n[[coordinate]]\nname = 'x'\nmass = 1\n[[spring]]\nbetween = ['x', 'ground']\ncharacteristic = [[-1, -1], "
          "[0, 0]]\n"
          "slope_above = '1 + " +
          number("stiffness_ratio") + "'\n[[damper]]\nbetween = ['x', 'ground']\ncoefficient = '2 * " +
          number("damping_ratio") + "'\n[[force]]\non = 'x'\namplitude = " + number("amplitude") +
          "\nphase = 'pi / 2'\n",
      "f.toml");
  const System first(known.build(values)), second(bent.build());
  Motion stop(first, {0.3, -0.2}), spring(second, {0.3, -0.2});
  run(stop, 100.0), run(spring, 100.0);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(stop.state()[i], spring.state()[i], 1e-12);
  const Classification with_stop = classify(first, {0.3, -0.2}), with_spring = classify(second, {0.3, -0.2});
  ASSERT_EQ(with_spring.attractor, Attractor::periodic);
  EXPECT_EQ(with_spring.n, with_stop.n);
  EXPECT_EQ(with_spring.p, 0);  // a corner is no impact
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(std::abs(with_spring.multipliers[i] - with_stop.multipliers[i]), 0.0, 1e-11);
}

/// The exponents' sum is the mean trace, also where a damper feeds energy at small speeds.
TEST(Characteristic, ASelfExcitedOscillatorSettlesOnACycle) {
  const System system = one_mass(
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[damper]]\nbetween = ['x', 'ground']\n"
      "characteristic = [[-1, 0.2], [1, -0.2]]\nslope_below = 0.5\nslope_above = 0.5\n");
  Motion motion(system, {0.1, 0.0});
  run(motion, 600.0);
  std::vector<double> corners;
  for (const Event& event : run(motion, 40.0)) corners.push_back(seconds(event, motion));
  ASSERT_GE(corners.size(), 12U);
  for (std::size_t i = 0; i + 8 < corners.size(); ++i)
    EXPECT_NEAR(corners[i + 8] - corners[i + 4], corners[i + 4] - corners[i], 1e-11);
}

/// The mass cannot go beyond the stop, and so not beyond a corner there, whichever contact numbers the pair.
/// Rounding of one number less another may not tell that it does.
TEST(Characteristic, ACornerAtAStopIsNeverPassed) {
  const auto corners = [](const std::string& points, const std::string& upper, const std::string& lower) {
    const std::string pair = "between = ['x', 'ground']\n";
    const std::string text =
        "name = 'm'\nomega = 1.3\n[[coordinate]]\nname = 'x'\nmass = 1\n[[force]]\non = 'x'\namplitude = 1.5\n"
        "[[damper]]\n" +
        pair + "coefficient = 0.1\n[[spring]]\n" + pair + "characteristic = " + points + "\n[[stop]]\nname = 'w'\n" +
        pair + "two_sided = true\nrestitution = 0.7\nclearance = " + upper + "\nclearance_lower = " + lower +
        "\n[[friction]]\nname = 'f'\n" + pair + "static = 0.1\n";
    const System system(ModelDefinition::parse(text, "f.toml").build());
    Motion motion(system, {0.0, 0.0});
    const std::vector<Event> events = run(motion, 200.0 * system.period());
    EXPECT_GT(std::ranges::count(events, EventKind::impact, &Event::kind), 200);
    return std::ranges::count(events, EventKind::corner, &Event::kind);
  };
  for (const std::string near : {"0.05", "0.1", "0.12", "0.14", "0.15", "0.3"}) {
    EXPECT_EQ(corners("[[-1, -1], [0.3, 0.3], [1, 3]]", "0.3", near), 0) << near;
    EXPECT_EQ(corners("[[-1, -3], [-0.3, -0.3], [1, 1]]", near, "0.3"), 0) << near;
  }
}

}  // namespace
}  // namespace slapstick::testing
