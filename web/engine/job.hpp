#pragma once
/// Long computations in slices, so that a worker of the page hears of a newer wish between two of them.
///
///     job.advance(8.0);          // about 8 ms of work
///     rows = job.rows();         // what came out since the last call
///
/// Slices end by the clock, but cut nothing: cuts of a Motion change no bit (flow/motion.hpp), so results do not depend
/// on the slices. A slice is longer than asked for by at most one stage (flow/stage.hpp), 50 ms.
/// Threads: a job belongs to one. Errors: the constructors throw; what happens later is in `failure`.
#include <chrono>
#include <string>
#include <vector>

#include "slapstick/flow/stage.hpp"

namespace slapstick::web {

class Deadline {
 public:
  explicit Deadline(double milliseconds)
      : end_(std::chrono::steady_clock::now() + std::chrono::duration<double, std::milli>(milliseconds)) {}
  [[nodiscard]] bool passed() const { return std::chrono::steady_clock::now() >= end_; }

 private:
  std::chrono::time_point<std::chrono::steady_clock, std::chrono::duration<double, std::nano>> end_;
};

class Job {
 public:
  virtual ~Job() = default;

  /// Works for about so long. @returns true if nothing is left to do
  bool advance(double milliseconds);

  /// Rows of numbers since the last call, flat; valid until the next call of anything.
  [[nodiscard]] const std::vector<double>& rows() { return hand_over(rows_, given_rows_); }
  /// A second table, likewise: events of a motion, states of a diagram.
  [[nodiscard]] const std::vector<double>& events() { return hand_over(events_, given_events_); }
  [[nodiscard]] int width() const { return width_; }  ///< numbers in a row
  [[nodiscard]] int event_width() const { return event_width_; }
  [[nodiscard]] const std::string& failure() const { return failure_; }  ///< one line, or empty

 protected:
  /// Works until the deadline. @returns true if nothing is left to do. @throws NumericalError, InputError
  virtual bool work(const Deadline& deadline) = 0;

  /// Advances to `end` and calls `use` after every event. @returns false if the deadline came first
  template <class Use>
  static bool run_until(Motion& motion, Instant end, const Deadline& deadline, const Use& use) {
    while (motion.time() < end) {
      const Instant stage = next_stage(motion.system(), motion.time(), end);
      for (int events = 0; motion.advance(stage) == Outcome::event;) {
        use();
        if (++events % 32 == 0 && deadline.passed()) return false;
      }
      if (motion.time() < end && deadline.passed()) return false;
    }
    return true;
  }

  std::vector<double> rows_, events_;
  int width_ = 0, event_width_ = 0;

 private:
  static const std::vector<double>& hand_over(std::vector<double>& grown, std::vector<double>& given) {
    given.swap(grown);
    grown.clear();
    return given;
  }

  std::vector<double> given_rows_, given_events_;
  std::string failure_;

 protected:
  bool done_ = false;  ///< nothing is left to do
};

}  // namespace slapstick::web
