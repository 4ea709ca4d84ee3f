#pragma once
/// What a batch does with each of its trajectories, and what it hands back (sweep/batch.hpp runs them).
///
/// A run starts at the problem's start, passes a transient, and is then recorded. Its length is counted in forcing
/// periods (units of time without forcing) from the start's instant.
/// Plain data: no errors, no cost.
#include <string>
#include <vector>

#include "slapstick/flow/motion.hpp"

namespace slapstick {

/// What is recorded of a run.
struct BatchPlan {
  int transient_periods = 0;  ///< before the recording, >= 0
  int periods = 1;            ///< of the recording, >= 1
  int points = 0;             ///< stroboscopic points: the states at the ends of the last so many periods of the
                              ///< recording, <= periods
  bool events = false;        ///< every event of the recording, one by one
};

/// What a run has recorded.
struct BatchRun {
  long impacts = 0;        ///< in the recording
  double speeds = 0.0;     ///< the sum of their speeds
  State end;               ///< the state at the end, 2 n numbers
  std::vector<double> points;         ///< BatchPlan::points rows of 2 n numbers, the last one `end`
  std::vector<long> point_impacts;    ///< impacts in the period before each point
  std::vector<Event> events;          ///< if they were asked for, in order
  long lane_events = 0;    ///< work: events that the lanes decided, from the start on ..
  long motion_events = 0;  ///< .. and events that a Motion decided: those in doubt, or all of a model that no lane
                           ///< can run
  bool in_lanes = false;   ///< whether lanes can run the model
  bool done = false;       ///< false if the run failed, or the batch was stopped before
  std::string failure;     ///< one line, what the NumericalError or InputError said; else empty
};

}  // namespace slapstick
