/// Looks for special points that a step can hide.
#include "continuation/hidden.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ranges.hpp"
#include "continuation/special.hpp"
#include "orbit/short_legs.hpp"

namespace slapstick::orbit {
namespace {

int outside(const Watched& watched) {
  constexpr double off_circle = 1e-7;  // of the circle: what lies on it all along is nothing that passes
  return static_cast<int>(
      ranges::count_if(watched.multipliers, [](const auto& mu) { return std::abs(mu) > 1.0 + off_circle; }));
}

}  // namespace

bool explained(const Watched& from, const Watched& to, const std::vector<SpecialPoint>& between) {
  int most = 0;
  for (const SpecialPoint& special : between) most += special.type == SpecialType::NS ? 2 : 1;
  return std::abs(outside(to) - outside(from)) <= most;
}

Pair pair_within(const Problem& problem, const Triple& triple, double range) {
  constexpr double near_zero = 0.5;  // what the parabola comes to, of the least of the three
  constexpr std::array<double Watched::*, 3> functions = {&Watched::flip, &Watched::torus, &Watched::turn};
  const auto& [first, second, third, back, ahead] = triple;
  Pair pair;
  for (const auto f : functions) {
    const double a = first.watched.*f, b = second.watched.*f, c = third.watched.*f;
    if (!(a * b > 0.0 && b * c > 0.0)) continue;
    const double left = (b - a) / back, right = (c - b) / ahead, bend = 2.0 * (right - left) / (back + ahead);
    const double slope = (left * ahead + right * back) / (back + ahead), vertex = -slope / bend;
    if (!(vertex > -back && vertex < ahead) || vertex == 0.0) continue;
    const double least = std::min({std::abs(a), std::abs(b), std::abs(c)});
    if (!(std::copysign(1.0, b) * (b + 0.5 * slope * vertex) < near_zero * least)) continue;
    pair.earlier = vertex < 0.0;
    const PathPoint& from = pair.earlier ? first : second;
    const PathPoint& to = pair.earlier ? second : third;
    const double part = pair.earlier ? back + vertex : vertex;
    const std::optional<PathPoint> middle = step_to(problem, from, part, range);
    if (!middle || !(middle->watched.*f * b < 0.0)) continue;
    pair.points = smooth_special_points(problem, from, *middle, range);
    ranges::move(smooth_special_points(problem, *middle, to, range), std::back_inserter(pair.points));
    return pair;
  }
  return pair;
}

std::vector<SpecialPoint> within_halves(const Problem& problem, const PathPoint& from, const PathPoint& to,
                                        double length, double range) {
  const double half = 0.5 * length;
  const std::optional<PathPoint> middle = step_to(problem, from, half, range);
  if (!middle) return {};
  std::vector<SpecialPoint> points = smooth_special_points(problem, from, *middle, range);
  ranges::move(smooth_special_points(problem, *middle, to, range), std::back_inserter(points));
  return points.empty() ? pair_within(problem, {from, *middle, to, half, half}, range).points : points;
}

std::vector<SpecialPoint> beside_change(const Problem& problem, const PathPoint& from, double length, double range) {
  constexpr double left_of_a_leg = 1e-5;
  std::optional<PathPoint> last;
  double end = 0.0;
  for (const double part : {1.0 - 1e-6, 1.0 - 1e-4, 1.0 - 1e-2}) {
    last = step_to(problem, from, part * length, range);
    end = part * length;
    if (last && shrunk_legs(from.orbit, last->orbit, left_of_a_leg) == 0) break;
    last.reset();
  }
  std::vector<SpecialPoint> points;
  if (!last) return points;
  PathPoint at = from;
  const auto look_as_far_as = [&](const PathPoint& next) {
    ranges::move(smooth_special_points(problem, at, next, range), std::back_inserter(points));
    at = next;
  };
  for (const double part : {0.5, 0.9, 0.97, 0.99})  // two of one type may lie close before the change
    if (const auto next = step_to(problem, from, part * length, range); next && part * length < end)
      look_as_far_as(*next);
  look_as_far_as(*last);
  return points;
}

}  // namespace slapstick::orbit
