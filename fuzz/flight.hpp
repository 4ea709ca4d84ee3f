#pragma once
/// A bounded piece of a motion, with the promises that every motion keeps.
#include <algorithm>
#include <cmath>

#include "slapstick/flow/motion.hpp"
#include "target.hpp"

namespace slapstick::fuzz {

/// At most 40 events, and as much time as 300 windows (System::windows_per_period) or two periods last.
inline void fly(const System& system, const State& start) {
  constexpr int most_events = 40;
  constexpr double most_windows = 300.0, most_periods = 2.0;
  Motion motion(system, start);
  const Instant end = Instant{}.plus(std::min(most_periods, most_windows / system.windows_per_period()));
  for (int i = 0; i < most_events; ++i) {
    const Instant before = motion.time();
    const bool ended = motion.advance(end) == Outcome::reached_end;
    demand(before <= motion.time() && motion.time() <= end, "time runs forwards, and not past the end");
    for (const double number : motion.state()) demand(std::isfinite(number), "a state is finite");
    if (ended) return;
    demand(motion.event().kind != EventKind::impact || motion.event().w > 0.0, "an impact has a speed");
  }
}

}  // namespace slapstick::fuzz
