#include "mode/series.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick::mode {
namespace {

/// 1 / spectral radius, or 1 if A is nilpotent (rigid bodies: the series ends by itself). Only eight bits are kept: the rounding of
/// an eigenvalue solver, which differs for a mirrored model, shall not reach the results.
double reference_length(const Matrix& A) {
  const double radius = A.eigenvalues().cwiseAbs().maxCoeff();
  if (!(radius > 1e-8 * A.cwiseAbs().maxCoeff() && radius > 0.0)) return 1.0;
  int exponent = 0;
  const double mantissa = std::frexp(1.0 / radius, &exponent);
  return std::ldexp(std::floor(256.0 * mantissa) / 256.0, exponent);
}

/// The greatest number with 24 bits up to x.
double few_bits(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(0x1p24 * mantissa), exponent - 24);
}

}  // namespace

Series::Series(const Matrix& A, const std::vector<RowVector>& rows, double period) : reference_(reference_length(A)) {
  A_ = A.cast<long double>() * static_cast<long double>(reference_);
  const Eigen::Index m = A_.rows();
  const Eigen::MatrixXd size_of_A = A_.cwiseAbs().cast<double>();
  for (const RowVector& row : rows) {
    auto& terms = scaled_.emplace_back();
    auto& sizes = magnitudes_.emplace_back();
    auto& errors = errors_.emplace_back(static_cast<std::size_t>(m), 0.0);
    RowVector error = RowVector::Zero(m);
    terms.push_back(row.cast<long double>());
    for (int n = 1; n < all_terms; ++n) {
      LongRow next = LongRow::Zero(m);
      for (Eigen::Index k = 0; k < m; ++k) {
        if (const long double factor = terms.back()[k] / n; factor != 0.0L) next += factor * A_.row(k);
      }
      error = (error + event::unit_roundoff * terms.back().cwiseAbs().cast<double>()) * size_of_A / n;
      errors.insert(errors.end(), error.begin(), error.end());
      terms.push_back(std::move(next));
    }
    for (const LongRow& term : terms) {
      for (Eigen::Index i = 0; i < m; ++i) sizes.push_back(static_cast<double>(std::abs(term[i])));
    }
  }
  // Bisection on the window length in units of the reference length; the tail grows with it.
  double low = 0.25, high = 4.0;
  while (!tail_is_negligible(low)) low *= 0.25;
  if (tail_is_negligible(high)) low = high;
  for (int k = 0; k < 12 && low < high; ++k) {
    const double middle = std::sqrt(low * high);
    (tail_is_negligible(middle) ? low : high) = middle;
  }
  window_in_periods_ = few_bits(low * reference_ / period);
  window_ = window_in_periods_ * period;
  const long double ratio = static_cast<long double>(window_in_periods_) * period / reference_;
  for (auto& terms : scaled_) {
    long double power = 1.0L;
    for (LongRow& term : terms) {
      term *= power;
      power *= ratio;
    }
  }
  scale_errors(static_cast<double>(ratio));
}

bool Series::tail_is_negligible(double ratio) const {
  const auto columns = static_cast<std::size_t>(A_.rows());
  for (std::size_t r = 0; r < magnitudes_.size(); ++r) {
    const std::vector<double>&sizes = magnitudes_[r], &errors = errors_[r];
    for (std::size_t i = 0; i < columns; ++i) {
      double power = 1.0, largest = 0.0, tail = 0.0;
      for (int n = 0; n < all_terms; ++n, power *= ratio) {
        const double term = sizes[n * columns + i] * power;
        if (n < event::terms)
          largest = std::max({largest, term, errors[n * columns + i] * power});
        else
          tail += term;
      }
      if (tail > 0.25 * event::unit_roundoff * largest) return false;
    }
  }
  return true;
}

void Series::scale_errors(double ratio) {
  const auto columns = static_cast<std::size_t>(A_.rows());
  for (auto& errors : errors_) {
    double power = 1.0;
    for (std::size_t n = 0; n < all_terms; ++n, power *= ratio)
      for (std::size_t i = 0; i < columns; ++i) errors[n * columns + i] *= power;
  }
}

double Series::error(std::size_t r, int n, int i) const {
  return errors_[r][static_cast<std::size_t>(n * A_.rows() + i)];
}

double Series::taylor(std::size_t r, int n, int i) const { return static_cast<double>(scaled_[r][n][i]); }

RowVector Series::end_value(std::size_t r) const {
  LongRow sum = scaled_[r].back();
  for (int n = all_terms - 2; n >= 0; --n) sum += scaled_[r][n];
  return sum.cast<double>();
}

RowVector Series::end_slope(std::size_t r) const {
  LongRow sum = LongRow::Zero(A_.rows());
  for (int n = all_terms - 1; n > 0; --n) sum += static_cast<long double>(n) * scaled_[r][n];
  return (sum / static_cast<long double>(window_)).cast<double>();
}

}  // namespace slapstick::mode
