#pragma once
/// What moves by the clock beside the harmonics of omega: tones of other frequencies, and signals.
///
/// In X a tone is a pair (cos, sin) that turns with its own frequency, and a signal a pair (value, slope) with
/// value' = slope / T, slope' = 0, T the period of the clock. A signal's slope jumps at its knots only, at a step its
/// value too, so that between two knots X' = A X. Both are set by the clock, so neither drifts. A pulse at a knot is
/// nothing of X: it is a jump of the velocities (Frame::kick).
///
/// The phase says where a signal in periods is. At a knot its two sides differ. So a straight line between two knots
/// has a name: the number of its first knot.
#include <vector>

#include "slapstick/base/clock.hpp"
#include "slapstick/model/model.hpp"

namespace slapstick::mode {

struct Tone {
  Tone(double of_frequency, double period);

  double frequency;  ///< rad per unit of time
  double turns;      ///< in a period of the clock

  /// Turns since t = 0, apart from whole ones. Error: some 2^-53 of a turn at any instant.
  [[nodiscard]] double at(Instant t) const;
};

/// A Signal by the clock.
class SignalTable {
 public:
  struct Value {
    double value = 0.0, slope = 0.0;  ///< slope per period of the clock; at a knot that behind the knot
  };

  SignalTable(const Signal& signal, double period);

  [[nodiscard]] Value at(Instant t) const;
  /// The value just before t: another one than `at` has where there is a step.
  [[nodiscard]] double before(Instant t) const;
  /// The area of the pulse at t, or 0.
  [[nodiscard]] double pulse(Instant t) const;
  /// The first knot after t, or `never`.
  [[nodiscard]] Instant next(Instant t) const;
  /// Is there a knot at t?
  [[nodiscard]] bool has_knot(Instant t) const;

  [[nodiscard]] bool in_periods() const { return in_periods_; }
  /// The line that holds from t on; of a signal in periods.
  [[nodiscard]] int line_at(Instant t) const { return static_cast<int>(place(t).piece); }

  static constexpr Instant never{INT64_MAX, 0.0};

 private:
  struct Place {
    std::int64_t round = 0;  ///< of a signal that repeats
    std::size_t piece = 0;   ///< begins at this knot; `outside` before the first and after the last knot
  };
  static constexpr std::size_t outside = SIZE_MAX;

  [[nodiscard]] Place place(Instant t) const;
  [[nodiscard]] Instant knot(std::int64_t round, std::size_t i) const;

  std::vector<Instant> knots_;
  std::vector<double> values_, slopes_, pulses_;
  double length_ = 0.0;  ///< of a round, in periods; 0: once
  bool in_periods_ = false;
};

/// A straight line of a signal in periods at a phase (periods), in the round in which it is nearest, also beyond its
/// ends. An orbit's equations ask for it: their instants move while the order of events stays.
/// No line is longer than 31/32 of a period: its ends are 1/64 of a period from where another round is as near.
[[nodiscard]] SignalTable::Value on_line(const Signal& signal, int line, double turns);
/// Its derivative at this phase, `rate` the derivative of the signal's numbers.
[[nodiscard]] SignalTable::Value line_rate(const Signal& signal, const Signal& rate, int line, double turns);
/// Is there no pulse between two neighbouring lines, no step, and one slope? Slopes are one within the rounding of the
/// points that they are made of: a point in the middle of a line has a value and an instant that are rounded.
[[nodiscard]] bool goes_straight_on(const Signal& signal, int line, int next);
/// The end of a line, in the round in which it is nearest to a phase.
[[nodiscard]] double line_end(const Signal& signal, int line, double turns);
/// .. and its derivative.
[[nodiscard]] double line_end_rate(const Signal& rate, int line);

}  // namespace slapstick::mode
