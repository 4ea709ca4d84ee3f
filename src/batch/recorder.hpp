#pragma once
/// What is recorded of a run, whoever carries it on: instants to look at, impacts, points.
#include <atomic>
#include <functional>
#include <optional>

#include "batch/tangent.hpp"
#include "flow/engine.hpp"
#include "slapstick/batch/run.hpp"

namespace slapstick::batch {

class Recorder {
 public:
  Recorder(const BatchPlan& plan, Instant begin)
      : plan_(&plan), begin_(begin), passed_(plan.transient_periods == 0 ? 1 : 0) {}

  /// The next instant to look at: the recording's start, a period before the first point, the points.
  [[nodiscard]] Instant next() const;
  /// Whether the recording has begun.
  [[nodiscard]] bool recording() const { return passed_ > 0; }
  [[nodiscard]] bool wants_events() const { return plan_->events && recording(); }
  [[nodiscard]] bool wants_exponent() const { return plan_->exponent; }
  /// Where the tangent starts from: `growth` is its ln |delta|.
  void begin_growth(double growth) { growth_before_ = growth; }
  /// Looks at the state (contact coordinates) at `next`. @param growth  ln |delta| there
  /// @returns true if the run is at its end
  bool look(const mode::Frame& frame, const double* p, const double* u, double growth);
  /// An impact of speed w.
  void count(double w) {
    ++impacts;
    speeds += w;
  }

  double impacts = 0.0, speeds = 0.0;  ///< since the recording began, or the run
  /// If set, takes each point in contact coordinates, with the impacts since the point before; true ends the run there.
  std::function<bool(const double* p, const double* u, long impacts)> watch = {};
  BatchRun run;

 private:
  const BatchPlan* plan_;
  Instant begin_;
  int passed_;                   ///< instants that have been looked at: a recording without a transient has begun
  double impacts_before_ = 0.0;  ///< at the one before
  double growth_before_ = 0.0;   ///< at the start of the recording
};

/// Carries a run on by its engine: to its end, or over one event. An impact that may begin a complete chatter is
/// followed by the next event.
/// @param tangent  follows too; null if the recorder wants no exponent
/// @param cancel   true: the run ends where it is, not done; null: never
/// @returns true if the run is at its end
bool follow(flow::Engine& engine, Recorder& recorder, EngineTangent* tangent, const std::atomic<bool>* cancel,
            bool to_the_end);

}  // namespace slapstick::batch
