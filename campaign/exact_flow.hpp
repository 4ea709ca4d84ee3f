#pragma once
/// exp(A s) of one mode on a grid s_j = j d, in quadruple precision, and bounds on its guards between the points: the
/// reference of the campaigns. Of the engine it takes only what defines the problem, A and the guards' rows, as stored
/// doubles.
///
/// About a point s_j a guard is h(s_j + x d) = sum_n D_n X_j x^n, D_n = c A^n d^n / n!, X_j = exp(A s_j) X. With d a
/// sixteenth of an engine's window twenty terms leave less than 2^-106 (fifteen, for 64 bits, 2^-66); the constructor
/// adds up what is left out and refuses more.
#include <vector>

#include "mode/mode.hpp"

namespace campaign {

__extension__ typedef __float128 Quad;

class ExactFlow {
 public:
  static constexpr int terms = 20;
  /// As many as T can tell from none.
  template <class T>
  static constexpr int useful = std::is_same_v<T, Quad> ? terms : 15;

  /// @param spacing  d  @param count  of intervals
  ExactFlow(const slapstick::mode::Mode& mode, double spacing, int count);

  [[nodiscard]] int size() const { return m_; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] int guards() const { return static_cast<int>(guards_.size()); }

  /// (c exp(A s_j))_i, rounded to doubles, j = 0 .. count().
  [[nodiscard]] const double* column(int guard, int i) const {
    return &guards_[guard].columns[static_cast<std::size_t>(i) * (count_ + 1)];
  }
  /// h(s_j) in quadruple precision.
  [[nodiscard]] Quad value(int guard, int j, const double* X) const;

  /// exp(A s_j) X.
  template <class T>
  void state(int j, const double* X, T* out) const;
  /// Coefficients of x^n, n < terms, about a point where the state is X_j.
  template <class T>
  void polynomial(int guard, const T* X_j, T* out) const;
  /// Sums of the sizes of the terms that those at the start are made of.
  void magnitudes(int guard, const double* X, long double* out) const;

  /// The largest sum of sizes |exp(A s_j)| |X| in the first `rows` rows: what relative errors of X can come to.
  [[nodiscard]] double reach(int rows, const double* X) const;

  /// |h| is at most this on the whole grid, and a bound on every sum of magnitudes that is made on the way.
  [[nodiscard]] double size(int guard, const double* X) const { return weigh(guards_[guard].size, X); }
  /// |h''| d^2 is at most this on the whole grid.
  [[nodiscard]] double bend(int guard, const double* X) const { return weigh(guards_[guard].bend, X); }
  /// Sum over the columns of the largest |(c exp(A s_j))_i X_i|: what depths are measured by.
  [[nodiscard]] double scale(int guard, const double* X) const { return weigh(guards_[guard].scale, X); }

 private:
  struct Guard {
    std::vector<Quad> taylor;  ///< D_n, by rows
    std::vector<long double> taylor_long;
    std::vector<Quad> rows;
    std::vector<double> columns, size, bend, scale;
  };

  [[nodiscard]] double weigh(const std::vector<double>& weights, const double* X) const;
  void set_grid(const slapstick::mode::Matrix& A);
  void set_guard(const slapstick::mode::Matrix& A, const slapstick::mode::RowVector& row, Guard& guard) const;
  void set_bounds(const std::vector<double>& values, const std::vector<double>& bends, Guard& guard) const;

  template <class T>
  [[nodiscard]] const std::vector<T>& grid() const;

  int m_, count_;
  double spacing_;
  std::vector<Quad> grid_;
  std::vector<long double> grid_long_;
  std::vector<Guard> guards_;
};

}  // namespace campaign
