#pragma once
/// The exponential series of a mode in double-doubles: Taylor rows, window length, flow matrix.
#include <vector>

#include "event/kernels.hpp"
#include "event/lane_block.hpp"
#include "mode/outline.hpp"

namespace slapstick::mode {

/// What is dropped by T_n, n >= 24, adds on the window to a row, to its slope and to its curvature by x.
struct Tail {
  double value;      ///< sum |T_n|
  double slope;      ///< sum n |T_n|
  double curvature;  ///< sum n (n - 1) |T_n|
};

/// For X' = A X and functionals h = c . X:  h(s) = sum_n (c A^n / n!) s^n X. The rows c are those of the guards, then
/// those that read the displacements; four are expanded at once (event/expansion.hpp).
///
/// The entries of A are rounded, by u S, S the sizes of what they were made of. What that does to a term,
/// e_n = (e_{n-1} |A| + u |c A^{n-1} / (n-1)!| S) / n, tells a term that the structure of the model makes zero, and
/// rounding does not, from one that is small.
///
/// The window length H is the largest for which, row by row, the dropped terms n >= 24 of every column are at most a
/// quarter ulp of the scale of that column: the largest kept term in its block (displacements, velocities, phases,
/// constant), of this row or of a displacement. What is dropped is bounded column by column and enters the bounds of
/// every guard; beyond n = 39 by a norm in those scales. As a number of periods H has at most 24 bits: multiples of it
/// are exact, and a clock that counts windows loses nothing.
class Series {
 public:
  /// @param longest_window  in periods; H is no longer than this
  /// Allocates three blocks. Cost: some microseconds for 7 numbers and 4 rows.
  Series(const Outline& outline, int displacements, double period, double longest_window);

  [[nodiscard]] double window() const { return window_; }
  [[nodiscard]] double window_in_periods() const { return window_in_periods_; }
  /// Coefficient of x^n (x = s / H) of row r with respect to X_i.
  [[nodiscard]] double taylor(int r, int n, int i) const { return at(all_.high, event::all_terms, r, n, i); }
  /// e_n of that coefficient, n < 8.
  [[nodiscard]] double error(int r, int n, int i) const {
    return weights_.high[n] * at(all_.errors, event::error_terms, r, n, i);
  }
  /// Bounds on the dropped terms of column i of row r, per unit of X_i.
  [[nodiscard]] Tail tail(int r, int i) const;
  /// Column i of row r at the window's end, c exp(A H), and its time derivative there.
  [[nodiscard]] double end_value(int r, int i) const;
  [[nodiscard]] double end_slope(int r, int i) const;

 private:
  void gather(const Outline& outline);
  void lay_out(const Outline& outline, int displacements);
  void find_window(double period, double longest_window);

  [[nodiscard]] double at(const event::Lane4* lanes, int rows, int r, int n, int i) const {
    return reinterpret_cast<const double*>(lanes + (static_cast<std::ptrdiff_t>(r / 4) * rows + n) * all_.m + i)[r % 4];
  }

  double reference_, unit_;  ///< a length of time like 1 / the spectral radius, and the greatest power of two up to it
  double window_ = 1.0, window_in_periods_ = 1.0;
  event::Expansion all_;
  event::Weights weights_;
  std::vector<int> column_ends_;
  std::vector<event::MatrixEntry> entries_;
  event::LaneBlock lanes_;  ///< all arrays of all_
};

}  // namespace slapstick::mode
