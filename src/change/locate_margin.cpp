/// The place of a change of events, also where a leg has shrunk to nothing.
#include "change/locate_margin.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "orbit/interpolate.hpp"
#include "orbit/short_legs.hpp"

namespace slapstick::orbit {
namespace {

/// Has a leg between two zeros of one guard shrunk to nothing? Without length it solves its equation anywhere.
bool loses_a_leg(const PathPoint& from, const Orbit& orbit) {
  const std::vector<bool> dead = dead_legs(from.orbit, orbit);
  return ranges::any_of(from.watched.tests, [&](const TestValue& test) {
    return test.test == Test::duration && test.starts_at_end && dead[test.leg];
  });
}

/// By interpolation over the best of some widths, until two agree.
std::optional<Located> in_some_width(const Problem& problem, const PathPoint& from, double near, double widest,
                                     double range, const std::function<double(const PathPoint&)>& f) {
  constexpr double agreement = 1e-12;
  std::optional<Located> best;
  double alike = INFINITY;
  for (const double part : {0.5, 0.25, 0.1, 0.02}) {
    auto other = locate_between(problem, from, near, part * widest, range, f);
    if (!other) continue;
    if (best) alike = std::min(alike, std::abs(other->point.orbit.parameter() - best->point.orbit.parameter()));
    if (!best || other->error < best->error) best = std::move(other);
    if (best->error <= agreement * range && alike <= agreement * range) break;
  }
  if (best && std::isfinite(alike)) best->error = std::max(best->error, alike);
  return best;
}

}  // namespace

/// Where a leg shrinks to nothing between two zeros of one guard, the equations are singular: there by interpolation.
std::optional<Located> locate_margin(const Problem& problem, const PathPoint& from, const PathPoint& to, double length,
                                     double range, std::size_t test) {
  constexpr double well_known = 1e-10;
  const auto value = [test](const Watched& watched) { return watched.tests[test].value; };
  std::optional<Located> located = locate(problem, from, length, range, value, value(to.watched));
  const bool regular = located && std::abs(value(located->point.watched)) <= 1e-9 * value(from.watched) &&
                       located->error <= well_known * range;
  const bool empty = located && loses_a_leg(from, located->point.orbit);
  if (regular && !empty) return located;
  const double before = value(from.watched), behind = value(to.watched);
  const double near = located ? located->length : length * before / (before - behind);
  std::optional<Located> best = in_some_width(problem, from, near, std::min(length, 0.02), range,
                                              [&](const PathPoint& point) { return value(point.watched); });
  if (empty) return best;
  return best && !(located && located->error < best->error) ? best : located;
}

}  // namespace slapstick::orbit
