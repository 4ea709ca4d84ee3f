/// Sums exp(A s) X term by term for a large mode.
#include "mode/term_sum.hpp"

#include <algorithm>
#include <utility>

#include "base/ranges.hpp"

namespace slapstick::mode {
namespace {

/// The displacements breadth first from one with few neighbours, so that neighbours come near each other.
std::vector<int> cuthill_mckee(const Eigen::MatrixXd& system, int d) {
  const auto linked = [&](int i, int j) {
    const auto acts = [&](int a, int b) { return system(d + a, b) != 0.0 || system(d + a, d + b) != 0.0; };
    return acts(i, j) || acts(j, i);
  };
  std::vector<int> degree(d), order, all(d);
  for (int i = 0; i < d; ++i) {
    all[i] = i;
    for (int j = 0; j < d; ++j) degree[i] += linked(i, j);
  }
  const auto fewer = [&](int i, int j) { return std::pair(degree[i], i) < std::pair(degree[j], j); };
  ranges::sort(all, fewer);
  std::vector<bool> taken(d, false);
  const auto take = [&](int i) {
    if (!taken[i]) order.push_back(i);
    taken[i] = true;
  };
  for (const int start : all) {
    auto next = order.size();
    for (take(start); next < order.size(); ++next) {
      for (const int i : all)
        if (linked(order[next], i)) take(i);
    }
  }
  return order;
}

}  // namespace

TermSum::TermSum(const Eigen::MatrixXd& system, int d)
    : d_(d), blocks_((d + 7) / 8), phases_(static_cast<int>(system.rows()) - 2 * d), order_(cuthill_mckee(system, d)) {
  const auto one = system.cols() - 1;
  for (const int i : order_) drift_.push_back(system(i, one));
  for (auto k = 2 * static_cast<Eigen::Index>(d); k < one; k += 2)
    turns_.emplace_back(system(k, k + 1), system(k + 1, k));
  for (int block = 0; block < blocks_; ++block) store_block(system, block);
}

void TermSum::store_block(const Eigen::MatrixXd& system, int block) {
  const int first = 8 * block, rows = std::min(8, d_ - first);
  const auto keep = [](event::PlacedRows& parts, int place, const event::Lane8& values) {
    if (event::greatest(event::magnitude(values)) > 0.0) parts.push_back({place, values});
  };
  for (const auto& [part, place] : {std::pair(0, p()), std::pair(d_, u())}) {
    for (int from = 1 - 8; from < d_; ++from) {
      event::Lane8 values{};
      for (int r = 0; r < rows; ++r) {
        const int column = from + r;
        if (column >= 0 && column < d_) values[r] = system(d_ + order_[first + r], part + order_[column]);
      }
      keep(diagonals_, place + from, values);
    }
  }
  for (int k = 0; k < phases_; ++k) {
    event::Lane8 values{};
    for (int r = 0; r < rows; ++r) values[r] = system(d_ + order_[first + r], 2 * d_ + k);
    keep(columns_, phase() + k, values);
  }
  diagonals_end_.push_back(static_cast<int>(diagonals_.size()));
  columns_end_.push_back(static_cast<int>(columns_.size()));
}

void TermSum::accelerate(double factor, const double* term, event::Lane8* out) const {
  const event::Placed* diagonal = diagonals_.data();
  const event::Placed* column = columns_.data();
  for (int b = 0; b < blocks_; ++b) {
    const event::Placed* const diagonal_end = diagonals_.data() + diagonals_end_[b];
    const event::Placed* const column_end = columns_.data() + columns_end_[b];
    kernels_->spread(diagonal, diagonal_end, column, column_end, factor, term, &out[b]);
    diagonal = diagonal_end;
    column = column_end;
  }
}

/// The forcing: (cos, sin)' = frequency (-sin, cos), (value, slope)' = (slope / T, 0), 1' = 0.
void TermSum::turn(double factor, const double* phase, double* out) const {
  for (std::size_t k = 0; k < turns_.size(); ++k) {
    out[2 * k] = factor * turns_[k].first * phase[2 * k + 1];
    out[2 * k + 1] = factor * turns_[k].second * phase[2 * k];
  }
  out[phases_ - 1] = 0.0;
}

void TermSum::state(double s, const double* X, double* out) const {
  constexpr int ready = 96;
  const int lanes = (phase() + phases_ + 7) / 8, needed = 2 * lanes + 2 * blocks_;
  event::Lane8 space[ready];
  event::Lanes more(needed > ready ? needed : 0);
  event::Lane8* const work = needed > ready ? more.data() : space;
  std::fill_n(work, needed, event::Lane8{});
  event::Lane8 *term = work, *next = work + lanes, *const sum = next + lanes;
  const auto numbers = [](event::Lane8* place) { return reinterpret_cast<double*>(place); };

  const double one = X[2 * d_ + phases_ - 1];  // 0 for a tangent
  for (int i = 0; i < d_; ++i) {
    numbers(term)[p() + i] = X[order_[i]];
    numbers(sum)[i] = X[order_[i]] + s * one * drift_[i];
    numbers(term)[u() + i] = numbers(sum)[8 * blocks_ + i] = X[d_ + order_[i]];
  }
  std::copy_n(X + 2 * d_, phases_, numbers(term) + phase());
  for (int n = 1; n < event::terms; ++n) {
    const double factor = s / n;
    event::Lane8 *const p_next = next + p() / 8, *const u_next = next + u() / 8;
    accelerate(factor, numbers(term), u_next);
    turn(factor, numbers(term) + phase(), numbers(next) + phase());
    for (int b = 0; b < blocks_; ++b) {
      p_next[b] = factor * term[u() / 8 + b];
      sum[b] += p_next[b];
      sum[blocks_ + b] += u_next[b];
    }
    for (int i = 0; n == 1 && i < d_; ++i) numbers(p_next)[i] += s * one * drift_[i];
    std::swap(term, next);
  }
  for (int i = 0; i < d_; ++i) {
    out[order_[i]] = numbers(sum)[i];
    out[d_ + order_[i]] = numbers(sum)[8 * blocks_ + i];
  }
}

}  // namespace slapstick::mode
