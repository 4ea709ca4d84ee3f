#pragma once
/// exp(A s) X and the Taylor coefficients of a functional in 50 digits, from the matrix of a mode taken as exact.
#include <cmath>
#include <vector>

#include "mode/mode.hpp"
#include "oracle/real.hpp"

namespace slapstick::mode::testing {

using oracle::Real;
using Exact = oracle::Vector;

inline Exact times(const Matrix& A, const Exact& x, const Real& factor) {
  Exact y(x.size(), Real(0));
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      if (A(i, j) != 0.0) y[i] += Real(A(i, j)) * x[j];
    }
    y[i] *= factor;
  }
  return y;
}

/// A^n X s^n / n! for n < count.
inline std::vector<Exact> series(const Matrix& A, const Exact& X, const Real& s, int count) {
  std::vector<Exact> terms{X};
  for (int n = 1; n < count; ++n) terms.push_back(times(A, terms.back(), s / n));
  return terms;
}

/// exp(A s) X for s up to a window: the series in 50 digits has nothing to fear from |A s| of four.
inline Exact flow(const Matrix& A, const Exact& X, const Real& s) {
  Exact sum(X.size(), Real(0));
  for (const Exact& term : series(A, X, s, 72)) {
    for (std::size_t i = 0; i < X.size(); ++i) sum[i] += term[i];
  }
  return sum;
}

/// What the rounding of a state is measured by: for each component the sizes of all contributions X_j to the end value,
/// or (`terms`) of all terms of the series that leads there.
inline std::vector<double> sizes(const Matrix& A, const std::vector<double>& X, double s, bool terms) {
  const Eigen::Index m = A.rows();
  Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> power =
      Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>::Identity(m, m);
  auto sum = power;
  const auto scaled = (A.cast<long double>() * static_cast<long double>(s)).eval();
  for (int n = 1; n < 72; ++n) {
    power = (power * scaled / static_cast<long double>(n)).eval();
    if (terms)
      sum += power.cwiseAbs();
    else
      sum += power;
  }
  std::vector<double> size(m, 0.0);
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j < m; ++j) size[i] += static_cast<double>(std::abs(sum(i, j))) * std::abs(X[j]);
  }
  return size;
}

inline Real dot(const RowVector& row, const Exact& x) {
  Real sum = 0;
  for (Eigen::Index i = 0; i < row.size(); ++i) {
    if (row[i] != 0.0) sum += Real(row[i]) * x[i];
  }
  return sum;
}

}  // namespace slapstick::mode::testing
