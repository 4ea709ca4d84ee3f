#pragma once
/// `simulate --sweep NAME=A:B --over PERIODS`: a run during which a parameter climbs or falls.
#include <string>

#include "model_options.hpp"
#include "verb.hpp"

namespace slapstick::app {

struct RunUpFiles {
  std::string events, trajectory, out;
  long long samples = 100;  ///< of the trajectory, per forcing period
  bool progress = false;
};

struct RunUpRange {
  std::string sweep;             ///< NAME=A:B
  long long over = 0, hold = 1;  ///< forcing periods, of the run and of each value

  void declare(Arguments& arguments);
  /// @throws InputError for options that a run-up does not have
  void check(const Arguments& arguments) const;
};

/// Tables as those of `simulate`, with a column for the parameter behind the time.
/// @returns the exit status @throws InputError naming the argument, NumericalError as Motion::advance
int run_up(const RunUpRange& range, const RunUpFiles& files, const ChosenModel& chosen, const State& start,
           const Context& context);

}  // namespace slapstick::app
