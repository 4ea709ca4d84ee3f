#include "orbit/crossing_curve.hpp"

#include <cmath>

#include "orbit/crossing.hpp"
#include "slapstick/base/text.hpp"

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
  [[nodiscard]] std::optional<Orbit> located(Orbit guess, bool hold_second) const;
  void add(const Orbit& orbit, Curve& curve) const;

  const Problem& problem_;
  Problem swapped_;
  const CurveOptions& options_;
  Vector2d ranges_;
};

/// The crossing near a guess, at its second parameter or at its first.
std::optional<Orbit> CrossingCurve::located(Orbit guess, bool hold_second) const {
  if (!hold_second) std::swap(guess.values[0], guess.values[1]);
  const auto found = crossing_near(hold_second ? problem_ : swapped_, guess, ranges_[hold_second ? 0 : 1]);
  if (!found) return std::nullopt;
  Orbit orbit = found->point.orbit;
  if (!hold_second) std::swap(orbit.values[0], orbit.values[1]);
  return orbit;
}

void CrossingCurve::add(const Orbit& orbit, Curve& curve) const {
  const System system(problem_.family().model(orbit.values));
  curve.points.push_back({orbit.values, describe(problem_, orbit, &system)});
  if (options_.progress) options_.progress(static_cast<long>(curve.points.size()));
}

Curve CrossingCurve::run(Orbit here, double sign) {
  Curve curve;
  curve.ended = "points";
  Vector2d along(0.0, sign);
  double step = options_.longest_step;
  add(here, curve);
  while (static_cast<int>(curve.points.size()) < options_.most_points && !stopped(options_.stop)) {
    Orbit guess = here;
    for (int j = 0; j < 2; ++j) guess.values[static_cast<std::size_t>(j)] += step * along[j] * ranges_[j];
    std::optional<Orbit> next;
    const bool leaves = !inside(guess.values);
    if (!leaves) next = located(guess, std::abs(along[1]) >= std::abs(along[0]));
    const Vector2d moved = next ? Vector2d((next->values[0] - here.values[0]) / ranges_[0],
                                           (next->values[1] - here.values[1]) / ranges_[1])
                                : Vector2d(0.0, 0.0);
    if (!next || !inside(next->values) || (curve.points.size() > 1 && moved.normalized().dot(along) < straight)) {
      step *= 0.5;
      if (step > shortest_step) continue;
      curve.failed = !leaves && !next;
      curve.ended =
          curve.failed ? "no crossing behind " + shown(here.values[0]) + ", " + shown(here.values[1]) : "range";
      return curve;
    }
    along = moved.normalized();
    here = std::move(*next);
    add(here, curve);
    step = std::min(options_.longest_step, 1.4 * step);
  }
  return curve;
}

}  // namespace

Curve crossing_curve(const Problem& problem, const SpecialPoint& point, const CurveOptions& options, double sign) {
  return CrossingCurve(problem, options, point.solution.orbit).run(point.solution.orbit, sign);
}

}  // namespace slapstick::orbit
