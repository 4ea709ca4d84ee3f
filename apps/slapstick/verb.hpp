#pragma once
/// The verbs of the program. To add one: write `verb_NAME.cpp` with an `add_NAME`, declare it here, and give it a line
/// in verbs.cpp.
#include <atomic>
#include <functional>
#include <vector>

#include "arguments.hpp"

namespace slapstick::app {

/// What every verb works with.
struct Context {
  const std::atomic<bool>& stop;  ///< set by Ctrl-C: stop soon, write what there is, return `interrupted`
};

/// Exit status of a run that Ctrl-C ended early. 2, 3 and 4 come from InputError, NumericalError and StorageError.
inline constexpr int interrupted = 130;
inline constexpr int done = 0;

/// Runs the verb after its arguments were read; returns the exit status.
using Action = std::function<int(const Context&)>;

struct Verb {
  const char* name;
  const char* summary;
  Action (*add)(Arguments&);  ///< declares the arguments; the Action owns the variables they are bound to
};

[[nodiscard]] const std::vector<Verb>& verbs();

Action add_models(Arguments& arguments);
Action add_new(Arguments& arguments);
Action add_show(Arguments& arguments);
Action add_check(Arguments& arguments);
Action add_modes(Arguments& arguments);
Action add_simulate(Arguments& arguments);
Action add_classify(Arguments& arguments);
Action add_lyapunov(Arguments& arguments);
Action add_orbit(Arguments& arguments);
Action add_continue(Arguments& arguments);
Action add_curve(Arguments& arguments);
Action add_poincare(Arguments& arguments);
Action add_diagram(Arguments& arguments);
Action add_map(Arguments& arguments);
Action add_basins(Arguments& arguments);
Action add_quantities(Arguments& arguments);
Action add_measure(Arguments& arguments);
Action add_spectrum(Arguments& arguments);
Action add_store(Arguments& arguments);
Action add_reproduce(Arguments& arguments);
Action add_describe(Arguments& arguments);
Action add_completion(Arguments& arguments);
Action add_explore(Arguments& arguments);  // where the HTTP library is

}  // namespace slapstick::app
