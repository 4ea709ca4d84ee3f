/// Computes exp(A s) of a mode in quadruple precision on a grid, with bounds on the guards between.
#include "exact_flow.hpp"
#include "mode/mode.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace campaign {
namespace {

using slapstick::mode::Matrix;
using slapstick::mode::RowVector;

double size_of(Quad x) { return std::abs(static_cast<double>(x)); }

/// out = a b, m x m by rows; zeros of a are passed over.
void multiply(const Quad* a, const Quad* b, Quad* out, int m) {
  std::fill_n(out, m * m, Quad(0));
  for (int i = 0; i < m; ++i) {
    for (int k = 0; k < m; ++k) {
      if (a[i * m + k] == 0) continue;
      for (int j = 0; j < m; ++j) out[i * m + j] += a[i * m + k] * b[k * m + j];
    }
  }
}

}  // namespace

ExactFlow::ExactFlow(const slapstick::mode::Mode& mode, double spacing, int count)
    : m_(mode.size()), count_(count), spacing_(spacing), guards_(mode.guards().size()) {
  set_grid(mode.system());
  for (std::size_t g = 0; g < guards_.size(); ++g) set_guard(mode.system(), mode.guards()[g].row, guards_[g]);
}

/// E = exp(A d) from its series, and its powers.
void ExactFlow::set_grid(const Matrix& A) {
  const int mm = m_ * m_;
  std::vector<Quad> step(mm, Quad(0)), term(mm, Quad(0)), next(mm), rate(mm);
  for (int i = 0; i < m_; ++i) {
    step[i * m_ + i] = term[i * m_ + i] = 1;
    for (int k = 0; k < m_; ++k) rate[i * m_ + k] = Quad(A(i, k)) * Quad(spacing_);
  }
  for (int n = 1; n < 40; ++n) {
    multiply(rate.data(), term.data(), next.data(), m_);
    for (int k = 0; k < mm; ++k) step[k] += term[k] = next[k] / n;
  }
  grid_.assign(static_cast<std::size_t>(count_ + 1) * mm, Quad(0));
  for (int i = 0; i < m_; ++i) grid_[i * m_ + i] = 1;
  for (int j = 0; j < count_; ++j) multiply(step.data(), &grid_[j * mm], &grid_[(j + 1) * mm], m_);
  grid_long_.assign(grid_.begin(), grid_.end());
}

void ExactFlow::set_guard(const Matrix& A, const RowVector& row, Guard& guard) const {
  std::vector<Quad> D(row.begin(), row.end());
  std::vector<double> value(m_, 0.0), bend(m_, 0.0), left_out(m_, 0.0), left_out_of_long(m_, 0.0);
  for (int n = 0; n < 40; ++n) {
    if (n < terms) guard.taylor.insert(guard.taylor.end(), D.begin(), D.end());
    std::vector<Quad> next(m_, Quad(0));
    for (int i = 0; i < m_; ++i) {
      value[i] += size_of(D[i]);
      bend[i] += n * (n - 1) * size_of(D[i]);
      if (n >= terms) left_out[i] += size_of(D[i]);
      if (n >= useful<long double>) left_out_of_long[i] += size_of(D[i]);
      for (int k = 0; k < m_; ++k) next[k] += D[i] * Quad(A(i, k)) * Quad(spacing_) / (n + 1);
    }
    D.swap(next);
  }
  const double all = *std::max_element(value.begin(), value.end());
  for (int i = 0; i < m_; ++i) {
    const double size = std::max(value[i], 0x1p-10 * all);
    if (!(left_out[i] <= 0x1p-106 * size && left_out_of_long[i] <= 0x1p-66 * size))
      throw std::logic_error("the grid of the reference is too wide");
  }
  guard.taylor_long.assign(guard.taylor.begin(), guard.taylor.end());
  set_bounds(value, bend, guard);
}

/// sum_n |D_n| |exp(A s_j)| and sum_n n (n - 1) |D_n| |exp(A s_j)|, column by column, and their largest over j.
void ExactFlow::set_bounds(const std::vector<double>& values, const std::vector<double>& bends, Guard& guard) const {
  guard.rows.reserve(static_cast<std::size_t>(count_ + 1) * m_);
  guard.columns.assign(static_cast<std::size_t>(count_ + 1) * m_, 0.0);
  guard.size.assign(m_, 0.0);
  guard.bend.assign(m_, 0.0);
  guard.scale.assign(m_, 0.0);
  for (int j = 0; j <= count_; ++j) {
    const Quad* E = &grid_[static_cast<std::size_t>(j) * m_ * m_];
    for (int k = 0; k < m_; ++k) {
      double size = 0.0, bend = 0.0;
      Quad row = 0;
      for (int i = 0; i < m_; ++i) {
        size += values[i] * size_of(E[i * m_ + k]);
        bend += bends[i] * size_of(E[i * m_ + k]);
        row += guard.taylor[i] * E[i * m_ + k];
      }
      guard.rows.push_back(row);
      guard.columns[static_cast<std::size_t>(k) * (count_ + 1) + j] = static_cast<double>(row);
      guard.size[k] = std::max(guard.size[k], 1.0001 * size);
      guard.bend[k] = std::max(guard.bend[k], 1.0001 * bend);
      guard.scale[k] = std::max(guard.scale[k], size_of(row));
    }
  }
}

double ExactFlow::reach(int rows, const double* X) const {
  double largest = 0.0;
  for (int j = 0; j <= count_; ++j) {
    for (int i = 0; i < rows; ++i) {
      const long double* row = &grid_long_[(static_cast<std::size_t>(j) * m_ + i) * m_];
      double sum = 0.0;
      for (int k = 0; k < m_; ++k) sum += static_cast<double>(std::abs(row[k])) * std::abs(X[k]);
      largest = std::max(largest, sum);
    }
  }
  return largest;
}

double ExactFlow::weigh(const std::vector<double>& weights, const double* X) const {
  double sum = 0.0;
  for (int i = 0; i < m_; ++i) sum += weights[i] * std::abs(X[i]);
  return 1.0001 * sum;
}

Quad ExactFlow::value(int guard, int j, const double* X) const {
  const Quad* row = &guards_[guard].rows[static_cast<std::size_t>(j) * m_];
  Quad sum = 0;
  for (int i = 0; i < m_; ++i) sum += row[i] * Quad(X[i]);
  return sum;
}

template <>
const std::vector<Quad>& ExactFlow::grid<Quad>() const {
  return grid_;
}
template <>
const std::vector<long double>& ExactFlow::grid<long double>() const {
  return grid_long_;
}

template <class T>
void ExactFlow::state(int j, const double* X, T* out) const {
  const T* E = &grid<T>()[static_cast<std::size_t>(j) * m_ * m_];
  for (int i = 0; i < m_; ++i) {
    T sum = 0;
    for (int k = 0; k < m_; ++k) sum += E[i * m_ + k] * T(X[k]);
    out[i] = sum;
  }
}

template <class T>
void ExactFlow::polynomial(int guard, const T* X_j, T* out) const {
  const T* D = nullptr;
  if constexpr (std::is_same_v<T, Quad>)
    D = guards_[guard].taylor.data();
  else
    D = guards_[guard].taylor_long.data();
  for (int n = 0; n < useful<T>; ++n, D += m_) {
    T sum = 0;
    for (int i = 0; i < m_; ++i) sum += D[i] * X_j[i];
    out[n] = sum;
  }
  std::fill(out + useful<T>, out + terms, T(0));
}

void ExactFlow::magnitudes(int guard, const double* X, long double* out) const {
  const long double* D = guards_[guard].taylor_long.data();
  for (int n = 0; n < terms; ++n, D += m_) {
    out[n] = 0;
    for (int i = 0; i < m_; ++i) out[n] += std::abs(D[i] * X[i]);
  }
}

template void ExactFlow::state<Quad>(int, const double*, Quad*) const;
template void ExactFlow::state<long double>(int, const double*, long double*) const;
template void ExactFlow::polynomial<Quad>(int, const Quad*, Quad*) const;
template void ExactFlow::polynomial<long double>(int, const long double*, long double*) const;

}  // namespace campaign
