/// Branches as wholes: the same from either end, and where they end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "orbit/short_legs.hpp"
#include "shaken_ball.hpp"

namespace slapstick::test {
namespace {

using orbit::SpecialType;

struct Followed {
  std::string model, parameter;
  double at;
  orbit::ContinuationOptions options;
};

/// A special point that lies in one step with a change of events, or beside a graze where a multiplier grows without
/// bound, must not depend on where the steps fall. From the other end they fall elsewhere.
TEST(BranchFromEitherEnd, HasTheSameSpecialPoints) {
  const std::vector<Followed> cases = {
      {"impact-oscillator", "omega", 2.0, {.from = 2.0 / 3.0, .to = 6.0}},
      {"impact-friction-oscillator", "omega", 2.0, {.from = 2.0 / 3.0, .to = 6.0}},
      {"bilinear-oscillator", "clearance", 0.0, {.from = -1.0, .to = 1.0}},
      {"gear-pair", "error", 0.05, {.from = 0.02, .to = 0.15}},
      {"sliding-block", "amplitude", 1.0, {.from = 0.4, .to = 3.0}},
  };
  for (const Followed& followed : cases) {
    const Posed posed(followed.model, {}, {followed.parameter}, {followed.at});
    const auto first = posed.settled();
    ASSERT_TRUE(first) << followed.model;
    const orbit::Branch whole = orbit::follow(*posed.problem, first->orbit, followed.options);
    EXPECT_FALSE(whole.failed()) << followed.model << ": " << ended(whole);
    ASSERT_FALSE(whole.special.empty()) << followed.model;
    for (const orbit::Solution* end : {&whole.points.front(), &whole.points.back()}) {
      const orbit::Branch again = orbit::follow(*posed.problem, end->orbit, followed.options);
      ASSERT_EQ(again.special.size(), whole.special.size()) << followed.model << " from " << end->orbit.parameter();
      const auto near = [&](const orbit::SpecialPoint& a) {
        return std::ranges::any_of(again.special, [&](const orbit::SpecialPoint& b) {
          return a.type == b.type && std::abs(a.value - b.value) < 1e-9;
        });
      };
      for (const orbit::SpecialPoint& point : whole.special)
        EXPECT_TRUE(near(point)) << followed.model << " from " << end->orbit.parameter() << ": " << name(point.type)
                                 << " " << point.value;
    }
  }
}

/// Below the kinetic friction a static friction has no meaning: the branch ends there, and nothing failed.
TEST(Branch, EndsWhereTheModelEnds) {
  const Posed posed("falling-friction", {}, {"static_friction"}, {1.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.4, .to = 3.6});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  EXPECT_EQ(branch.down.kind, orbit::BranchEnd::Kind::no_model) << ended(branch);
  EXPECT_EQ(branch.up.kind, orbit::BranchEnd::Kind::range) << ended(branch);
  constexpr double shortest = 1e-8 * 3.2;
  EXPECT_NEAR(branch.down.value, 1.0, 2.0 * shortest);
  EXPECT_GE(branch.down.value, 1.0);
}

/// Near the onset of a chatter with friction no step leads on, and orbits are sought whose impacts are not those of the
/// chatter.
TEST(BranchOfChatterWithFriction, GoesThroughItsOnset) {
  const Posed posed("impact-friction-oscillator", {}, {"clearance"}, {0.0});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = -1.0, .to = 0.5});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  EXPECT_EQ(branch.points.back().label, "1-0-I");
  ASSERT_EQ(std::ranges::count(branch.special, SpecialType::CH, &orbit::SpecialPoint::type), 2);
  // Pressed by more than the force's amplitude less friction the mass stays on its stop.
  EXPECT_EQ(branch.points.front().label, "1-0-II");
  const auto released = std::ranges::find(branch.special, SpecialType::CH, &orbit::SpecialPoint::type);
  EXPECT_NEAR(released->value, -0.9, 1e-12);
  EXPECT_LT(released->error, 1e-12);
}

/// Where a rest ends the chatter is there at once: no cascade, no graze besides, and the place is that of the release.
TEST(BranchOfRest, GoesOverToAChatterWhereTheContactLetsGo) {
  const Posed table("shaken-table", {}, {"acceleration"}, {0.7});
  const auto first = table.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*table.problem, first->orbit, {.from = 0.5, .to = 1.5});
  EXPECT_EQ(ended(branch), "down: range; up: range");
  ASSERT_EQ(branch.special.size(), 1U);
  EXPECT_EQ(branch.special[0].type, SpecialType::CH);
  EXPECT_NEAR(branch.special[0].value, 1.0, 1e-12);  // as large as gravity
  EXPECT_EQ(branch.points.back().label, "1-inf-II");
}

/// At either stop a spool rests until the pressure exceeds preload, spring and friction; a rest at the second stop is
/// as isolated as one at the first.
TEST(BranchOfRest, IsLeftAtEitherStopWhereThePressureSays) {
  constexpr double mean = 124110.0, pulsation = 27580.0, preload = 8.54503372291542,
                   spring = 1488.578099595049 * 1.016e-3;
  const Posed spool("spool", {}, {"area"}, {8e-5});
  const auto first = spool.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*spool.problem, first->orbit, {.from = 5e-5, .to = 1.1e-4});
  EXPECT_EQ(ended(branch), "down: range; up: range");
  const double lower = (preload + 1.0) / (mean + pulsation), upper = (preload + spring - 1.0) / (mean - pulsation);
  std::vector<double> onsets;
  for (const orbit::SpecialPoint& special : branch.special)
    if (special.type == SpecialType::CH) onsets.push_back(special.value);
  ASSERT_GE(onsets.size(), 2U);
  EXPECT_NEAR(onsets.front(), lower, 1e-12 * lower);
  EXPECT_NEAR(onsets.back(), upper, 1e-12 * upper);
  for (const orbit::Solution* rest : {&branch.points.front(), &branch.points.back()}) {
    EXPECT_EQ(rest->label, "1-0-II");
    EXPECT_TRUE(rest->stable());
  }
}

/// At the second of two stops on one coordinate a chatter's gaps are known to a rounding of the distance of the stops:
/// its last flights are rounding.
TEST(BranchOfChatter, OfASpoolBetweenTwoStopsIsPassed) {
  const Posed spool("spool", {}, {"stiffness"}, {1488.578099595049});
  const auto first = spool.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*spool.problem, first->orbit, {.from = 900.0, .to = 3000.0});
  EXPECT_EQ(ended(branch), "down: range; up: range");
  std::vector<const orbit::SpecialPoint*> onsets;
  for (const orbit::SpecialPoint& special : branch.special)
    if (special.type == SpecialType::CH) onsets.push_back(&special);
  ASSERT_EQ(onsets.size(), 2U);
  const auto chatters = [](double stiffness) {
    const Posed there("spool", {}, {"stiffness"}, {stiffness});
    const auto orbit = there.settled();
    return orbit && orbit->chatter;
  };
  for (const orbit::SpecialPoint* onset : onsets) {
    const double beside = std::max(10.0 * onset->error, 0.1);
    EXPECT_NE(chatters(onset->value - beside), chatters(onset->value + beside)) << onset->value;
  }
}

/// Orbits with ever more impacts, each behind a graze that the branch turns back at, gather where a ball that is
/// released comes to rest just as it is released again. That place is found by one simulation of one period.
TEST(Cascade, GathersWhereACompleteChatterBegins) {
  struct Case {
    double restitution, step;
  };
  for (const auto& [restitution, step] : {Case{0.5, 0.02}, Case{0.4, 0.02}, Case{0.4, 0.01}}) {
    const Posed posed("shaken-table", {{"restitution", restitution}}, {"acceleration"}, {1.2});
    const auto first = posed.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch =
        orbit::follow(*posed.problem, first->orbit, {.from = 1.02, .to = 2.8, .longest_step = step});
    EXPECT_EQ(std::ranges::count(branch.special, SpecialType::CH, &orbit::SpecialPoint::type), 1);
    EXPECT_EQ(branch.points.back().label, "1-1-I") << step;
    const auto onset = std::ranges::find(branch.special, SpecialType::CH, &orbit::SpecialPoint::type);
    ASSERT_NE(onset, branch.special.end()) << ended(branch);
    const double rests = onset->value - 0.05, bounces = onset->value + 0.05;
    ASSERT_TRUE(comes_to_rest(restitution, rests));
    ASSERT_FALSE(comes_to_rest(restitution, bounces));
    constexpr double width = 1e-12;
    EXPECT_NEAR(onset->value, onset_by_bisection(restitution, rests, bounces), onset->error + width)
        << name(onset->occurrence);
    EXPECT_LT(onset->error, 1e-6);  // where the chatter is left alone it is known to 6e-6
    EXPECT_EQ(branch.points.front().label, "1-inf-II") << ended(branch);
    EXPECT_FALSE(branch.failed()) << ended(branch);
  }
}

/// Between equal stops a cascade adds an impact at each of them; its orbits are all much alike, and the branch does not
/// run over itself.
TEST(Cascade, OfSymmetricOrbitsGoesOverToTheChatter) {
  const Posed rattle("two-sided-rattle", {}, {"clearance"}, {0.5});
  const auto first = rattle.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*rattle.problem, first->orbit, {.from = 0.02, .to = 1.0});
  EXPECT_EQ(ended(branch), "down: range; up: range");
  const auto onset = std::ranges::find(branch.special, SpecialType::CH, &orbit::SpecialPoint::type);
  ASSERT_NE(onset, branch.special.end());
  EXPECT_LT(onset->error, 1e-8);
  EXPECT_TRUE(branch.points.front().chatter);
  EXPECT_FALSE(branch.points.back().chatter);
  for (const orbit::Solution& point : branch.points)
    EXPECT_EQ(point.chatter, point.orbit.parameter() < onset->value) << point.orbit.parameter();
}

/// A graze 1e-18 ahead of a point, by the value of the margin, is 1e-7 of arclength ahead.
constexpr double graze_right_ahead = -0.66809573755613;
void expect_the_graze_in(double from, double to) {
  const Posed posed("impact-friction-oscillator", {}, {"clearance"}, {-0.1});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = from, .to = to});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  EXPECT_TRUE(std::ranges::any_of(branch.special,
                                  [&](const orbit::SpecialPoint& point) {
                                    return point.type == SpecialType::GR &&
                                           std::abs(point.value - graze_right_ahead) < 1e-12;
                                  }))
      << from << ":" << to;
}

/// Impacts are counted by simulations on both sides.
TEST(Graze, RightAheadOfAPointIsWhereTheSimulatorSays) {
  expect_the_graze_in(-1.5, 1.5);
  const auto impacts = [](double clearance) {
    const Posed there("impact-friction-oscillator", {}, {"clearance"}, {clearance});
    const auto orbit = there.settled();
    return orbit ? orbit->impacts : -1;
  };
  EXPECT_EQ(impacts(graze_right_ahead - 1e-11), impacts(graze_right_ahead + 1e-11) + 1);
}

/// How wide the range is must not move it.
TEST(Graze, RightAheadOfAPointIsThereInAWiderRange) { expect_the_graze_in(-5.0, 5.0); }

/// Just behind the onset from which a chatter is followed its first steps are among impacts too short to be told from
/// rounding; how near that is has nothing to do with the range.
TEST(BranchOfChatter, IsFollowedFromItsOnsetInAnyRange) {
  const Overrides values = {{"damping_ratio", 0.09386343155181627},
                            {"dashpot_ratio", 4.985171604055366},
                            {"force_share_2", 0.0},
                            {"mass_ratio", 10.119324338277726},
                            {"omega", 2.3617816406498755},
                            {"restitution", 0.8155175435188234},
                            {"static_friction", 0.15411938429145117},
                            {"stiffness_ratio", 5.230796080110011}};
  const Posed posed("vibro-impact", values, {"clearance"}, {-0.499});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = -0.53, .to = -0.496});
  EXPECT_EQ(ended(branch), "down: range; up: range");
  const auto onset = std::ranges::find(branch.special, SpecialType::CH, &orbit::SpecialPoint::type);
  ASSERT_NE(onset, branch.special.end());
  EXPECT_NEAR(onset->value, -0.5173143141, 2e-8);  // the limit of the grazes' geometric sequence
  EXPECT_LT(onset->value, onset[1].value);
  EXPECT_TRUE(branch.points.front().chatter);
}

/// As the coefficient of restitution comes to 1 a chatter has impacts without bound, and each step costs the cube of
/// their number.
TEST(BranchOfChatter, OfImpactsWithoutBoundEndsAndSaysWhy) {
  const Overrides values = {
      {"acceleration", 1.012888671993797}, {"gravity", 0.948853760922176}, {"omega", 0.8876782561858597}};
  const Posed posed("shaken-table", values, {"restitution"}, {0.42189720735878417});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch =
      orbit::follow(*posed.problem, first->orbit, {.from = 0.4, .to = 1.0, .longest_step = 0.1});
  EXPECT_TRUE(branch.failed());
  EXPECT_NE(ended(branch).find("more than 1000 events is not followed, beyond restitution = 0.98"), std::string::npos)
      << ended(branch);
}

/// Without loss at impacts all multipliers are on the unit circle. What is at the very end of a range may have another
/// structure.
TEST(Branch, HasNoSpecialPointAtTheVeryEndOfItsRange) {
  const Posed posed("impact-pair", {}, {"restitution"}, {0.6});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.5, .to = 1.0});
  EXPECT_EQ(ended(branch), "down: range; up: range");
  EXPECT_TRUE(branch.special.empty());
  EXPECT_NEAR(std::abs(branch.points.back().multipliers.front()), 1.0, 1e-9);
}

/// The cycle of four periods and three impacts lives on a closed curve, which turns round at 2.65 and 2.83. The first
/// way on passed its first orbit on a long step, and went round once more.
TEST(Branch, ThatComesRoundListsEachPointOnce) {
  const Posed posed("vibro-impact", {{"omega", 2.82}}, {"omega"}, {2.82});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  ASSERT_EQ(first->orbit.shape.n, 4);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 2.6, .to = 3.2});
  EXPECT_EQ(branch.up.kind, orbit::BranchEnd::Kind::closed) << ended(branch);
  EXPECT_EQ(branch.down.kind, orbit::BranchEnd::Kind::closed);
  EXPECT_EQ(branch.points.front().orbit.parameter(), branch.points.back().orbit.parameter());
  for (std::size_t i = 0; i < branch.special.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(branch.special[i].type == branch.special[k].type &&
                   std::abs(branch.special[i].value - branch.special[k].value) < 1e-9)
          << name(branch.special[i].type) << " at " << branch.special[i].value;
  EXPECT_GE(branch.special.size(), 40U);
}

}  // namespace
}  // namespace slapstick::test
