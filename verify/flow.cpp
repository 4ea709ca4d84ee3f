/// Computes exp(A t) X in balls.
#include "flow.hpp"

#include <algorithm>
#include <cmath>

namespace verify {

Flow::Flow(const Mode& mode, const Head& head)
    : A(mode.rows.size(), Balls(mode.rows.size())),
      weight(mode.rows.size(), 1.0),
      nu(0.0),
      rows_(mode.rows),
      first_phase_(2 * static_cast<std::size_t>(head.d)) {
  for (std::size_t i = 0; i < size(); ++i)
    for (const auto& [j, a] : rows_[i]) A[i][static_cast<std::size_t>(j)] = a;
  for (const Guard& guard : mode.guards) {
    guards.emplace_back(size());
    for (const auto& [j, c] : guard.row) guards.back()[static_cast<std::size_t>(j)] = c;
  }
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

std::vector<double> Flow::apply_sizes(const std::vector<double>& x) const {
  std::vector<double> y(size(), 0.0);
  for (std::size_t i = 0; i < size(); ++i)
    for (const auto& [j, a] : rows_[i]) y[i] += std::abs(a) * x[static_cast<std::size_t>(j)];
  return y;
}

std::vector<double> Flow::sizes_of(const Balls& x) const {
  std::vector<double> y(size(), 1.0);
  for (std::size_t i = 0; i < first_phase_; ++i) y[i] = std::abs(x[i].near());
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
      const auto zero = [&](const auto& entry) {
        const auto j = static_cast<std::size_t>(entry.first);
        return still[j] && x[j].is_zero();
      };
      if (!still[i] || std::all_of(rows_[i].begin(), rows_[i].end(), zero)) continue;
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
    Balls next;
    next.reserve(X.size());
    for (const Balls& row : flow.A) next.push_back(over(dot(row, V_.back()), n));
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

bool Series::curvature_within(const Ball& M, double from, double to, int depth) const {
  if (depth == 12 && most(2, Ball(to)) <= M) return true;
  const double middle = from + 0.5 * (to - from);
  const Ball here = abs(value(2, Ball(middle)));
  if (here + (Ball(to) - Ball(from)) * most(3, Ball(to)) <= M) return true;
  if (depth == 0 || here > M) return false;
  return curvature_within(M, from, middle, depth - 1) && curvature_within(M, middle, to, depth - 1);
}

}  // namespace verify
