#pragma once
/// The last part of a run that was ended early, flown once more: the run itself had no reason to keep it.
#include <chrono>

#include "slapstick/flow/motion.hpp"

namespace slapstick::app {

/// Keeps the motion as it was at two earlier instants. The older one is `periods` before the latest mark, or half a
/// second of work where that is less, so that to fly from it takes no longer; or it is the run's start.
class Retrace {
 public:
  Retrace(const Motion& start, double periods)
      : older_(start), newer_(start), periods_(periods), marked_(Clock::now()) {}

  /// Call it often, while the motion stands at an event or at a cut.
  void mark(const Motion& motion);

  [[nodiscard]] const Motion& from() const { return older_; }

 private:
  using Clock = std::chrono::steady_clock;
  Motion older_, newer_;
  double periods_;
  Clock::time_point marked_;
  int calls_ = 0;
};

}  // namespace slapstick::app
