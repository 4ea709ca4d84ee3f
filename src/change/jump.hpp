#pragma once
/// What motions that start on an orbit do, by running them.
#include "change/reshape.hpp"

namespace slapstick::orbit {

/// A motion from inside a leg of an orbit that may itself be no motion any more; empty where a guard is used up there.
/// @param part  of the leg's length
[[nodiscard]] std::optional<Motion> motion_from(const System& system, const ModeSet& set, const Orbit& orbit,
                                                std::size_t leg, double part);

/// What the motion does just beyond a change of a stable orbit, by running it.
struct MotionBeyond {
  std::optional<Jump> jump;        ///< the motion leaves the orbit
  std::optional<HalfBranch> next;  ///< the orbit that it settles on has hardly moved: no jump
  bool family = false;             ///< the orbit that it settles on is one of a family
};
[[nodiscard]] MotionBeyond run_beyond(const Problem& problem, const PathPoint& change, double range,
                                      const std::atomic<bool>* stop);

/// Is the motion discontinuous at a change, as where a velocity comes to zero and static friction holds it that exceeds
/// the kinetic one? Motions from the orbit a little to either side then differ within a cycle, however near they are;
/// at any other change less and less.
[[nodiscard]] bool departs(const Problem& problem, const PathPoint& change, const TestValue& test, double range);

}  // namespace slapstick::orbit
