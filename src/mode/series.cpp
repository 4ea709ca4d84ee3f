/// Computes the exponential series of a mode in double-doubles.
#include "mode/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/dense.hpp"

namespace slapstick::mode {
namespace {

/// 1 / spectral radius, or 1 if A is nilpotent (rigid bodies: the series ends by itself). Only eight bits are kept: the rounding of
/// an eigenvalue solver, which differs for a mirrored model, shall not reach the results.
double reference_length(const Matrix& A) {
  const double radius = std::sqrt(dense::eigenvalues(A).cwiseAbs2().maxCoeff());
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

Series::Series(const Matrix& A, const Matrix& size, const std::vector<RowVector>& rows, int displacements,
               double period, double longest_window)
    : m_(A.rows()), d_(displacements), A_(static_cast<std::size_t>(m_)), reference_(reference_length(A)) {
  for (Eigen::Index k = 0; k < m_; ++k) {
    for (Eigen::Index i = 0; i < m_; ++i)
      if (A(k, i) != 0.0)
        A_[k].push_back(
            {static_cast<std::size_t>(i), A(k, i), std::abs(A(k, i)) * reference_, size(k, i) * reference_});
  }
  for (const RowVector& row : rows) expand(row);
  // Bisection on the window length in units of the reference length; the tail grows with it.
  double low = 0.25, high = 4.0;
  for (int k = 0; k < 40 && !tail_is_negligible(low); ++k) low *= 0.25;
  if (tail_is_negligible(high)) low = high;
  for (int k = 0; k < 12 && low < high; ++k) {
    const double middle = std::sqrt(low * high);
    (tail_is_negligible(middle) ? low : high) = middle;
  }
  set_window(low, period, longest_window);
}

/// The terms of one row, their sizes and errors, for a window of the reference length.
void Series::expand(const RowVector& row) {
  auto& terms = scaled_.emplace_back();
  Matrix& size = sizes_.emplace_back(Matrix::Zero(all_terms, m_));
  Matrix& error = errors_.emplace_back(Matrix::Zero(all_terms, m_));
  terms.emplace_back(row.begin(), row.end());
  size.row(0) = row.cwiseAbs();
  for (int n = 1; n < all_terms; ++n) {
    LongRow next(static_cast<std::size_t>(m_));
    for (Eigen::Index k = 0; k < m_; ++k) {
      const DoubleDouble factor = terms.back()[k] * reference_ / n;
      const double before = error(n - 1, k) / n, fresh = event::unit_roundoff * size(n - 1, k) / n;
      if (factor.hi == 0.0 && before == 0.0) continue;
      for (const Entry& entry : A_[k]) {
        next[entry.column] += factor * entry.value;
        error(n, static_cast<Eigen::Index>(entry.column)) += before * entry.magnitude + fresh * entry.size;
      }
    }
    for (Eigen::Index i = 0; i < m_; ++i) size(n, i) = std::abs(next[i].hi);
    terms.push_back(std::move(next));
  }
}

/// By columns, the largest of the kept terms.
RowVector Series::largest(std::size_t r, double ratio) const {
  RowVector out = RowVector::Zero(m_);
  double power = 1.0;
  for (int n = 0; n < event::terms; ++n, power *= ratio) out = out.cwiseMax(power * sizes_[r].row(n));
  return out;
}

/// By rows and columns: the largest kept term in the column's block, of the row itself or of the displacements, the latter times what the row
/// has of them. A part of the model far from a guard reaches it in a late term only, which no window could be measured by.
std::vector<RowVector> Series::scales(double ratio) const {
  const std::array<std::pair<Eigen::Index, Eigen::Index>, 4> blocks = {
      {{0, d_}, {d_, d_}, {2 * d_, m_ - 1 - 2 * d_}, {m_ - 1, 1}}};
  std::vector<RowVector> all;
  RowVector common = RowVector::Zero(4);
  for (std::size_t r = 0; r < sizes_.size(); ++r) {
    const RowVector own = largest(r, ratio);
    RowVector by_block = RowVector::Zero(4);
    for (int b = 0; b < 4; ++b) {
      const auto [begin, count] = blocks[b];
      if (count > 0) by_block[b] = own.segment(begin, count).maxCoeff();
    }
    if (r + static_cast<std::size_t>(d_) >= sizes_.size()) common = common.cwiseMax(by_block);
    all.push_back(by_block);
  }
  for (RowVector& by_block : all) {
    double share = 0.0;
    for (int b = 0; b < 4; ++b)
      if (common[b] > 0.0) share = std::max(share, by_block[b] / common[b]);
    RowVector scale(m_);
    for (int b = 0; b < 4; ++b)
      scale.segment(blocks[b].first, blocks[b].second).setConstant(std::max(by_block[b], share * common[b]));
    by_block = scale;
  }
  return all;
}

/// The norm of A in which a row t counts max_i |t_i| / scale_i.
double Series::norm(const RowVector& scale) const {
  RowVector sum = RowVector::Zero(m_);
  for (Eigen::Index k = 0; k < m_; ++k)
    for (const Entry& entry : A_[k]) sum[static_cast<Eigen::Index>(entry.column)] += scale[k] * entry.magnitude;
  double norm = 0.0;
  for (Eigen::Index i = 0; i < m_; ++i)
    if (sum[i] > 0.0) norm = std::max(norm, scale[i] > 0.0 ? sum[i] / scale[i] : INFINITY);
  return norm;
}

/// By columns, the sums over the dropped terms: n < 40 as they are, the others by their norm, |T_{39+k}| <= |T_39| nu^k 39! / (39 + k)!, so that
///     sum |T_n|          <= |T_39| nu / 40 / (1 - nu / 41),
///     sum n |T_n|        <= |T_39| nu / (1 - nu / 40),
///     sum n (n-1) |T_n|  <= |T_39| nu (39 + nu / (1 - nu / 40)).
Tail<RowVector> Series::tail(std::size_t r, const RowVector& scale, double ratio) const {
  Tail<RowVector> sum{RowVector::Zero(m_), RowVector::Zero(m_), RowVector::Zero(m_)};
  double power = 1.0;
  for (int n = 0; n < event::terms; ++n) power *= ratio;
  for (int n = event::terms; n < all_terms; ++n, power *= ratio) {
    const RowVector term = power * sizes_[r].row(n);
    sum.value += term;
    sum.slope += n * term;
    sum.curvature += n * (n - 1.0) * term;
  }
  double last = 0.0;
  for (Eigen::Index i = 0; i < m_; ++i)
    if (scale[i] > 0.0) last = std::max(last, power / ratio * sizes_[r](all_terms - 1, i) / scale[i]);
  const double nu = ratio * norm(scale);
  if (last == 0.0) return sum;
  if (!(nu < all_terms)) {
    const RowVector none = RowVector::Constant(m_, INFINITY);
    return {none, none, none};
  }
  const double left = nu / (1.0 - nu / all_terms);
  sum.value += last * (nu / all_terms) / (1.0 - nu / (all_terms + 1)) * scale;
  sum.slope += last * left * scale;
  sum.curvature += last * (nu * (all_terms - 1.0) + nu * left) * scale;
  return sum;
}

bool Series::tail_is_negligible(double ratio) const {
  const std::vector<RowVector> all = scales(ratio);
  for (std::size_t r = 0; r < all.size(); ++r) {
    if ((tail(r, all[r], ratio).value.array() > 0.25 * event::unit_roundoff * all[r].array()).any()) return false;
  }
  return true;
}

void Series::set_window(double low, double period, double longest_window) {
  window_in_periods_ = few_bits(std::min(low * reference_ / period, longest_window));
  window_ = window_in_periods_ * period;
  const DoubleDouble ratio = two_product(window_in_periods_, period) / reference_;
  const std::vector<RowVector> all = scales(ratio.hi);
  for (std::size_t r = 0; r < all.size(); ++r) {
    tails_.push_back(tail(r, all[r], ratio.hi));
    DoubleDouble power = 1.0;
    for (int n = 0; n < all_terms; ++n, power *= ratio) {
      for (DoubleDouble& term : scaled_[r][n]) term *= power;
      errors_[r].row(n) *= power.hi;
    }
  }
}

double Series::error(std::size_t r, int n, int i) const { return errors_[r](n, i); }

double Series::taylor(std::size_t r, int n, int i) const { return scaled_[r][n][i].hi; }

RowVector Series::end_value(std::size_t r) const {
  RowVector out(m_);
  for (Eigen::Index i = 0; i < m_; ++i) {
    DoubleDouble sum;
    for (int n = all_terms - 1; n >= 0; --n) sum += scaled_[r][n][i];
    out[i] = sum.hi;
  }
  return out;
}

RowVector Series::end_slope(std::size_t r) const {
  RowVector out(m_);
  for (Eigen::Index i = 0; i < m_; ++i) {
    DoubleDouble sum;
    for (int n = all_terms - 1; n > 0; --n) sum += scaled_[r][n][i] * n;
    out[i] = (sum / window_).hi;
  }
  return out;
}

}  // namespace slapstick::mode
