/// Carries the state at a flight's origin to the present window.
#include "flow/flight_origin.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"

namespace slapstick::flow {
namespace {

using Wide = std::vector<DoubleDouble>;

/// exp(A s) X from its series, for |A| s <= 4 or a window, whose terms are negligible long before the 48th.
Wide step(const mode::Matrix& A, DoubleDouble s, const Wide& X) {
  Wide sum = X, term = X;
  for (int n = 1; n < 48; ++n) {
    Wide next(X.size());
    for (std::size_t i = 0; i < X.size(); ++i) {
      for (std::size_t j = 0; j < X.size(); ++j) {
        const double a = A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (a != 0.0) next[i] += a * term[j];
      }
      next[i] = next[i] * s / n;
      sum[i] += next[i];
    }
    term.swap(next);
  }
  return sum;
}

}  // namespace

void FlightOrigin::pass(double duration, const event::Lanes& from, const event::Lanes& to) {
  if (windows_ == 0) {
    note(from);
    if (staleness_ == 0.0) ranges::transform(from, largest_.begin(), event::magnitude);
  }
  event::Lane8 total{};
  for (std::size_t b = 0; b < largest_.size(); ++b)
    total += largest_[b] = event::larger(largest_[b], event::magnitude(to[b]));
  size_ = event::sum(total);
  elapsed_ = elapsed_ + duration;
  count();
}

void FlightOrigin::carry(const mode::Mode& mode, double* X) {
  const auto* origin = reinterpret_cast<const double*>(X_.data());
  Wide state(origin, origin + m_);
  const DoubleDouble elapsed = elapsed_ + two_product(whole_, mode.window());
  const double rate = mode.system().cwiseAbs().rowwise().sum().maxCoeff();
  const double count = std::max(1.0, std::ceil(elapsed.hi * std::min(0.25 * rate, 1.0 / mode.window())));
  for (double k = 0; k < count; ++k) state = step(mode.system(), elapsed / count, state);
  ranges::transform(state, X, [](DoubleDouble x) { return x.hi; });
  windows_ = 0;  // X is the origin now
  staleness_ = carried;
}

}  // namespace slapstick::flow
