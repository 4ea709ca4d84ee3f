/// Compares two looks at a motion with the linear part of the map beside a cycle.
#include "section/approach.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"

namespace slapstick::section {
namespace {

using Eigen::VectorXd;

/// As many as the slowest multiplier needs to halve an amplitude, but no more than a trial may last. An even number: a
/// motion that alternates beside the cycle is farther away on one side than on the other.
long cycles_of_stage(double slowest, int n) {
  const double halving = slowest > 0.5 ? std::ceil(std::log(0.5) / std::log(slowest)) : 1.0;
  return 2 * static_cast<long>(std::max(1.0, std::min(std::ceil(halving / 2.0), std::floor(longest_trial / n / 2.0))));
}

}  // namespace

Approach::Approach(const flow::Translations& translations, const FixedPoint& cycle, int n, const VectorXd& scale)
    : translations_(translations),
      x_(cycle.x),
      scale_(scale),
      numbers_(translations.numbers(cycle.x)),
      turns_(cycle.multipliers.front().imag() != 0.0) {
  const dense::Eigenpairs left = dense::eigenpairs(cycle.value.jacobian.transpose());
  Eigen::Index leading = 0;
  if (left.values.size() > 0) left.values.cwiseAbs().maxCoeff(&leading);
  w_ = left.vectors.col(leading);
  w_ /= w_.cwiseAbs().dot(translations.numbers(scale));
  const double slowest = std::abs(cycle.multipliers.front());
  const long cycles = cycles_of_stage(slowest, n);
  left_ = std::pow(slowest, static_cast<double>(cycles));
  stage_ = cycles * n;
}

double Approach::distance(const Eigen::Ref<const VectorXd>& x) const {
  return section::distance(translations_, x, x_, scale_);
}

Approach::Look Approach::at(const VectorXd& x) const {
  const VectorXd away = translations_.numbers(x) - numbers_;
  return {distance(x), std::abs((w_.transpose() * away.cast<std::complex<double>>())(0))};
}

bool Approach::loses(const Look& before, const Look& after, double there) const {
  constexpr double share = 0.5;             // of the linear loss
  constexpr double linear = 1e-2;           // farther away the loss must be near the linear one, from both sides
  constexpr double above_rounding = 1e-13;  // a loss below is that of some hundred roundings
  // what is left is of faster directions, which fall by themselves
  if (before.amplitude <= there) return after.distance <= 0.8 * before.distance;
  const double lost = before.amplitude - after.amplitude;
  const double expected = before.amplitude * (1.0 - left_);
  const bool no_curve_between = !turns_ || before.distance <= linear || lost * share <= expected;
  return lost >= share * expected && lost > above_rounding && no_curve_between;
}

}  // namespace slapstick::section
