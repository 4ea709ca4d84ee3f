#pragma once
/// What a run would cost, before it starts: a run that cannot end within hours is refused instead of hanging.
#include <string>

#include "model_options.hpp"
#include "slapstick/flow/system.hpp"

namespace slapstick::app {

/// What a verb is certain to run through: this many forcing periods of one motion (of each value of a diagram).
struct Work {
  double periods = 0.0;
  std::string option;  ///< what the user may lower: "--periods"
};

/// Windows that one motion may take: one to some hours of one core.
inline constexpr double most_windows = 1e11;

/// Compiles the model and estimates the work: windows per period (System::windows_per_period) times periods.
/// @param more  parameter values on top of the user's --set, as in a sweep; they are left out of the message's "--set
/// NAME=VALUE"
/// @throws InputError that names the values which cause it, if it is more than `most_windows`, or if the System cannot
/// be made
[[nodiscard]] System affordable_system(const ChosenModel& chosen, const Work& work, const Overrides& more = {});

}  // namespace slapstick::app
