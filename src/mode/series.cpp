/// Finds the window of a mode, and expands its rows over it.
#include "mode/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/dense.hpp"
#include "base/double_double.hpp"
#include "base/elementary.hpp"

namespace slapstick::mode {
namespace {

/// The spectral radius of A: of its motion without forcing, and the frequencies of what turns. Signals are nilpotent,
/// and nothing acts on either.
double spectral_radius(const Matrix& A, int d) {
  double radius = std::sqrt(dense::eigenvalues(A.topLeftCorner(2 * d, 2 * d)).cwiseAbs2().maxCoeff());
  for (Eigen::Index c = 2 * d; c + 1 < A.rows(); ++c)
    radius = std::max(radius, std::sqrt(std::abs(A(c, c + 1) * A(c + 1, c))));
  return radius;
}

/// 1 / spectral radius, or 1 if A is nilpotent (rigid bodies: the series ends by itself). Only eight bits are kept: the
/// rounding of an eigenvalue solver, which differs for a mirrored model, shall not reach the results.
double reference_length(const Matrix& A, int d) {
  const double radius = spectral_radius(A, d);
  if (!(radius > 1e-8 * A.cwiseAbs().maxCoeff() && radius > 0.0)) return 1.0;
  int exponent = 0;
  const double mantissa = std::frexp(1.0 / radius, &exponent);
  return std::ldexp(std::floor(256.0 * mantissa) / 256.0, exponent);
}

double power_of_two_in(double x) {
  int exponent = 0;
  (void)std::frexp(x, &exponent);
  return std::ldexp(0.5, exponent);
}

/// The greatest number with 24 bits up to x.
double few_bits(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(0x1p24 * mantissa), exponent - 24);
}

/// 2^e_1 .. 2^e_n / n!, e_n = floor(log2 n).
constexpr std::array<DoubleDouble, event::all_terms> factors = [] {
  std::array<DoubleDouble, event::all_terms> all{};
  all[0] = 1.0;
  for (int n = 1; n < event::all_terms; ++n) {
    double power = 1.0;
    while (2.0 * power <= n) power *= 2.0;
    all[n] = all[n - 1] * power / n;
  }
  return all;
}();

/// w_n for r = ratio, to a relative 40 u.
using Rough = std::array<double, event::all_terms>;
Rough rough_weights(double ratio) {
  Rough power{1.0, ratio}, weights{};
  for (int n = 2; n < event::all_terms; ++n) power[n] = power[n / 2] * power[n - n / 2];
  for (int n = 0; n < event::all_terms; ++n) weights[n] = power[n] * factors[n].hi;
  return weights;
}

/// The same in double-doubles; those of the terms that are dropped in doubles.
event::Weights exact_weights(DoubleDouble ratio) {
  event::Weights weights;
  std::array<DoubleDouble, event::terms> power{1.0, ratio};
  for (int n = 2; n < event::terms; ++n) power[n] = power[n / 2] * power[n - n / 2];
  for (int n = 0; n < event::terms; ++n) {
    const DoubleDouble weight = power[n] * factors[n], halves = split(weight.hi);
    weights.high[n] = weight.hi;
    weights.low[n] = weight.lo;
    weights.upper[n] = halves.hi;
    weights.lower[n] = halves.lo;
  }
  const Rough rough = rough_weights(ratio.hi);
  std::copy(rough.begin() + event::terms, rough.end(), weights.high + event::terms);
  return weights;
}

/// Is what a window drops negligible? The longer the window, the more it drops: what is known of one is known of
/// others.
class Negligible {
 public:
  /// @param ratio  r of a window of the reference length
  Negligible(const event::Expansion& all, double ratio) : all_(all), ratio_(ratio) {}

  bool operator()(double length) {
    if (length > longest_ && length < shortest_) (void)excess(length);
    return length <= longest_;
  }

  /// Brackets the longest window between two that are near each other. The excess grows about like length^24: its 24th
  /// root, and from the second step on how that has grown (a secant of the logarithms).
  void approach(double length) {
    double slope = 1.0, before = 0.0;
    for (int k = 0; k < 4; ++k) {
      const double over = excess(length);
      if (!(over > 0x1p-100 && over < 0x1p100)) return;
      const double root = std::sqrt(std::sqrt(std::sqrt(fixed::cube_root(over)))),
                   log = 2.0 * (root - 1.0) / (root + 1.0);
      if (k > 0 && std::abs(before) < 0.5) slope = std::clamp(slope * (1.0 - log / before), 0.5, 2.0);
      before = log;
      const double half = 0.5 * log / slope;
      length *= (1.0 - half) / (1.0 + half);
      if (std::abs(log) < 0x1p-6 && k > 0) break;
    }
    (void)excess(length * (1.0 - 0x1p-13));
    (void)excess(length * (1.0 + 0x1p-13));
  }

 private:
  double excess(double length) {
    const double over = event::kernels().excess(all_, rough_weights(length * ratio_).data(), length * ratio_);
    if (over <= 1.0)
      longest_ = std::max(longest_, length);
    else
      shortest_ = std::min(shortest_, length);
    return over;
  }

  const event::Expansion& all_;
  double ratio_, longest_ = 0.0, shortest_ = INFINITY;
};

}  // namespace

Series::Series(const Outline& outline, int displacements, double period, double longest_window)
    : reference_(reference_length(outline.system, displacements)), unit_(power_of_two_in(reference_)) {
  gather(outline);
  lay_out(outline, displacements);
  event::kernels().expand(all_);
  find_window(period, longest_window);
  weights_ = exact_weights(two_product(window_in_periods_, period) * (1.0 / unit_));
  event::kernels().enclose_tails(all_, weights_.high, weights_.high[1]);
  event::kernels().finish(all_, weights_);
}

/// The entries of A by columns, times the unit.
void Series::gather(const Outline& outline) {
  const Matrix& A = outline.system;
  all_.m = static_cast<int>(A.rows());
  column_ends_.reserve(static_cast<std::size_t>(all_.m) + 1);
  entries_.reserve(static_cast<std::size_t>((A.array() != 0.0).count()));
  column_ends_.push_back(0);
  for (int i = 0; i < all_.m; ++i) {
    for (int k = 0; k < all_.m; ++k) {
      if (A(k, i) == 0.0) continue;
      const double value = A(k, i) * unit_;
      const DoubleDouble halves = split(value);
      entries_.push_back({k, value, halves.hi, halves.lo, outline.system_size(k, i) * unit_});
    }
    column_ends_.push_back(static_cast<int>(entries_.size()));
  }
  all_.column_ends = column_ends_.data();
  all_.entries = entries_.data();
}

/// The arrays, and the rows to expand.
void Series::lay_out(const Outline& outline, int displacements) {
  const int m = all_.m, guards = static_cast<int>(outline.guards.size()), rows = guards + displacements;
  const auto groups = static_cast<std::ptrdiff_t>((rows + 3) / 4);
  all_.groups = static_cast<int>(groups);
  std::copy_n(std::array{0, displacements, 2 * displacements, m - 1, m}.data(), event::blocks + 1, all_.block_ends);
  constexpr int tables = 2 * event::all_terms + event::error_terms + 3 + 4;
  constexpr int small = (event::terms + 1) * event::blocks + event::blocks + 1;
  event::LaneBlockBuilder block(static_cast<std::size_t>(4 * (groups * (tables * m + small) + 3 * m)));
  const auto take = [&](std::ptrdiff_t count) { return block.take<event::Lane4>(count); };
  all_.high = take(groups * event::all_terms * m);
  all_.low = take(groups * event::terms * m);
  all_.dropped = take(groups * (event::all_terms - event::terms) * m);
  all_.errors = take(groups * event::error_terms * m);
  all_.tails = take(groups * 3 * m);
  all_.ends = take(groups * 4 * m);
  all_.peaks = take(groups * (event::terms + 1) * event::blocks);
  all_.scales = take(groups * event::blocks);
  all_.displacements = take(groups);
  all_.scratch = take(2 * m);
  all_.reach = block.take<double>(event::blocks * m);
  lanes_ = block.release();

  // A term of a number that changes nothing is zero, as of a slider that slips: it reaches no further one.
  std::fill_n(all_.reach, event::blocks * m, 0.0);
  for (int i = 0; i < m; ++i)
    for (int at = column_ends_[i]; at < column_ends_[i + 1]; ++at) {
      if (column_ends_[entries_[at].row] == column_ends_[entries_[at].row + 1]) continue;
      int from = 0;
      while (entries_[at].row >= all_.block_ends[from + 1]) ++from;
      all_.reach[from * m + i] += std::abs(entries_[at].value);
    }
  for (int r = 0; r < 4 * all_.groups; ++r) {
    auto* const row =
        reinterpret_cast<double*>(all_.high + static_cast<std::ptrdiff_t>(r / 4) * event::all_terms * m) + r % 4;
    for (int i = 0; i < m; ++i)
      row[4 * i] = r < guards ? outline.guards[r].row[i] : i == r - guards && r < rows ? 1.0 : 0.0;
    reinterpret_cast<double*>(all_.displacements)[r] = r >= guards && r < rows ? 1.0 : 0.0;
  }
}

/// By bisection in units of the reference length.
void Series::find_window(double period, double longest_window) {
  Negligible negligible(all_, reference_ / unit_);
  negligible.approach(2.0);
  double low = 0.25, high = 4.0;
  for (int k = 0; k < 40 && !negligible(low); ++k) low *= 0.25;
  if (negligible(high)) low = high;
  for (int k = 0; k < 12 && low < high; ++k) {
    const double middle = std::sqrt(low * high);
    (negligible(middle) ? low : high) = middle;
  }
  window_in_periods_ = few_bits(std::min(low * reference_ / period, longest_window));
  window_ = window_in_periods_ * period;
}

Tail Series::tail(int r, int i) const {
  constexpr double up = 1.0 + 0x1p-40;  // more than the rounding of weights and sums
  return {up * at(all_.tails, 3, r, 0, i), up * at(all_.tails, 3, r, 1, i), up * at(all_.tails, 3, r, 2, i)};
}

double Series::end_value(int r, int i) const { return at(all_.ends, 4, r, 0, i) + at(all_.ends, 4, r, 1, i); }

double Series::end_slope(int r, int i) const {
  return (two_sum(at(all_.ends, 4, r, 2, i), at(all_.ends, 4, r, 3, i)) / window_).hi;
}

}  // namespace slapstick::mode
