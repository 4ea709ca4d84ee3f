#pragma once
/// The three kinds of failure that reach a caller. The command line turns them into exit status 2, 3 and 4.
///
/// A function that throws leaves its arguments as they were, unless it says otherwise. What the library itself gets
/// wrong is an assertion.
#include <stdexcept>
#include <string>

namespace slapstick {

/// The caller's mistake. The message is one line and names the argument, and the file, line and key where there is one.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : InputError({}, message) {}
  /// @param place  "model.toml:12: "
  InputError(const std::string& place, const std::string& message)
      : std::runtime_error(place + message), place_(place), message_(message) {}

  [[nodiscard]] const std::string& place() const { return place_; }  ///< empty where there is no place
  /// Without the place.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  std::string place_, message_;
};

/// A start that lies behind one of the model's stops.
struct BehindStop : InputError {
  using InputError::InputError;
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
