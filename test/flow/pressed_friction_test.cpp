/// Friction contacts that functions of time press, against closed forms: m v' = -mu N(t) while one slips.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::testing {
namespace {

constexpr double pi = std::numbers::pi;

ModelDefinition file(const std::string& parts) { return ModelDefinition::parse("name = 'm'\n" + parts, "f.toml"); }

const char* const mass = "[[coordinate]]\nname = 'x'\nmass = 1\n";
const char* const push = "[[force]]\non = 'x'\namplitude = 1\nharmonic = 0\n";

/// mu = 0.5 at rest, 0.25 in slip.
std::string pad(const std::string& constant) {
  return "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.5\nkinetic = 0.25\nnormal_force = { "
         "constant = " +
         constant + " }\n";
}

std::string pressed(const std::string& by) { return "[[force]]\non = 'pad'\n" + by + "\n"; }

std::string signal(const std::string& points) { return "[[signal]]\nname = 'pedal'\npoints = " + points + "\n"; }

/// N = 3 + 2 sin 2 t, in one force and in two: the speed that is lost is a quarter of its integral.
TEST(PressedFriction, AHarmonicTakesItsIntegral) {
  for (const std::string& by :
       {pad("3") + pressed("amplitude = 2"),
        pad("0") + pressed("amplitude = 3\nharmonic = 0") + pressed("amplitude = -2\nphase = 'pi'"),
        pad("3") + pressed("amplitude = 2\nfrequency = 2")}) {
    const System system(file("omega = 2\n" + std::string(mass) + by).build());
    Motion motion(system, {0.0, 10.0});
    EXPECT_TRUE(run(motion, 5.0).empty());
    EXPECT_NEAR(motion.state()[1], 10.0 - 0.25 * (15.0 + 1.0 - std::cos(10.0)), 1e-14);
    EXPECT_NEAR(motion.state()[0], 50.0 - 0.25 * (37.5 + 5.0 - std::sin(10.0) / 2.0), 1e-13);
  }
}

/// Over a period of N = 3 + 2 sin 2 t, and a quarter of it as the force of the slip.
TEST(PressedFriction, ItsNormalForceIsMeasured) {
  const ModelDefinition model = file("omega = 2\n" + std::string(mass) + pad("3") + pressed("amplitude = 2"));
  const Quantity N = find_quantity(quantities(model), "N_pad"), F = find_quantity(quantities(model), "F_pad");
  const Measured found = measure(Motion(System(model.build()), {0.0, 10.0}), Instant{}.plus(3.0), {N, F});
  for (const auto& [of, size] : {std::pair(found.of[0], 1.0), std::pair(found.of[1], 0.25)}) {
    EXPECT_NEAR(of.mean, 3.0 * size, 1e-14);
    EXPECT_NEAR(of.rms, std::sqrt(11.0) * size, 1e-14);
    EXPECT_NEAR(of.least, size, 1e-14);
    EXPECT_NEAR(of.greatest, 5.0 * size, 1e-14);
  }
}

/// The mass stops where the integral has taken its whole speed, and stays.
TEST(PressedFriction, ABrakeStopsWhereItsIntegralIsTheSpeed) {
  const System system(file("omega = 2\n" + std::string(mass) + pad("3") + pressed("amplitude = 2")).build());
  Motion motion(system, {0.0, 2.0});
  const std::vector<Event> events = run(motion, 20.0);
  ASSERT_EQ(kinds(events), "stick");
  const double t = seconds(events[0], motion);
  EXPECT_NEAR(0.25 * (3.0 * t + 1.0 - std::cos(2.0 * t)), 2.0, 1e-14);
}

/// N = sin t is negative in every second half: nothing presses there, and in the others the contact takes mu 2.
TEST(PressedFriction, ANegativeForceDoesNotPull) {
  const System system(file("omega = 1\n" + std::string(mass) + pad("0") + pressed("amplitude = 1")).build());
  Motion motion(system, {0.0, 5.0});
  const std::vector<Event> events = run(motion, 6.0 * pi - 0.5);
  ASSERT_EQ(kinds(events), "unload load unload load unload");
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(seconds(events[static_cast<std::size_t>(i)], motion), (i + 1) * pi, 1e-14);
  EXPECT_NEAR(motion.state()[1], 5.0 - 3.0 * 0.5, 1e-14);
}

/// A push of 1 is held until 0.5 N = 0.5 (4 - t) has fallen to it, at 2; then v' = 1 - 0.25 (4 - t). At 4 the brake is
/// off, and stays off.
TEST(PressedFriction, ABrakeThatIsReleasedLetsGo) {
  const System system(file(std::string(mass) + push + pad("0") + signal("[[0, 4], [4, 0]]") +
                           pressed("amplitude = 1\nsignal = 'pedal'"))
                          .build());
  Motion motion(system, {0.0, 0.0});
  std::vector<Event> events = run(motion, 3.0);
  ASSERT_EQ(kinds(events), "release");
  EXPECT_NEAR(seconds(events[0], motion), 2.0, 1e-15);
  EXPECT_NEAR(motion.state()[1], 0.125 * 5.0, 1e-15);
  events = run(motion, 7.0);
  ASSERT_EQ(kinds(events), "unload knot");
  EXPECT_NEAR(seconds(events[0], motion), 4.0, 1e-14);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "unloaded");
  EXPECT_NEAR(motion.state()[1], 0.125 * 12.0 + 6.0, 1e-14);
}

/// Two masses stand at walls, and the pads that hold them too are let off at pi: both rows say the same.
TEST(PressedFriction, TwoThatAreLetOffAtOnceAreBothUnloaded) {
  std::string machine = "omega = 1\n";
  for (const std::string name : {"x", "y"})
    machine += "[[coordinate]]\nname = '" + name + "'\nmass = 1\n[[force]]\non = '" + name +
               "'\namplitude = 1\nharmonic = 0\n[[stop]]\nname = 'wall_" + name + "'\nbetween = ['" + name +
               "', 'ground']\nclearance = 0\nrestitution = 0.5\n[[friction]]\nname = 'pad_" + name + "'\nbetween = ['" +
               name + "', 'ground']\nstatic = 0.5\nnormal_force = { constant = 0 }\n" + "[[force]]\non = 'pad_" + name +
               "'\namplitude = 1\n";
  const System system(file(machine).build());
  Motion motion(system, {0.0, 0.0, 0.0, 0.0});
  const std::vector<Event> events = run(motion, 4.0);
  ASSERT_EQ(kinds(events), "unload unload");
  for (const Event& event : events) EXPECT_NEAR(seconds(event, motion), pi, 1e-15);
}

/// A step from 3 to 1 at t = 1 lets the push win, and one to 10 at t = 3 stops the mass: 1.5 = (2.5 - 1) s.
TEST(PressedFriction, AStepLetsGoAndCatches) {
  const System system(file(std::string(mass) + push + pad("0") +
                           signal("[[0, 3], [1, 3], [1, 1], [3, 1], [3, 10], [9, 10]]") +
                           pressed("amplitude = 1\nsignal = 'pedal'"))
                          .build());
  Motion motion(system, {0.0, 0.0});
  std::vector<Event> events = run(motion, 2.9);
  EXPECT_NEAR(motion.state()[1], 0.75 * 1.9, 1e-15);
  events = run(motion, 6.0);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().kind, EventKind::stick);
  EXPECT_NEAR(seconds(events.back(), motion), 4.0, 1e-15);
  EXPECT_EQ(motion.state()[1], 0.0);
  EXPECT_NEAR(motion.state()[0], 1.5 + 0.75, 1e-15);
}

/// Fixed limits are those of a contact that a force of 1 presses: by the file, and by the modes.
TEST(PressedFriction, AConstantForceGivesTheMotionOfFixedLimits) {
  const std::string rest = "omega = 1.3\n" + std::string(mass) +
                           "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[force]]\non = 'x'\namplitude = 3\n"
                           "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.5\nkinetic = 0.25\n";
  const ModelDefinition fixed = file(rest);
  const ModelDefinition loaded =
      file(rest + "normal_force = { constant = 0.4 }\n" + pressed("amplitude = 0.6\nharmonic = 0"));
  const System one(fixed.build()), other(loaded.build());
  Motion a(one, {1.0, 0.0}), b(other, {1.0, 0.0});
  const std::vector<Event> first = run(a, 200.0), second = run(b, 200.0);
  ASSERT_EQ(kinds(first), kinds(second));
  ASSERT_GT(first.size(), 20U);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(seconds(first[i], a), seconds(second[i], b), 1e-12);
  const Classification of_one = classify(one, {1.0, 0.0}), of_other = classify(other, {1.0, 0.0});
  EXPECT_EQ(of_one.label, of_other.label);
  ASSERT_EQ(of_one.multipliers.size(), of_other.multipliers.size());
  for (std::size_t i = 0; i < of_one.multipliers.size(); ++i)
    EXPECT_LT(std::abs(of_one.multipliers[i] - of_other.multipliers[i]), 1e-12);
}

/// What presses does no work: what the push on x gives is lost in the pad, or stored.
TEST(PressedFriction, WhatPressesDoesNoWork) {
  const ModelDefinition brake = file("omega = 2\n" + std::string(mass) + push + pad("3") + pressed("amplitude = 2"));
  const System system(brake.build());
  const Instant end = Instant{}.plus(3.0 / system.period());
  const double v = 9.0;
  Motion motion(system, {0.0, v});
  const std::vector<Quantity> all = quantities(system.model());
  const Measured found = measure(motion, end, {find_quantity(all, "power_in"), find_quantity(all, "power_pad")});
  Motion again(system, {0.0, v});
  run(again, 3.0);
  const double x = again.state()[0], after = again.state()[1];
  EXPECT_NEAR(3.0 * found.of[0].mean, x, 1e-13);  // the push alone
  EXPECT_NEAR(3.0 * found.of[1].mean, x - 0.5 * (after * after - v * v), 1e-13);
}

std::string refusal(const std::string& parts) {
  try {
    (void)file(parts).build();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PressedFriction, WhatNothingPressesIsRefusedWithItsLine) {
  const std::string fixed = "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 1\n";
  EXPECT_NE(refusal("omega = 1\n" + std::string(mass) + fixed + pressed("amplitude = 1"))
                .find("f.toml:10: force 1: friction contact 'pad'"),
            std::string::npos);
  EXPECT_NE(refusal("omega = 1\n" + std::string(mass) + fixed + pressed("amplitude = 1")).find("normal_force = {"),
            std::string::npos);
  EXPECT_NE(refusal(std::string(mass) + pad("1") + "[[impulse]]\nname = 'hit'\non = 'pad'\nmomentum = 1\ntime = 1\n")
                .find("unknown coordinate 'pad'"),
            std::string::npos);
  EXPECT_NE(refusal("omega = 1\n" + std::string(mass) +
                    "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = "
                    "1\ncharacteristic = [[0, 1], [1, 0.5]]\nnormal_force = { constant = 1 }\n" +
                    pressed("amplitude = 1"))
                .find("not linear"),
            std::string::npos);
  EXPECT_EQ(refusal("omega = 1\n" + std::string(mass) + pad("1") + pressed("amplitude = 0")), "accepted");
}

}  // namespace
}  // namespace slapstick::testing
