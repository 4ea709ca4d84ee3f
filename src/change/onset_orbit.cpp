/// Solves for the onset of a complete chatter: the orbit on the stable manifold of the bounce map's second fixed point.
#include "change/onset_orbit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "change/cascade_law.hpp"
#include "orbit/margins.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// The stop that chatters, its flight and its rest, in one model.
class Bounce {
 public:
  Bounce(const ModeSet& set, int stop, const Leg& flight)
      : set_(set),
        stop_(stop),
        row_(set.frame().stops[static_cast<std::size_t>(stop)]),
        lines_(flight.lines),
        flight_(flight.states),
        closed_(flight.states) {
    closed_.stops[static_cast<std::size_t>(stop)] = mode::StopState::closed;
  }

  [[nodiscard]] const mode::ContactStates& closed() const { return closed_; }
  [[nodiscard]] Index velocity() const { return set_.frame().u(row_.own); }

  /// The speed of separation, the pressing acceleration and the rate at which it falls, where a leg begins at an
  /// impact.
  struct Numbers {
    Jet v, a, j;
    [[nodiscard]] double w() const { return v.value()[0] * j.value()[0] / (a.value()[0] * a.value()[0]); }
  };
  [[nodiscard]] Numbers numbers(const VectorXd& x, double t) const {
    const Jet before = extended(set_, lines_, x, t);
    Leg rest;
    rest.states = closed_;
    rest.lines = lines_;
    rest.ending = Ending::onset;
    rest.contact = stop_;
    rest.chattering = std::uint32_t{1} << stop_;
    const Jet X = leg_start(set_, rest, x, t);
    const ModeRates &flight = set_.mode(flight_), &closed = set_.mode(closed_);
    const RowVectorXd pressing = row_.sign * flight.outline.system.row(velocity());
    const RowVectorXd falling = -pressing * closed.outline.system;
    Numbers numbers{row_jet(-row_.sign * RowVectorXd::Unit(before.all.rows(), velocity()), before),
                    row_jet(pressing, X), row_jet(falling, X)};
    for (Index p = 0; p < X.parameters; ++p) {
      const auto at = static_cast<std::size_t>(p);
      const RowVectorXd rate = row_.sign * flight.rates[at].system.row(velocity());
      numbers.a.by_parameter()(0, p) += rate.dot(X.value());
      numbers.j.by_parameter()(0, p) -=
          (rate * closed.outline.system + pressing * closed.rates[at].system).dot(X.value());
    }
    return numbers;
  }

  /// The contact state so long after an impact as if the contact had stayed closed since, except for a speed of
  /// separation.
  [[nodiscard]] VectorXd state_after(const Leg& rest, const VectorXd& x, double t, double seconds, double speed) const {
    const Jet start = leg_start(set_, rest, x, t);
    Jet X(start.all.rows(), 0, 0);
    X.value() = start.value();
    flow(set_.mode(closed_), seconds, X);
    X.value()[velocity()] = -row_.sign * speed;
    return contact_state(set_, X.value());
  }

 private:
  static Jet row_jet(const RowVectorXd& row, const Jet& X) {
    Jet h(1, X.states, X.parameters);
    h.all = row * X.all;
    return h;
  }

  const ModeSet& set_;
  int stop_;
  const mode::ContactRow& row_;
  std::vector<int> lines_;  ///< of the signals
  mode::ContactStates flight_, closed_;
};

bool is_flight(const Leg& leg, int stop, const mode::ContactStates& states) {
  return leg.ending == Ending::guard && leg.kind == mode::GuardKind::gap && leg.contact == stop && leg.states == states;
}

/// Of a stop's impacts the one where w is nearest to w*, in a burst whose contact then lets go.
struct Approach {
  std::size_t from;    ///< the leg that begins there
  std::size_t beyond;  ///< the first leg after the burst
  double off = INFINITY;
};

/// The first leg after a burst: behind the chatter's rest, or the flight from which the contact does not come back at
/// once. An orbit with a complete chatter of the stop has only that burst.
std::optional<std::size_t> leg_beyond(const ModeSet& set, const Orbit& orbit, int stop, std::size_t from) {
  for (std::size_t step = 0; step < orbit.legs(); ++step) {
    const std::size_t i = (from + step) % orbit.legs();
    const Leg& leg = orbit.shape.legs[i];
    if (leg.ending == Ending::chatter) {
      const std::size_t rest = (i + 1) % orbit.legs();
      if (orbit.shape.legs[rest].kind != mode::GuardKind::press) return std::nullopt;
      return (rest + 1) % orbit.legs();
    }
    const auto numbers = Bounce(set, stop, leg).numbers(orbit.x[i], orbit.t[i]);
    const double a = numbers.a.value()[0], j = numbers.j.value()[0];
    const bool returns =
        a > 0.0 && j > 0.0 && orbit.duration(i) * set.period() * j < 2.0 * a;  // a graze's flight: 1.5 a / j
    if (!returns) return step == 0 || chattering_stop(orbit) == stop ? std::nullopt : std::optional(i);
    if (!is_flight(leg, stop, orbit.shape.legs[from].states)) return std::nullopt;
  }
  return std::nullopt;
}

/// Far from the onset a is as good as constant during a burst, and w falls by r from impact to impact; near the fixed
/// point w stays.
std::optional<Approach> nearest_approach(const ModeSet& set, const Orbit& orbit, int stop, double restitution) {
  // Of the fall far from the onset. A larger share takes bursts for approaches that Newton's method then leads astray;
  // with a smaller one an onset is looked for only where a cascade has hardly anything left to gather.
  constexpr double slow = 0.25;
  const double wanted = bounce_rates(restitution).w;
  const auto w_at = [&](std::size_t leg) -> std::optional<double> {
    const Leg& before = orbit.shape.legs[(leg + orbit.legs() - 1) % orbit.legs()];
    if (!is_flight(before, stop, before.states) || before.strikes.empty()) return std::nullopt;
    const auto numbers = Bounce(set, stop, before).numbers(orbit.x[leg], orbit.t[leg]);
    if (!(numbers.a.value()[0] > 0.0 && numbers.j.value()[0] > 0.0)) return std::nullopt;
    return numbers.w();
  };
  std::optional<Approach> best;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const std::optional<double> w = w_at(i), next = w_at((i + 1) % orbit.legs());
    if (!w || !next || !(*w - *next < slow * (1.0 - restitution) * *w)) continue;
    const double off = std::abs(*w - wanted);
    if (!(off < (best ? best->off : 0.5 * wanted))) continue;
    const std::optional<std::size_t> beyond = leg_beyond(set, orbit, stop, i);
    if (beyond) best = Approach{i, *beyond, off};
  }
  return best;
}

/// The orbit with the burst's legs behind the approach replaced by one closed leg until the contact lets go.
Orbit cut_off(const ModeSet& set, Orbit orbit, int stop, const Approach& approach) {
  const std::size_t legs = orbit.legs(), keep = (approach.from + legs - approach.beyond) % legs;
  rotate(orbit, approach.beyond);
  const Leg flight = orbit.shape.legs[keep - 1];
  const Bounce bounce(set, stop, flight);
  Leg rest = flight;
  rest.states = bounce.closed();
  rest.ending = Ending::onset;
  rest.kind = mode::GuardKind::press;
  rest.chattering = std::uint32_t{1} << stop;
  rest.strikes.clear();
  rest.event = EventKind::release;
  const auto numbers = bounce.numbers(orbit.x[keep], orbit.t[keep]);
  const double left = numbers.a.value()[0] / numbers.j.value()[0];
  orbit.shape.legs.resize(keep);
  orbit.shape.legs.push_back(rest);
  orbit.x.resize(keep + 1);
  orbit.t.resize(keep + 2);
  orbit.t.back() = orbit.t[keep] + left / set.period();
  orbit.x[0] = bounce.state_after(rest, orbit.x[keep], orbit.t[keep], left, 0.0);
  orbit.t[0] = orbit.shape.n > 0 ? orbit.t.back() - orbit.shape.n : 0.0;
  return orbit;
}

/// More impacts before the closed leg, where the fixed point has them.
Orbit with_more_impacts(const ModeSet& set, Orbit orbit, int count, const BounceRates& rates) {
  const Leg rest = orbit.shape.legs.back(), flight = orbit.shape.legs.end()[-2];
  const Bounce bounce(set, rest.contact, flight);
  const VectorXd x = orbit.x.back();
  const double t = orbit.t.end()[-2], end = orbit.t.back();
  const auto numbers = bounce.numbers(x, t);
  double a = numbers.a.value()[0], passed = 0.0;
  const double j = numbers.j.value()[0];
  orbit.shape.legs.pop_back();
  orbit.t.pop_back();
  for (int i = 0; i < count; ++i) {
    passed += rates.sigma * a / j;
    a *= rates.mu;
    orbit.shape.legs.push_back(flight);
    orbit.t.push_back(t + passed / set.period());
    orbit.x.push_back(bounce.state_after(rest, x, t, passed, rates.w * a * a / j));
  }
  orbit.shape.legs.push_back(rest);
  orbit.t.push_back(end);
  return orbit;
}

/// Could it be a motion? All that ends a leg must be positive within, except for the flights of the burst, which the
/// fixed point keeps apart. A slider of its pair may touch its limit at the stop, where the first impact has drawn it.
bool is_possible(const Problem& problem, Orbit orbit) {
  const mode::Frame& frame = problem.base().compiled().frame();
  const Leg flight = orbit.shape.legs.end()[-2];
  Leg& rest = orbit.shape.legs.back();
  rest.ending = Ending::guard;
  const auto of_stop = [&](const TestValue& test) {
    const mode::SliderRow* slider = frame.slider(test.kind, test.contact);
    if (slider != nullptr)
      return frame.in_step(frame.stops[static_cast<std::size_t>(rest.contact)].own, slider->pair.own);
    const bool of_contact = test.kind == mode::GuardKind::gap || test.kind == mode::GuardKind::press;
    return of_contact && test.contact == rest.contact;
  };
  const auto of_burst = [&](const TestValue& test) {
    const bool lets_go = test.leg == 0 && test.at == 0.0;
    return of_stop(test) && (lets_go || test.leg + 1 == orbit.legs() || orbit.shape.legs[test.leg] == flight);
  };
  for (const TestValue& test : test_values(ModeSet(problem.family(), orbit.values), orbit))
    if (!of_burst(test) && !(test.value > 0.0)) return false;
  return true;
}

/// Solves the equations, with the first parameter as an unknown. @returns whether its legs come one after the other
bool solve_onset(const Problem& problem, Orbit& orbit) {
  constexpr int most_steps = 20;
  const std::size_t legs = orbit.legs(), last = legs - 1;
  std::vector<Condition> conditions = fixed_parameters(problem, legs);
  conditions[0].function = [&](const ModeSet& set, const Linearised& at, const Orbit& now) {
    const int stop = now.shape.legs[last].contact;
    const Bounce::Numbers numbers = Bounce(set, stop, now.shape.legs[last - 1]).numbers(now.x[last], now.t[last]);
    const BounceRates rates = bounce_rates(set.model().stops[static_cast<std::size_t>(stop)].restitution);
    const double v = numbers.v.value()[0], a = numbers.a.value()[0], j = numbers.j.value()[0];
    Jet w = numbers.v;  // v j / a^2 - w*
    w.all = (j / (a * a)) * numbers.v.all + (v / (a * a)) * numbers.j.all - (2.0 * v * j / (a * a * a)) * numbers.a.all;
    for (Index p = 0; p < w.parameters; ++p)
      w.by_parameter()(0, p) -=
          rates.w_rate * set.rate(static_cast<std::size_t>(p)).stops[static_cast<std::size_t>(stop)].restitution;
    const RowVectorXd by = by_unknowns(problem, w, at.states[last], last, legs);
    return Residual{numbers.w() - rates.w + w.by_state().row(0).dot(at.defects[last]), by};
  };
  if (!solve(problem, orbit, conditions, most_steps).converged) return false;
  return std::adjacent_find(orbit.t.begin(), orbit.t.end(), std::greater_equal()) == orbit.t.end();
}

}  // namespace

bool has_friction(const Model& model, const mode::Frame& frame, int stop) {
  const int own = frame.stops[static_cast<std::size_t>(stop)].own;
  for (std::size_t i = 0; i < frame.frictions.size(); ++i)
    if (model.frictions[i].static_friction > 0.0 && frame.parallel(frame.frictions[i].own, own) != 0) return true;
  return false;
}

std::optional<int> chattering_stop(const Orbit& orbit) {
  std::optional<int> stop;
  for (const Leg& leg : orbit.shape.legs) {
    if (leg.ending != Ending::chatter) continue;
    if (stop || std::popcount(leg.chattering) > 1) return std::nullopt;
    stop = leg.contact;
  }
  return stop;
}

namespace {

constexpr std::size_t most_legs = 600;  ///< with more a step costs seconds; r = 0.96 is known to rounding with these

/// Do the equations hold for a stop of these modes? A contact that rests meanwhile must not feel its impacts.
bool has_equations(const ModeSet& set, const Orbit& near, int stop) {
  const mode::Frame& frame = set.frame();
  const int own = frame.stops[static_cast<std::size_t>(stop)].own;
  const double r = set.model().stops[static_cast<std::size_t>(stop)].restitution;
  if (!(r > 0.0 && r < 1.0) || own >= frame.n || has_friction(set.model(), frame, stop)) return false;
  for (const Leg& leg : near.shape.legs) {
    if (!is_flight(leg, stop, leg.states)) continue;
    const std::vector<bool>& steady = set.mode(leg.states).outline.steady;
    for (int i = 0; i < frame.d; ++i)
      if (steady[static_cast<std::size_t>(i)] && frame.mass_inverse(own, i) != 0.0) return false;
  }
  for (int other = 0; other < static_cast<int>(frame.stops.size()); ++other)  // two onsets at once, as of equal stops
    if (other != stop &&
        nearest_approach(set, near, other, set.model().stops[static_cast<std::size_t>(other)].restitution))
      return false;
  return true;
}

/// Adds impacts until the parameter stops to change. What is left of the changes then is rounding, by chance small in
/// one of them.
std::optional<OnsetOrbit> converged(const Problem& problem, Orbit orbit, int stop) {
  constexpr int at_once = 16;     // halved where Newton's method fails: larger saves steps, and changes no result
  constexpr double safety = 4.0;  // of rounding, of which the last two changes are but samples
  double change = INFINITY, left = 1.0;
  int settled = 0;
  for (int more = at_once; more > 0 && settled < 2 && orbit.legs() < most_legs;) {
    const ModeSet set(problem.family(), orbit.values);
    const BounceRates rates = bounce_rates(set.model().stops[static_cast<std::size_t>(stop)].restitution);
    Orbit next = with_more_impacts(set, orbit, more, rates);
    if (!solve_onset(problem, next)) {
      more /= 2;
      continue;
    }
    const double moved = std::abs(next.parameter() - orbit.parameter());
    left = std::pow(rates.mu / rates.lambda, more);
    settled = moved >= 0.5 * change || moved == 0.0 ? settled + 1 : 0;
    change = settled > 1 ? std::max(moved, change) : moved;
    orbit = std::move(next);
  }
  if (change == INFINITY || !is_possible(problem, orbit)) return std::nullopt;
  const double truncated = change * left / (1.0 - left);
  const double rounding = settled > 0 ? change : 0.0;
  const double error =
      truncated + safety * (rounding + std::numeric_limits<double>::epsilon() * std::abs(orbit.parameter()));
  return OnsetOrbit{std::move(orbit), error};
}

}  // namespace

std::optional<OnsetOrbit> onset_orbit(const Problem& problem, const Orbit& near, int stop) {
  try {
    const ModeSet set(problem.family(), near.values);
    if (!has_equations(set, near, stop)) return std::nullopt;
    const double restitution = set.model().stops[static_cast<std::size_t>(stop)].restitution;
    const std::optional<Approach> approach = nearest_approach(set, near, stop, restitution);
    if (!approach) return std::nullopt;
    Orbit orbit = cut_off(set, near, stop, *approach);
    if (orbit.legs() > most_legs || !solve_onset(problem, orbit)) return std::nullopt;
    return converged(problem, std::move(orbit), stop);
  } catch (const InputError&) {  // no model where a step led
    return std::nullopt;
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace slapstick::orbit
