#pragma once
/// What a batch does with each of its trajectories, and what it hands back (sweep/batch.hpp runs them).
///
/// A run starts at the problem's start, passes a transient, and is then recorded. Its length is counted in forcing
/// periods (units of time without forcing) from the start's instant.
///
/// The exponent is ln(|delta| at the end / |delta| at the start of the recording) / periods. The tangent vector delta
/// follows the run, events included (flow/tangent.hpp), from its start: 1, 1/2, 1/3, .. in contact coordinates, without
/// what the first mode holds still. A transient turns delta to the direction that grows most; a tangent that is zero at
/// its end starts again.
/// The largest of all 2 n exponents is meant: without forcing the one along the motion, 0, is among them, and so is
/// that of a rigid translation. attractor/lyapunov.hpp has all exponents, with errors.
/// Plain data: no errors, no cost.
#include <string>
#include <vector>

#include "slapstick/flow/motion.hpp"

namespace slapstick {

/// What is recorded of a run.
struct BatchPlan {
  int transient_periods = 0;  ///< before the recording, >= 0
  int periods = 1;            ///< of the recording, >= 1
  int points = 0;             ///< stroboscopic points, <= periods: the states at the ends of the last `points` periods
                              ///< of the recording
  bool events = false;        ///< every event of the recording, one by one
  bool exponent = false;      ///< the largest Lyapunov exponent
};

/// What a run has recorded.
struct BatchRun {
  long impacts = 0;                 ///< in the recording
  double speeds = 0.0;              ///< the sum of their speeds
  State end;                        ///< the state at the end, 2 n numbers
  std::vector<double> points;       ///< BatchPlan::points rows of 2 n numbers, the last one `end`
  std::vector<long> point_impacts;  ///< impacts in the period before each point
  std::vector<Event> events;        ///< if they were asked for, in order
  /// If it was asked for: of the recording, per forcing period (unit of time without forcing); -infinity where stick or
  /// chatter forget every small change.
  double exponent = 0.0;
  long lane_events = 0;    ///< work: events that the lanes decided, from the start on ..
  long motion_events = 0;  ///< .. and events that a Motion decided: those in doubt, or all of a model that no lane
                           ///< can run
  bool in_lanes = false;   ///< whether lanes can run the model
  bool done = false;       ///< false if the run failed, or the batch was stopped before
  std::string failure;     ///< one line, what the NumericalError or InputError said; else empty
};

}  // namespace slapstick
