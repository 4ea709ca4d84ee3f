#pragma once
/// The numbers that prove the limit of a complete chatter (docs/certainty.md, section 8; docs/certificate.md, `tail`).
///
/// They are found anew from the modes and the state, with a box of their own; nothing of flow/chatter.hpp is used.
#include "flow/compiled_system.hpp"

namespace slapstick::certify {

struct LimitProof {
  /// Modes in which the pair leaves its stop, returns to it, and would be held off it by friction; all the same without
  /// friction on the pair.
  ModeId rise = 0, back = 0, hold = 0;
  double longest = 0.0;                                                         ///< bound of the time to the limit
  double rise_least = 0.0, rise_most = 0.0, fall_least = 0.0, fall_most = 0.0;  ///< accelerations towards the stop
  double error = 0.0;                                                           ///< bound of what `duration` is off
};

/// @param rise      the mode of the flight that begins at the last impact
/// @param closed    the mode that stands for the chatter; X: its state at the start, at rest on the stop
/// @param v         speed at which the pair leaves the stop
/// @param duration  time to the limit
LimitProof prove_limit(const flow::CompiledSystem& system, int stop, ModeId rise, ModeId closed, const double* X, double v,
                       double duration);

}  // namespace slapstick::certify
