#pragma once
/// Time as an integer number of forcing periods plus a fraction, so that long runs lose no phase.
#include <cmath>
#include <cstdint>

namespace slapstick {

/// An instant t = (period + fraction) * T, with T the forcing period (1 for a model without forcing).
///
/// Invariant: 0 <= fraction < 1. Carrying a whole period from the fraction to the integer is exact in binary floating
/// point, so the phase after 1e7 periods is as accurate as after one; only `seconds` (for people) mixes the two parts.
struct Instant {
  std::int64_t period = 0;
  double fraction = 0.0;

  /// This instant plus `duration` periods (any sign, |duration| < 2^53).
  [[nodiscard]] Instant plus(double duration) const {
    const double sum = fraction + duration;
    const double whole = std::floor(sum);
    double rest = sum - whole;  // exact except when sum is a tiny negative number
    auto carried = period + static_cast<std::int64_t>(whole);
    if (rest >= 1.0) {
      rest = 0.0;
      ++carried;
    }
    return {carried, rest};
  }

  /// Periods from `earlier` to this instant; the integer parts cancel exactly.
  [[nodiscard]] double since(const Instant& earlier) const {
    return static_cast<double>(period - earlier.period) + (fraction - earlier.fraction);
  }

  /// Time in the model's unit, for output: (period + fraction) * T.
  [[nodiscard]] double seconds(double forcing_period) const {
    return (static_cast<double>(period) + fraction) * forcing_period;
  }

  friend bool operator==(const Instant&, const Instant&) = default;
  friend auto operator<=>(const Instant&, const Instant&) = default;
};

}  // namespace slapstick
