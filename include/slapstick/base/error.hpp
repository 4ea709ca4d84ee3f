#pragma once
/// The three kinds of failure that reach a caller. The command line turns them into exit status 2, 3 and 4.
#include <stdexcept>

namespace slapstick {

/// The caller's mistake. The message is one line and names the argument, and the file, line and key where there is one.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The numerics did not succeed. The message says what, where (time, mode, state) and what to try.
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file or a store could not be read or written.
struct StorageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace slapstick
