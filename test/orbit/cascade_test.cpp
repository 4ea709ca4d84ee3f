/// A cascade followed to where its grazes and folds are nearly one: a frame that friction holds, hit from inside some
/// 30 times a period.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::test {
namespace {

using orbit::CurveEnd, orbit::Jump, orbit::Occurrence, orbit::Passage, orbit::Sliding, orbit::SpecialType;

const Overrides of_a_cascade = {{"clearance", 0.4230402420127488},
                                {"damping", 0.03423195895104019},
                                {"drive", 0.9112589278007787},
                                {"friction", 3.395538214067513},
                                {"restitution", 0.7760093846640501}};

orbit::Branch follow_omega(const Overrides& fixed, double at, const orbit::ContinuationOptions& options) {
  const Posed posed("stick-slip-impact", fixed, {"omega"}, {at});
  const auto first = posed.settled();
  if (!first) throw NumericalError("no orbit at " + std::to_string(at));
  return orbit::follow(*posed.problem, first->orbit, options);
}

/// In a cascade folds follow grazes ever more closely: at 1e-7 of the range the orbit found behind a graze lies beyond
/// the next fold, where the branch has turned once more, and seems to be a persistence. In a range of 1e-5 the nearest
/// orbit is the one that says least.
TEST(Graze, IsAFoldWhateverFoldFollows) {
  struct Case {
    double at, from, to;
    int most_points;
  };
  for (const auto& [at, from, to, most_points] :
       {Case{0.31714, 0.317127, 2.3, 16}, Case{0.317135, 0.3171255, 0.317145, 60}}) {
    const orbit::Branch branch =
        follow_omega(of_a_cascade, at, {.from = from, .to = to, .most_points = most_points, .longest_step = 0.1});
    const auto graze = std::ranges::find_if(branch.special, [](const orbit::SpecialPoint& point) {
      return point.type == SpecialType::GR && std::abs(point.value - 0.317127845087) < 1e-11;
    });
    ASSERT_NE(graze, branch.special.end()) << ended(branch);
    EXPECT_EQ(graze->passage, Passage::fold);
    ASSERT_NE(graze, branch.special.begin()) << "the fold is between the graze and the low end of the branch";
    EXPECT_EQ(graze[-1].type, SpecialType::LP);
    EXPECT_GT(graze[-1].value, graze->value);
  }
}

/// Where impacts are hardly more than rounding, the orbit found behind a graze is an earlier one of the branch, which
/// seems to go on with it. The place is that of nine grazes in 0.3171:0.31713. Between impacts friction holds the
/// frame: the cascade gathers by what that leaves of the restitution, r' = (5 r - 1) / 6 here. By r the place was known
/// to 1e-7 only.
TEST(Cascade, EndsAtItsLimitAndDoesNotLeadBackIntoItself) {
  const orbit::Branch branch = follow_omega(of_a_cascade, 0.31755, {.from = 0.317, .to = 0.3176, .longest_step = 0.1});
  ASSERT_FALSE(branch.special.empty()) << ended(branch);
  EXPECT_EQ(branch.special.front().type, SpecialType::CH) << ended(branch);
  EXPECT_NEAR(branch.special.front().value, 0.3171176583500, branch.special.front().error + 1e-13);
  EXPECT_LT(branch.special.front().error, 1e-11);
  for (const orbit::SpecialPoint& point : branch.special)
    EXPECT_EQ((point.passage == Passage::fold), point.type == SpecialType::GR) << point.value;
}

/// With fewer grazes than a limit can be taken from it is not known to be a cascade, but a branch that is led back over
/// itself is no motion's: that is said.
TEST(Branch, ThatIsLedBackOverItselfSaysSo) {
  const orbit::Branch branch =
      follow_omega(of_a_cascade, 0.317119, {.from = 0.3171, .to = 0.3171195, .longest_step = 0.1});
  EXPECT_TRUE(branch.failed());
  EXPECT_NE(ended(branch).find("leads back over the branch itself"), std::string::npos) << ended(branch);
  for (const orbit::SpecialPoint& point : branch.special)  // the change that misled it is not there
    EXPECT_EQ((point.passage == Passage::fold), point.type == SpecialType::GR) << point.value;
}

/// Behind a graze 2e-8 of the range before a fold the orbit that is found lies beyond the fold. Followed the wrong way
/// the branch came back up the whole cascade, each point twice.
TEST(Cascade, IsFollowedDownwardsThroughEachFoldOnce) {
  const Overrides overrides = {{"clearance", 0.4845448322189744},
                               {"damping", 0.039413741949173096},
                               {"drive", 0.955244801907239},
                               {"friction", 3.21028381157707},
                               {"restitution", 0.7748947988455672}};
  const orbit::Branch branch =
      follow_omega(overrides, 0.307801, {.from = 0.2962, .to = 2.6658, .most_points = 16, .longest_step = 0.1});
  const auto graze = std::ranges::find_if(branch.special, [](const orbit::SpecialPoint& point) {
    return point.type == SpecialType::GR && std::abs(point.value - 0.307784900924) < 1e-11;
  });
  ASSERT_NE(graze, branch.special.end()) << ended(branch);
  EXPECT_EQ(graze->passage, Passage::fold);
  ASSERT_NE(graze, branch.special.begin());
  EXPECT_EQ(graze[-1].type, SpecialType::LP);
  EXPECT_NEAR(graze[-1].value, 0.307784947026, 1e-11);
  for (const orbit::SpecialPoint& point : branch.special)
    EXPECT_EQ(std::ranges::count_if(branch.special,
                                    [&](const orbit::SpecialPoint& other) {
                                      return other.type == point.type && std::abs(other.value - point.value) < 1e-10;
                                    }),
              1)
        << point.value;
}

}  // namespace
}  // namespace slapstick::test
