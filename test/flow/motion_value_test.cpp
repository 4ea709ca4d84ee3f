/// Motions and Systems as values: copies, moves and lifetimes.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "flow/compiled_system.hpp"
#include "flow/runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

/// The state and the events of a motion over its next `time` time units, to the last bit.
struct Course {
  std::vector<double> times;
  State end;
  friend bool operator==(const Course&, const Course&) = default;
};

Course course(Motion& motion, double time) {
  Course seen;
  for (const Event& event : testing::run(motion, time)) seen.times.push_back(event.time.since({}));
  seen.end = motion.state();
  return seen;
}

TEST(MotionAsAValue, CopyGoesOnWithTheSameBitsAndByItself) {
  const System system(oracle::vibro_impact(1.5));
  Motion motion(system, {-0.5, 0.0, 0.0, 0.0});
  (void)course(motion, 40.0);
  Motion copy = motion;
  const Course first = course(motion, 40.0);
  EXPECT_FALSE(first.times.empty());
  EXPECT_EQ(course(copy, 40.0), first);
}

TEST(MotionAsAValue, AssignmentTakesAMotionOfAnotherSystemWithMoreNumbers) {
  const System small(oracle::ball(0.5)), large(oracle::vibro_impact(1.5));
  ASSERT_LT(small.model().size(), large.model().size());
  Motion motion(small, {1.0, 0.0});
  Motion other(large, {-0.5, 0.0, 0.0, 0.0});
  motion = other;
  EXPECT_EQ(course(motion, 40.0), course(other, 40.0));
  EXPECT_EQ(motion.system().model().name, large.model().name);
}

TEST(MotionAsAValue, AssignmentToItselfChangesNothing) {
  const System system(oracle::vibro_impact(1.5));
  Motion motion(system, {-0.5, 0.0, 0.0, 0.0});
  Motion copy = motion;
  const Motion& itself = motion;
  motion = itself;
  EXPECT_EQ(course(motion, 40.0), course(copy, 40.0));
}

TEST(MotionAsAValue, OutlivesTheSystemItWasMadeFrom) {
  auto made = [] { return Motion(System(oracle::vibro_impact(1.5)), {-0.5, 0.0, 0.0, 0.0}); };
  Motion orphan = made();
  const System system(oracle::vibro_impact(1.5));
  Motion motion(system, {-0.5, 0.0, 0.0, 0.0});
  EXPECT_EQ(course(orphan, 40.0), course(motion, 40.0));
}

TEST(SystemAsAValue, CopyStandsForTheSameCompiledModelAndIsLeftWholeByAMove) {
  System system(oracle::vibro_impact(1.5));
  const System copy = system;
  const System moved = std::move(system);
  EXPECT_EQ(&copy.compiled(), &moved.compiled());
  EXPECT_EQ(&system.compiled(), &moved.compiled());  // NOLINT(bugprone-use-after-move): what is promised
}

}  // namespace
}  // namespace slapstick
