#pragma once
/// X' = A X in balls: Taylor series of exp(A t) X with a proven remainder.
///
/// With positive weights w, |x|_w = max |x_i| / w_i and nu = |A|_w, the terms V_n = A^n X / n! obey
/// |V_{N+j}|_w <= |V_N|_w nu^j N! / (N+j)!. N is chosen so large that nu t <= (N - 8) / 4; then for r <= 3
///     sum over n >= N of n^r |V_n|_w t^n  <=  2 N^r |V_N|_w t^N,
/// because each term is below (1/4) (1 + 1/N)^3 of the one before, less than a half.
#include "linear.hpp"

namespace verify {

/// A, its norm, and the weights of the norm, which are near the eigenvector of |A|.
class Flow {
 public:
  /// @param phases  the first number of X that is a cosine or sine; the last number is 1
  Flow(Matrix A, Matrix rows, std::size_t phases);

  Matrix A;
  Matrix rows;  ///< the functionals of X that are looked at
  std::vector<double> weight;
  double nu;  ///< not below |A|_w
  [[nodiscard]] std::size_t size() const { return weight.size(); }
  /// A x.
  [[nodiscard]] Balls rate(const Balls& x) const;
  /// The numbers that exp(A t) x leaves as they are, exactly.
  [[nodiscard]] std::vector<bool> still(const Balls& x) const;

  // Sizes of what is added up, in doubles: only allowances for rounding are made of them.
  /// |x|, with 1 for a phase: those are known to a rounding of 1.
  [[nodiscard]] std::vector<double> sizes_of(const Balls& x) const;
  /// |A| x and exp(|A| t) x.
  [[nodiscard]] std::vector<double> apply_sizes(const std::vector<double>& x) const;
  [[nodiscard]] std::vector<double> carry_sizes(const std::vector<double>& x, double t) const;
  /// |row| x.
  [[nodiscard]] double size_of(std::size_t row, const std::vector<double>& x) const;

 private:
  struct Entry {
    std::size_t column;
    double size;  ///< not below the entry's
  };
  std::vector<std::vector<Entry>> entries_, row_entries_;
  std::size_t phases_;
};

/// f(t) = sum b_n t^n for t in [0, reach], of which the first terms are stored.
struct Series {
  Balls b;
  Ball reach;
  ulong N, drop;  ///< b_n belongs to V_{n + drop}; the terms from V_N on are missing
  Ball tail;      ///< those of f^(r) are in sum at most tail N^r reach^(N - drop - r), r <= 3

  /// f^(r)(t).
  [[nodiscard]] Ball value(ulong r, const Ball& t) const { return sum(r, t, false); }
  /// The sum of the sizes of the terms of f^(r) at t: |f^(r)| is no larger on [0, t].
  [[nodiscard]] Ball most(ulong r, const Ball& t) const { return sum(r, t, true); }

 private:
  [[nodiscard]] Ball sum(ulong r, const Ball& t, bool of_sizes) const;
};

/// exp(A t) X for t in [0, reach], by at least `least` terms.
class Expansion {
 public:
  Expansion(const Flow& flow, const Balls& X, const Ball& reach, std::size_t least = 0);
  [[nodiscard]] Balls at(const Ball& t) const;
  /// row . exp(A t) X, less its terms n < drop, divided by t^drop; drop + 4 <= least.
  [[nodiscard]] Series of(const Balls& row, std::size_t drop = 0) const;

 private:
  std::vector<double> weight_;  ///< 0 where no term is missing
  std::vector<Balls> V_;
  Ball reach_, tail_;  ///< tail_: 2 |V_N|_w
};

}  // namespace verify
