#pragma once
/// The exponential series of a mode in double-doubles: Taylor rows, window length, flow matrix.
#include <vector>

#include "base/double_double.hpp"
#include "event/window.hpp"
#include "mode/frame.hpp"

namespace slapstick::mode {

/// For X' = A X and functionals h = c . X:  h(s) = sum_n (c A^n / n!) s^n X.
///
/// The entries of A are rounded, by u S, S the sizes of what they were made of. What that does to a term,
/// e_n = (e_{n-1} |A| + u |c A^{n-1} / (n-1)!| S) / n, tells a term that the structure of the model makes zero, and rounding does not, from one
/// that is small.
///
/// The window length H is the largest for which, row by row, the dropped terms n >= 24 of every column are at most a quarter ulp of the scale of
/// that column: the largest kept term in its block (displacements, velocities, phases, constant), of this row or of a displacement.
/// What is dropped is bounded column by column and enters the bounds of every guard; beyond n = 39 by a norm in those scales. As a
/// number of periods H has at most 24 bits: multiples of it are exact, and a clock that counts windows loses nothing.
/// What is dropped by T_n, n >= 24, adds on the window to a row, to its slope and to its curvature by x.
template <class Number>
struct Tail {
  Number value;      ///< sum |T_n|
  Number slope;      ///< sum n |T_n|
  Number curvature;  ///< sum n (n - 1) |T_n|
};

class Series {
 public:
  /// @param rows  the last `displacements` of them read the displacements
  /// @param longest_window  in periods; H is no longer than this
  /// @param size  S
  Series(const Matrix& A, const Matrix& size, const std::vector<RowVector>& rows, int displacements, double period,
         double longest_window);

  [[nodiscard]] double window() const { return window_; }
  [[nodiscard]] double window_in_periods() const { return window_in_periods_; }
  /// Coefficient of x^n (x = s / H) of row r with respect to X_i.
  [[nodiscard]] double taylor(std::size_t r, int n, int i) const;
  /// e_n of that coefficient.
  [[nodiscard]] double error(std::size_t r, int n, int i) const;
  /// Bounds on the dropped terms of column i of row r, per unit of X_i.
  [[nodiscard]] Tail<double> tail(std::size_t r, int i) const {
    return {tails_[r].value[i], tails_[r].slope[i], tails_[r].curvature[i]};
  }
  /// Row r at the window's end, c exp(A H), and its time derivative there.
  [[nodiscard]] RowVector end_value(std::size_t r) const;
  [[nodiscard]] RowVector end_slope(std::size_t r) const;

 private:
  using LongRow = std::vector<DoubleDouble>;
  static constexpr int all_terms = 40;

  /// A non-zero entry of a row of A, and its two sizes times the reference length.
  struct Entry {
    std::size_t column;
    double value;
    double magnitude, size;
  };

  void expand(const RowVector& row);
  [[nodiscard]] RowVector largest(std::size_t r, double ratio) const;
  [[nodiscard]] std::vector<RowVector> scales(double ratio) const;
  [[nodiscard]] Tail<RowVector> tail(std::size_t r, const RowVector& scale, double ratio) const;
  [[nodiscard]] double norm(const RowVector& scale) const;
  [[nodiscard]] bool tail_is_negligible(double ratio) const;
  void set_window(double ratio, double period, double longest_window);

  Eigen::Index m_, d_;
  std::vector<std::vector<Entry>> A_;         ///< by rows
  std::vector<std::vector<LongRow>> scaled_;  ///< [row][n]: c A^n / n! times window^n
  std::vector<Matrix> sizes_;                 ///< [row]: 40 x m, |c A^n / n!| times the reference length^n
  std::vector<Matrix> errors_;                ///< [row]: 40 x m, e_n, times the window^n once it is known
  std::vector<Tail<RowVector>> tails_;
  double reference_ = 1.0, window_ = 1.0, window_in_periods_ = 1.0;
};

}  // namespace slapstick::mode
