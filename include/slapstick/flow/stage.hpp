#pragma once
/// Long runs in stages, so that a wish to stop is heard within a second also where one forcing period takes minutes.
///
/// Stages end at instants that depend on the System alone, never on when somebody looked: a run has the same bits
/// whether it could be stopped or not.
#include <atomic>

#include "slapstick/flow/motion.hpp"

namespace slapstick {

/// The end of the stage that `now` lies in, strictly later than `now` and at most `end`: 4096 periods, or as many of
/// them, or such a part of one, as a million windows fill (a twentieth of a second for the paper's system).
[[nodiscard]] Instant next_stage(const System& system, Instant now, Instant end);

[[nodiscard]] inline bool stopped(const std::atomic<bool>* stop) {
  return stop != nullptr && stop->load(std::memory_order_relaxed);
}

[[nodiscard]] inline const Motion& motion_of(const Motion& motion) { return motion; }
/// Of a TangentMotion or a section.
template <class Carrier>
[[nodiscard]] const Motion& motion_of(const Carrier& carrier) {
  return carrier.motion();
}

/// Advances a Motion or TangentMotion to `end` and calls `use()` after every event.
/// @param stop  null: cannot be stopped
/// @returns false if it was stopped; the motion then stands somewhere before `end`
/// @throws NumericalError as Motion::advance
template <class AnyMotion, class Use>
bool run_to(AnyMotion& motion, Instant end, const std::atomic<bool>* stop, const Use& use) {
  Instant stage = motion_of(motion).time();
  do {
    stage = next_stage(motion_of(motion).system(), stage, end);
    while (motion.advance(stage) == Outcome::event) {
      use();
      if (stopped(stop)) return false;
    }
    if (stopped(stop)) return false;
  } while (stage < end);
  return true;
}

}  // namespace slapstick
