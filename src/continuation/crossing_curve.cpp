/// Branch points followed in two parameters, located anew in each step.
#include "continuation/crossing_curve.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "continuation/crossing.hpp"
#include "continuation/curve_walk.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Vector2d;

/// The same family with its two parameters in the other order.
Family swapped(const Family& family) {
  return {{family.names[1], family.names[0]},
          [family](const std::vector<double>& v) {
            return family.model({v[1], v[0]});
          },
          [family](const std::vector<double>& v, std::size_t which) {
            return family.rate({v[1], v[0]}, 1 - which);
          }};
}

struct CrossingPlace {
  Orbit orbit;
  Vector2d along;               ///< in units of both ranges
  std::optional<Orbit> before;  ///< none at the first place
  Watched watched = {};         ///< nothing
};

class CrossingCurve : public CurveWalk<CrossingPlace> {
 public:
  CrossingCurve(const Problem& problem, const CurveOptions& options, const Orbit& start)
      : CurveWalk(options),
        problem_(problem),
        swapped_(swapped(problem.family()), {start.values[1], start.values[0]}),
        ranges_(ranges()[0], ranges()[1]) {}

  Curve run(Orbit here, double sign) {
    const Itinerary shape = here.shape;
    return walk(shape, problem_.family().names, {std::move(here), Vector2d(0.0, sign), {}}, options_.longest_step);
  }

 private:
  using Place = CrossingPlace;

  [[nodiscard]] const std::vector<double>& values(const Place& here) const override { return here.orbit.values; }
  [[nodiscard]] std::array<double, 2> rates(const Place& here) const override { return {here.along[0], here.along[1]}; }
  [[nodiscard]] std::optional<Place> next(const Place& here, const CurveStep& step) const override;
  /// The first tangent is a guess.
  [[nodiscard]] bool goes_on(const Place& here, const Place& ahead) const override {
    return !here.before || straight(way(here.orbit, ahead.orbit).dot(here.along));
  }
  [[nodiscard]] CurvePoint point(const Place& here) const override {
    const System system(problem_.family().model(here.orbit.values));
    return {here.orbit.values, describe(problem_, here.orbit, &system)};
  }
  [[nodiscard]] CurvePlace watched(const Place& here) const override { return {here.watched, rates(here)}; }
  bool pass(const Place& before, Place& now, double length, Curve& curve) const override;

  /// From one orbit to another, in units of both ranges.
  [[nodiscard]] Vector2d chord(const Orbit& from, const Orbit& to) const {
    return {(to.values[0] - from.values[0]) / ranges_[0], (to.values[1] - from.values[1]) / ranges_[1]};
  }
  [[nodiscard]] Vector2d way(const Orbit& from, const Orbit& to) const { return chord(from, to).normalized(); }
  /// The tangent at the last of three orbits, of the circle through them. A secant's angle to the curve would not fall
  /// with the step.
  [[nodiscard]] Vector2d tangent(const Orbit& before, const Orbit& here, const Orbit& next) const {
    const Vector2d a = chord(before, here), b = chord(here, next);
    const double turned = std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b)) * b.norm() / (a.norm() + b.norm());
    const double c = std::cos(turned), s = std::sin(turned);
    return Vector2d(c * b[0] - s * b[1], s * b[0] + c * b[1]).normalized();
  }
  [[nodiscard]] std::optional<Orbit> located_at(Orbit here, std::vector<double> values, bool hold_second) const;

  const Problem& problem_;
  Problem swapped_;
  Vector2d ranges_;
};

/// The crossing near some values, at the second of them or at the first, from the crossing `here`.
std::optional<Orbit> CrossingCurve::located_at(Orbit here, std::vector<double> values, bool hold_second) const {
  if (!hold_second) {
    std::swap(here.values[0], here.values[1]);
    std::swap(values[0], values[1]);
  }
  try {
    const auto found = crossing_near(hold_second ? problem_ : swapped_, here, values, ranges_[hold_second ? 0 : 1]);
    if (!found) return std::nullopt;
    Orbit orbit = found->point.orbit;
    orbit.values[1] = values[1];  // held up to the rounding of an interpolation
    if (!hold_second) std::swap(orbit.parameter(), orbit.values[1]);
    return orbit;
  } catch (const InputError&) {  // no model there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

/// A step to the end of a range holds that parameter, any other the one that changes most.
std::optional<CrossingPlace> CrossingCurve::next(const Place& here, const CurveStep& step) const {
  std::vector<double> to = here.orbit.values;
  for (Eigen::Index j = 0; j < 2; ++j) to[static_cast<std::size_t>(j)] += step.length * here.along[j] * ranges_[j];
  if (step.wall) to[*step.wall] = step.value;
  const bool hold_second = step.wall ? *step.wall == 1 : std::abs(here.along[1]) >= std::abs(here.along[0]);
  std::optional<Place> first;
  for (const bool second : {hold_second, !hold_second}) {  // near a turn two crossings lie in one search
    const auto found = located_at(here.orbit, to, second);
    if (!found) continue;
    const Vector2d along = here.before ? tangent(*here.before, here.orbit, *found) : way(here.orbit, *found);
    Place ahead{*found, along, here.orbit};
    if (goes_on(here, ahead)) return ahead;
    if (!first) first = std::move(ahead);
    if (step.wall || !here.before) break;
  }
  return first;
}

/// Where a parameter has come to its end between three points: the vertex of the parabola through them, over the other
/// parameter.
bool CrossingCurve::pass(const Place& from, Place& to, double /*length*/, Curve& curve) const {
  if (!from.before) return false;
  const Orbit &before = *from.before, &here = from.orbit, &next = to.orbit;
  for (std::size_t j = 0; j < 2; ++j) {
    const std::size_t i = 1 - j;
    const double a = here.values[j] - before.values[j], b = next.values[j] - here.values[j];
    if (!(a * b < 0.0)) continue;
    const double s = here.values[i] - before.values[i], t = next.values[i] - here.values[i];
    const double bend = (b / t - a / s) / (s + t), slope = a / s + bend * s;  // at `here`
    const double place = -0.5 * slope / bend;
    if (!((place + s) * (place - t) <= 0.0)) continue;
    std::vector<double> values = here.values;
    values[i] += place;
    values[j] += slope * place + bend * place * place;
    if (const auto there = located_at(here, values, i == 1)) values = there->values;
    add_event(curve, {{{.kind = Meeting::Kind::turn, .parameter = j}}, values, curve.points.size() - 1}, ranges());
  }
  return false;
}

}  // namespace

Curve crossing_curve(const Problem& problem, const SpecialPoint& point, const CurveOptions& options, double sign) {
  return CrossingCurve(problem, options, point.solution.orbit).run(point.solution.orbit, sign);
}

}  // namespace slapstick::orbit
