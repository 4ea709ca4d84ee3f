#include <algorithm>
#include <cmath>

#include "orbit/change_kind.hpp"
#include "orbit/crossing_curve.hpp"
#include "orbit/path.hpp"
#include "orbit/special.hpp"
#include "orbit/two_ways.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rim = 1e-4;  ///< so near to the end of a range, as a part of it, a curve has come to it

/// Follows f = 0 on the surface of orbits over two parameters. Near a point the surface has two tangent directions; the curve's is the one along
/// which f does not change, the other is where Newton's correction of f goes.
class CurveFollower {
 public:
  CurveFollower(const Problem& problem, const SpecialPoint& point, const CurveOptions& options)
      : problem_(problem), point_(point), options_(options) {}

  /// @param sign  +1 or -1: one way from the point and the other
  Curve run(Orbit orbit, double sign);

 private:
  struct Place {
    Orbit orbit;
    VectorXd units;
    VectorXd along, across;  ///< of length 1, orthogonal, in units
    VectorXd
        tangent;  ///< of the branch in the first parameter, never turned round along the curve: f may depend on its sense
    Watched watched;
  };

  [[nodiscard]] Place place(Orbit orbit, const Place* before) const;
  [[nodiscard]] std::optional<Orbit> moved(const Place& from, double along, double across) const;
  [[nodiscard]] std::optional<double> f(const Place& from, double along, double across) const;
  [[nodiscard]] std::optional<Orbit> corrected(const Place& from, double step) const;
  void note(const Place& before, const Place& now, Curve& curve) const;
  [[nodiscard]] bool inside(const std::vector<double>& values) const;
  /// The parameters at a distance along the tangent.
  [[nodiscard]] std::vector<double> ahead(const Place& here, double step) const;
  [[nodiscard]] bool at_the_rim(const Place& here) const;
  [[nodiscard]] CurvePoint point_of_curve(const Place& here) const;
  void note_own(const Watched& at);
  [[nodiscard]] std::optional<Place> next_place(const Place& here, double step) const;
  [[nodiscard]] MatrixXd surface(const Linearised& at, const VectorXd& units) const;

  const Problem& problem_;
  const SpecialPoint& point_;
  const CurveOptions& options_;
  std::vector<bool> own_;
};

bool CurveFollower::inside(const std::vector<double>& values) const {
  return values[0] >= options_.from && values[0] <= options_.to && values[1] >= options_.second_from &&
         values[1] <= options_.second_to;
}

/// Two orthonormal columns: the tangent plane of the surface.
MatrixXd CurveFollower::surface(const Linearised& at, const VectorXd& units) const {
  MatrixXd matrix = at.by * units.asDiagonal();
  level_rows(matrix);
  return Eigen::JacobiSVD<MatrixXd>(matrix, Eigen::ComputeFullV).matrixV().rightCols(2);
}

/// The orbit at given distances in the tangent plane.
std::optional<Orbit> CurveFollower::moved(const Place& from, double along, double across) const {
  Orbit orbit = from.orbit;
  const ModeSet set(problem_.family(), orbit.values);
  const Linearised at = linearise(problem_, set, orbit);
  move(problem_, at, (along * from.along + across * from.across).cwiseProduct(from.units), 0.0, orbit);
  const std::vector<Condition> conditions = {{from.along.cwiseQuotient(from.units).transpose()},
                                             {from.across.cwiseQuotient(from.units).transpose()}};
  if (!solve(problem_, orbit, conditions, 10).converged) return std::nullopt;
  return orbit;
}

std::optional<double> CurveFollower::f(const Place& from, double along, double across) const {
  const std::optional<Orbit> orbit = moved(from, along, across);
  if (!orbit) return std::nullopt;
  return defining(point_, point_of(problem_, *orbit, options_.to - options_.from, from.tangent).watched);
}

CurveFollower::Place CurveFollower::place(Orbit orbit, const Place* before) const {
  constexpr double h = 1e-5;
  Place here;
  here.units = arclength_units(problem_, orbit, options_.to - options_.from);
  here.units[problem_.parameter_column(orbit.legs(), 1)] = options_.second_to - options_.second_from;
  const ModeSet set(problem_.family(), orbit.values);
  const MatrixXd plane = surface(linearise(problem_, set, orbit), here.units);
  here.orbit = std::move(orbit);
  PathPoint point =
      point_of(problem_, here.orbit, options_.to - options_.from, before != nullptr ? before->tangent : VectorXd());
  here.tangent = std::move(point.tangent);
  here.watched = std::move(point.watched);
  here.along = plane.col(0);
  here.across = plane.col(1);
  const auto slope = [&](double a, double b) {
    const auto plus = f(here, a * h, b * h), minus = f(here, -a * h, -b * h);
    if (!plus || !minus) throw NumericalError("curve: no orbits beside " + shown(here.orbit.values[0]));
    return (*plus - *minus) / (2.0 * h);
  };
  const double p = slope(1.0, 0.0), q = slope(0.0, 1.0), size = std::hypot(p, q);
  if (!(size > 0.0)) throw NumericalError("curve: the special point is degenerate at " + shown(here.orbit.values[0]));
  const VectorXd along = (q * plane.col(0) - p * plane.col(1)) / size,
                 across = (p * plane.col(0) + q * plane.col(1)) / size;
  here.along = before != nullptr && along.dot(before->along) < 0.0 ? VectorXd(-along) : along;
  here.across = across;
  return here;
}

/// A step along the tangent, then the secant rule across it.
std::optional<Orbit> CurveFollower::corrected(const Place& from, double step) const {
  double a = 0.0, b = 1e-3 * step;
  std::optional<double> f_a = f(from, step, a), f_b = f(from, step, b);
  const double start = f_a ? std::abs(*f_a) : 0.0;
  for (int k = 0; k < 25 && f_a && f_b; ++k) {
    if (*f_a == *f_b || std::abs(b - a) < 1e-13) return moved(from, step, b);
    const double next = b - *f_b * (b - a) / (*f_b - *f_a);
    if (!std::isfinite(next) || std::abs(next) > step) return std::nullopt;
    a = b;
    f_a = f_b;
    b = next;
    f_b = f(from, step, b);
  }
  if (!f_b || std::abs(*f_b) > 1e-6 * start) return std::nullopt;
  return moved(from, step, b);
}

/// The margins that are zero all along: the point's own, and those that say the same in other words.
void CurveFollower::note_own(const Watched& at) {
  constexpr double zero = 1e-6;
  own_.assign(at.tests.size(), false);
  for (std::size_t i = 0; i < at.tests.size(); ++i) {
    double largest = 0.0;
    for (const TestValue& other : at.tests)
      if (other.test == at.tests[i].test && std::isfinite(other.value))
        largest = std::max(largest, std::abs(other.value));
    own_[i] = std::abs(at.tests[i].value) <= zero * largest;
  }
}

/// On a curve of GR, SL, CH or CO the simulator cannot decide; whether the orbit is a motion but for that is seen from its other margins.
CurvePoint CurveFollower::point_of_curve(const Place& here) const {
  CurvePoint point{here.orbit.values, describe(problem_, here.orbit, nullptr)};
  point.solution.is_motion = true;
  for (std::size_t i = 0; i < here.watched.tests.size() && point.solution.is_motion; ++i) {
    if (own_[i] || here.watched.tests[i].value >= 0.0) continue;
    point.solution.is_motion = false;
    point.solution.why = describe(here.watched.tests[i], here.orbit.shape, problem_.base());
  }
  return point;
}

/// Signs that have changed beside the one that is zero all along.
void CurveFollower::note(const Place& before, const Place& now, Curve& curve) const {
  const auto add = [&](const std::string& what) {
    curve.met.push_back({what, now.orbit.values, curve.points.size() - 1});
  };
  const auto changes = [](double a, double b) { return (a < 0.0) != (b < 0.0); };
  if (point_.type != SpecialType::PD && changes(before.watched.flip, now.watched.flip)) add("a multiplier passes -1");
  if (point_.type != SpecialType::LP && changes(before.watched.turn, now.watched.turn))
    add("a fold of the branch: a multiplier passes +1");
  if (point_.type != SpecialType::NS && point_.type != SpecialType::PD &&
      changes(before.watched.torus, now.watched.torus))
    add("two multipliers whose product is 1");
  for (int j = 0; j < 2; ++j) {
    const Index column = problem_.parameter_column(before.orbit.legs(), j);
    if (changes(before.along[column], now.along[column]))
      add("the curve turns back in " + problem_.family().names[static_cast<std::size_t>(j)]);
  }
  for (std::size_t i = 0; i < before.watched.tests.size(); ++i) {
    if (!own_[i] && before.watched.tests[i].value > 0.0 && now.watched.tests[i].value < 0.0)
      add("the events change: " + describe(now.watched.tests[i], now.orbit.shape, problem_.base()));
  }
}

std::vector<double> CurveFollower::ahead(const Place& here, double step) const {
  std::vector<double> values = here.orbit.values;
  for (Index j = 0; j < 2; ++j) {
    const Index column = problem_.parameter_column(here.orbit.legs(), j);
    values[static_cast<std::size_t>(j)] += step * here.along[column] * here.units[column];
  }
  return values;
}

bool CurveFollower::at_the_rim(const Place& here) const {
  std::vector<double> values = here.orbit.values;
  for (Index j = 0; j < 2; ++j) {
    const Index column = problem_.parameter_column(here.orbit.legs(), j);
    values[static_cast<std::size_t>(j)] += std::copysign(rim * here.units[column], here.along[column]);
  }
  return !inside(values);
}

std::optional<CurveFollower::Place> CurveFollower::next_place(const Place& here, double step) const {
  try {
    if (const auto found = corrected(here, step)) return place(*found, &here);
  } catch (const InputError&) {  // no model there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

Curve CurveFollower::run(Orbit orbit, double sign) {
  Curve curve;
  curve.ended = "points";
  Place here = place(std::move(orbit), nullptr);
  if (here.along[problem_.parameter_column(here.orbit.legs(), 1)] * sign < 0.0) here.along = -here.along;
  note_own(here.watched);
  double step = 0.25 * options_.longest_step;
  curve.points.push_back(point_of_curve(here));
  while (static_cast<int>(curve.points.size()) < options_.most_points && !stopped(options_.stop)) {
    std::optional<Place> next;
    if (inside(ahead(here, step))) next = next_place(here, step);
    if (!next || here.along.dot(next->along) < 0.9 || !inside(next->orbit.values)) {
      step *= 0.5;
      if (step > 1e-7) continue;
      curve.failed = !at_the_rim(here);
      curve.ended = curve.failed
                        ? "no convergence behind " + shown(here.orbit.values[0]) + ", " + shown(here.orbit.values[1])
                        : "range";
      return curve;
    }
    note(here, *next, curve);
    curve.points.push_back(point_of_curve(*next));
    here = std::move(*next);
    step = std::min(options_.longest_step, 1.4 * step);
    if (options_.progress) options_.progress(static_cast<long>(curve.points.size()));
  }
  return curve;
}

}  // namespace

Curve locus(const Problem& problem, const SpecialPoint& point, const CurveOptions& options) {
  if (problem.parameters() != 2) throw InputError("curve: a family of two parameters is needed");
  if (point.type == SpecialType::BP)
    return joined(crossing_curve(problem, point, options, -1.0), crossing_curve(problem, point, options, 1.0),
                  &Curve::met);
  CurveFollower follower(problem, point, options);
  Orbit start = point.solution.orbit;
  Curve down = follower.run(start, -1.0);
  return joined(std::move(down), follower.run(start, 1.0), &Curve::met);
}

}  // namespace slapstick::orbit
