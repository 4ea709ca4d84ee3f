#include "orbit/reshape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
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

namespace {

/// An impact whose speed goes to zero is no more: its leg and the next are one, or a velocity of the same pair passes zero there instead.
std::vector<Orbit> without_impact(const ModeSet& set, const Orbit& orbit, const TestValue& test) {
  std::vector<Orbit> shapes;
  if (test.test != Test::speed || test.kind != mode::GuardKind::gap || orbit.legs() < 2) return shapes;
  Orbit turned = orbit;
  rotate(turned, test.leg);  // the impact ends the first leg
  const mode::Frame& frame = set.frame();
  for (std::size_t i = 0; i < frame.frictions.size(); ++i) {
    if (frame.parallel(frame.frictions[i].own, frame.stops[test.contact].own) == 0) continue;
    Orbit reversed = turned;
    Leg& leg = reversed.shape.legs[0];
    leg.kind = mode::GuardKind::slip;
    leg.contact = static_cast<int>(i);
    leg.strikes.clear();
    const auto next = reversed.shape.legs[1].states.frictions[i];
    leg.event = next == mode::FrictionState::slip_plus ? EventKind::slip_plus
                : next == mode::FrictionState::stick   ? EventKind::stick
                                                       : EventKind::slip_minus;
    leg.event_contact = static_cast<int>(frame.stops.size() + i);
    shapes.push_back(std::move(reversed));
  }
  if (turned.shape.legs[0].states == turned.shape.legs[1].states) {
    turned.shape.legs.erase(turned.shape.legs.begin());
    turned.x.erase(turned.x.begin() + 1);
    turned.t.erase(turned.t.begin() + 1);
    shapes.push_back(std::move(turned));
  }
  return shapes;
}

/// Does the branch of a new orbit come from the change: has it, followed back, a margin that is zero there?
bool comes_from(const Problem& problem, const PathPoint& next, double critical, double range) {
  constexpr double same = 1e-7;  // of the range
  PathPoint back = next;
  back.tangent = -back.tangent;
  const double turn = std::abs(next.watched.turn);
  const double near = turn > 0.0 ? std::abs(next.orbit.values[0] - critical) / (turn * range) : 0.0;
  for (double length : {1.5 * near, 4.0 * near, 20.0 * near}) {
    if (!(length > 0.0) || length > 0.05) return false;
    const std::optional<PathPoint> beyond = step_to(problem, back, length, range);
    if (!beyond) continue;
    for (std::size_t i = 0; i < back.watched.tests.size(); ++i) {
      if (!(back.watched.tests[i].value > 0.0) || !(beyond->watched.tests[i].value < 0.0)) continue;
      const auto value = [i](const Watched& watched) { return watched.tests[i].value; };
      const auto located = locate(problem, back, length, range, value, beyond->watched.tests[i].value);
      if (located && std::abs(located->point.orbit.values[0] - critical) < same * range) return true;
    }
  }
  return false;
}

/// The point of a new orbit, led away from the change; empty if it does not come from there.
std::optional<Reshaped> born(const Problem& problem, const PathPoint& change, const Orbit& orbit, double length,
                             double range) {
  const double critical = change.orbit.values[0], away = orbit.values[0] - critical;
  if (away == 0.0 || std::abs(away) > 10.0 * length * range) return std::nullopt;
  Reshaped next{point_of(problem, orbit, range, {}), away * change.watched.turn < 0.0};
  if (next.point.watched.turn * away < 0.0) {
    next.point.tangent = -next.point.tangent;
    next.point.watched.turn = -next.point.watched.turn;
    next.point.watched.cross = -next.point.watched.cross;
  }
  if (!comes_from(problem, next.point, critical, range)) return std::nullopt;
  return next;
}

}  // namespace

std::optional<Reshaped> reshape(const Problem& problem, const PathPoint& change, const TestValue& test, double range) {
  const double critical = change.orbit.values[0];
  const ModeSet set(problem.family(), change.orbit.values);
  for (double length : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const std::optional<PathPoint> beyond = step_to(problem, change, length, range);
    if (!beyond) continue;
    std::vector<Orbit> guesses = shapes_near(problem, beyond->orbit);
    std::ranges::copy(without_impact(set, beyond->orbit, test), std::back_inserter(guesses));
    for (double side : {1.0, -1.0}) {  // where the old branch would have gone on, then where it came from
      for (Orbit guess : guesses) {
        guess.values[0] = critical + side * (beyond->orbit.values[0] - critical);
        const std::optional<Orbit> orbit = solved(problem, guess);
        if (!orbit) continue;
        if (auto next = born(problem, change, *orbit, length, range)) return next;
      }
    }
  }
  return std::nullopt;
}

}  // namespace slapstick::orbit
