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
  /// @param p, u  jumps of the numbers of the basis of displacements, and of that of velocities
  void add(const Balls& p, const Balls& u);
  /// What the coordinates are added up from is at least this, and so is what contact numbers are.
  void raise(const std::vector<double>& sizes, const std::vector<double>& of_numbers);
  /// An impulse P at a number.
  void raise_by_impulse(std::size_t number, double P);
  /// Velocities that an impulse at the number changes were rounded by so much without a word of the file.
  void widen(std::size_t number, double off);
  /// @returns how many coordinates have jumps that are too large for their own sizes, and no more than the rounding of
  ///          the contact numbers that tell them: a coordinate beside a clearance that is far greater than it
  [[nodiscard]] long check(long line, const Refuse& refuse) const;

  /// The worst coordinate's largest jump, and all of the worst one's together, in units of its sizes.
  [[nodiscard]] double largest(bool of_velocities) const { return worst(largest_, of_velocities); }
  [[nodiscard]] double sum(bool of_velocities) const { return worst(sum_, of_velocities); }

 private:
  [[nodiscard]] bool within_own(std::size_t i) const;
  [[nodiscard]] bool by_rounding(std::size_t i) const;
  [[nodiscard]] double relative(const std::vector<double>& jumps, std::size_t i) const;
  [[nodiscard]] double worst(const std::vector<double>& jumps, bool of_velocities) const;

  const Mechanics& m_;
  std::vector<double> largest_, sum_, scale_;
  std::vector<double> reach_;  ///< sizes of the contact numbers that tell the coordinate
};

}  // namespace verify
