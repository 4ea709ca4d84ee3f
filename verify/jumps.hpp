#pragma once
/// Jumps of the model's own coordinates and velocities, from one segment to the next.
///
/// A contact number x_a - x_b - shift may be far greater than the coordinate that it tells: its rounding would hide
/// that the coordinate has moved. So each coordinate's jumps are measured by the sizes of what that coordinate alone is
/// added up from: exp(|A| t) |(q, v, phases, 1)| along the segments, and impulses.
#include "flight.hpp"

namespace verify {

class Jumps {
 public:
  explicit Jumps(const Mechanics& mechanics);
  /// @param by  of the first n contact numbers, and of their velocities
  void add(const Balls& p, const Balls& u);
  /// What the coordinates are added up from is at least this.
  void raise(const std::vector<double>& sizes);
  /// An impulse P at a number.
  void raise_by_impulse(std::size_t number, double P);
  /// Numbers were rounded by so much without a word of the file.
  void widen(double off);
  void check(long line, const Refuse& refuse) const;

  /// The worst coordinate's largest jump, and all of the worst one's together, in units of its sizes.
  [[nodiscard]] double largest(bool of_velocities) const { return worst(largest_, of_velocities); }
  [[nodiscard]] double sum(bool of_velocities) const { return worst(sum_, of_velocities); }

 private:
  [[nodiscard]] double relative(const std::vector<double>& jumps, std::size_t i) const;
  [[nodiscard]] double worst(const std::vector<double>& jumps, bool of_velocities) const;

  const Mechanics& m_;
  std::vector<double> largest_, sum_, scale_;
};

}  // namespace verify
