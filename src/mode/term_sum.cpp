#include "slapstick/mode/term_sum.hpp"

#include <algorithm>

namespace slapstick::mode {
namespace {

double* numbers(event::Lanes& lanes) { return reinterpret_cast<double*>(lanes.data()); }

}  // namespace

TermSum::TermSum(const Eigen::MatrixXd& system, int d)
    : d_(d), blocks_((d + 7) / 8), phases_(static_cast<int>(system.rows()) - 2 * d) {
  const auto one = system.cols() - 1;
  for (int i = 0; i < d; ++i) drift_.push_back(system(i, one));
  for (auto k = 2 * static_cast<Eigen::Index>(d); k < one; k += 2) frequencies_.push_back(system(k + 1, k));
  for (int first = 0; first < d; first += 8) {
    const int rows = std::min(8, d - first);
    for (int column = 0; column <= one; ++column) {
      if (system.block(d + first, column, rows, 1).isZero(0.0)) continue;
      event::Lane8 value{};
      for (int r = 0; r < rows; ++r) value[r] = system(d + first + r, column);
      const int padding = 8 * blocks_ - d;
      columns_.push_back(column + (column >= d ? padding : 0) + (column >= 2 * d ? padding : 0));
      values_.push_back(value);
    }
    begins_.push_back(static_cast<int>(columns_.size()));
  }
}

void TermSum::accelerate(double factor, const event::Lane8* term, event::Lane8* out) const {
  const auto* x = reinterpret_cast<const double*>(term);
  for (int b = 0; b < blocks_; ++b) {
    event::Lane8 even{}, odd{};  // two chains: an addition waits for the one before it
    int k = begins_[b];
    for (; k + 2 <= begins_[b + 1]; k += 2) {
      even += values_[k] * x[columns_[k]];
      odd += values_[k + 1] * x[columns_[k + 1]];
    }
    if (k < begins_[b + 1]) even += values_[k] * x[columns_[k]];
    out[b] = factor * (even + odd);
  }
}

/// The forcing: (cos, sin)' = frequency (-sin, cos), 1' = 0.
void TermSum::turn(double factor, const double* phase, double* out) const {
  for (std::size_t k = 0; k < frequencies_.size(); ++k) {
    out[2 * k] = -factor * frequencies_[k] * phase[2 * k + 1];
    out[2 * k + 1] = factor * frequencies_[k] * phase[2 * k];
  }
  out[phases_ - 1] = 0.0;
}

void TermSum::state(double s, const double* X, double* out) const {
  const int phase = 16 * blocks_;
  const double one = X[2 * d_ + phases_ - 1];  // 0 for a tangent
  event::Lanes term(2 * blocks_ + (phases_ + 7) / 8), next(term.size());
  std::copy_n(X, d_, numbers(term));
  std::copy_n(X + d_, d_, numbers(term) + phase / 2);
  std::copy_n(X + 2 * d_, phases_, numbers(term) + phase);
  event::Lanes sum(term.begin(), term.begin() + 2 * blocks_);
  for (int i = 0; i < d_; ++i) numbers(sum)[i] += s * one * drift_[i];
  for (int n = 1; n < event::terms; ++n) {
    const double factor = s / n;
    accelerate(factor, term.data(), next.data() + blocks_);
    turn(factor, numbers(term) + phase, numbers(next) + phase);
    for (int b = 0; b < blocks_; ++b) {
      next[b] = factor * term[blocks_ + b];
      sum[b] += next[b];
      sum[blocks_ + b] += next[blocks_ + b];
    }
    if (n == 1)
      for (int i = 0; i < d_; ++i) numbers(next)[i] += s * one * drift_[i];
    std::swap(term, next);
  }
  std::copy_n(numbers(sum), d_, out);
  std::copy_n(numbers(sum) + phase / 2, d_, out + d_);
}

}  // namespace slapstick::mode
