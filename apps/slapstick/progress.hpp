#pragma once
/// "diagram: 312/2000 (16 %), 1240/s, 0:12 left" on standard error, if that is a terminal or the user asked for it.
#include <chrono>
#include <string>

namespace slapstick::app {

class Progress {
 public:
  /// @param what    what the numbers count, e.g. "values"
  /// @param forced  show it even if standard error is not a terminal (then in lines of their own)
  Progress(std::string what, double total, bool forced);
  ~Progress();  ///< wipes the line from a terminal
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap unless it is time for a new line: five a second on a terminal, else one. One thread at a time.
  void update(double amount);
  /// The same where what is to do grows.
  void update(double amount, double total) {
    total_ = total;
    update(amount);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  double total_;
  bool terminal_, shown_;
  Clock::time_point begin_, next_;
};

}  // namespace slapstick::app
