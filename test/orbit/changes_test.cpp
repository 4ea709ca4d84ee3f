/// Where branches change their events, cross or end: each by a second route.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::test {
namespace {

using orbit::CurveEnd, orbit::Jump, orbit::Occurrence, orbit::Passage, orbit::Sliding, orbit::SpecialType;

orbit::Branch branch_of(const std::string& model, const Overrides& fixed, const std::string& parameter, double at,
                        orbit::ContinuationOptions options) {
  const Posed posed(model, fixed, {parameter}, {at});
  const auto first = posed.settled();
  if (!first) throw NumericalError("no orbit at " + std::to_string(at));
  return orbit::follow(*posed.problem, first->orbit, options);
}

std::vector<double> values(const orbit::Branch& branch, SpecialType type) {
  std::vector<double> all;
  for (const orbit::SpecialPoint& point : branch.special)
    if (point.type == type) all.push_back(point.value);
  std::ranges::sort(all);
  return all;
}

/// What the motion from the model's start settles on.
std::string attractor(const std::string& model, Overrides all, const std::string& parameter, double value) {
  all[parameter] = value;
  const auto found = Posed(model, all, {}, {}).settled(0, 2000);
  return found ? found->label : "none";
}

/// A leg that shrinks to nothing makes the equations singular on its side of the point; on the other side it is an
/// ordinary zero of a margin.
TEST(Change, IsTheSameFromBothSides) {
  const orbit::Branch up = branch_of("spool", {}, "frequency", 255.0, {.from = 255.0, .to = 265.0}),
                      down = branch_of("spool", {}, "frequency", 265.0, {.from = 255.0, .to = 265.0});
  const std::vector<double> a = values(up, SpecialType::SL), b = values(down, SpecialType::SL);
  ASSERT_EQ(a.size(), 2U) << ended(up);
  ASSERT_EQ(b.size(), 2U) << ended(down);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(a[k], b[k], 1e-10 * a[k]);
  const orbit::Branch right = branch_of("vibro-impact", {}, "omega", 2.2, {.from = 1.2, .to = 2.3}),
                      left = branch_of("vibro-impact", {}, "omega", 1.4, {.from = 1.2, .to = 2.3});
  const std::vector<double> c = values(right, SpecialType::SL), d = values(left, SpecialType::SL);
  ASSERT_EQ(c.size(), 3U);
  ASSERT_EQ(d.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(c[k], d[k], 1e-10);
}

/// A spring that is just touched is engaged and let go at one instant. The 2-2 orbit beyond gains its third contact
/// there, by brute force too.
TEST(Change, OfACompliantStopIsPassed) {
  const orbit::Branch branch =
      branch_of("bilinear-oscillator", {}, "clearance", 0.0, {.from = -0.36, .to = 0.01, .most_points = 300});
  const std::vector<double> touches = values(branch, SpecialType::GR);
  ASSERT_EQ(touches.size(), 2U) << ended(branch);
  EXPECT_EQ(branch.points.front().label, "2-2-I") << ended(branch);
  EXPECT_EQ(attractor("bilinear-oscillator", {}, "clearance", touches[0] - 1e-3), "2-2-I");
  EXPECT_EQ(attractor("bilinear-oscillator", {}, "clearance", touches[0] + 1e-3), "2-3-I");
}

/// The displacement turns, a corner of the valve, while it is beyond a corner of the mount or an edge of the hydraulic
/// stop. Where it reaches that no more the two crossings are gone and the turn stays, on the unstable part of the
/// branch too, where no motion shows it. The greatest displacement of the orbits beside says where that is.
TEST(Change, OfATurnBetweenTwoCrossingsIsPassed) {
  const orbit::Branch branch = branch_of("bump-stop", {}, "omega", 0.6, {.from = 0.6, .to = 2.0});
  EXPECT_EQ(branch.up.kind, orbit::BranchEnd::Kind::range) << ended(branch);
  EXPECT_EQ(values(branch, SpecialType::LP).size(), 2U) << ended(branch);
  int left = 0;
  for (const orbit::SpecialPoint& point : branch.special) {
    if (point.type != SpecialType::GR) continue;
    EXPECT_EQ(point.passage, Passage::persistence) << point.value;
    const auto events = [&](std::size_t at) { return branch.points.at(at).orbit.legs(); };
    left += events(point.after) > events(std::min(point.after + 1, branch.points.size() - 1));
  }
  EXPECT_GE(left, 2);
}

/// Both bounces of a ball on a shaken table, the one that is caught rising and the one that is not, have one impact
/// speed: they differ in phase only.
TEST(Branch, WithTheSameStatesAtAnotherPhaseIsAnotherOne) {
  const orbit::Branch branch =
      branch_of("shaken-table", {{"restitution", 0.5}}, "acceleration", 1.2, {.from = 0.9, .to = 2.5});
  ASSERT_EQ(values(branch, SpecialType::LP).size(), 1U) << ended(branch);
  const bool saddle = std::ranges::any_of(branch.points, [](const orbit::Solution& point) {
    return point.orbit.parameter() > 2.0 && point.multipliers.front().real() > 2.0;
  });
  EXPECT_TRUE(saddle) << ended(branch);
}

/// Constant Coulomb friction makes the equations a monotone inclusion: an isolated motion cannot jump. Here both halves
/// of a symmetric cycle change at once.
TEST(Change, OfBothHalvesOfASymmetricCycleIsPassed) {
  const orbit::Branch branch = branch_of("coulomb-oscillator", {}, "omega", 0.3, {.from = 0.25, .to = 0.35});
  for (const orbit::SpecialPoint& point : branch.special) EXPECT_NE(point.passage, Passage::jump) << point.value;
  EXPECT_LT(branch.points.front().orbit.parameter(), 0.2575) << ended(branch);
}

/// The only contact of a period vanishes: the linear response is left, whose amplitude is the gap there.
TEST(Change, WithoutTheLastContactIsPassed) {
  const orbit::Branch branch = branch_of("gear-pair", {}, "omega", 1.3, {.from = 1.2, .to = 1.6});
  ASSERT_FALSE(branch.special.empty()) << ended(branch);
  const orbit::SpecialPoint& point = branch.special.back();
  EXPECT_EQ(point.type, SpecialType::GR);
  EXPECT_EQ(point.passage, Passage::persistence);
  EXPECT_EQ(branch.points.back().label, "1-0-I") << ended(branch);
}

/// The symmetric motion between two stops loses its symmetry at two points; the branch that crosses there was not
/// scripted, and by brute force the two contacts of a period have different speeds between them.
TEST(Crossing, OfASymmetricOrbitLeadsToAsymmetricOnes) {
  const Posed posed("two-sided-rattle", {}, {"omega"}, {1.5});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::ContinuationOptions options{.from = 1.0, .to = 1.6};
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, options);
  const std::vector<double> crossings = values(branch, SpecialType::BP);
  ASSERT_EQ(crossings.size(), 2U) << ended(branch);
  const auto bp = std::ranges::find(branch.special, SpecialType::BP, &orbit::SpecialPoint::type);
  EXPECT_LT(bp->error, 1e-10);
  ASSERT_EQ(bp->born.size(), 1U);  // the other side is its mirror image
  const orbit::Branch other = orbit::follow(*posed.problem, bp->born[0], options);
  const std::vector<double> seen = values(other, SpecialType::BP);  // from the other branch, on which it is a fold
  ASSERT_FALSE(seen.empty()) << ended(other);
  EXPECT_NEAR(seen.front(), bp->value, 1e-9);
  for (const double fold : values(other, SpecialType::LP))
    for (const double crossing : crossings) EXPECT_GT(std::abs(fold - crossing), 1e-4);
  const auto speeds_differ = [](double omega) {
    const Posed at("two-sided-rattle", {{"omega", omega}}, {}, {});
    const auto found = at.settled(1, 3000);
    if (!found) return std::string("no orbit");
    std::vector<double> speeds;
    for (const orbit::EventOfOrbit& event : orbit::events(*at.problem, found->orbit))
      if (event.kind == EventKind::impact) speeds.push_back(std::abs(event.w));
    return std::string(std::abs(speeds.at(0) - speeds.at(1)) > 1e-3 ? "asymmetric" : "symmetric");
  };
  EXPECT_EQ(speeds_differ(crossings[1] - 3e-2), "asymmetric");
  EXPECT_EQ(speeds_differ(crossings[0] - 3e-3), "symmetric");
  EXPECT_EQ(speeds_differ(crossings[1] + 3e-3), "symmetric");
}

/// In two parameters the crossings of a symmetric family form a curve, here with a turning point. On it lie those of
/// every single branch.
TEST(Crossing, IsFollowedInTwoParameters) {
  const Posed posed("two-sided-rattle", {}, {"omega", "restitution"}, {1.5, 0.7});
  const Posed single("two-sided-rattle", {}, {"omega"}, {1.5});
  const auto first = single.settled();
  ASSERT_TRUE(first);
  const orbit::ContinuationOptions range{.from = 1.0, .to = 1.6};
  const orbit::Branch branch = orbit::follow(*single.problem, first->orbit, range);
  auto bp = *std::ranges::find(branch.special, SpecialType::BP, &orbit::SpecialPoint::type);
  bp.solution.orbit.values.push_back(0.7);
  const orbit::Curve curve = orbit::locus(
      *posed.problem, bp, {.from = 1.0, .to = 1.6, .second_from = 0.5, .second_to = 0.9, .longest_step = 0.05});
  EXPECT_FALSE(curve.failed()) << ended(curve);
  ASSERT_GT(curve.points.size(), 20U);
  const orbit::CurvePoint& other = curve.points[curve.points.size() / 4];
  const std::vector<double> there =
      values(branch_of("two-sided-rattle", {{"restitution", other.values[1]}}, "omega", 1.59, range), SpecialType::BP);
  const bool on_the_branch =
      std::ranges::any_of(there, [&](double value) { return std::abs(value - other.values[0]) < 1e-9; });
  EXPECT_TRUE(on_the_branch) << other.values[0] << " " << other.values[1];
  const std::vector<double> rate = orbit::sensitivity(posed.family, {bp.value, 0.7}, bp);
  const auto near = [&](double r) {
    const auto all = values(branch_of("two-sided-rattle", {{"restitution", r}}, "omega", 1.5, range), SpecialType::BP);
    return *std::ranges::min_element(all, {}, [&](double value) { return std::abs(value - bp.value); });
  };
  EXPECT_NEAR(rate.at(0), (near(0.701) - near(0.699)) / 0.002, 1e-4);
}

/// Both stops of a symmetric orbit lose their second impacts at one point.
TEST(Change, OfSeveralImpactsTogetherIsPassed) {
  const orbit::Branch branch = branch_of("two-sided-rattle", {}, "omega", 0.75, {.from = 0.7, .to = 1.0});
  const auto has = [&](const char* label) {
    return std::ranges::any_of(branch.points, [&](const orbit::Solution& point) { return point.label == label; });
  };
  EXPECT_FALSE(branch.failed()) << ended(branch);
  EXPECT_TRUE(has("1-4-I"));
  EXPECT_TRUE(has("1-2-I"));
}

/// .. and all that there are: the response without impacts is left, whose graze is met from its own side at the same
/// value.
TEST(Change, OfAllImpactsTogetherIsPassed) {
  const orbit::Branch branch = branch_of("impact-absorber", {}, "clearance", 1,
                                         {.from = 0.05, .to = 5.0, .most_points = 1500}),
                      plain = branch_of("impact-absorber", {}, "clearance", 3.0, {.from = 1.2, .to = 5.0});
  EXPECT_EQ(branch.points.back().label, "1-0-I") << ended(branch);
  const std::vector<double> a = values(branch, SpecialType::GR), b = values(plain, SpecialType::GR);
  ASSERT_FALSE(a.empty());
  ASSERT_FALSE(b.empty());
  EXPECT_TRUE(std::ranges::any_of(b, [&](double value) { return std::abs(value - a.back()) < 1e-9; }));
}

/// Towards a complete chatter infinitely many impacts are added; the branch goes on behind them, and says where they
/// gather.
TEST(Change, ToACompleteChatterIsPassed) {
  const orbit::Branch branch =
      branch_of("vibro-impact", {{"omega", 2.2}}, "restitution", 0.00542, {.from = 0.005, .to = 0.0056});
  const std::vector<double> onset = values(branch, SpecialType::CH);
  ASSERT_EQ(onset.size(), 1U) << ended(branch);
  EXPECT_TRUE(branch.points.front().chatter) << ended(branch);
  EXPECT_FALSE(branch.points.back().chatter);
  EXPECT_EQ(attractor("vibro-impact", {{"omega", 2.2}}, "restitution", onset[0] - 2e-6), "1-inf-II");
  EXPECT_NE(attractor("vibro-impact", {{"omega", 2.2}}, "restitution", onset[0] + 2e-6), "1-inf-II");
}

/// From within the chatter the same onset is met.
TEST(Change, FromACompleteChatterIsPassed) {
  const orbit::ContinuationOptions range{.from = 0.005, .to = 0.0056};
  const orbit::Branch up = branch_of("vibro-impact", {{"omega", 2.2}}, "restitution", 0.0052, range),
                      down = branch_of("vibro-impact", {{"omega", 2.2}}, "restitution", 0.0055, range);
  const std::vector<double> a = values(up, SpecialType::CH), b = values(down, SpecialType::CH);
  ASSERT_EQ(a.size(), 1U) << ended(up);
  ASSERT_EQ(b.size(), 1U) << ended(down);
  EXPECT_NEAR(a[0], b[0], 1e-6);
  EXPECT_FALSE(up.points.back().chatter) << ended(up);
}

/// The stick-slip cycle on a belt ends where damping is too strong; what is left is steady sliding.
TEST(Change, WithNothingBehindItIsAJump) {
  const orbit::Branch branch = branch_of("belt", {}, "damping_ratio", 0.02, {.from = 0.0, .to = 0.3});
  ASSERT_FALSE(branch.special.empty());
  EXPECT_EQ(branch.special.back().type, SpecialType::SL);
  ASSERT_TRUE(branch.special.back().jump);
  EXPECT_EQ(branch.special.back().jump->kind, Jump::Kind::wanders);
  EXPECT_FALSE(branch.failed());
  EXPECT_NE(attractor("belt", {}, "damping_ratio", branch.special.back().value - 1e-5), "none");
  EXPECT_EQ(attractor("belt", {}, "damping_ratio", branch.special.back().value + 1e-5), "none");
}

/// At a graze an orbit with the impact leaves to one side; to the other it would end its leg at the gap's second zero.
/// Where multipliers are 1e7 the two are one instant to the simulator as far as it is looked at.
TEST(Graze, LeadsToTheSideOnWhichItsImpactIsTheFirstZero) {
  const Overrides overrides = {{"absorber_damping", 0.14786346566974834}, {"absorber_frequency", 0.9336976411009086},
                               {"clearance", 0.892880301769342},          {"damping_ratio", 0.023794430476950974},
                               {"mass_ratio", 0.04892740423358287},       {"omega", 1.3558017703470817},
                               {"restitution", 0.8103137320738286}};
  const orbit::Branch branch =
      branch_of("impact-absorber", overrides, "clearance_lower", 0.892880301769342, {.from = 0.8877, .to = 0.893});
  const std::vector<double> grazes = values(branch, SpecialType::GR);
  ASSERT_EQ(grazes.size(), 1U) << ended(branch);
  EXPECT_EQ(ended(branch), "down: range; up: range");
  EXPECT_EQ(branch.special.front().passage, Passage::persistence);
  EXPECT_LT(branch.points.front().orbit.parameter(), 0.88771);
  for (const orbit::Solution& point : branch.points)
    EXPECT_EQ(point.impacts, point.orbit.parameter() < grazes[0] ? 55 : 54) << point.orbit.parameter();
}

/// Where a motion dies out margins are used up within rounding, that of a stop by 5e-8 of the range as well; behind it
/// the same events go on.
TEST(Change, BehindWhichTheSameEventsGoOnIsNone) {
  const Overrides overrides = {{"damping_ratio", 0.09170313198423563},
                               {"dashpot_ratio", 5.605143802961681},
                               {"mass_ratio", 8.882177764245107},
                               {"omega", 2.4783340590222633},
                               {"phase", 0.0},
                               {"restitution", 0.7378166350693303},
                               {"static_friction", 0.14673072780766264},
                               {"stiffness_ratio", 4.987529339884452}};
  const Posed posed("vibro-impact", overrides, {"force_share_2"}, {0.0});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.0, .to = 1.0});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  const std::vector<double> sticks = values(branch, SpecialType::SL);
  ASSERT_EQ(sticks.size(), 3U) << ended(branch);
  EXPECT_NEAR(sticks.back(), 0.743334030184, 1e-11);
  EXPECT_TRUE(values(branch, SpecialType::GR).empty());
}

/// With another number of impacts that are hardly more than rounding a chatter is the same orbit: where it changes its
/// events that one goes back, and is not what lies beyond.
TEST(Change, OfAChatterIsNotAFoldOntoItself) {
  const Overrides overrides = {{"area", 7.899199000902047e-05},         {"frequency", 265.85461448723464},
                               {"mass", 0.0002857669730364452},         {"mean", 137905.8726074355},
                               {"pulsation", 30565.46527534561},        {"restitution", 0.2689696249584422},
                               {"static_friction", 1.0176945711871863}, {"stiffness", 1556.6594764062866},
                               {"stroke", 0.0011237928851010452}};
  const orbit::Branch branch =
      branch_of("spool", overrides, "preload", 11.0, {.from = 2.6, .to = 23.4, .most_points = 60, .longest_step = 0.1});
  const auto slide = std::ranges::find_if(branch.special, [](const orbit::SpecialPoint& point) {
    return point.type == SpecialType::SL && std::abs(point.value - 11.1392525082) < 1e-9;
  });
  ASSERT_NE(slide, branch.special.end()) << ended(branch);
  EXPECT_EQ(slide->passage, Passage::persistence);
  ASSERT_GT(branch.points.back().orbit.parameter(), 11.2);
  const Posed beyond("spool", overrides, {"preload"}, {11.2});
  const auto settled = beyond.settled();
  ASSERT_TRUE(settled);
  const auto after =
      std::ranges::find_if(branch.points, [](const orbit::Solution& point) { return point.orbit.parameter() > 11.2; });
  EXPECT_EQ(after->label, settled->label);
}

/// A bubble of doubled orbits that opens and closes between two points of the branch: no sign changes there. The bubble
/// was found with short steps.
TEST(Branch, SeesADoublingThatIsTakenBackBetweenTwoPoints) {
  const Overrides damped = {{"damping_ratio", 0.0688}};
  const orbit::ContinuationOptions fine{.from = 0.89, .to = 0.95, .step = 1e-3, .longest_step = 2e-3},
      coarse{.from = 0.89, .to = 0.95, .step = 0.05, .longest_step = 0.1};
  const std::vector<double> all =
      values(branch_of("bilinear-oscillator", damped, "omega", 0.945, fine), SpecialType::PD);
  const orbit::Branch quick = branch_of("bilinear-oscillator", damped, "omega", 0.945, coarse);
  const std::vector<double> again = values(quick, SpecialType::PD);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_LT(all[1] - all[0], 0.002);
  ASSERT_EQ(again.size(), 2U) << quick.points.size() << " points";
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(all[k], again[k], 1e-9);
}

/// Below a fold of the rattle two orbits of one shape live side by side. From a guess near one, with that one taken
/// out, Newton's method comes to the other.
TEST(Deflation, FindsTheOtherOrbitOfAFold) {
  const Posed posed("two-sided-rattle", {}, {"omega"}, {0.8});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.75, .to = 1.0});
  const std::vector<double> folds = values(branch, SpecialType::LP);
  ASSERT_FALSE(folds.empty());
  const Posed there("two-sided-rattle", {{"omega", folds.back() - 2e-2}}, {}, {});
  const auto near = std::ranges::min_element(branch.points, {}, [&](const orbit::Solution& point) {
    return point.label == first->label ? std::abs(point.orbit.parameter() - folds.back() + 2e-2) : INFINITY;
  });
  orbit::Orbit guess = near->orbit;
  guess.values.clear();
  const auto one = orbit::refine(*there.problem, guess);
  ASSERT_TRUE(one);
  orbit::Orbit aside = *one;
  for (Eigen::VectorXd& x : aside.x) x *= 1.05;
  const auto again = orbit::refine(*there.problem, aside);
  ASSERT_TRUE(again);
  EXPECT_LT((again->x[0] - one->x[0]).norm(), 1e-9);
  const auto other = orbit::refine(*there.problem, aside, {*one});
  ASSERT_TRUE(other);
  EXPECT_GT((other->x[0] - one->x[0]).norm(), 1e-3);
}

}  // namespace
}  // namespace slapstick::test
