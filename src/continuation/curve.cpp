/// Follows a special point in two parameters.
#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/text.hpp"
#include "change/change_kind.hpp"
#include "continuation/crossing_curve.hpp"
#include "continuation/curve_walk.hpp"
#include "continuation/death_curve.hpp"
#include "continuation/special.hpp"
#include "continuation/two_ways.hpp"
#include "orbit/path.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A place of the surface of orbits.
struct SurfacePlace {
  Orbit orbit;
  VectorXd units;
  VectorXd along, across;  ///< of length 1, orthogonal, in units
  /// of the branch in the first parameter, never turned round along the curve: f may depend on its sense
  VectorXd tangent;
  Watched watched, before;  ///< here, and at the place before
};

/// Follows f = 0 on the surface of orbits over two parameters. Near a point the surface has two tangent directions; the
/// curve's is the one along which f does not change, the other is where Newton's correction of f goes.
class CurveFollower : public CurveWalk<SurfacePlace> {
 public:
  CurveFollower(const Problem& problem, const SpecialPoint& point, const CurveOptions& options)
      : CurveWalk(options), problem_(problem), point_(point) {}

  /// @param sign  +1 or -1: one way from the point and the other
  Curve run(Orbit orbit, double sign);

 private:
  using Place = SurfacePlace;

  [[nodiscard]] const std::vector<double>& values(const Place& here) const override { return here.orbit.values; }
  [[nodiscard]] std::array<double, 2> rates(const Place& here) const override;
  [[nodiscard]] std::optional<Place> next(const Place& here, const CurveStep& step) const override;
  [[nodiscard]] bool goes_on(const Place& here, const Place& ahead) const override {
    return straight(here.along.dot(ahead.along));
  }
  [[nodiscard]] CurvePoint point(const Place& here) const override;
  [[nodiscard]] CurvePlace watched(const Place& here) const override;
  bool pass(const Place& before, Place& now, double length, Curve& curve) const override;
  void explain(const Place& here, CurveEnd& end) const override {
    find_cause(point_, here.before, here.watched, own_, end);
  }

  [[nodiscard]] Place place(Orbit orbit, const Place* before) const;
  [[nodiscard]] std::optional<Orbit> moved(const Place& from, double along, double across) const;
  [[nodiscard]] std::optional<double> f(const Place& from, double along, double across) const;
  [[nodiscard]] std::optional<Orbit> corrected(const Place& from, double step, double reach) const;
  [[nodiscard]] std::optional<Orbit> at_wall(const Place& from, const CurveStep& wall, double across, double* f) const;
  [[nodiscard]] std::optional<Place> place_at_wall(const Place& from, const CurveStep& wall) const;
  [[nodiscard]] Place start(Orbit orbit);
  [[nodiscard]] MatrixXd surface(const Linearised& at, const VectorXd& units) const;

  const Problem& problem_;
  const SpecialPoint& point_;
  std::vector<bool> own_;
};

/// Two orthonormal columns: the tangent plane of the surface.
MatrixXd CurveFollower::surface(const Linearised& at, const VectorXd& units) const {
  MatrixXd matrix = at.by * units.asDiagonal();
  level_rows(matrix);
  return dense::right_singular_vectors(matrix).rightCols(2);
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

SurfacePlace CurveFollower::place(Orbit orbit, const Place* before) const {
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
  here.before = before != nullptr ? before->watched : here.watched;
  here.along = plane.col(0);
  here.across = plane.col(1);
  const auto slope = [&](double a, double b) {
    const auto plus = f(here, a * h, b * h), minus = f(here, -a * h, -b * h);
    if (!plus || !minus) throw NumericalError("curve: no orbits beside " + shown(here.orbit.parameter()));
    return (*plus - *minus) / (2.0 * h);
  };
  const double p = slope(1.0, 0.0), q = slope(0.0, 1.0), size = std::hypot(p, q);
  if (!(size > 0.0)) throw NumericalError("curve: the special point is degenerate at " + shown(here.orbit.parameter()));
  const VectorXd along = (q * plane.col(0) - p * plane.col(1)) / size,
                 across = (p * plane.col(0) + q * plane.col(1)) / size;
  here.along = before != nullptr && along.dot(before->along) < 0.0 ? VectorXd(-along) : along;
  here.across = across;
  return here;
}

/// A step along the tangent, then the secant rule across it, no farther than `reach`.
std::optional<Orbit> CurveFollower::corrected(const Place& from, double step, double reach) const {
  double a = 0.0, b = 1e-3 * reach;
  std::optional<double> f_a = f(from, step, a), f_b = f(from, step, b);
  const double start = f_a ? std::abs(*f_a) : 0.0;
  for (int k = 0; k < 25 && f_a && f_b; ++k) {
    if (*f_a == *f_b || std::abs(b - a) < 1e-13) return moved(from, step, b);
    const double next = b - *f_b * (b - a) / (*f_b - *f_a);
    if (!std::isfinite(next) || std::abs(next) > reach) return std::nullopt;
    a = b;
    f_a = f_b;
    b = next;
    f_b = f(from, step, b);
  }
  if (!f_b || std::abs(*f_b) > 1e-6 * start) return std::nullopt;
  return moved(from, step, b);
}

/// The first place. The special point is known to its error only, and where several margins vanish together some of
/// them as its root.
SurfacePlace CurveFollower::start(Orbit orbit) {
  Place here = place(std::move(orbit), nullptr);
  if (const auto found = corrected(here, 0.0, 0.25 * options_.longest_step)) here = place(*found, &here);
  std::vector<std::vector<TestValue>> off;
  for (const double aside : {0.1 * options_.longest_step, -0.1 * options_.longest_step})
    if (const auto there = moved(here, 0.0, aside))
      off.push_back(test_values(ModeSet(problem_.family(), there->values), *there));
  own_ = own_margins(point_, here.watched.tests, off);
  tests_ = curve_tests(point_, here.watched, own_);
  return here;
}

/// On a curve of GR, SL, CH or CO the simulator cannot decide; whether the orbit is a motion apart from that is seen
/// from its other margins.
CurvePoint CurveFollower::point(const Place& here) const {
  CurvePoint point{here.orbit.values, describe(problem_, here.orbit, nullptr)};
  point.solution.is_motion = true;
  for (std::size_t i = 0; i < here.watched.tests.size() && point.solution.is_motion; ++i) {
    if (own_[i] || here.watched.tests[i].value >= 0.0) continue;
    point.solution.is_motion = false;
    point.solution.why = describe(used(here.watched.tests[i]), here.orbit.shape, problem_.base());
  }
  return point;
}

std::array<double, 2> CurveFollower::rates(const Place& here) const {
  std::array<double, 2> all{};
  for (Index j = 0; j < 2; ++j) {
    const Index column = problem_.parameter_column(here.orbit.legs(), j);
    const auto i = static_cast<std::size_t>(j);
    all[i] = here.along[column] * here.units[column] / ranges()[i];
  }
  return all;
}

CurvePlace CurveFollower::watched(const Place& here) const { return {here.watched, rates(here)}; }

/// The orbit of the surface that has the wall's value, at a distance across the curve.
std::optional<Orbit> CurveFollower::at_wall(const Place& from, const CurveStep& wall, double across, double* f) const {
  Orbit orbit = from.orbit;
  const ModeSet set(problem_.family(), orbit.values);
  move(problem_, linearise(problem_, set, orbit),
       (wall.length * from.along + across * from.across).cwiseProduct(from.units), 0.0, orbit);
  orbit.values[*wall.wall] = wall.value;
  const std::vector<Condition> conditions = {{fixed_parameters(problem_, orbit.legs())[*wall.wall]},
                                             {from.across.cwiseQuotient(from.units).transpose()}};
  if (!solve(problem_, orbit, conditions, 10).converged) return std::nullopt;
  *f = defining(point_, point_of(problem_, orbit, options_.to - options_.from, from.tangent).watched);
  return orbit;
}

/// Where the curve meets the end of a range. The model may not exist beyond, so that the tangent there is extrapolated.
std::optional<SurfacePlace> CurveFollower::place_at_wall(const Place& from, const CurveStep& wall) const {
  try {
    double a = 0.0, b = 1e-3 * wall.length, f_a = 0.0, f_b = 0.0;
    std::optional<Orbit> orbit = at_wall(from, wall, a, &f_a), next = at_wall(from, wall, b, &f_b);
    for (int k = 0; k < 25 && orbit && next; ++k) {
      if (f_a == f_b || std::abs(b - a) < 1e-13) break;
      const double s = b - f_b * (b - a) / (f_b - f_a);
      if (!(std::abs(s) <= wall.length)) return std::nullopt;
      a = b;
      f_a = f_b;
      b = s;
      orbit = std::move(next);
      next = at_wall(from, wall, b, &f_b);
    }
    if (!next) return std::nullopt;
    Place last = from;
    last.watched = point_of(problem_, *next, options_.to - options_.from, from.tangent).watched;
    for (Index j = 0; j < 2; ++j) {  // of the parabola that has the first tangent and both points
      const Index column = problem_.parameter_column(next->legs(), j);
      const auto i = static_cast<std::size_t>(j);
      const double chord = (next->values[i] - from.orbit.values[i]) / (wall.length * from.units[column]);
      last.along[column] = 2.0 * chord - from.along[column];
    }
    last.orbit = std::move(*next);
    return last;
  } catch (const InputError&) {  // no model there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

std::optional<SurfacePlace> CurveFollower::next(const Place& here, const CurveStep& step) const {
  if (step.wall) return place_at_wall(here, step);
  try {
    if (const auto found = corrected(here, step.length, step.length)) return place(*found, &here);
  } catch (const InputError&) {  // no model there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

/// An NS curve ends where its two multipliers become real, at 1 or -1: the resonances 1:1 and 1:2.
bool CurveFollower::pass(const Place& before, Place& now, double length, Curve& curve) const {
  const auto complex = [](const Place& here) { return 2.0 - std::abs(sum_of_pair(here.watched)); };
  if (point_.type != SpecialType::NS || complex(now) >= 0.0) return CurveWalk::pass(before, now, length, curve);
  if (auto end = located(before, now, length, complex)) now = std::move(*end);
  const Meeting met{.kind = Meeting::Kind::end_of_torus, .order = sum_of_pair(now.watched) < 0.0 ? 2 : 1};
  add_event(curve, {{met}, now.orbit.values, curve.points.size()}, ranges());
  curve.up = {.kind = CurveEnd::Kind::end_of_torus, .values = now.orbit.values, .near = met};
  return true;
}

Curve CurveFollower::run(Orbit orbit, double sign) {
  Place here = start(std::move(orbit));
  if (here.along[problem_.parameter_column(here.orbit.legs(), 1)] * sign < 0.0) here.along = -here.along;
  return walk(point_.solution.orbit.shape, problem_.family().names, std::move(here), 0.25 * options_.longest_step);
}

}  // namespace

Curve locus(const Problem& problem, const SpecialPoint& point, const CurveOptions& options) {
  if (problem.parameters() != 2) throw InputError("curve: a family of two parameters is needed");
  if (point.death && (point.occurrence == Occurrence::death || point.passage == Passage::family))
    return joined(death_curve(problem, point, options, -1.0), death_curve(problem, point, options, 1.0), &Curve::met);
  if (point.type == SpecialType::BP)
    return joined(crossing_curve(problem, point, options, -1.0), crossing_curve(problem, point, options, 1.0),
                  &Curve::met);
  CurveFollower follower(problem, point, options);
  Orbit start = point.solution.orbit;
  Curve down = follower.run(start, -1.0);
  return joined(std::move(down), follower.run(start, 1.0), &Curve::met);
}

}  // namespace slapstick::orbit
