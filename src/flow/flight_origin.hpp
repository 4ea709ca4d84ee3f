#pragma once
/// Where a flight began, and its state there: what a doubtful touch, windows later, is judged from.
///
/// Every window's step rounds the state, by units of the largest numbers of the flight, also where they have become
/// small. A guard that comes within that rounding of zero is looked at again with a state that was carried from the
/// flight's origin in double-doubles. So touch, hit and miss do not depend on how many windows lie between.
#include <vector>

#include "base/double_double.hpp"
#include "mode/mode.hpp"

namespace slapstick::flow {

class FlightOrigin {
 public:
  explicit FlightOrigin(int size) : m_(size), X_((size + 7) / 8), largest_(X_) {}

  /// A flight begins. Most end in their first window: only `pass` writes anything down.
  void begin() {
    windows_ = 0;
    staleness_ = 0.0;
  }
  /// A part of a window of this duration has been flown, between these states. When the count is high, it begins anew.
  void pass(double duration, const event::Lanes& from, const event::Lanes& to);
  /// A whole window is flown from this state. Is `largest()` to begin anew? The caller brings it up to date.
  bool leave(const event::Lanes& from) {
    if (windows_ == 0) note(from);
    return staleness_ == 0.0;
  }
  /// .. and has been; `size`: the sum of `largest()`.
  void arrive(double size) {
    size_ = size;
    ++whole_;
    count();
  }
  /// Carries the origin to now and writes its state into X, rounded once. Cost: some microseconds per period of the
  /// fastest motion.
  void carry(const mode::Mode& mode, double* X);

  /// Does the state carry more than its own rounding ..
  [[nodiscard]] bool stale() const { return staleness_ > 0.0; }
  /// .. and can `carry` make it better?
  [[nodiscard]] bool can_carry() const { return windows_ > 0; }
  /// How much, in units of what one window's operators lose of `largest()`, the greatest |X| of the flight.
  [[nodiscard]] double staleness() const { return staleness_; }
  [[nodiscard]] const double* largest() const { return reinterpret_cast<const double*>(largest_.data()); }
  [[nodiscard]] event::Lanes& largest_lanes() { return largest_; }
  /// The sum of those.
  [[nodiscard]] double size() const { return size_; }

 private:
  void note(const event::Lanes& from) {
    for (std::size_t b = 0; b < X_.size(); ++b) X_[b] = from[b];
    elapsed_ = {};
    whole_ = 0;
  }
  void count() {
    staleness_ = ++windows_;
    if (windows_ >= most_windows) begin();
  }

  static constexpr int most_windows = 4096;
  static constexpr double carried = 0x1p-12;  ///< far more than double-doubles lose, in that unit

  int m_;
  event::Lanes X_, largest_;
  double size_ = 0.0, staleness_ = 0.0;
  DoubleDouble elapsed_;  ///< in parts of windows ..
  int whole_ = 0;         ///< .. and whole ones
  int windows_ = 0;       ///< both
};

}  // namespace slapstick::flow
