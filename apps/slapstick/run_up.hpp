#pragma once
/// `--sweep NAME=A:B --over PERIODS` of `simulate` and `spectrum`: a run during which a parameter climbs or falls.
#include <string>
#include <vector>

#include "model_options.hpp"
#include "slapstick/flow/run_up.hpp"
#include "verb.hpp"

namespace slapstick::app {

struct RunUpFiles {
  std::string events, trajectory, out;
  long long samples = 100;  ///< of the trajectory, per forcing period
  bool progress = false;
};

struct Climb {
  std::string name;  ///< of the parameter or group
  RunUpOptions options;
};

struct RunUpRange {
  std::string sweep;             ///< NAME=A:B
  long long over = 0, hold = 1;  ///< forcing periods, of the run and of each value
  bool logarithmic = false;

  /// @param others  options that a run-up does not have
  void declare(Arguments& arguments, const std::vector<std::string>& others);
  /// @throws InputError naming the argument
  [[nodiscard]] Climb climb(const ChosenModel& chosen) const;
};

[[nodiscard]] RunUp run_of(const Climb& climb, const ChosenModel& chosen, const State& start);

/// Tables as those of `simulate`, with a column for the parameter behind the time.
/// @returns the exit status @throws InputError naming the argument, NumericalError as Motion::advance
int run_up(const RunUpRange& range, const RunUpFiles& files, const ChosenModel& chosen, const State& start,
           const Context& context);

}  // namespace slapstick::app
