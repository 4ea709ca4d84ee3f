#pragma once
/// Pixels of `quick` in the lanes of a batch: lanes give the points at phase 0, the scalar engine confirms the cycles.
///
/// A pixel's run ends as soon as a cycle is confirmed, at most after MapProblem::periods. Every fourth point is
/// compared with those before; what returns within the tolerance, and at the end what comes nearer, is a start for
/// Newton's method (section/confirmation.hpp). A pixel makes its System only then, and most modes are never made.
/// Cost: a lane's periods, a System, Newton's method and the record of the cycle. Of a motion that comes to a known
/// cycle (known_cycles.hpp) the periods are all, and they are fewer.
#include "slapstick/sweep/map.hpp"
#include "sweep/known_cycles.hpp"
#include "sweep/map_pixel.hpp"

namespace slapstick::sweep {

struct LaneFinding {
  Classification found;
  std::unique_ptr<System> system;  ///< null if nobody needed it
};

/// Runs those of the tasks that lanes can decide: a driven model without translations that fits the lanes. `take` gets
/// each as it is decided; those it never gets are a Motion's. What a pixel gives depends on its model, its start and
/// the known cycles only.
/// @param known  null: none
void run_quick_in_lanes(const MapProblem& problem, std::span<const PixelTask> tasks, const KnownCycles* known,
                        const std::function<void(std::size_t, LaneFinding&&)>& take);

}  // namespace slapstick::sweep
