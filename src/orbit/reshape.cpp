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

/// The cycle of one leg without its event, from phase 0.
Orbit uncut(const ModeSet& set, const Orbit& orbit) {
  Orbit plain = orbit;
  const double wait = std::ceil(orbit.t[0]) - orbit.t[0];
  Jet X = leg_start(set, orbit.shape.legs[0], orbit.x[0], orbit.t[0]);
  flow(set.mode(orbit.shape.legs[0].states), wait * set.period(), X);
  const int n = set.frame().n;
  plain.x[0] << X.value().head(n), X.value().segment(set.frame().d, n);
  plain.shape.legs[0].ending = Ending::cut;
  plain.shape.legs[0].strikes.clear();
  plain.t = {0.0, static_cast<double>(orbit.shape.n)};
  return plain;
}

/// An impact whose speed goes to zero is no more: its leg and the next are one, or a velocity of the same pair passes zero there instead.
std::vector<Orbit> without_impact(const ModeSet& set, const Orbit& orbit, const TestValue& test) {
  std::vector<Orbit> shapes;
  if (test.test != Test::speed || test.kind != mode::GuardKind::gap) return shapes;
  if (orbit.legs() == 1) return {uncut(set, orbit)};
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

/// A gap that touches zero within a leg: an impact of no speed is put there, and the cycle begins with it.
std::vector<Orbit> with_impact(const ModeSet& set, const Orbit& orbit, const TestValue& test) {
  if (test.test != Test::guard || test.kind != mode::GuardKind::gap) return {};
  Orbit split = orbit;
  const Leg& old = orbit.shape.legs[test.leg];
  const double at = orbit.t[test.leg] + test.at;
  Jet X = leg_start(set, old, orbit.x[test.leg], orbit.t[test.leg]);
  flow(set.mode(old.states), test.at * set.period(), X);
  const int n = set.frame().n, own = set.frame().stops[test.contact].own;
  VectorXd x(2 * n);
  x << X.value().head(n), X.value().segment(set.frame().d, n);
  if (own < n) x[own] = 0.0;
  Leg impact = old;
  impact.ending = Ending::guard;
  impact.kind = mode::GuardKind::gap;
  impact.contact = impact.event_contact = test.contact;
  impact.event = EventKind::impact;
  impact.strikes = {{1U << test.contact, false}};
  if (old.ending == Ending::cut) {  // one leg, from the impact to the impact
    split.shape.legs = {impact};
    split.x = {x};
    split.t = {at, at + orbit.shape.n};
    return {split};
  }
  const auto place = static_cast<std::ptrdiff_t>(test.leg);
  split.shape.legs.insert(split.shape.legs.begin() + place, impact);
  split.x.insert(split.x.begin() + place + 1, x);
  split.t.insert(split.t.begin() + place + 1, at);
  return {split};
}

/// The branch of a shape of which the orbit at the change is one already, by arclength to either side of it.
std::optional<Reshaped> leaving(const Problem& problem, const PathPoint& change, const Orbit& shape, double range) {
  Orbit orbit = shape;
  std::vector<Condition> conditions = fixed_parameters(problem, orbit.legs());
  if (!solve(problem, orbit, conditions, 12).converged)
    orbit = shape;  // singular at the change itself: it is the solution
  const double critical = change.orbit.values[0];
  if (std::abs(orbit.values[0] - critical) > 1e-9 * range) return std::nullopt;
  const PathPoint start = point_of(problem, orbit, range, {});
  for (const double sense : {1.0, -1.0}) {
    for (const double length : {1e-4, 1e-3, 5e-3}) {
      PathPoint from = start;
      from.tangent = sense * start.tangent;
      std::optional<PathPoint> next = step_to(problem, from, length, range);
      if (!next || !is_motion(problem, next->orbit)) continue;
      const bool folds = (next->orbit.values[0] - critical) * change.watched.turn < 0.0;
      return Reshaped{std::move(*next), folds};
    }
  }
  return std::nullopt;
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
  std::vector<Orbit> known = without_impact(set, change.orbit, test);
  std::ranges::copy(with_impact(set, change.orbit, test), std::back_inserter(known));
  for (const Orbit& shape : known)
    if (auto next = leaving(problem, change, shape, range)) return next;
  for (double length : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const std::optional<PathPoint> beyond = step_to(problem, change, length, range);
    if (!beyond) continue;
    const std::vector<Orbit> guesses = shapes_near(problem, beyond->orbit);
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
