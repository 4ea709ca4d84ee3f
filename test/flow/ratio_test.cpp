/// Links between coordinates at the ends of levers and gears, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::testing {
namespace {

/// A pinion of inertia 2 and a wheel of inertia 3.
ModelDefinition gears(const std::string& parts) {
  return ModelDefinition::parse(
      "name = 'gears'\n[[coordinate]]\nname = 'x1'\nmass = 2\n[[coordinate]]\nname = 'x2'\nmass = 3\n" + parts,
      "f.toml");
}

constexpr double r_a = 0.5, r_b = -1.25;
/// What a force along y moves: 1 / m = r_a^2 / 2 + r_b^2 / 3.
constexpr double inverse_mass = r_a * r_a / 2.0 + r_b * r_b / 3.0;

std::string mesh(const std::string& kind, const std::string& more) {
  return "[[" + kind + "]]\nname = 'mesh'\nbetween = ['x1', 'x2']\nratio = [0.5, -1.25]\n" + more + "\n";
}

/// omega^2 = k / m, and the rotation in which y does not change.
TEST(Ratio, OfASpringMakesTheClosedFrequencyAndAFreeRotation) {
  const System system(gears(mesh("spring", "stiffness = 7")).build());
  const auto modes = natural_modes(system, sliding_states(system, {0.0, 0.0, 0.0, 0.0}));
  ASSERT_EQ(modes.size(), 3U);
  EXPECT_NEAR(modes.back().frequency, std::sqrt(7.0 * inverse_mass), 1e-14);
  Motion motion(system, {1.0, -2.5, 0.4, 1.0});  // 0.5 * 1 + 1.25 * 0.4 = 1, and y' = 0
  const double from = 0.5 * 1.0 + 1.25 * 0.4, omega = std::sqrt(7.0 * inverse_mass), time = 1.7;
  while (motion.advance(Instant{}.plus(time / system.period())) == Outcome::event) {
  }
  const State& at = motion.state();
  EXPECT_NEAR(r_a * at[0] - r_b * at[2], from * std::cos(omega * time), 1e-13);
  EXPECT_NEAR(at[1] * 2.0 / r_a + at[3] * 3.0 / r_b, -2.5 * 2.0 / r_a + 3.0 / r_b, 1e-13);  // no torque has part in it
}

/// P = (1 + r) y' m; the one end gets -r_a P, the other r_b P.
TEST(Ratio, OfAStopSharesTheBlow) {
  const System system(gears(mesh("stop", "clearance = 1\nrestitution = 0.6")).build());
  Motion motion(system, {0.0, 2.0, 0.0, 0.8});
  const double speed = r_a * 2.0 - r_b * 0.8, momentum = 1.6 * speed / inverse_mass;
  ASSERT_EQ(motion.advance(Instant{}.plus(10.0)), Outcome::event);
  EXPECT_NEAR(motion.time().seconds(system.period()), 1.0 / speed, 1e-15);
  EXPECT_NEAR(motion.event().w, speed, 1e-14);
  EXPECT_NEAR(motion.state()[1], 2.0 - r_a * momentum / 2.0, 1e-14);
  EXPECT_NEAR(motion.state()[3], 0.8 + r_b * momentum / 3.0, 1e-14);
}

/// Friction along y brings y' to rest after y' m / f, and holds the gears together.
TEST(Ratio, OfFrictionStopsTheTeethAndHoldsThem) {
  const System system(
      gears(mesh("friction", "static = 0.4") + "[[force]]\non = 'x1'\namplitude = 0.1\nharmonic = 0\n").build());
  Motion motion(system, {0.0, 1.0, 0.0, 0.5});
  const double speed = r_a * 1.0 - r_b * 0.5, slows = 0.4 * inverse_mass - 0.1 * r_a / 2.0;
  ASSERT_EQ(motion.advance(Instant{}.plus(10.0)), Outcome::event);
  EXPECT_EQ(motion.event().kind, EventKind::stick);
  EXPECT_NEAR(motion.time().seconds(system.period()), speed / slows, 1e-13);
  while (motion.advance(Instant{}.plus(20.0)) == Outcome::event) {
  }
  EXPECT_NEAR(r_a * motion.state()[1] - r_b * motion.state()[3], 0.0, 1e-14);
}

/// Both sides of a two-sided stop, and a compliant stop beside it, are on one pair.
TEST(Ratio, OfATwoSidedStopHoldsOnBothSides) {
  const System system(
      gears(mesh("stop", "clearance = 1\nclearance_lower = 0.5\ntwo_sided = true\nrestitution = 1")).build());
  Motion motion(system, {0.0, 2.0, 0.0, 0.0});
  std::vector<double> at;
  while (at.size() < 4 && motion.advance(Instant{}.plus(100.0)) == Outcome::event)
    at.push_back(r_a * motion.state()[0] - r_b * motion.state()[2]);
  ASSERT_EQ(at.size(), 4U);
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(at[i], i % 2 == 0 ? 1.0 : -0.5, 1e-14);
}

/// A press that holds two bodies together by a ratio whose y is rounded.
/// @param scaled  0.7 x1 and 0.3 x2 are the coordinates, and the stop has no ratio
ModelDefinition press(bool scaled, double amplitude, double clearance) {
  const auto number = [](double value) { return std::to_string(value); };
  const double a = scaled ? 0.7 : 1.0, b = scaled ? 0.3 : 1.0;
  const auto spring = [&](const std::string& x, double k, double by) {
    return "[[spring]]\nbetween = ['" + x + "', 'ground']\nstiffness = '" + number(k) + " / " + number(by * by) + "'\n";
  };
  const std::string force = "[[force]]\non = 'x1'\namplitude = '" + number(amplitude) + " / " + number(a) +
                            "'\nharmonic = 1\n[[force]]\non = 'x1'\namplitude = '1.5 / " + number(a) +
                            "'\nharmonic = 0\n";
  return ModelDefinition::parse(
      "name = 'press'\nomega = 1\n[[coordinate]]\nname = 'x1'\nmass = '1 / " + number(a * a) +
          "'\n[[coordinate]]\nname = 'x2'\nmass = '1 / " + number(b * b) + "'\n" + force + spring("x1", 0.3, a) +
          spring("x2", 0.2, b) + "[[damper]]\nbetween = ['x2', 'ground']\ncoefficient = '0.2 / " + number(b * b) +
          "'\n[[stop]]\nname = 's'\nbetween = ['x1', 'x2']\nrestitution = 0.5\nclearance = " + number(clearance) +
          (scaled ? "\n" : "\nratio = [0.7, 0.3]\n"),
      "f.toml");
}

/// A state that is written out and read back is held as before: 0.7 x1 and 0.3 x2 are not each other's to the last bit.
TEST(Ratio, OfBodiesThatAreHeldIsReadBackAsHeld) {
  for (const double clearance : {0.0, 0.1})
    for (const double amplitude : {0.1, 0.23, 0.5, 0.9, 1.1, 1.2}) {
      const auto settles = [&](bool scaled) {
        const System system(press(scaled, amplitude, clearance).build());
        return classify(system, {0.0, 0.0, 0.0, 0.0}).label;
      };
      EXPECT_EQ(settles(true), "1-0-II") << amplitude << ", " << clearance;
      EXPECT_EQ(settles(false), "1-0-II") << amplitude << ", " << clearance;
    }
}

/// A closed stop bears blows on a body, and friction on it stays at rest, although 3 x is rounded.
TEST(Ratio, OfAClosedStopBearsABlowWhole) {
  const ModelDefinition held = ModelDefinition::parse(
      "name = 'held'\nomega = 0\n[[coordinate]]\nname = 'x1'\nmass = 24.18292231253241\n[[coordinate]]\nname = 'x2'\n"
      "mass = 1\n[[impulse]]\nname = 'blow'\non = 'x1'\nmomentum = 0.6\ntime = 1\nperiod = 3\n[[friction]]\nname = "
      "'pad'\nbetween = ['x1', 'x2']\nratio = [3, 1]\nstatic = 1\nkinetic = 0.5\n[[stop]]\nname = 'wall'\nbetween = "
      "['x1', 'ground']\nratio = [3, 1]\nclearance = 0\nrestitution = 0\n",
      "f.toml");
  const System system(held.build());
  Motion motion(system, {0.0, 0.0, -0.13660288195821463, 0.0});
  const std::vector<Event> events = run(motion, 15.0);
  EXPECT_GE(events.size(), 5U);  // the blows at 1, 4, 7, 10 and 13
  for (const Event& event : events) EXPECT_EQ(event.kind, EventKind::knot);
  EXPECT_EQ(motion.state()[3], 0.0);
}

TEST(Ratio, ThatMeansNothingIsRefusedInOneLine) {
  const auto refused = [](const std::string& parts, const std::string& says) {
    try {
      (void)gears(parts).build();
      ADD_FAILURE() << parts;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  };
  const std::string spring = "[[spring]]\nbetween = ['x1', 'x2']\nstiffness = 1\n";
  refused(spring + "ratio = [1, 0]\n", "1e-6 .. 1e6");
  refused(spring + "ratio = [1e4, 1e-4]\n", "quotient");
  refused(spring + "ratio = [1, 2, 3]\n", "found 3 numbers");
  refused(mesh("stop", "clearance = 1\nrestitution = 0") +
              "[[friction]]\nname = 'rub'\nstatic = 1\nbetween = ['x2', 'x1']\nratio = [-2.5, 1]\n",
          "multiple of that of 'rub'");
  refused(
      mesh("stop", "clearance = 1\nrestitution = 0") +
          "[[stop]]\nname = 'face'\nbetween = ['x1', 'x2']\nratio = [-0.5, 1.25]\nclearance = -1\nrestitution = 0\n",
      "leaves no room");
  refused("[parameters]\np = 2\n" + spring + "ratio = [1, 'p']\n", "plain number");
  refused(
      "[[base]]\nname = 'table'\nharmonics = [{ amplitude = 1 }]\n[[spring]]\nbetween = ['x1', 'table']\nstiffness = "
      "1\n"
      "ratio = [1, 2]\n",
      "stand still with the ground");
}

/// Where a belt comes to stick, a body that nothing touches stays: the rounding of 1.5 / 1.2 is no dependence.
TEST(Ratio, RoundingOfAQuotientLetsNoBodyMove) {
  const ModelDefinition definition = ModelDefinition::parse(
      "name = 'm'\n[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'x2'\nmass = 1\n"
      "[[coordinate]]\nname = 'x3'\nmass = 1\n"
      "[[friction]]\nname = 'fr'\nbetween = ['x1', 'x2']\nstatic = 0.3\nbelt_speed = -0.04\n"
      "[[stop]]\nname = 'st'\nbetween = ['x1', 'x2']\nclearance = 0.1\nrestitution = 0.5\n"
      "[[stop]]\nname = 'a'\nbetween = ['x1', 'x3']\nratio = [1.5, -1.2]\nclearance = 1\nrestitution = 0.5\n"
      "[[stop]]\nname = 'b'\nbetween = ['x1', 'ground']\nclearance = 1\nrestitution = 0.5\n[start]\nv2 = 0.1\n",
      "f.toml");
  const System system(definition.build());
  Motion motion(system, definition.start());
  while (motion.advance(Instant{}.plus(1.0)) == Outcome::event) {
  }
  EXPECT_EQ(motion.state()[4], 0.0);
  EXPECT_EQ(motion.state()[5], 0.0);
}

}  // namespace
}  // namespace slapstick::testing
