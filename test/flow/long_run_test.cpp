/// K32: long runs lose no phase. SLAPSTICK_CAMPAIGN=100 runs the 1e7 periods of shared/reliability.md.
#include <gtest/gtest.h>

#include <algorithm>

#include "flow/runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

TEST(LongRun, OfAStableOrbitReturnsToItsPointAndPhase) {
  const System system(oracle::vibro_impact(2.2));
  Motion motion(system, {-0.5, 0, 0, 0});
  const std::int64_t settle = 2000, periods = 100'000 * testing::campaign();
  while (motion.advance({settle, 0.0}) == Outcome::event) {
  }
  const State point = motion.state();
  double phase = -1.0, worst_phase = 0.0, worst_state = 0.0;
  long impacts = 0;
  for (std::int64_t p = settle + 1; p <= settle + periods; ++p) {
    while (motion.advance({p, 0.0}) == Outcome::event) {
      if (motion.event().kind != EventKind::impact) continue;
      ++impacts;
      if (phase < 0.0) phase = motion.event().time.fraction;
      worst_phase = std::max(worst_phase, std::abs(motion.event().time.fraction - phase));
    }
    if (p % 1000 == 0) {
      const State now = motion.state();
      for (std::size_t i = 0; i < now.size(); ++i) worst_state = std::max(worst_state, std::abs(now[i] - point[i]));
    }
  }
  std::printf("%ld impacts, drift of the impact phase %.1e, of the fixed point %.1e\n", impacts, worst_phase,
              worst_state);
  EXPECT_EQ(impacts, periods);
  EXPECT_LE(worst_phase, 2e-15);
  EXPECT_LE(worst_state, 1e-12);
}

TEST(LongRun, CountsItsWorkAsExpected) {  // a change in the work done is noticed
  const System system(oracle::vibro_impact(2.2));
  Motion motion(system, {-0.5, 0, 0, 0});
  while (motion.advance({1000, 0.0}) == Outcome::event) {
  }
  const Counters& counters = motion.counters();
  EXPECT_EQ(counters.grazes, 0);
  EXPECT_NEAR(static_cast<double>(counters.impacts), 1000, 5);
  EXPECT_LE(counters.windows, 4 * counters.segments);
  EXPECT_LE(counters.evaluations, 8 * counters.events);
}

}  // namespace
}  // namespace slapstick
