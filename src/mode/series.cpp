#include "mode/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace slapstick::mode {
namespace {

/// 1 / spectral radius, or 1 if A is nilpotent (rigid bodies: the series ends by itself).
double reference_length(const Matrix& A) {
  const double radius = A.eigenvalues().cwiseAbs().maxCoeff();
  return radius > 1e-8 * A.cwiseAbs().maxCoeff() && radius > 0.0 ? 1.0 / radius : 1.0;
}

using Weights = std::array<std::array<long double, event::terms>, event::terms>;

/// C(j, n) / C(23, n) for n <= j.
Weights bernstein_weights() {
  Weights weights{};
  for (int j = 0; j < event::terms; ++j) {
    weights[j][0] = 1.0L;
    for (int n = 1; n <= j; ++n)
      weights[j][n] = weights[j][n - 1] * static_cast<long double>(j - n + 1) / static_cast<long double>(event::degree - n + 1);
  }
  return weights;
}

}  // namespace

Series::Series(const Matrix& A, const std::vector<RowVector>& rows) : reference_(reference_length(A)) {
  A_ = A.cast<long double>() * static_cast<long double>(reference_);
  for (const RowVector& row : rows) {
    auto& terms = scaled_.emplace_back();
    terms.push_back(row.cast<long double>());
    for (int n = 1; n < all_terms; ++n) terms.push_back(terms.back() * A_ / static_cast<long double>(n));
  }
  // Bisection on the window length in units of the reference length; the tail grows with it.
  double low = 1e-6, high = 4.0;
  if (tail_is_negligible(high)) low = high;
  for (int k = 0; k < 24 && low < high; ++k) {
    const double middle = std::sqrt(low * high);
    (tail_is_negligible(middle) ? low : high) = middle;
  }
  ratio_ = low;
  window_ = ratio_ * reference_;
  for (auto& terms : scaled_) {
    long double power = 1.0L;
    for (LongRow& term : terms) {
      term *= power;
      power *= ratio_;
    }
  }
}

bool Series::tail_is_negligible(double ratio) const {
  for (const auto& terms : scaled_) {
    for (Eigen::Index i = 0; i < A_.rows(); ++i) {
      long double power = 1.0L, largest = 0.0L, tail = 0.0L;
      for (int n = 0; n < all_terms; ++n, power *= ratio) {
        const long double term = std::abs(terms[n][i]) * power;
        if (n < event::terms) largest = std::max(largest, term);
        else tail += term;
      }
      if (tail > 0.25L * event::unit_roundoff * largest) return false;
    }
  }
  return true;
}

double Series::taylor(std::size_t r, int n, int i) const {
  return static_cast<double>(scaled_[r][n][i]);
}

double Series::bernstein(std::size_t r, int j, int i) const {
  static const auto weights = bernstein_weights();
  long double sum = 0.0L;
  for (int n = 0; n <= j; ++n) sum += weights[j][n] * scaled_[r][n][i];
  return static_cast<double>(sum);
}

Matrix Series::flow() const {
  const Eigen::Index m = A_.rows();
  LongMatrix term = LongMatrix::Identity(m, m), sum = term;
  for (int n = 1; n < all_terms; ++n) {
    term = term * A_ * (static_cast<long double>(ratio_) / static_cast<long double>(n));
    sum += term;
  }
  return sum.cast<double>();
}

}  // namespace slapstick::mode
