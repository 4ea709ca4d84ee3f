#pragma once
/// An impact section run in stages, so that it can be stopped (flow/stage.hpp).
#include "slapstick/flow/stage.hpp"
#include "slapstick/section/impact_section.hpp"

namespace slapstick {

/// Runs to `end`, or until `use(point)` returns false for an impact.
/// @param stop  null: cannot be stopped
/// @returns false if it was stopped
/// @throws NumericalError as Motion::advance
template <class Use>
bool run_impacts(ImpactSection& section, Instant end, const std::atomic<bool>* stop, const Use& use) {
  SectionPoint point;
  Instant stage = section.motion().time();
  do {
    stage = next_stage(section.motion().system(), stage, end);
    while (section.next(stage, point)) {
      if (!use(point)) return true;
      if (stopped(stop)) return false;
    }
    if (stopped(stop)) return false;
  } while (stage < end);
  return true;
}

}  // namespace slapstick
