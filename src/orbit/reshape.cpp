#include "orbit/reshape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "attractor/cycle.hpp"
#include "orbit/record.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr std::size_t most_held = 4;  ///< legs whose length is held in turn

/// A motion from inside a leg of an orbit that may itself be no motion any more.
std::optional<Motion> motion_from(const System& system, const ModeSet& set, const Orbit& orbit, std::size_t leg,
                                  double part) {
  const ModeRates& mode = set.mode(orbit.shape.legs[leg].states);
  Jet X = leg_start(set, orbit.shape.legs[leg], orbit.x[leg], orbit.t[leg]);
  flow(mode, part * orbit.duration(leg) * set.period(), X);
  for (const mode::Guard& guard : mode.outline.guards)
    if (guard.row.dot(X.value()) <= 0.0) return std::nullopt;
  const int n = system.frame().n;
  VectorXd x(2 * n);
  x << X.value().head(n), X.value().segment(system.frame().d, n);
  const double t = orbit.t[leg] + part * orbit.duration(leg), whole = std::floor(t);
  return Motion(system, attractor::user_state(system, x), {static_cast<std::int64_t>(whole), t - whole});
}

/// Do two cycles have the same legs, wherever they begin?
bool same_cycle(const Orbit& a, const Orbit& b) {
  if (a.legs() != b.legs()) return false;
  std::vector<Leg> turned = a.shape.legs;
  for (std::size_t k = 0; k < turned.size(); ++k) {
    if (turned == b.shape.legs) return true;
    std::ranges::rotate(turned, turned.begin() + 1);
  }
  return false;
}

/// The cycles that motions from inside an orbit's legs show, each shape once.
std::vector<Orbit> shapes_near(const Problem& problem, const Orbit& orbit) {
  std::vector<Orbit> shapes;
  const System system(problem.family().model(orbit.values));
  const ModeSet set(constant_family(system.model()), {});
  for (std::size_t leg = 0; leg < orbit.legs(); ++leg) {
    for (double part : {0.5, 0.1, 0.9}) {
      try {
        const std::optional<Motion> motion = motion_from(system, set, orbit, leg, part);
        if (!motion) continue;
        std::optional<Orbit> seen = record(*motion, orbit.shape.n);
        if (!seen) continue;
        const bool new_shape =
            std::ranges::none_of(shapes, [&](const Orbit& other) { return same_cycle(other, *seen); });
        if (!new_shape || same_cycle(orbit, *seen)) continue;
        seen->values = orbit.values;
        shapes.push_back(std::move(*seen));
      } catch (const InputError&) {  // behind a stop
      } catch (const NumericalError&) {
      }
    }
  }
  return shapes;
}

bool is_motion(const Problem& problem, const Orbit& orbit) {
  try {
    return verify(System(problem.family().model(orbit.values)), orbit).is_motion;
  } catch (const InputError&) {
    return false;
  }
}

/// Newton's method from a guess: at its own parameter, and with the parameter free and the length of one of the shortest legs held.
std::optional<Orbit> solved(const Problem& problem, const Orbit& guess) {
  if (auto orbit = refine(problem, guess); orbit && is_motion(problem, *orbit)) return orbit;
  std::vector<std::size_t> events(guess.legs());
  std::iota(events.begin(), events.end(), std::size_t{1});
  std::ranges::sort(events, {}, [&](std::size_t event) { return guess.duration(event - 1); });
  if (events.size() > most_held) events.resize(most_held);
  for (const std::size_t event : events) {
    Orbit orbit = guess;
    std::vector<Condition> conditions = fixed_parameters(problem, orbit.legs());
    conditions[0].row.setZero();
    conditions[0].row[problem.instant_column(event)] = 1.0;
    conditions[0].row[problem.instant_column(event - 1)] = -1.0;
    if (solve(problem, orbit, conditions, 20).converged && is_motion(problem, orbit)) return orbit;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Reshaped> reshape(const Problem& problem, const PathPoint& change, double range) {
  const double critical = change.orbit.values[0];
  for (double length : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const std::optional<PathPoint> beyond = step_to(problem, change, length, range);
    if (!beyond) continue;
    for (double side : {1.0, -1.0}) {  // where the old branch would have gone on, then where it came from
      for (Orbit guess : shapes_near(problem, beyond->orbit)) {
        guess.values[0] = critical + side * (beyond->orbit.values[0] - critical);
        const std::optional<Orbit> orbit = solved(problem, guess);
        const double away = orbit ? orbit->values[0] - critical : 0.0;
        if (away == 0.0 || std::abs(away) > 100.0 * length * range) continue;
        Reshaped next{point_of(problem, *orbit, range, {}), away * change.watched.turn < 0.0};
        if (next.point.watched.turn * away < 0.0) {
          next.point.tangent = -next.point.tangent;
          next.point.watched.turn = -next.point.watched.turn;
          next.point.watched.cross = -next.point.watched.cross;
        }
        return next;
      }
    }
  }
  return std::nullopt;
}

}  // namespace slapstick::orbit
