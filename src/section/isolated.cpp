/// Evaluates the map at both ends of a fixed point's error.
#include "section/isolated.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Wider: two maps more for each slow cycle. Narrower: of a point at which Newton's method stopped on its way to the
/// end of a continuum, 1e-11 from its image, nothing is asked if the map's curvature is above slow^2 / 2e-11.
constexpr double slow = 1e-4;

/// What is known of a fixed point, in numbers relative to the motion's size.
class Known {
 public:
  Known(const ReturnMap& map, const FixedPoint& point, const VectorXd& scale)
      : map_(map), point_(point), sizes_(map.translations().numbers(scale)) {
    constexpr double component_rounding =
        0x1p-40;  // of eigenvectors: a coordinate that rests at a stop is not put behind it
    const dense::Eigenpairs pairs = dense::eigenpairs(derivative());
    Index slowest = 0;
    (pairs.values.array() - 1.0).abs().minCoeff(&slowest);
    if (pairs.values[slowest].imag() == 0.0) left_ = 1.0 - pairs.values[slowest].real();
    direction_ = pairs.vectors.col(slowest).real();
    direction_ /= direction_.cwiseAbs().maxCoeff();
    direction_ = (direction_.array().abs() > component_rounding).select(direction_, 0.0);
  }

  /// 1 - mu of the multiplier nearest to 1; infinite if that is complex.
  [[nodiscard]] double left() const { return left_; }
  [[nodiscard]] double missed() const { return residual().cwiseAbs().maxCoeff(); }

  /// The next correction of Newton's method.
  [[nodiscard]] VectorXd correction() const {
    return dense::solve(derivative() - MatrixXd::Identity(sizes_.size(), sizes_.size()), -residual());
  }

  /// How far from the fixed point rounding may keep Newton's method.
  [[nodiscard]] double rounding() const {
    // The image's, which all events of the cycle add to. More: cycles beside a fold are undecided where 1 - mu is about
    // the square root of it. Fewer: the end of a continuum is told as a cycle.
    constexpr double roundings = 16.0;
    return roundings * std::numeric_limits<double>::epsilon() * numbers(point_.x).cwiseAbs().maxCoeff() / left_;
  }

  [[nodiscard]] VectorXd moved(const VectorXd& by) const {
    return point_.x + map_.translations().representative(by.cwiseProduct(sizes_));
  }
  [[nodiscard]] VectorXd along(double distance) const { return moved(distance * direction_); }

 private:
  [[nodiscard]] VectorXd numbers(const VectorXd& x) const {
    return map_.translations().numbers(x).cwiseQuotient(sizes_);
  }
  [[nodiscard]] VectorXd residual() const { return numbers(point_.value.image - point_.x); }
  [[nodiscard]] MatrixXd derivative() const {
    return sizes_.cwiseInverse().asDiagonal() * point_.value.jacobian * sizes_.asDiagonal();
  }

  const ReturnMap& map_;
  const FixedPoint& point_;
  VectorXd sizes_, direction_;
  double left_ = INFINITY;
};

std::optional<FixedPoint> point_at(const ReturnMap& map, const VectorXd& x, int n, Stop stop) {
  try {
    FixedPoint point{x, map.value(x, n, stop), {}};
    point.multipliers = map.multipliers(point.value.jacobian);
    return point;
  } catch (const InputError&) {  // no motion is there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

}  // namespace

bool isolated(const ReturnMap& map, FixedPoint& found, int n, const VectorXd& scale, Stop stop) {
  constexpr double changes = 0.25;
  constexpr int most_steps = 40;  // 2^-40 is rounding
  const auto is_slow = [](std::complex<double> mu) { return std::abs(mu - 1.0) <= slow; };
  for (int step = 0; step < most_steps && !stopped(stop); ++step) {
    if (ranges::none_of(found.multipliers, is_slow)) return true;
    const Known here(map, found, scale);
    if (std::isinf(here.left())) return true;  // motions turn about the point
    if (!(here.left() > 0.0)) return false;
    const VectorXd correction = here.correction();
    const double newton = correction.cwiseAbs().maxCoeff(), error = std::max(newton, here.rounding());
    const auto keeps = [&](double distance) {
      const auto there = point_at(map, here.along(distance), n, stop);
      return !there || std::abs(Known(map, *there, scale).left() - here.left()) <= changes * here.left();
    };
    if (keeps(error) && keeps(-error)) return true;
    if (!(newton > here.rounding())) return false;
    auto next = point_at(map, here.moved(correction), n, stop);
    if (!next || Known(map, *next, scale).missed() > here.missed()) return false;
    found = std::move(*next);
  }
  return false;
}

}  // namespace slapstick::section
