/// Branches: what changes along them, by a second route each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "flow/contact_state.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/cycle_energy.hpp"

namespace slapstick::test {
namespace {

using orbit::Passage;

TEST(Branch, RefusesAStartOutsideItsRange) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  EXPECT_THROW((void)orbit::follow(*posed.problem, first->orbit, {.from = 2.5, .to = 3.0}), InputError);
}

/// What a motion that starts on an orbit becomes at another frequency.
std::string label_at(double omega, const orbit::Orbit& orbit) {
  const Posed posed("vibro-impact", {{"omega", omega}}, {}, {});
  const double whole = std::floor(orbit.t[0]);
  Eigen::VectorXd x = orbit.x[0];
  x[0] = std::min(x[0], 0.0);  // the gap is -x[0] up to the rounding of Newton's method
  Motion motion(posed.system, flow::user_state(posed.system, x),
                {static_cast<std::int64_t>(whole), orbit.t[0] - whole});
  while (motion.advance({static_cast<std::int64_t>(whole) + 1, 0.0}) == Outcome::event) {
  }
  return classify(posed.system, motion.state(), {.transient_periods = 3000}).label;
}

/// What the attractor is on either side of each special point of the 1-1 branch, by brute force.
TEST(Branch, OfThePaperChangesWhereItsAttractorDoes) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 1.1135, .to = 2.9});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  const std::vector<std::pair<std::string, std::pair<std::string, std::string>>> expected = {
      {"GR", {"", "1-1-I"}}, {"SL", {"1-1-I", "1-1-II"}}, {"SL", {"1-1-II", "1-1-I"}}, {"PD", {"1-1-I", "2-2-I"}}};
  std::size_t k = 0;
  for (const orbit::SpecialPoint& point : branch.special) {
    const std::string below = label_at(point.value - 3e-4, point.solution.orbit),
                      above = label_at(point.value + 3e-4, point.solution.orbit);
    if (below == above) continue;  // a reversal more or less within the sticking motion
    ASSERT_LT(k, expected.size());
    EXPECT_EQ(name(point.type), expected[k].first) << point.value;
    if (!expected[k].second.first.empty()) {  // below the graze the 1-2 orbit is unstable and other attractors live
      EXPECT_EQ(below, expected[k].second.first) << point.value;
    }
    EXPECT_EQ(above, expected[k].second.second) << point.value;
    ++k;
  }
  EXPECT_EQ(k, expected.size());
  for (const orbit::Solution& point : branch.points)
    EXPECT_TRUE(point.is_motion) << point.orbit.parameter() << " " << point.why;
}

/// A coarse step over several changes places them where a fine one does: margins that are rounding are no changes.
TEST(Branch, SpecialPointsDoNotDependOnTheRange) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  for (const auto& [from, to] : {std::pair(1.05, 4.0), std::pair(1.3, 3.2), std::pair(1.4, 2.3)}) {
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = from, .to = to});
    std::vector<double> stick;
    for (const orbit::SpecialPoint& point : branch.special)
      if (point.type == orbit::SpecialType::SL && point.value > 1.4) stick.push_back(point.value);
    ASSERT_EQ(stick.size(), 3U) << from;
    EXPECT_NEAR(stick[0], 1.4617750474838, 1e-9) << from;
    EXPECT_NEAR(stick[1], 1.5681567254004, 1e-9) << from;
    EXPECT_NEAR(stick[2], 1.6044013956145, 1e-9) << from;
  }
}

/// An impact whose speed goes to zero is lost, not the branch: the orbit without it goes on.
TEST(Branch, GoesOnWithoutAnImpactThatIsLost) {
  const Posed posed("vibro-impact", {}, {"clearance"}, {0.0});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.0, .to = 0.4});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  ASSERT_FALSE(branch.points.empty());
  EXPECT_EQ(branch.points.back().impacts, 0);
  EXPECT_TRUE(branch.points.back().is_motion);
  EXPECT_EQ(branch.points.back().orbit.parameter(), 0.4);
  const auto graze = std::ranges::find(branch.special, orbit::SpecialType::GR, &orbit::SpecialPoint::type);
  ASSERT_NE(graze, branch.special.end());
  EXPECT_NEAR(graze->value, 0.24955384, 1e-7);
}

/// Linear response and impacting orbits meet at one graze, from whichever side it is reached.
TEST(Branch, MeetsAGrazeFromBothSidesAtTheSameValue) {
  const double exact = 1.0 / std::sqrt(9.16);  // 1 / |1 - w^2 + 2 i z w| at w = 2, z = 0.1
  const Posed outside("impact-oscillator", {}, {"clearance"}, {0.5});
  const auto first = outside.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*outside.problem, first->orbit, {.from = 0.25, .to = 0.6});
  const auto graze = std::ranges::find(branch.special, orbit::SpecialType::GR, &orbit::SpecialPoint::type);
  ASSERT_NE(graze, branch.special.end());
  EXPECT_NEAR(graze->value, exact, 1e-11);
  EXPECT_EQ(graze->passage, Passage::persistence);
  const Posed inside("impact-oscillator", {}, {"clearance"}, {0.2});
  const auto hitting = inside.settled(1);
  ASSERT_TRUE(hitting);
  const orbit::Branch back = orbit::follow(*inside.problem, hitting->orbit, {.from = 0.15, .to = 0.6});
  const auto same = std::ranges::find(back.special, orbit::SpecialType::GR, &orbit::SpecialPoint::type);
  ASSERT_NE(same, back.special.end());
  EXPECT_NEAR(same->value, exact, 1e-9);
  EXPECT_EQ(back.points.back().impacts, 0) << ended(back);
}

/// A doubling 4e-7 before an impact's speed goes to zero lies in one of the last step's parts, nearly at its end: from
/// one start of these it was not seen.
TEST(Branch, SeesADoublingJustBeforeAGrazeFromEveryStart) {
  const Overrides values = {
      {"cosine", 0.961332572276375}, {"damping_ratio", 0.0941735420012799}, {"restitution", 0.9512984707492715}};
  for (const double start : {0.94, 0.97, 1.0}) {
    const Posed posed("impact-oscillator", values, {"omega"}, {start});
    const auto first = posed.settled(1);
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.9, .to = 1.05});
    const auto pd = std::ranges::find(branch.special, orbit::SpecialType::PD, &orbit::SpecialPoint::type);
    ASSERT_NE(pd, branch.special.end()) << start;
    const Posed there("impact-oscillator", values, {"omega"}, {pd->value});
    const auto orbit = orbit::refine(*there.problem, pd->solution.orbit);
    ASSERT_TRUE(orbit);
    const auto mu = orbit::describe(*there.problem, *orbit, nullptr).multipliers;
    EXPECT_LT(std::min(std::abs(mu[0] + 1.0), std::abs(mu[1] + 1.0)), 1e-4) << start;
  }
}

/// A branch that was born at a doubling is not doubled there again.
TEST(Branch, IsNotDoubledAtItsBirth) {
  const Posed posed("shaken-table", {{"restitution", 0.5}}, {"acceleration"}, {1.4});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::ContinuationOptions options{.from = 1.3, .to = 1.6};
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, options);
  ASSERT_EQ(branch.special.size(), 1U);
  ASSERT_EQ(branch.special.front().born.size(), 1U);
  const orbit::Branch second = orbit::follow(*posed.problem, branch.special.front().born.front(), options);
  ASSERT_FALSE(second.special.empty());
  EXPECT_EQ(second.special.front().occurrence, orbit::Occurrence::end_of_doubled);
  EXPECT_TRUE(second.special.front().born.empty());
}

/// Behind the doubling of vibro-impact's 2-3 orbit the doubled one's events change within a step: it is begun so near
/// that it is a motion.
TEST(DoubledOrbit, IsBegunWhereItIsAMotion) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::ContinuationOptions options{.from = 1.1, .to = 1.2};
  orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 1.1, .to = 2.3});
  for (const double doubling : {1.11329814659, 1.11360700997}) {
    const auto pd = std::ranges::find_if(branch.special, [&](const orbit::SpecialPoint& point) {
      return point.type == orbit::SpecialType::PD && std::abs(point.value - doubling) < 1e-8 &&
             point.occurrence != orbit::Occurrence::end_of_doubled;
    });
    ASSERT_NE(pd, branch.special.end()) << doubling;
    ASSERT_EQ(pd->born.size(), 1U);
    branch = orbit::follow(*posed.problem, pd->born.front(), options);
    EXPECT_FALSE(branch.failed()) << ended(branch);
    EXPECT_TRUE(std::ranges::all_of(branch.points, &orbit::Solution::is_motion)) << doubling;
  }
}

/// A mass between equal stops: where its symmetric orbit loses the symmetry, a branch and its mirror image are born.
/// One is followed, from the symmetric orbit to where it comes back to it.
TEST(Symmetry, IsBrokenToABranchAndItsImage) {
  const Posed posed("two-sided-rattle", {}, {"omega"}, {1.6});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::ContinuationOptions options{.from = 1.0, .to = 1.7};
  const orbit::Branch trunk = orbit::follow(*posed.problem, first->orbit, options);
  ASSERT_EQ(trunk.special.size(), 2U);
  for (const orbit::SpecialPoint& point : trunk.special) {
    ASSERT_EQ(name(point.type), "BP");
    EXPECT_EQ(point.born.size(), 1U) << name(point.occurrence);
  }
  const orbit::Branch broken = orbit::follow(*posed.problem, trunk.special.back().born.front(), options);
  EXPECT_FALSE(broken.failed()) << ended(broken);
  EXPECT_NEAR(broken.special.front().value, trunk.special.front().value, 1e-8);
  EXPECT_NEAR(broken.special.back().value, trunk.special.back().value, 1e-8);
  EXPECT_EQ(std::ranges::count(broken.special, orbit::SpecialType::BP, &orbit::SpecialPoint::type), 2);
  EXPECT_FALSE(orbit::lies_on(*posed.problem, broken, first->orbit));
  EXPECT_TRUE(orbit::lies_on(*posed.problem, trunk, first->orbit));
}

/// A parameter that passes zero has no size of its own there. Load and stop are shifted together: the doubling is at
/// the same place against the stop.
TEST(Branch, FindsADoublingWhereItsParameterIsZero) {
  const double doubling = 0.330330594422301;  // of the clearance without load; cases.json
  const Posed posed("impact-oscillator", {{"clearance", doubling}}, {"load"}, {0.1});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = -0.2, .to = 0.2});
  EXPECT_FALSE(branch.failed()) << ended(branch);
  const auto pd = std::ranges::find(branch.special, orbit::SpecialType::PD, &orbit::SpecialPoint::type);
  ASSERT_NE(pd, branch.special.end());
  EXPECT_NEAR(pd->value, 0.0, 1e-12);
}

/// Forced at even harmonics only, an orbit may be two equal halves; a frame that drifts makes them look alike or not,
/// as far as it has come. Where all orbits of a branch are so its folds are folds; where one becomes so the branch
/// ends, in the doubling of the half.
TEST(Symmetry, OfEvenHarmonicsAndADriftAreNotTakenForADoubling) {
  for (const double away : {0.0, 1e3}) {
    const Posed posed("stick-slip-impact", {}, {"drive"}, {0.9});
    State start = posed.start();
    for (std::size_t i = 0; i < start.size() / 2; ++i) start[i] += away;
    const auto first = orbit::settle(*posed.problem, posed.system, start).orbit;
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.3, .to = 2.7});
    const auto fold = std::ranges::find(branch.special, orbit::SpecialType::LP, &orbit::SpecialPoint::type);
    ASSERT_NE(fold, branch.special.end());
    EXPECT_NEAR(fold->value, 0.813224728387, 1e-9);
    const orbit::SpecialPoint& end = branch.special.back();
    ASSERT_EQ(end.type, orbit::SpecialType::PD);
    EXPECT_EQ(end.occurrence, orbit::Occurrence::end_of_doubled);
    const orbit::Orbit& halves = end.solution.orbit;
    for (std::size_t i = 0, half = halves.legs() / 2; i < half; ++i)
      EXPECT_NEAR(halves.t[i + half], halves.t[i] + 0.5, 1e-3);
  }
}

/// The image by a second route: the motion from the reversed state, half a period later, settles on it.
TEST(Symmetry, ImageIsTheMotionFromTheReversedState) {
  const Posed posed("two-sided-rattle", {}, {"omega"}, {1.4});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 1.39, .to = 1.41});
  State reversed = orbit::at_phase_zero(*posed.problem, first->orbit);
  for (double& number : reversed) number = -number;
  const auto image = orbit::orbit_near(*posed.problem, Motion(posed.system, reversed, {0, 0.5}), 200, 1);
  ASSERT_TRUE(image);
  EXPECT_TRUE(orbit::lies_on(*posed.problem, branch, first->orbit));
  EXPECT_FALSE(orbit::lies_on(*posed.problem, branch, image->orbit));
  EXPECT_TRUE(orbit::image_lies_on(*posed.problem, branch, image->orbit));
  EXPECT_FALSE(orbit::image_lies_on(*posed.problem, branch, first->orbit));
}

/// A branch that goes on to its own images comes back over itself: every place on it is listed once.
TEST(Symmetry, LeadsABranchOverNoPlaceTwice) {
  const Posed posed("two-sided-rattle", {}, {"omega"}, {1.5});
  const auto first = posed.settled(1);
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 0.3, .to = 4.0});
  std::vector<double> places;
  for (const orbit::SpecialPoint& point : branch.special)
    if (point.type != orbit::SpecialType::BP) places.push_back(point.value);
  ASSERT_GT(places.size(), 10U);
  std::ranges::sort(places);
  const auto twice = std::ranges::adjacent_find(places, [](double a, double b) { return b - a < 1e-7; });
  EXPECT_EQ(twice, places.end()) << ended(branch);
}

/// A load, or walls that are not about the middle of the spring, leave no image; a middle elsewhere does.
TEST(Symmetry, IsTheModelsAboutAnyPoint) {
  const auto is_own_image = [](double load, double upper, double lower) {
    const Posed posed("two-sided-rattle", {{"load", load}, {"clearance", upper}, {"clearance_lower", lower}}, {"omega"},
                      {1.6});
    const auto first = posed.settled(1);
    const orbit::Branch branch = orbit::follow(*posed.problem, first.value().orbit, {.from = 1.59, .to = 1.61});
    return orbit::image_lies_on(*posed.problem, branch, first->orbit);
  };
  EXPECT_TRUE(is_own_image(0.0, 0.5, 0.5));
  EXPECT_TRUE(is_own_image(0.1, 0.6, 0.4));
  EXPECT_FALSE(is_own_image(0.1, 0.5, 0.5));
  EXPECT_FALSE(is_own_image(0.0, 0.6, 0.4));
}

/// A block that only sticks, or one whose every direction is annihilated, has no multiplier but zeros.
TEST(Orbit, WithoutAFreeDirectionHasZeroMultipliers) {
  const Posed posed("impact-oscillator", {{"restitution", 0.0}}, {}, {});
  const auto found = posed.settled();
  ASSERT_TRUE(found);
  for (const auto& multiplier : found->multipliers) EXPECT_EQ(multiplier, 0.0);
  const Posed block("sliding-block", {}, {}, {});
  const auto slides = block.settled();
  ASSERT_TRUE(slides);
  for (const auto& multiplier : slides->multipliers) EXPECT_EQ(multiplier, 0.0);
}

/// Every point is a motion of its own, unstable ones too: the simulator ends a cycle where it began.
TEST(Branch, UnstablePointsAreOrbitsOfTheSimulator) {
  const Posed posed("vibro-impact", {}, {"omega"}, {2.2});
  const auto first = posed.settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = 2.2, .to = 4.0});
  const orbit::Solution& last = branch.points.back();
  EXPECT_FALSE(last.stable());
  const System system(posed.definition.build({{"omega", last.orbit.parameter()}}));
  const double whole = std::floor(last.orbit.t[0]);
  Motion motion(system, flow::user_state(system, last.orbit.x[0]),
                {static_cast<std::int64_t>(whole), last.orbit.t[0] - whole});
  const Eigen::VectorXd begin = flow::contact_state(motion);
  for (std::size_t i = 0; i < last.orbit.legs(); ++i)
    ASSERT_EQ(motion.advance(motion.time().plus(2.0)), Outcome::event);
  EXPECT_LT((flow::contact_state(motion) - begin).norm(), 1e-11 * begin.norm());
}

/// A reversal of the carriage moves onto an impact, and from there on the impact reverses it: the impact stays. By
/// brute force the orbit of the new events is on the branch, and motions leave it where it folds.
TEST(Branch, KeepsAnImpactThatAReversalMeets) {
  const std::string model = std::string(SLAPSTICK_ORBIT_MODELS) + "rail-hammer.toml";
  const auto one_impact = [](const Posed& posed, bool stable) {
    const auto wanted = [=](const orbit::Solution& s) { return s.impacts == 1 && s.stable() == stable; };
    const auto all =
        orbit::search(*posed.problem, posed.system, posed.start(), {.starts = 200, .enough = wanted}).orbits;
    return std::ranges::find_if(all, wanted)->orbit;
  };
  const Posed posed(model, {}, {"frequency"}, {5.9905});
  const orbit::Branch branch =
      orbit::follow(*posed.problem, one_impact(posed, false), {.from = 5.985, .to = 6.0, .longest_step = 0.1});
  const auto place = [&](orbit::SpecialType type) {
    const auto found = std::ranges::find(branch.special, type, &orbit::SpecialPoint::type);
    return found == branch.special.end() ? 0.0 : found->value;
  };
  const double fold = place(orbit::SpecialType::LP);
  EXPECT_TRUE(std::ranges::any_of(branch.special, [](const auto& s) { return std::abs(s.value - 5.991930921) < 1e-8; }))
      << ended(branch);
  EXPECT_NEAR(fold, 5.992745338, 1e-8) << ended(branch);
  const Posed beyond(model, {}, {"frequency"}, {5.9925});
  EXPECT_TRUE(orbit::lies_on(*beyond.problem, branch, one_impact(beyond, false)));
  EXPECT_TRUE(orbit::lies_on(*beyond.problem, branch, one_impact(beyond, true)));
  const State start = orbit::at_phase_zero(*beyond.problem, one_impact(beyond, true));
  const auto label = [&](double frequency) {
    const Posed at(model, {{"frequency", frequency}}, {}, {});
    return classify(at.system, start, {.transient_periods = 3000}).label;
  };
  EXPECT_EQ(label(fold - 2e-5), "1-1-I");
  EXPECT_NE(label(fold + 2e-5), "1-1-I");
}

/// A search finds the unstable orbit from which a doubled one was born, beside that one.
TEST(Search, FindsStableAndUnstableOrbits) {
  const Posed posed("vibro-impact", {{"omega", 2.88}}, {}, {});
  const auto found =
      orbit::search(*posed.problem, posed.system, posed.start(), {.most_n = 2, .starts = 8, .periods = 100}).orbits;
  std::string all;
  for (const orbit::Solution& solution : found)
    all += solution.label + (solution.stable() ? " stable, " : " unstable, ");
  EXPECT_NE(all.find("1-1-I unstable"), std::string::npos) << all;
  EXPECT_NE(all.find("2-2-I stable"), std::string::npos) << all;
}

/// How many of a chatter's impacts are legs of an orbit depends on where a motion was recorded: it is one motion all
/// the same, also run through twice.
TEST(Search, ListsAChatteringOrbitOnce) {
  const Posed posed("vibro-impact", {{"omega", 0.5}}, {}, {});
  const auto found =
      orbit::search(*posed.problem, posed.system, posed.start(), {.most_n = 2, .starts = 3, .periods = 60}).orbits;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().label, "1-inf-II");
}

/// A complete chatter: infinitely many impacts, some thirty of them flown, the rest summed; still one isolated orbit
/// with exact multipliers.
TEST(Orbit, OfCompleteChatterIsSolved) {
  const Posed posed("vibro-impact", {{"omega", 0.55}}, {}, {});
  const auto found = posed.settled();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->label, "1-inf-II");
  const Classification seen = classify(posed.system, posed.start());
  ASSERT_FALSE(seen.multipliers.empty());
  EXPECT_NEAR(std::abs(found->multipliers.front()), std::abs(seen.multipliers.front()), 1e-7);
  EXPECT_LT(std::abs(cycle_energy(*posed.problem, found->orbit).balance()),
            1e-10 * cycle_energy(*posed.problem, found->orbit).input);
}

/// A model without forcing: the period is an unknown. On the belt: the closed form of stick and slip.
TEST(Orbit, OfAnAutonomousModelHasItsOwnPeriod) {
  const Posed posed("belt", {}, {}, {});
  const auto found = posed.settled();
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_motion) << found->why;
  Motion motion(posed.system, posed.start());
  double last = 0.0, period = 0.0;
  for (int k = 0; k < 40; ++k) {
    ASSERT_EQ(motion.advance({1'000'000, 0.0}), Outcome::event);
    if (motion.event().kind != EventKind::release) continue;
    period = motion.event().time.since({}) - last;
    last = motion.event().time.since({});
  }
  EXPECT_NEAR(found->cycle, period, 1e-11 * period);
}

}  // namespace
}  // namespace slapstick::test
