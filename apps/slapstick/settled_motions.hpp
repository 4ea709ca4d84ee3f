#pragma once
/// The motions that settle over a range of a parameter, as a cloud of points: what a branch is drawn over.
#include <atomic>
#include <functional>
#include <string>

#include "figure/figure.hpp"
#include "orbit_options.hpp"

namespace slapstick::app {

struct SettledMotions {
  figure::Points cloud;  ///< speeds of impacts, or the first coordinate at the events
  bool speeds = false;   ///< which: a model with stops has speeds
  long failed = 0;       ///< values that are left out ..
  std::string failure;   ///< .. and why the first of them is
};

struct SettledRange {
  ParameterRange range;
  int count = 2;        ///< values, both ends included
  int transient = 500;  ///< forcing periods before each
  bool show_progress = false;
};

/// With stops as `diagram` finds them, the state carried on both ways from the start at the first and the last value;
/// without, from the start at each value. `instead` gives a start where the model's own is not valid, as behind a stop
/// that has moved.
[[nodiscard]] SettledMotions settled_motions(const ChosenModel& chosen, const ModelOptions& options,
                                             const std::string& parameter, const SettledRange& at,
                                             const std::function<State(double value)>& instead,
                                             const std::atomic<bool>& stop);

}  // namespace slapstick::app
