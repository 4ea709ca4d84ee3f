/// One-way clutches against closed forms: what they hold, what they drag, what is measured of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "runs.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::testing {
namespace {

constexpr double pi = std::numbers::pi;

ModelDefinition file(const std::string& parts) { return ModelDefinition::parse("name = 'm'\n" + parts, "f.toml"); }

const char* const disc = "[[coordinate]]\nname = 'x'\nmass = 2\n";

std::string wheel(const std::string& ends, const std::string& limits) {
  return "[[freewheel]]\nname = 'pawl'\nbetween = " + ends + "\n" + limits + "\n";
}

std::string push(const std::string& amplitude) {
  return "[[force]]\non = 'x'\namplitude = " + amplitude + "\nharmonic = 0\n";
}

Measured measured(const ModelDefinition& model, const State& start, double time, const std::vector<std::string>& of) {
  std::vector<Quantity> wanted;
  for (const std::string& one : of) wanted.push_back(find_quantity(quantities(model), one));
  return measure(Motion(System(model.build()), start), Instant{}.plus(time), wanted);
}

/// A body of mass 2 that runs ahead is slowed by the drag, stops, and is held against a push.
TEST(Freewheel, DragsAheadAndHoldsBack) {
  const ModelDefinition model = file(std::string(disc) + push("-3") + wheel("['x', 'ground']", "holds = 4\ndrag = 1"));
  const System system(model.build());
  Motion motion(system, {0.0, 4.0});
  const std::vector<Event> events = run(motion, 10.0);
  ASSERT_EQ(kinds(events), "stick");
  EXPECT_NEAR(seconds(events[0], motion), 2.0, 1e-15);  // v' = -(3 + 1) / 2
  EXPECT_NEAR(motion.state()[0], 4.0, 1e-15);
  const Measured found = measured(model, {0.0, 4.0}, 4.0, {"F_pawl", "power_pawl", "power_in", "w_pawl"});
  EXPECT_NEAR(found.of[0].greatest, 1.0, 1e-15);
  EXPECT_NEAR(found.of[0].least, -3.0, 1e-15);
  EXPECT_NEAR(found.of[1].mean, 1.0 * 4.0 / 4.0, 1e-15);   // drag times the way
  EXPECT_NEAR(found.of[2].mean, -3.0 * 4.0 / 4.0, 1e-15);  // the push alone: the clutch brings nothing
  EXPECT_NEAR(found.of[3].mean, 1.0, 1e-15);
}

/// More than it holds: it slips back, and takes holds times the way.
TEST(Freewheel, SlipsBackWhereItIsOvercome) {
  const ModelDefinition model = file(std::string(disc) + push("-6") + wheel("['x', 'ground']", "holds = 4\ndrag = 1"));
  const System system(model.build());
  Motion motion(system, {0.0, 0.0});
  (void)run(motion, 2.0);
  EXPECT_NEAR(motion.state()[1], -2.0, 1e-15);
  EXPECT_NEAR(measured(model, {0.0, 0.0}, 2.0, {"power_pawl"}).of[0].mean, 4.0 * 2.0 / 2.0, 1e-15);
}

/// The ends exchanged and the ratios of a pair of gears: y = 2 x, or -2 x in the other sense.
TEST(Freewheel, HoldsBackWhatItsEndsAndRatiosSay) {
  const auto speed = [&](const std::string& ends, const std::string& push_by) {
    const System system(file(std::string(disc) + push(push_by) + wheel(ends, "holds = 4")).build());
    Motion motion(system, {0.0, 0.0});
    (void)run(motion, 1.0);
    return motion.state()[1];
  };
  EXPECT_EQ(speed("['x', 'ground']", "1"), 0.5);
  EXPECT_EQ(speed("['x', 'ground']", "-1"), 0.0);
  EXPECT_EQ(speed("['ground', 'x']", "1"), 0.0);
  EXPECT_EQ(speed("['ground', 'x']", "-1"), -0.5);
  const std::string doubled = "['x', 'ground']\nratio = [2, 1]";
  EXPECT_EQ(speed(doubled, "-8"), 0.0);    // held with 2 * 4
  EXPECT_EQ(speed(doubled, "-10"), -1.0);  // (-10 + 8) / 2
}

/// A rocker of speed cos t turns a wheel of mass 1 that is loaded by c v. The clutch lets go at t1, where the wheel
/// would slow down less than the rocker, -sin t1 + c cos t1 = 0. The wheel is caught at t2, where
/// cos t2 = cos t1 e^(-c (t2 - t1)).
TEST(Freewheel, OfARockerTurnsAWheelAsItsClosedForm) {
  constexpr double c = 0.2;
  const ModelDefinition model = load_model(SLAPSTICK_RATCHET);
  const double t1 = std::atan(c);
  double below = 1.5 * pi, above = 2.0 * pi;  // between them the rocker overtakes
  for (int k = 0; k < 60; ++k) {
    const double t = 0.5 * (below + above);
    (std::cos(t) < std::cos(t1) * std::exp(-c * (t - t1)) ? below : above) = t;
  }
  const double t2 = below, kept = std::exp(-c * (t2 - t1));
  const System system(model.build());
  Motion motion(system, model.start());
  std::vector<Event> events = run(motion, 6.0 * pi);
  events.erase(events.begin(), events.end() - 2);
  ASSERT_EQ(kinds(events), "release stick");
  EXPECT_NEAR(seconds(events[0], motion), 4.0 * pi + t1, 1e-14);
  EXPECT_NEAR(seconds(events[1], motion), 4.0 * pi + t2, 1e-13);
  const auto named = [&](const char* name) { return find_quantity(quantities(model), name); };
  const Measured found = measure(motion, motion.time().plus(1.0), {named("v_wheel"), named("F_pawl")});
  const double speed = (std::cos(t1) * (1.0 - kept) / c + std::sin(t1) - std::sin(t2)) / (2.0 * pi);
  EXPECT_NEAR(found.of[0].mean, speed, 1e-13);  // that of the rocker is 0
  EXPECT_NEAR(found.of[1].mean, -c * speed, 1e-14);
  EXPECT_NEAR(found.of[1].least, std::sin(t2) - c * std::cos(t2), 1e-13);
}

/// A bearing bears up to 1 either way, and the clutch beside it 500 in one sense and nothing in the other: of what they
/// hold together each has as much as it can bear. Once half of `holds` went round between them.
TEST(Freewheel, SharesWhatItHoldsWithABearing) {
  const auto forces = [&](const std::string& load) {
    return measured(file("omega = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n" + load +
                         "[[friction]]\nname = 'bearing'\nbetween = ['ground', 'x']\nstatic = 1\n" +
                         wheel("['x', 'ground']", "holds = 500")),
                    {0.0, 0.0}, 1.0, {"F_bearing", "F_pawl"})
        .of;
  };
  const auto none = forces(""), back = forces(push("-3")), ahead = forces(push("0.5"));
  EXPECT_EQ(none[0].rms, 0.0);
  EXPECT_EQ(none[1].rms, 0.0);
  EXPECT_NEAR(back[0].mean, 3.0 / 501.0, 1e-13);  // its ends are exchanged
  EXPECT_NEAR(back[1].mean, -1500.0 / 501.0, 1e-12);
  EXPECT_NEAR(ahead[0].mean, -0.5, 1e-13);
  EXPECT_EQ(ahead[1].rms, 0.0);
  const auto both = forces("[[force]]\non = 'x'\namplitude = 0.9\n");
  EXPECT_NEAR(both[1].mean, -500.0 / 501.0 * 0.9 / pi, 1e-13);
  EXPECT_NEAR(both[1].greatest, 0.0, 1e-13);
  EXPECT_NEAR(both[0].least, -0.9, 1e-13);
}

/// A ball that chatters to rest on a floor, and rubs on a clutch: that is friction of (0.3 + 0.1) / 2 and a force of
/// (0.3 - 0.1) / 2 that lifts.
TEST(Freewheel, OfABallThatChattersIsFrictionAndAForce) {
  const std::string ball =
      "[[coordinate]]\nname = 'x'\nmass = 1\n[[stop]]\nname = 'floor'\nbetween = ['ground', 'x']\nclearance = 0\n"
      "restitution = 0.5\n" +
      push("-1");
  const State start{0.5, 0.0};
  const auto one = measured(file(ball + wheel("['x', 'ground']", "holds = 0.3\ndrag = 0.1")), start, 9.0,
                            {"F_pawl", "power_pawl", "F_floor", "power_in", "v", "a"})
                       .of;
  const auto other =
      measured(file(ball + push("0.1") + "[[friction]]\nname = 'wall'\nbetween = ['x', 'ground']\nstatic = 0.2\n"),
               start, 9.0, {"F_wall", "power_wall", "F_floor", "power_in", "v", "a"})
          .of;
  EXPECT_GT(one[2].impulses, 10);
  for (const double Statistics::*of : {&Statistics::mean, &Statistics::least, &Statistics::greatest})
    EXPECT_NEAR(one[0].*of, other[0].*of - 0.1, 1e-14);
  EXPECT_NEAR(one[1].mean, other[1].mean - 0.1 * other[4].mean, 1e-14);
  EXPECT_NEAR(one[3].mean, other[3].mean - 0.1 * other[4].mean, 1e-14);
  for (const std::size_t same : {2U, 4U, 5U}) EXPECT_NEAR(one[same].mean, other[same].mean, 1e-14);
}

/// Constants that a sum with `holds` would swallow. Once a body under a push of 3 coasted for ever beside 1e15.
TEST(Freewheel, ThatWouldSwallowOtherForcesIsRefused) {
  const auto built = [&](const std::string& limits) {
    return System(file(std::string(disc) + push("-3") + wheel("['x', 'ground']", limits)).build());
  };
  EXPECT_NO_THROW(built("holds = 3e8"));
  EXPECT_THROW(built("holds = 1e15"), InputError);
}

TEST(Freewheel, OnlyAConstantForceAtItsEndsIsAPartOfIt) {
  const Model sound = file(std::string(disc) + wheel("['x', 'ground']", "holds = 4")).build();
  EXPECT_NO_THROW(System{sound});
  const auto refused = [&](auto change) {
    Model model = sound;
    model.omega = 1.0;
    change(model.forces.at(0));
    EXPECT_THROW(System{model}, InputError);
  };
  refused([](Force& force) { force.harmonic = 1; });
  refused([](Force& force) { force.contact = 1; });
  Model two = sound;
  two.coordinates.push_back({"y", 1.0});
  two.frictions[0].b = 1;
  EXPECT_THROW(System{two}, InputError);  // nothing acts on y
  two.forces.push_back({1, 0, -two.forces[0].amplitude});
  two.forces.back().contact = 0;
  EXPECT_NO_THROW(System{two});
  two.forces.back().amplitude *= 0.5;
  EXPECT_THROW(System{two}, InputError);
}

TEST(Freewheel, WithoutSenseIsRefused) {
  for (const char* limits : {"holds = -1", "holds = 1\ndrag = -0.1"}) {
    try {
      (void)file(std::string(disc) + wheel("['x', 'ground']", limits)).build();
      ADD_FAILURE() << limits;
    } catch (const InputError& error) {
      EXPECT_NE(error.message().find("freewheel 'pawl'"), std::string::npos) << error.message();
      EXPECT_NE(error.message().find("is negative"), std::string::npos) << error.message();
    }
  }
}

}  // namespace
}  // namespace slapstick::testing
