#pragma once
/// Ctrl-C and SIGTERM. The first asks for a clean end, the second ends the program at once.
///
/// Loops ask `stop_requested` and write what they have. A computation that cannot ask, for it is one long step (the
/// matrices of a thousand coordinates), is ended as by a second signal: 1.8 s after the first, unless the results are
/// being written by then. A machine that gives the process no time is waited for: an end needs 1 s of the
/// processor, or a process that waits for something else, as for a reader of its pipe.
#include <atomic>

namespace slapstick::app {

[[nodiscard]] const std::atomic<bool>& stop_requested();

/// From here on signals are caught. Those that the caller lets the process ignore (nohup, background job) are not. A
/// file that may not grow any further (ulimit -f) is an error of writing, and no death.
void catch_signals();

/// The first signal was answered: results are being written, and that may take its time.
void answer_signal();

}  // namespace slapstick::app
