#pragma once
/// The stroboscopic section: the state of a motion once per forcing period, always at the same phase.
/// Shapes, threads and cost are those of the Motion that a section carries.
#include "slapstick/flow/stage.hpp"

namespace slapstick {

struct StroboscopicPoint {
  Instant time;     ///< fraction == the section's phase, exactly
  ModeId mode = 0;  ///< System::mode_name
  State state;      ///< user's coordinates; just after an event that falls on this very instant
};

class StroboscopicSection {
 public:
  /// Takes the motion over; its System must outlive the section.
  /// @param phase  fraction of a period in [0, 1)
  /// @throws InputError if the model has no harmonic forcing (then no phase is distinguished) or the phase is outside
  /// [0, 1)
  StroboscopicSection(Motion motion, double phase);

  /// Moves on to the next instant of this phase, strictly later than now. No allocation once `point.state` has its
  /// size.
  /// @returns false if `stop` was set (null: cannot be stopped); `point` is then unchanged
  /// @throws NumericalError as Motion::advance
  bool next(StroboscopicPoint& point, const std::atomic<bool>* stop = nullptr);

  [[nodiscard]] const Motion& motion() const { return motion_; }

 private:
  Motion motion_;
  double phase_;
};

}  // namespace slapstick
