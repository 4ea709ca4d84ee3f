/// Computes exp(A t) X in balls.
#include "flow.hpp"

#include <algorithm>
#include <cmath>

namespace verify {

namespace {

/// Of an entry that is zero in exact arithmetic the balls know only the radius, near 2^-250 of its terms. Its size is
/// 2^48 radii, so that the allowances of rounding (2^-40) and of a start (2^-44 of sizes) are some radii. With less
/// than 2^44 no such condition would ever count as zero.
std::vector<double> magnitudes(const Balls& row) {
  constexpr double above_rounding = 0x1p+48;
  std::vector<double> sizes;
  for (const Ball& x : row) sizes.push_back(abs(x).highest() + above_rounding * x.radius());
  return sizes;
}

}  // namespace

Flow::Flow(Matrix system, Matrix functionals, std::size_t phases)
    : A(std::move(system)), rows(std::move(functionals)), weight(A.size(), 1.0), nu(0.0), phases_(phases) {
  const auto entries_of = [](const Matrix& matrix) {
    std::vector<std::vector<Entry>> all;
    for (const Balls& row : matrix) {
      all.emplace_back();
      const std::vector<double> sizes = magnitudes(row);
      for (std::size_t j = 0; j < sizes.size(); ++j)
        if (sizes[j] != 0.0) all.back().push_back({j, sizes[j]});
    }
    return all;
  };
  entries_ = entries_of(A);
  row_entries_ = entries_of(rows);
  // Any positive weights are right; good ones save terms.
  for (int round = 0;; ++round) {
    const std::vector<double> image = apply_sizes(weight);
    nu = 0.0;
    for (std::size_t i = 0; i < size(); ++i) nu = std::max(nu, image[i] / weight[i]);
    if (round == 8 || nu == 0.0) break;
    for (std::size_t i = 0; i < size(); ++i) weight[i] = image[i] / nu + 0.25 * weight[i];
  }
  nu = nu * (1.0 + 0x1p-30) + 0x1p-900;  // more than the rounding of sums of up to 10000 terms, and than underflow
}

Balls Flow::rate(const Balls& x) const {
  Balls y(size());
  for (std::size_t i = 0; i < size(); ++i)
    for (const Entry& entry : entries_[i]) y[i].add_product(A[i][entry.column], x[entry.column]);
  return y;
}

std::vector<double> Flow::apply_sizes(const std::vector<double>& x) const {
  std::vector<double> y(size(), 0.0);
  for (std::size_t i = 0; i < size(); ++i)
    for (const Entry& entry : entries_[i]) y[i] += entry.size * x[entry.column];
  return y;
}

double Flow::size_of(std::size_t row, const std::vector<double>& x) const {
  double sum = 0.0;
  for (const Entry& entry : row_entries_[row]) sum += entry.size * x[entry.column];
  return sum;
}

std::vector<double> Flow::sizes_of(const Balls& x) const {
  std::vector<double> y(size(), 1.0);
  for (std::size_t i = 0; i < phases_; ++i) y[i] = std::abs(x[i].near());
  return y;
}

std::vector<double> Flow::carry_sizes(const std::vector<double>& x, double t) const {
  std::vector<double> term = x, sum = x;
  for (int n = 1; n < 20.0 + 4.0 * nu * t; ++n) {
    term = apply_sizes(term);
    for (std::size_t i = 0; i < x.size(); ++i) sum[i] += term[i] *= t / n;
  }
  return sum;
}

namespace {

/// log2 of |x|_w, nearly.
double magnitude(const Balls& x, const std::vector<double>& weight) {
  double e = -INFINITY;
  for (std::size_t i = 0; i < x.size(); ++i) e = std::max(e, x[i].exponent() - std::log2(weight[i]));
  return e;
}

Ball no_less_than_norm(const Balls& x, const std::vector<double>& weight) {
  Ball sum;
  for (std::size_t i = 0; i < x.size(); ++i) sum = sum + abs(x[i]) / Ball(weight[i]);
  return sum;
}

}  // namespace

/// Number i stays as it is if all that its rate is made of is zero and stays so.
std::vector<bool> Flow::still(const Balls& x) const {
  std::vector<bool> still(size(), true);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto zero = [&](const Entry& entry) { return still[entry.column] && x[entry.column].is_zero(); };
      if (!still[i] || std::all_of(entries_[i].begin(), entries_[i].end(), zero)) continue;
      still[i] = false;
      changed = true;
    }
  }
  return still;
}

Expansion::Expansion(const Flow& flow, const Balls& X, const Ball& reach, std::size_t least)
    : weight_(flow.weight), V_{X}, reach_(reach) {
  constexpr double below = -240.0;  // log2 of the remainder
  const double start = magnitude(X, flow.weight), pace = std::log2(reach.near());
  least = std::max(least, 10 + static_cast<std::size_t>(4.0 * flow.nu * reach.near()));
  const std::size_t most = 4 * least + 200;
  for (std::size_t n = 1;; ++n) {
    Balls next = flow.rate(V_.back());
    for (Ball& x : next) x = over(std::move(x), n);
    V_.push_back(std::move(next));
    const double size = magnitude(V_.back(), flow.weight) + static_cast<double>(n) * pace;
    if (n >= least && (n >= most || !(size > start + below))) break;
  }
  tail_ = times(no_less_than_norm(V_.back(), flow.weight), 2);
  const std::vector<bool> still = flow.still(V_.back());
  for (std::size_t i = 0; i < still.size(); ++i)
    if (still[i] && V_.back()[i].is_zero()) weight_[i] = 0.0;
  V_.pop_back();
  // What the bound on the tail asks for; a NaN makes every claim unproven.
  if (!(times(Ball(flow.nu) * reach, 4) <= Ball(static_cast<double>(V_.size() - 8)))) tail_ = tail_ / Ball(0.0);
}

Balls Expansion::at(const Ball& t) const {
  Balls x = V_.back();
  for (std::size_t n = V_.size() - 1; n-- > 0;)
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::move(x[i]) * t + V_[n][i];
  const Ball rest = tail_ * power(reach_, V_.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = widen(std::move(x[i]), rest * Ball(weight_[i]));
  return x;
}

Series Expansion::of(const Balls& row, std::size_t drop) const {
  Series series{{}, reach_, V_.size(), drop, tail_};
  for (std::size_t n = drop; n < V_.size(); ++n) series.b.push_back(dot(row, V_[n]));
  Ball size;
  for (std::size_t i = 0; i < row.size(); ++i) size = size + abs(row[i]) * Ball(weight_[i]);
  series.tail = tail_ * size;
  return series;
}

Ball Series::sum(ulong r, const Ball& t, bool of_sizes) const {
  Ball total;
  for (ulong n = b.size(); n-- > r;) {
    Ball term = of_sizes ? abs(b[n]) : b[n];
    for (ulong j = 0; j < r; ++j) term = times(std::move(term), n - j);
    total = std::move(total) * t + term;
  }
  const Ball missing = tail * power(Ball(static_cast<double>(N)), r) * power(reach, N - drop - r);
  return of_sizes ? total + missing : widen(std::move(total), missing);
}

}  // namespace verify
