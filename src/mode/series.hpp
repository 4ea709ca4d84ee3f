#pragma once
/// The exponential series of a mode in extended precision: Taylor rows, window length, flow matrix.
#include <vector>

#include "slapstick/event/window.hpp"
#include "slapstick/mode/frame.hpp"

namespace slapstick::mode {

/// For X' = A X and functionals h = c . X:  h(s) = sum_n (c A^n / n!) s^n X.
///
/// The entries of A are rounded. What that does to a term, e_n = (e_{n-1} + u |c A^{n-1} / (n-1)!|) |A| / n, tells a term that the structure of
/// the model makes zero, and rounding does not, from one that is small.
///
/// The window length H is the largest for which, row by row and column by column, the dropped terms n >= 24 are at most a quarter
/// ulp of the largest kept term of that column, or of its error e_n, so that the remainder is covered by the rounding bound of the same column. As a number
/// of periods H has at most 24 bits: multiples of it are exact, and a clock that counts windows loses nothing.
class Series {
 public:
  Series(const Matrix& A, const std::vector<RowVector>& rows, double period);

  [[nodiscard]] double window() const { return window_; }
  [[nodiscard]] double window_in_periods() const { return window_in_periods_; }
  /// Coefficient of x^n (x = s / H) of row r with respect to X_i.
  [[nodiscard]] double taylor(std::size_t r, int n, int i) const;
  /// e_n of that coefficient.
  [[nodiscard]] double error(std::size_t r, int n, int i) const;
  /// Row r at the window's end, c exp(A H), and its time derivative there.
  [[nodiscard]] RowVector end_value(std::size_t r) const;
  [[nodiscard]] RowVector end_slope(std::size_t r) const;

 private:
  using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using LongRow = Eigen::Matrix<long double, 1, Eigen::Dynamic>;
  static constexpr int all_terms = 40;

  [[nodiscard]] bool tail_is_negligible(double ratio) const;
  void scale_errors(double ratio);

  LongMatrix A_;                                 ///< A times the reference length
  std::vector<std::vector<LongRow>> scaled_;     ///< [row][n]: c A^n / n! times window^n
  std::vector<std::vector<double>> magnitudes_;  ///< [row][n * m + i]: |c A^n / n!| times the reference length^n
  std::vector<std::vector<double>> errors_;      ///< [row][n * m + i]: e_n, scaled likewise
  double reference_ = 1.0, window_ = 1.0, window_in_periods_ = 1.0;
};

}  // namespace slapstick::mode
