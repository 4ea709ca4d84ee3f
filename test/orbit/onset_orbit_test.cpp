/// The onset of a complete chatter as an orbit: against bisection by the simulator, for any restitution.
#include "change/onset_orbit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "shaken_ball.hpp"

namespace slapstick::test {
namespace {

/// A ball that lies on the table until the table falls faster than the ball: nothing before is remembered, so that one
/// period decides.
TEST(OnsetOrbit, OfAShakenBallIsWhereTheSimulatorSaysForAnyRestitution) {
  struct Case {
    double restitution, rests, bounces;
  };
  for (const auto& [restitution, rests, bounces] :
       {Case{0.3, 1.94, 1.95}, Case{0.6, 1.455, 1.465}, Case{0.7, 1.333, 1.337}, Case{0.8, 1.223, 1.225},
        Case{0.9, 1.1165, 1.117}, Case{0.95, 1.06275, 1.0628}}) {
    const double onset = onset_by_bisection(restitution, rests, bounces);
    const Posed posed("shaken-table", {{"restitution", restitution}}, {"acceleration"},
                      {onset - 0.02 * (onset - rests)});
    const auto first = orbit::settle(*posed.problem, posed.system, {0.0, 0.0}).orbit;
    ASSERT_TRUE(first && first->chatter) << restitution;
    const auto found = orbit::onset_orbit(*posed.problem, first->orbit, 0);
    ASSERT_TRUE(found) << restitution;
    EXPECT_NEAR(found->orbit.parameter(), onset, found->error + 2e-13) << restitution;  // bisection ends at 1e-13
    EXPECT_LT(found->error, 1e-13) << restitution;
  }
}

/// From the cascade's side, where the contact lets go after a finite number of impacts, the equations are the same.
TEST(OnsetOrbit, IsTheSameFromTheCascade) {
  const double restitution = 0.6, onset = onset_by_bisection(restitution, 1.455, 1.465);
  const Posed posed("shaken-table", {{"restitution", restitution}}, {"acceleration"}, {onset - 1e-3});
  const auto first = orbit::settle(*posed.problem, posed.system, {0.0, 0.0}).orbit;
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = onset - 2e-3, .to = onset + 1e-4});
  const auto bounces = std::ranges::find_if(branch.points, [&](const orbit::Solution& point) {
    return point.orbit.parameter() > onset + 1e-5 && !point.chatter;
  });
  ASSERT_NE(bounces, branch.points.end()) << ended(branch);
  const auto found = orbit::onset_orbit(*posed.problem, bounces->orbit, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->orbit.parameter(), onset, found->error + 2e-13);
}

/// The flights of the burst leave the slider where the first impact has drawn it.
TEST(OnsetOrbit, BesideASliderIsWhereTheBranchSays) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 0.75\n[parameters]\nload = 0.222\n[[coordinate]]\nname = 'x'\nmass = 1\n"
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.2\n"
      "[[force]]\non = 'x'\namplitude = 1\n[[force]]\non = 'x'\namplitude = 'load'\nharmonic = 0\n"
      "[[jenkins]]\nname = 'j'\nbetween = ['x', 'ground']\nstiffness = 1\nlimit = 0.2\n"
      "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\nrestitution = 0.5\n",
      "m.toml");
  const auto problem = orbit::pose(definition.family({"load"}), {0.222});
  const auto first = orbit::settle(*problem, System(definition.build()), definition.start(), {.transient = 100}).orbit;
  ASSERT_TRUE(first && first->chatter);
  const auto found = orbit::onset_orbit(*problem, first->orbit, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->orbit.parameter(), 0.219815648, 3e-6);  // of the cascade's last grazes
}

/// What rounding leaves is in the stated error, however small the parameter: 1.459 + offset is the onset for r = 0.6,
/// by 40 digits.
TEST(OnsetOrbit, IsAsWellKnownAsItSaysWhereTheParameterIsSmall) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "table-by-offset.toml", {}, {"offset"}, {-1e-4});
  const auto first = orbit::settle(*posed.problem, posed.system, {0.0, 0.0}).orbit;
  ASSERT_TRUE(first);
  const auto found = orbit::onset_orbit(*posed.problem, first->orbit, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->orbit.parameter(), 4.60027577467332e-5, found->error);
  EXPECT_LT(found->error, 1e-14);
}

/// An orbit whose oscillator does not reach its bumper yet has an onset of its own, which is no motion's: it lies
/// behind the graze.
TEST(Onset, OfAnOrbitThatIsNoMotionThereIsNotSaid) {
  double onsets[2] = {};
  for (const int i : {0, 1}) {
    const double at = i == 0 ? 1.1 : 1.435;
    const Posed posed(SLAPSTICK_ORBIT_MODELS "ball-and-oscillator.toml", {{"stop", 1.40712}, {"kappa", 20000.0}},
                      {"acceleration"}, {at});
    const auto first = posed.settled();
    ASSERT_TRUE(first && first->chatter);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 1.05, .to = 1.4361});
    const auto onset = std::ranges::find(branch.special, orbit::SpecialType::CH, &orbit::SpecialPoint::type);
    ASSERT_NE(onset, branch.special.end()) << ended(branch);
    onsets[i] = onset->value;
  }
  EXPECT_NEAR(onsets[0], onsets[1], 1e-13);
  EXPECT_NEAR(onsets[0], 1.4360390142653, 1e-12);
}

/// The onset on a branch. By the places of the cascade's changes, with one rate, onsets were off by 1.7e-7, 7.8e-8 and
/// 3.1e-8, and said less.
TEST(Onset, OnABranchIsWhereTheSimulatorSaysAndAsWellKnownAsItSays) {
  struct Case {
    double restitution, at, from, to;
  };
  for (const auto& [restitution, at, from, to] :
       {Case{0.3, 1.946, 1.94, 1.948}, Case{0.6, 1.4589, 1.458, 1.4592}, Case{0.7, 1.3359, 1.3355, 1.336}}) {
    const Posed posed("shaken-table", {{"restitution", restitution}}, {"acceleration"}, {at});
    const auto first = orbit::settle(*posed.problem, posed.system, {0.0, 0.0}).orbit;
    ASSERT_TRUE(first && first->chatter) << restitution;
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = from, .to = to});
    const auto onset = std::ranges::find(branch.special, orbit::SpecialType::CH, &orbit::SpecialPoint::type);
    ASSERT_NE(onset, branch.special.end()) << restitution << ": " << ended(branch);
    EXPECT_NEAR(onset->value, onset_by_bisection(restitution, at, to), onset->error + 2e-13) << restitution;
    EXPECT_LT(onset->error, 1e-13) << restitution;
  }
}

}  // namespace
}  // namespace slapstick::test
