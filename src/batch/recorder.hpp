#pragma once
/// What is recorded of a run, whoever carries it on: instants to look at, impacts, points.
#include <optional>

#include "flow/engine.hpp"
#include "slapstick/batch/run.hpp"

namespace slapstick::batch {

class Recorder {
 public:
  Recorder(const RunPlan& plan, Instant begin) : plan_(&plan), begin_(begin) {}

  /// The next instant to look at: the recording's start, a period before the first point, the points.
  [[nodiscard]] Instant next() const;
  /// Whether the recording has begun.
  [[nodiscard]] bool recording() const { return passed_ > 0; }
  [[nodiscard]] bool wants_events() const { return plan_->events && recording(); }
  /// Looks at the state (contact coordinates) at `next`. @returns true if the run is at its end
  bool look(const mode::Frame& frame, const double* p, const double* u);
  /// An impact of speed w.
  void count(double w) {
    ++impacts;
    speeds += w;
  }

  double impacts = 0.0, speeds = 0.0;  ///< since the recording began, or the run
  Run run;

 private:
  const RunPlan* plan_;
  Instant begin_;
  int passed_ = 0;  ///< instants that have been looked at
  double impacts_before_ = 0.0;  ///< at the one before
};

/// Carries a run on by its engine: to its end, or over one event. An impact that may begin a complete chatter is followed by the next event.
/// @returns true if the run is at its end
bool follow(flow::Engine& engine, Recorder& recorder, bool to_the_end);

}  // namespace slapstick::batch
