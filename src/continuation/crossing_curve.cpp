/// Branch points followed in two parameters, located anew in each step.
#include "continuation/crossing_curve.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "continuation/crossing.hpp"
#include "continuation/curve_events.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Vector2d;

constexpr double straight = 0.8;        ///< least cosine between neighbouring steps
constexpr double shortest_step = 1e-5;  ///< in units of both ranges

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

class CrossingCurve {
 public:
  CrossingCurve(const Problem& problem, const CurveOptions& options, const Orbit& start)
      : problem_(problem),
        swapped_(swapped(problem.family()), {start.values[1], start.values[0]}),
        options_(options),
        ranges_(options.to - options.from, options.second_to - options.second_from) {}

  Curve run(Orbit here, double sign);

 private:
  [[nodiscard]] bool inside(const std::vector<double>& values) const {
    return values[0] >= options_.from && values[0] <= options_.to && values[1] >= options_.second_from &&
           values[1] <= options_.second_to;
  }
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
  struct Step {
    std::vector<double> values;  ///< that it leads to
    double length = 0.0;
    bool hold_second = false;  ///< the parameter that is kept
    bool last = false;         ///< the step ends on the end of a range
  };
  [[nodiscard]] Step step_from(const Orbit& here, const Vector2d& along, double length) const;
  [[nodiscard]] std::optional<Orbit> located(Orbit here, std::vector<double> values, bool hold_second) const;
  void note_turns(const Orbit& before, const Orbit& here, const Orbit& next, Curve& curve) const;
  void add(const Orbit& orbit, Curve& curve) const;

  const Problem& problem_;
  Problem swapped_;
  const CurveOptions& options_;
  Vector2d ranges_;
};

/// The crossing near some values, at the second of them or at the first, from the crossing `here`.
std::optional<Orbit> CrossingCurve::located(Orbit here, std::vector<double> values, bool hold_second) const {
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

/// Where a parameter has come to its end between three points: the vertex of the parabola through them, over the other
/// parameter.
void CrossingCurve::note_turns(const Orbit& before, const Orbit& here, const Orbit& next, Curve& curve) const {
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
    if (const auto there = located(here, values, i == 1)) values = there->values;
    add_event(curve, {{{.kind = Meeting::Kind::turn, .parameter = j}}, values, curve.points.size() - 1},
              {ranges_[0], ranges_[1]});
  }
}

void CrossingCurve::add(const Orbit& orbit, Curve& curve) const {
  const System system(problem_.family().model(orbit.values));
  curve.points.push_back({orbit.values, describe(problem_, orbit, &system)});
  if (options_.progress) options_.progress(static_cast<long>(curve.points.size()));
}

/// How a step along a direction goes: to the end of a range that it would pass, which is then held.
CrossingCurve::Step CrossingCurve::step_from(const Orbit& here, const Vector2d& along, double length) const {
  const std::array<double, 2> least = {options_.from, options_.second_from}, most = {options_.to, options_.second_to};
  Step step{here.values, length, std::abs(along[1]) >= std::abs(along[0]), false};
  std::optional<std::size_t> wall;
  for (std::size_t j = 0; j < 2; ++j) {
    const double rate = along[static_cast<Eigen::Index>(j)] * ranges_[static_cast<Eigen::Index>(j)];
    const double to_end = rate != 0.0 ? ((rate > 0.0 ? most[j] : least[j]) - here.values[j]) / rate : INFINITY;
    if (to_end > step.length) continue;
    step.length = std::max(to_end, 0.0);
    wall = j;
  }
  for (std::size_t j = 0; j < 2; ++j)
    step.values[j] += step.length * along[static_cast<Eigen::Index>(j)] * ranges_[static_cast<Eigen::Index>(j)];
  if (!wall) return step;
  step.values[*wall] = along[static_cast<Eigen::Index>(*wall)] > 0.0 ? most[*wall] : least[*wall];
  step.hold_second = *wall == 1;
  step.last = true;
  return step;
}

Curve CrossingCurve::run(Orbit here, double sign) {
  Curve curve;
  curve.parameters = problem_.family().names;
  curve.shape = here.shape;
  curve.up.kind = CurveEnd::Kind::most_points;
  Vector2d along(0.0, sign);
  double length = options_.longest_step;
  std::optional<Orbit> before;
  add(here, curve);
  while (static_cast<int>(curve.points.size()) < options_.most_points && !stopped(options_.stop)) {
    const Step step = step_from(here, along, length);
    if (step.last && step.length < shortest_step) {  // the curve is at the end of a range
      curve.up.kind = CurveEnd::Kind::range;
      return curve;
    }
    const auto goes_on = [&](const std::optional<Orbit>& to) {
      return to && inside(to->values) && (curve.points.size() == 1 || way(here, *to).dot(along) >= straight);
    };
    std::optional<Orbit> next = located(here, step.values, step.hold_second);
    if (!goes_on(next) && !step.last && before) {  // near a turn of the held parameter two crossings lie in one search
      std::optional<Orbit> other = located(here, step.values, !step.hold_second);
      if (goes_on(other)) next = std::move(other);
    }
    if (!goes_on(next)) {
      length = 0.5 * std::min(length, step.length);
      if (length > shortest_step) continue;
      if (!next || inside(next->values))
        curve.up = {.kind = CurveEnd::Kind::no_step, .failed = true, .values = here.values};
      else
        curve.up.kind = CurveEnd::Kind::range;
      return curve;
    }
    along = before ? tangent(*before, here, *next) : way(here, *next);
    if (before) note_turns(*before, here, *next, curve);
    before = std::exchange(here, std::move(*next));
    add(here, curve);
    if (step.last) {
      curve.up.kind = CurveEnd::Kind::range;
      return curve;
    }
    length = std::min(options_.longest_step, 1.4 * length);
  }
  if (stopped(options_.stop)) curve.up.kind = CurveEnd::Kind::stopped;
  return curve;
}

}  // namespace

Curve crossing_curve(const Problem& problem, const SpecialPoint& point, const CurveOptions& options, double sign) {
  return CrossingCurve(problem, options, point.solution.orbit).run(point.solution.orbit, sign);
}

}  // namespace slapstick::orbit
