/// Where a motion dies out: the place, by extrapolation of the lengths of the legs that shrink.
#include "change/dying.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/ranges.hpp"
#include "orbit/record.hpp"

namespace slapstick::orbit {
namespace {

using Orbits = std::vector<const Orbit*>;  // along a branch

/// Points of a branch at which one leg is ever longer, the nearest first, and what they say.
struct Shrinking {
  std::vector<double> length, value;
  double first = 0.0;              ///< the leg's greatest length on the way ..
  const Orbit* longest = nullptr;  ///< .. and the orbit that has it
  const Orbit* near = nullptr;     ///< the nearest in which the leg has a part of that length

  [[nodiscard]] double shrunk() const { return length.front() / first; }
  [[nodiscard]] double seen() const { return std::abs(value.front() - value.back()); }
  [[nodiscard]] Death death(std::size_t leg) const {
    const double all = at_zero(length, value),
                 without_first = at_zero({length.begin() + 1, length.end()}, {value.begin() + 1, value.end()}),
                 without_last = at_zero({length.begin(), length.end() - 1}, {value.begin(), value.end() - 1});
    return {all, std::max(std::abs(without_first - all), std::abs(without_last - all)), leg, *longest, *near};
  }
};

Shrinking shrinking(const Orbits& orbits, std::size_t leg) {
  constexpr std::size_t most = 8;
  constexpr double part = 0.01;  // seven lengths from there on, to 7.5 times as long, leave 0.075^7 of what is extrapolated
  Shrinking found;
  for (std::size_t i = orbits.size(); i-- > 0;) {
    const Orbit& orbit = *orbits[i];
    if (!(orbit.shape.legs == orbits.back()->shape.legs)) break;
    if (orbit.duration(leg) > found.first) {
      found.first = orbit.duration(leg);
      found.longest = &orbit;
    }
    if (found.length.size() == most || (!found.length.empty() && orbit.duration(leg) < 1.2 * found.length.back()))
      continue;
    found.length.push_back(orbit.duration(leg));
    found.value.push_back(orbit.values[0]);
  }
  for (std::size_t i = orbits.size(); i-- > 0;) {
    found.near = orbits[i];
    if (found.near == found.longest || found.near->duration(leg) >= part * found.first) break;
  }
  return found;
}

Orbits orbits_of(const std::vector<Solution>& points) {
  Orbits orbits;
  for (const Solution& point : points) orbits.push_back(&point.orbit);
  return orbits;
}

std::optional<Death> dies_out(const Orbits& orbits) {
  constexpr std::size_t fewest = 5;
  constexpr double all_but_gone = 0.1, resolved = 1e-7, near = 0.5, well_known = 1e-3;
  const Orbit& last = *orbits.back();
  const double cycle = last.t.back() - last.t.front();
  std::vector<Death> deaths;
  for (std::size_t leg = 0; leg < last.legs(); ++leg) {
    if (!(last.duration(leg) > resolved * cycle)) continue;
    const Shrinking all = shrinking(orbits, leg);
    if (all.length.size() < fewest || !(all.shrunk() < all_but_gone)) continue;
    const Death death = all.death(leg);
    const bool is_near = std::abs(death.value - all.value.front()) < near * all.seen();
    if (is_near && death.error < well_known * all.seen()) deaths.push_back(death);
  }
  if (deaths.empty()) return std::nullopt;
  Death best = *ranges::min_element(deaths, {}, &Death::error);
  for (const Death& other : deaths)  // what another leg's own error does not explain
    best.error = std::max(best.error, std::abs(other.value - best.value) - other.error);
  return best;
}

}  // namespace

double at_zero(const std::vector<double>& x, std::vector<double> y) {
  for (std::size_t order = 1; order < x.size(); ++order)
    for (std::size_t i = 0; i + order < x.size(); ++i)
      y[i] = (x[i + order] * y[i] - x[i] * y[i + 1]) / (x[i + order] - x[i]);
  return y[0];
}

double growth(const Problem& problem, const PathPoint& at, const Eigen::VectorXd& direction, std::size_t leg) {
  const Eigen::Index begin = problem.instant_column(leg), end = problem.instant_column(leg + 1);
  return direction[end] * at.units[end] - direction[begin] * at.units[begin];
}

std::size_t dying_leg(const Problem& problem, const PathPoint& at) {
  constexpr double alike =
      10.0;  // a leg that goes like the fourth power of another seems to be gone after a quarter of the way
  std::vector<double> left;  // to where a leg would be gone, if it went on as there
  for (std::size_t i = 0; i < at.orbit.legs(); ++i)
    left.push_back(in_burst(at.orbit, i) ? INFINITY
                                         : at.orbit.duration(i) / std::abs(growth(problem, at, at.tangent, i)));
  const double least = *ranges::min_element(left);
  std::size_t leg = 0;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (left[i] < alike * least && (left[leg] >= alike * least || left[i] > left[leg])) leg = i;
  return leg;
}

std::vector<PathPoint> away_from_death(const Problem& problem, const PathPoint& near, double range, std::size_t most) {
  constexpr double longer = 1.4;  // from point to point
  const std::size_t leg = dying_leg(problem, near);
  std::vector<PathPoint> points = {near};
  while (points.size() < most) {
    const PathPoint& last = points.back();
    auto next = step_to(problem, last,
                        (longer - 1.0) * last.orbit.duration(leg) / growth(problem, last, last.tangent, leg), range);
    if (!next || !(next->orbit.duration(leg) > last.orbit.duration(leg))) break;
    points.push_back(std::move(*next));
  }
  return points;
}

std::optional<Death> dies_out(const std::vector<Solution>& points) { return dies_out(orbits_of(points)); }

std::optional<Death> dies_out(const Problem& problem, const std::vector<Solution>& points, const PathPoint& last, double range) {
  if (auto death = dies_out(points)) return death;
  constexpr std::size_t enough = 14;  // for the leg to have been ten times as long
  const std::vector<PathPoint> away = away_from_death(problem, last, range, enough);
  Orbits orbits;
  for (const PathPoint& point : away) orbits.push_back(&point.orbit);
  ranges::reverse(orbits);
  return dies_out(orbits);
}

void sharpen_death(const Problem& problem, const std::vector<Solution>& points, const PathPoint& from, double range, Change& change) {
  if (legs_gone(from.orbit, change.at.orbit) < 2) return;
  constexpr int nearer = 12;
  constexpr double closer = 1.3;  // in each step
  std::vector<PathPoint> beside;
  const double length = arclength(problem, from, change.at.orbit);
  for (int k = 1; k <= nearer; ++k)
    if (auto next = step_to(problem, from, (1.0 - std::pow(closer, -k)) * length, range))
      beside.push_back(std::move(*next));
  Orbits orbits = orbits_of(points);
  while (orbits.size() > 1 && orbits.back()->values != from.orbit.values) orbits.pop_back();
  for (const PathPoint& next : beside) orbits.push_back(&next.orbit);
  const std::optional<Death> death = dies_out(orbits);
  if (!death || beside.empty()) return;
  if (death->error < change.special.error) {
    change.special.value = death->value;
    change.special.error = death->error;
  }
  change.nearby = describe(problem, death->near, nullptr);
}

}  // namespace slapstick::orbit
