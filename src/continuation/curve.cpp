/// Follows a special point in two parameters.
#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/text.hpp"
#include "change/change_kind.hpp"
#include "continuation/crossing_curve.hpp"
#include "continuation/curve_events.hpp"
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

constexpr double shortest_step = 1e-7;
constexpr double rim = 1e-4;  ///< so near to the end of a range, as a part of it, a curve has come to it

/// Follows f = 0 on the surface of orbits over two parameters. Near a point the surface has two tangent directions; the
/// curve's is the one along which f does not change, the other is where Newton's correction of f goes.
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
    /// of the branch in the first parameter, never turned round along the curve: f may depend on its sense
    VectorXd tangent;
    Watched watched;
  };

  [[nodiscard]] Place place(Orbit orbit, const Place* before) const;
  [[nodiscard]] std::optional<Orbit> moved(const Place& from, double along, double across) const;
  [[nodiscard]] std::optional<double> f(const Place& from, double along, double across) const;
  [[nodiscard]] std::optional<Orbit> corrected(const Place& from, double step, double reach) const;
  [[nodiscard]] CurvePlace watched_at(const Place& here) const;
  [[nodiscard]] std::optional<Place> located(const Place& before, const Place& now, double step,
                                             const std::function<double(const Place&)>& value) const;
  void note(const Place& before, const Place& now, double step, Curve& curve) const;
  [[nodiscard]] bool inside(const std::vector<double>& values) const;
  /// The end of a range that the tangent meets first.
  struct Wall {
    Index parameter = 0;
    double value = 0.0;
    double step = 0.0;  ///< along the tangent
  };
  [[nodiscard]] Wall wall(const Place& here) const;
  [[nodiscard]] std::optional<Orbit> at_wall(const Place& from, const Wall& wall, double across, double* f) const;
  [[nodiscard]] std::optional<Place> place_at_wall(const Place& from, const Wall& wall) const;
  [[nodiscard]] std::optional<Place> end_of_torus(const Place& before, const Place& now, double step) const;
  [[nodiscard]] bool at_the_rim(const Place& here) const;
  bool end(const Place& here, const Place& next, double step, bool at_range, Curve& curve);
  [[nodiscard]] std::array<double, 2> ranges() const {
    return {options_.to - options_.from, options_.second_to - options_.second_from};
  }
  [[nodiscard]] CurvePoint point_of_curve(const Place& here) const;
  [[nodiscard]] Place start(Orbit orbit);
  [[nodiscard]] std::optional<Place> next_place(const Place& here, double step) const;
  [[nodiscard]] MatrixXd surface(const Linearised& at, const VectorXd& units) const;

  const Problem& problem_;
  const SpecialPoint& point_;
  const CurveOptions& options_;
  std::vector<bool> own_;
  std::vector<CurveTest> tests_;
};

bool CurveFollower::inside(const std::vector<double>& values) const {
  return values[0] >= options_.from && values[0] <= options_.to && values[1] >= options_.second_from &&
         values[1] <= options_.second_to;
}

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
CurveFollower::Place CurveFollower::start(Orbit orbit) {
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
CurvePoint CurveFollower::point_of_curve(const Place& here) const {
  CurvePoint point{here.orbit.values, describe(problem_, here.orbit, nullptr)};
  point.solution.is_motion = true;
  for (std::size_t i = 0; i < here.watched.tests.size() && point.solution.is_motion; ++i) {
    if (own_[i] || here.watched.tests[i].value >= 0.0) continue;
    point.solution.is_motion = false;
    point.solution.why = describe(used(here.watched.tests[i]), here.orbit.shape, problem_.base());
  }
  return point;
}

CurvePlace CurveFollower::watched_at(const Place& here) const {
  const std::size_t legs = here.orbit.legs();
  return {here.watched,
          {here.along[problem_.parameter_column(legs, 0)], here.along[problem_.parameter_column(legs, 1)]}};
}

/// The zero of a function between two places, at which its signs differ.
std::optional<CurveFollower::Place> CurveFollower::located(const Place& before, const Place& now, double step,
                                                           const std::function<double(const Place&)>& value) const {
  constexpr double place_tolerance_of_step = 1e-7;  // of the step: the tangents, by differences, are known no better
  double a = 0.0, b = step, f_a = value(before), f_b = value(now);
  std::optional<Place> best;
  for (int k = 0; k < 30 && b - a > place_tolerance_of_step * step; ++k) {
    double s = (a * f_b - b * f_a) / (f_b - f_a);
    if (!(s > a && s < b) || k % 3 == 2) s = 0.5 * (a + b);
    std::optional<Place> there = next_place(before, s);
    if (!there) break;
    const double f_s = value(*there), moved = std::min(s - a, b - s);
    const bool left = (f_s < 0.0) == (f_a < 0.0);
    (left ? a : b) = s;
    (left ? f_a : f_b) = f_s;
    best = std::move(there);
    if (f_s == 0.0 || moved <= place_tolerance_of_step * step) break;
  }
  return best;
}

/// Points of codimension two between two places.
void CurveFollower::note(const Place& before, const Place& now, double step, Curve& curve) const {
  for (const CurveTest& test : tests_) {
    const auto value = [&](const Place& here) { return test.value(watched_at(here)); };
    const double from = value(before), to = value(now);
    if (!(std::abs(from) >= test.noise && std::abs(to) >= test.noise)) continue;  // no sign, or no value
    if ((from < 0.0) == (to < 0.0) || (test.falls && !(from > 0.0 && to < 0.0))) continue;
    const std::optional<Place> there = located(before, now, step, value);
    const Place& at = there ? *there : now;
    if (test.holds && !test.holds(at.watched)) continue;
    add_event(curve, {{test.met}, at.orbit.values, curve.points.size() - 1}, ranges());
  }
}

CurveFollower::Wall CurveFollower::wall(const Place& here) const {
  const std::array<double, 2> least = {options_.from, options_.second_from}, most = {options_.to, options_.second_to};
  Wall first{.step = INFINITY};
  for (Index j = 0; j < 2; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const Index column = problem_.parameter_column(here.orbit.legs(), j);
    const double value = here.along[column] > 0.0 ? most[i] : least[i];
    const double step = (value - here.orbit.values[i]) / (here.along[column] * here.units[column]);
    if (step < first.step) first = {j, value, std::max(step, 0.0)};
  }
  return first;
}

/// The orbit of the surface that has the wall's value, at a distance across the curve.
std::optional<Orbit> CurveFollower::at_wall(const Place& from, const Wall& wall, double across, double* f) const {
  Orbit orbit = from.orbit;
  const ModeSet set(problem_.family(), orbit.values);
  move(problem_, linearise(problem_, set, orbit),
       (wall.step * from.along + across * from.across).cwiseProduct(from.units), 0.0, orbit);
  orbit.values[static_cast<std::size_t>(wall.parameter)] = wall.value;
  const std::vector<Condition> conditions = {
      {fixed_parameters(problem_, orbit.legs())[static_cast<std::size_t>(wall.parameter)]},
      {from.across.cwiseQuotient(from.units).transpose()}};
  if (!solve(problem_, orbit, conditions, 10).converged) return std::nullopt;
  *f = defining(point_, point_of(problem_, orbit, options_.to - options_.from, from.tangent).watched);
  return orbit;
}

/// Where the curve meets the end of a range. The model may not exist beyond, so that the tangent there is extrapolated.
std::optional<CurveFollower::Place> CurveFollower::place_at_wall(const Place& from, const Wall& wall) const {
  try {
    double a = 0.0, b = 1e-3 * wall.step, f_a = 0.0, f_b = 0.0;
    std::optional<Orbit> orbit = at_wall(from, wall, a, &f_a), next = at_wall(from, wall, b, &f_b);
    for (int k = 0; k < 25 && orbit && next; ++k) {
      if (f_a == f_b || std::abs(b - a) < 1e-13) break;
      const double s = b - f_b * (b - a) / (f_b - f_a);
      if (!(std::abs(s) <= wall.step)) return std::nullopt;
      a = b;
      f_a = f_b;
      b = s;
      orbit = std::move(next);
      next = at_wall(from, wall, b, &f_b);
    }
    if (!next || !inside(next->values)) return std::nullopt;
    Place last = from;
    last.watched = point_of(problem_, *next, options_.to - options_.from, from.tangent).watched;
    for (Index j = 0; j < 2; ++j) {  // of the parabola that has the first tangent and both points
      const Index column = problem_.parameter_column(next->legs(), j);
      const auto i = static_cast<std::size_t>(j);
      const double chord = (next->values[i] - from.orbit.values[i]) / (wall.step * from.units[column]);
      last.along[column] = 2.0 * chord - from.along[column];
    }
    last.orbit = std::move(*next);
    return last;
  } catch (const InputError&) {  // no model there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

/// An NS curve ends where its two multipliers become real, at 1 or -1: the resonances 1:1 and 1:2.
std::optional<CurveFollower::Place> CurveFollower::end_of_torus(const Place& before, const Place& now,
                                                                double step) const {
  const auto complex = [](const Place& here) { return 2.0 - std::abs(sum_of_pair(here.watched)); };
  if (point_.type != SpecialType::NS || complex(now) >= 0.0) return std::nullopt;
  std::optional<Place> end = located(before, now, step, complex);
  return end ? end : now;
}

bool CurveFollower::at_the_rim(const Place& here) const {
  return wall(here).step * std::abs(here.along[problem_.parameter_column(here.orbit.legs(), wall(here).parameter)]) <
         rim;
}

std::optional<CurveFollower::Place> CurveFollower::next_place(const Place& here, double step) const {
  try {
    if (const auto found = corrected(here, step, step)) return place(*found, &here);
  } catch (const InputError&) {  // no model there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

/// @returns true if the curve has come to its end: the range's, or a torus's
bool CurveFollower::end(const Place& here, const Place& next, double step, bool at_range, Curve& curve) {
  const std::optional<Place> torus = end_of_torus(here, next, step);
  const Place& last = torus ? *torus : next;
  if (!torus) note(here, next, step, curve);
  curve.points.push_back(point_of_curve(last));
  if (torus) {
    const Meeting met{.kind = Meeting::Kind::end_of_torus, .order = sum_of_pair(torus->watched) < 0.0 ? 2 : 1};
    add_event(curve, {{met}, torus->orbit.values, curve.points.size() - 1}, ranges());
    curve.up = {.kind = CurveEnd::Kind::end_of_torus, .values = torus->orbit.values, .near = met};
  }
  return torus || at_range;
}

Curve CurveFollower::run(Orbit orbit, double sign) {
  Curve curve;
  curve.parameters = problem_.family().names;
  curve.shape = point_.solution.orbit.shape;
  curve.up.kind = CurveEnd::Kind::most_points;
  Place here = start(std::move(orbit));
  if (here.along[problem_.parameter_column(here.orbit.legs(), 1)] * sign < 0.0) here.along = -here.along;
  Watched before = here.watched;
  double step = 0.25 * options_.longest_step;
  curve.points.push_back(point_of_curve(here));
  while (static_cast<int>(curve.points.size()) < options_.most_points && !stopped(options_.stop)) {
    const Wall ahead = wall(here);
    const bool last = ahead.step <= step;
    std::optional<Place> next = last ? place_at_wall(here, ahead) : next_place(here, step);
    if (next && (here.along.dot(next->along) < 0.9 || !inside(next->orbit.values))) next.reset();
    if (!next) {
      step = 0.5 * std::min(step, ahead.step);
      if (step > shortest_step && !(last && at_the_rim(here))) continue;
      curve.up.kind = CurveEnd::Kind::range;
      if (at_the_rim(here)) return curve;
      curve.up = {.kind = CurveEnd::Kind::no_step, .failed = true, .values = here.orbit.values};
      find_cause(point_, before, here.watched, own_, curve.up);
      return curve;
    }
    if (last) curve.up.kind = CurveEnd::Kind::range;
    if (end(here, *next, last ? ahead.step : step, last, curve)) return curve;
    before = std::move(here.watched);
    here = std::move(*next);
    step = std::min(options_.longest_step, 1.4 * step);
    if (options_.progress) options_.progress(static_cast<long>(curve.points.size()));
  }
  if (stopped(options_.stop)) curve.up.kind = CurveEnd::Kind::stopped;
  return curve;
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
