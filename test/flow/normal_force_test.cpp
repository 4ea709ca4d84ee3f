/// Friction with a normal force that is linear in the state, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::testing {
namespace {

constexpr double pi = std::numbers::pi;

ModelDefinition file(const std::string& parts) { return ModelDefinition::parse("name = 'm'\n" + parts, "f.toml"); }

const char* const one_mass =
    "[[coordinate]]\nname = 'x'\nmass = 1\n[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n";

std::string coordinate(const std::string& name) { return "[[coordinate]]\nname = '" + name + "'\nmass = 1\n"; }

std::string dry(const std::string& more) {
  return "[[friction]]\nname = 'dry'\nbetween = ['x', 'ground']\n" + more + "\n";
}

/// Slip to the left lowers the stiffness by mu k, slip to the right raises it: half circles of other frequencies.
TEST(NormalForce, ASpringThatPressesMoreAsTheMassMovesOut) {
  const System system(file(one_mass + dry("static = 0.1\nnormal_force = { constant = 10, x = 4 }")).build());
  Motion motion(system, {5.0, 0.0});
  const std::vector<Event> events = run(motion, 10.0);
  ASSERT_EQ(kinds(events), "slip+ stick");
  const double left = 2.0 / 0.6 - 5.0, right = -2.0 / 1.4 - left;
  EXPECT_NEAR(seconds(events[0], motion), pi / std::sqrt(0.6), 1e-14);
  EXPECT_NEAR(seconds(events[1], motion), pi / std::sqrt(0.6) + pi / std::sqrt(1.4), 1e-14);
  EXPECT_NEAR(motion.state()[0], right, 1e-14);
  EXPECT_EQ(motion.state()[1], 0.0);
}

/// Body x at its stop is pressed by k (y - x) alone. While x rests, y - x = a cos(2 t) - sin(2 t) / 2: the stop lets go
/// at tan(2 t) = 2 a. The friction contact numbers y - x, so that this force is one number times a factor.
TEST(NormalForce, AForceThatIsOneNumberIsLetGoOnce) {
  const System system(file(coordinate("x") + coordinate("y") +
                           "[[spring]]\nbetween = ['y', 'x']\nstiffness = 4\n"
                           "[[friction]]\nname = 'dry'\nbetween = ['y', 'x']\nstatic = 1\nkinetic = 0\n"
                           "normal_force = { constant = 10, y = 0.1 }\n"
                           "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.7\nrestitution = 0.5\n")
                          .build());
  for (int i = 1; i <= 40; ++i) {
    const double a = 0.31 * i;
    Motion motion(system, {0.7, 0.0, 0.7 + a, -1.0});
    std::vector<Event> releases;
    while (motion.time() < Instant{}.plus(1.0) && motion.advance(Instant{}.plus(1.0)) == Outcome::event)
      if (motion.event().kind == EventKind::release) releases.push_back(motion.event());
    ASSERT_EQ(releases.size(), 1u) << i;
    EXPECT_NEAR(seconds(releases[0], motion), 0.5 * std::atan(2.0 * a), 1e-14) << i;
  }
}

/// The same of a driven machine, in which the zero was found to 1e-32: there the force seemed to hold, again and again.
TEST(NormalForce, AForceThatIsOneNumberDoesNotHoldByItsRounding) {
  const ModelDefinition machine = file(
      "omega = 1\n" + coordinate("x1") + coordinate("x2") +
      "[[spring]]\nbetween = ['x2', 'x1']\nstiffness = 3.9755151303364173\n"
      "[[force]]\non = 'x1'\namplitude = 2\nharmonic = 1\nphase = 1\n"
      "[[friction]]\nname = 'dry'\nbetween = ['x2', 'x1']\nstatic = 1\nkinetic = 0\n"
      "normal_force = { constant = 0.06, x1 = 0.10782794140454821, v1 = -0.0008087266434085583 }\n"
      "[[stop]]\nname = 'upper'\nbetween = ['x2', 'ground']\nclearance = 0.7928402135123633\n"
      "restitution_over_speed = [[0.17799406808116672, 0.3], [1.2493305724523185, 0.2726872899401177]]\n"
      "[[stop]]\nname = 'lower'\nbetween = ['ground', 'x2']\nclearance = -0.09086281624164161\n"
      "restitution_over_speed = [[0.33916680952901623, 0.3], [1.5407968603218958, 0.2227138120117905]]\n"
      "[start]\nx1 = -0.840160345762101\nv1 = 0.8317299295493767\nx2 = 0.6407849931989338\nv2 = 0.3576308002888793\n");
  const System system(machine.build());
  Motion motion(system, machine.start());
  const std::vector<Event> events = run(motion, 10 * pi);
  const auto releases =
      std::count_if(events.begin(), events.end(), [](const Event& event) { return event.kind == EventKind::release; });
  EXPECT_LT(events.size(), 300u);
  EXPECT_EQ(releases, 10);
}

/// y rises towards body x, which it holds at a stop, and loads the friction between them on the way. What makes the
/// load's instant exact must not move x, whose number is that of another stop: x stays at rest.
TEST(NormalForce, AContactThatIsLoadedOpensNoStop) {
  for (int i = 1; i <= 40; ++i) {
    const double a = 1.0 + 0.13 * i, loaded = -0.6 * a;
    const System system(file(coordinate("x") + coordinate("y") +
                             "[[spring]]\nbetween = ['y', 'x']\nstiffness = 4\n"
                             "[[friction]]\nname = 'dry'\nbetween = ['y', 'x']\nstatic = 0.01\n"
                             "normal_force = { constant = " +
                             shown(-0.1 * (loaded - 0.79)) +
                             ", y = 0.1 }\n"
                             "[[stop]]\nname = 'far'\nbetween = ['ground', 'x']\nclearance = 0.79\nrestitution = 0.5\n"
                             "[[stop]]\nname = 'near'\nbetween = ['x', 'ground']\nclearance = 0.09\nrestitution = 0.5\n"
                             "[start]\nx = -0.79\n")
                            .build());
    Motion motion(system, {-0.79, 0.0, -0.79 - a, 1.0});
    ASSERT_EQ(kinds(run(motion, 0.5)), "load") << i;
    EXPECT_EQ(motion.state()[0], -0.79) << i;
  }
}

/// N = 1 - 2 cos t presses from pi / 3 to 5 pi / 3 only: what it takes of the speed is mu (4 pi / 3 + 2 sqrt 3) a
/// period.
TEST(NormalForce, AContactThatIsPressedNowAndThen) {
  const System system(file(coordinate("x") + coordinate("y") +
                           "[[spring]]\nbetween = ['y', 'ground']\nstiffness = 1\n" +
                           dry("static = 0.1\nnormal_force = { constant = 1, y = -2 }"))
                          .build());
  Motion motion(system, {0.0, 5.0, 1.0, 0.0});
  EXPECT_EQ(system.mode_name(motion.mode_id()), "unloaded");
  const std::vector<Event> events = run(motion, 6.0 * pi);
  ASSERT_EQ(kinds(events), "load unload load unload load unload");
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(seconds(events[2 * i], motion), (2.0 * i + 1.0 / 3.0) * pi, 1e-14 * (1 + i));
    EXPECT_NEAR(seconds(events[2 * i + 1], motion), (2.0 * i + 5.0 / 3.0) * pi, 1e-14 * (1 + i));
  }
  EXPECT_EQ(events[0].w, 5.0);
  EXPECT_NEAR(motion.state()[1], 5.0 - 0.3 * (4.0 * pi / 3.0 + 2.0 * std::sqrt(3.0)), 1e-14);
}

/// A force of 1 is held until mu_s N = 0.5 (2 + cos t) has fallen to 1, at pi / 2; then x'' = 1 - 0.4 (2 + cos t).
TEST(NormalForce, AWeightThatSlipsAwayAsItsPressFalls) {
  const System system(file(coordinate("x") + coordinate("y") +
                           "[[spring]]\nbetween = ['y', 'ground']\nstiffness = 1\n"
                           "[[force]]\non = 'x'\namplitude = 1\nharmonic = 0\n" +
                           dry("static = 0.5\nkinetic = 0.4\nnormal_force = { constant = 2, y = 1 }"))
                          .build());
  Motion motion(system, {0.0, 0.0, 1.0, 0.0});
  const std::vector<Event> events = run(motion, pi);
  ASSERT_EQ(kinds(events), "release");
  EXPECT_NEAR(seconds(events[0], motion), pi / 2.0, 1e-15);
  EXPECT_NEAR(motion.state()[1], 0.1 * pi + 0.4, 1e-14);  // int_(pi/2)^pi 0.2 - 0.4 cos t
  EXPECT_NEAR(motion.state()[0], 0.1 * pi * pi / 4.0 + 0.4 * (pi / 2.0 - 1.0), 1e-14);
}

/// At rest and pressed by nothing sideways: N and both limits come to zero together, and the contact is unloaded.
TEST(NormalForce, AnIdleContactIsUnloadedAndSticksAgain) {
  const System system(file(coordinate("x") + coordinate("y") +
                           "[[spring]]\nbetween = ['y', 'ground']\nstiffness = 1\n" +
                           dry("static = 0.1\nnormal_force = { constant = 1, y = 2 }"))
                          .build());
  Motion motion(system, {0.3, 0.0, 1.0, 0.0});
  EXPECT_EQ(system.mode_name(motion.mode_id()), "stick");
  run(motion, 2.0 * pi / 3.0 + 1e-3);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "unloaded");
  const std::vector<Event> events = run(motion, 2.5);
  ASSERT_EQ(kinds(events), "load stick");
  EXPECT_NEAR(seconds(events[0], motion), 4.0 * pi / 3.0, 1e-14);
  EXPECT_EQ(motion.state()[0], 0.3);
}

/// Terms of no stiffness leave fixed limits: the same bits.
TEST(NormalForce, AConstantOneGivesTheBitsOfFixedLimits) {
  const std::string rest = std::string("omega = 1.3\n") + one_mass + "[[force]]\non = 'x'\namplitude = 3\n";
  const System fixed(file(rest + dry("static = '0.5 * 1.7'\nkinetic = '0.3 * 1.7'")).build());
  for (const char* normal : {"{ constant = 1.7 }", "{ constant = 1.7, x = 0 }"}) {
    const System loaded(file(rest + dry("static = 0.5\nkinetic = 0.3\nnormal_force = " + std::string(normal))).build());
    Motion a(fixed, {1.0, 0.0}), b(loaded, {1.0, 0.0});
    const std::vector<Event> first = run(a, 200.0), second = run(b, 200.0);
    ASSERT_EQ(kinds(first), kinds(second));
    ASSERT_GT(first.size(), 20U);
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].time, second[i].time);
    EXPECT_EQ(a.state(), b.state()) << normal;
  }
}

/// A brake pad that a gap switches on: the stop is hit at pi / 2 with speed 1 and pushes with 100 delta for
/// pi / 10.05..
TEST(NormalForce, ACompliantStopPressesAContactWhileItTouches) {
  const System system(
      file(coordinate("x") + coordinate("y") +
           "[[spring]]\nbetween = ['y', 'ground']\nstiffness = 1\n"
           "[[compliant_stop]]\nname = 'pad'\nbetween = ['y', 'ground']\nclearance = 0\nstiffness = 99\n" +
           dry("static = 0.2\nnormal_force = { compliant_stop = 'pad' }"))
          .build());
  Motion motion(system, {0.0, 3.0, -1.0, 0.0});
  EXPECT_EQ(system.mode_name(motion.mode_id()), "unloaded");
  const std::vector<Event> events = run(motion, 3.0);
  ASSERT_EQ(kinds(events), "engage disengage");
  EXPECT_NEAR(seconds(events[1], motion), pi / 2.0 + pi / 10.0, 1e-14);
  // delta = 0.1 sin 10 s, N = 9.9 sin 10 s, int = 9.9 * 2 / 10
  EXPECT_NEAR(motion.state()[1], 3.0 - 0.2 * 1.98, 1e-14);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "unloaded");
}

/// k on the way in and k_u on the way out: the mass comes back with sqrt(k_u / k) of its speed.
TEST(NormalForce, AStopOfTwoStiffnessesHasARestitution) {
  const System system(
      file(coordinate("x") +
           "[[compliant_stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 1\nstiffness = 100\n"
           "unloading_stiffness = 36\n")
          .build());
  Motion motion(system, {0.0, 2.0});
  const std::vector<Event> events = run(motion, 3.0);
  ASSERT_EQ(kinds(events), "engage slip- disengage");
  EXPECT_NEAR(seconds(events[1], motion), 0.5 + pi / 20.0, 1e-15);
  EXPECT_NEAR(seconds(events[2], motion), 0.5 + pi / 20.0 + pi / 12.0, 1e-14);
  EXPECT_NEAR(motion.state()[1], -1.2, 1e-14);
}

/// A pressed stop of two stiffnesses holds still wherever the press is between k_u delta and k delta.
TEST(NormalForce, AStopOfTwoStiffnessesHoldsAWeight) {
  const System system(
      file(coordinate("x") +
           "[[force]]\non = 'x'\namplitude = 5\nharmonic = 0\n"
           "[[compliant_stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0\nstiffness = 100\n"
           "unloading_stiffness = 36\n")
          .build());
  Motion motion(system, {0.08, 0.0});
  EXPECT_TRUE(run(motion, 10.0).empty());
  EXPECT_EQ(motion.state()[0], 0.08);
  EXPECT_EQ(system.mode_name(motion.mode_id()), "stick|on");
}

std::string refusal(const std::string& parts) {
  try {
    (void)file(parts);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NormalForce, WhatIsNotLinearIsRefusedWithItsLine) {
  const std::string here = "f.toml:12: friction 'dry': normal_force";
  EXPECT_EQ(refusal(one_mass + dry("static = 1\nnormal_force = { y = 1 }")).find(here + ": unknown key 'y'"), 0U);
  EXPECT_NE(refusal(one_mass + dry("static = 1\nnormal_force = { stop = 'wall' }")).find("rigid stop"),
            std::string::npos);
  EXPECT_NE(refusal(one_mass + dry("static = 1\nnormal_force = { compliant_stop = 'wall' }")).find("unknown compliant"),
            std::string::npos);
  EXPECT_NE(refusal(one_mass + dry("static = 1\ncharacteristic = [[0, 1], [1, 0.5]]\nnormal_force = { x = 1 }"))
                .find("not linear"),
            std::string::npos);
  EXPECT_NE(refusal(one_mass + dry("static = 1\nnormal_force = { constant = -1 }")).find("is negative"),
            std::string::npos);
}

}  // namespace
}  // namespace slapstick::testing
