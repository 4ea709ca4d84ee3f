/// Other event sequences of which an orbit at a change is an orbit too: what has vanished is left out, or an impact put
/// in.
#include "change/coincident.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/ranges.hpp"
#include "change/past_knot.hpp"
#include "change/without_legs.hpp"
#include "orbit/leg_flow.hpp"
#include "orbit/short_legs.hpp"
#include "orbit/ties.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

constexpr double vanishing = 1e-2;  ///< of the speed of a slip or an impact at the point before: it vanishes
constexpr double no_gap = 1e-9;     ///< of the largest margin of a gap at the point before
constexpr double no_speed = 1e-4;   ///< of the largest speed at the point before: so much is left by rounding

/// The largest relative velocity of a friction contact within a leg.
double fastest(const ModeSet& set, const Orbit& orbit, std::size_t leg, std::size_t contact) {
  constexpr int samples = 8;
  const Eigen::Index velocity = set.frame().d + set.frame().frictions[contact].own;
  double most = 0.0;
  for (int k = 1; k < samples; ++k)
    most = std::max(most, std::abs(state_within(set, orbit, leg, orbit.duration(leg) * k / samples)[velocity]));
  return most;
}

}  // namespace

bool slip_dies(const ModeSet& set, const Orbit& before, const Orbit& orbit, std::size_t leg, std::size_t other) {
  bool slips = false;
  for (std::size_t i = 0; i < set.frame().frictions.size(); ++i) {
    if (orbit.shape.legs[other].states.frictions[i] != mode::FrictionState::stick ||
        orbit.shape.legs[leg].states.frictions[i] == mode::FrictionState::stick)
      continue;
    if (!(fastest(set, orbit, leg, i) < vanishing * fastest(set, before, leg, i))) return false;
    slips = true;
  }
  return slips;
}

namespace {

/// The impact at the end of the first leg as the corner of a polyline over a velocity, which that passes there instead.
std::optional<Orbit> with_corner(const ModeSet& set, const Orbit& orbit) {
  const mode::ContactStates &before = orbit.shape.legs[0].states, &behind = orbit.shape.legs[1].states;
  for (std::size_t i = 0; i < before.pieces.size(); ++i) {
    mode::ContactStates next = before;
    next.pieces[i] = behind.pieces[i];
    if (std::abs(behind.pieces[i] - before.pieces[i]) != 1 || !(next == behind)) continue;
    Orbit crossed = orbit;
    Leg& leg = crossed.shape.legs[0];
    leg.kind = behind.pieces[i] > before.pieces[i] ? mode::GuardKind::corner_above : mode::GuardKind::corner_below;
    leg.contact = static_cast<int>(i);
    leg.strikes.clear();
    leg.event = EventKind::corner;
    leg.event_contact = mode::contact_index(leg.kind, leg.contact, set.model());
    return crossed;
  }
  return std::nullopt;
}

/// An impact whose speed goes to zero is no more: its leg and the next are one, or a velocity of the same pair passes
/// zero or a corner there instead.
std::vector<Orbit> without_impact(const ModeSet& set, const Orbit& before, const Orbit& orbit, const TestValue& test) {
  std::vector<Orbit> shapes;
  if (test.test != Test::speed || test.kind != mode::GuardKind::gap) return shapes;
  if (orbit.legs() == 1) return {uncut(set, orbit)};
  Orbit turned = orbit;
  rotate(turned, test.leg);  // the impact ends the first leg
  const std::vector<bool> dead = dead_legs(before, orbit);
  const auto goes = [&](std::size_t leg) {  // what follows an impact of no speed is no more either
    return dead[leg] || slip_dies(set, before, orbit, leg, test.leg);
  };
  std::size_t next = test.leg + 1;
  for (; turned.legs() > 2 && goes(next % orbit.legs()); ++next) leave_out(turned, 1, 1);
  if (turned.legs() == 2 && goes(next % orbit.legs())) return {uncut(set, turned)};
  const mode::Frame& frame = set.frame();
  for (std::size_t i = 0; i < frame.frictions.size(); ++i) {
    if (!frame.in_step(frame.frictions[i].own, frame.stops[test.contact].own)) continue;
    Orbit reversed = turned;
    Leg& leg = reversed.shape.legs[0];
    leg.kind = mode::GuardKind::slip;
    leg.contact = static_cast<int>(i);
    leg.strikes.clear();
    const auto behind = reversed.shape.legs[1].states.frictions[i];
    leg.event = behind == mode::FrictionState::slip_plus ? EventKind::slip_plus
                : behind == mode::FrictionState::stick   ? EventKind::stick
                                                         : EventKind::slip_minus;
    leg.event_contact = static_cast<int>(frame.stops.size() + i);
    shapes.push_back(std::move(reversed));
  }
  if (auto crossed = with_corner(set, turned)) shapes.push_back(std::move(*crossed));
  if (turned.shape.legs[0].states == turned.shape.legs[1].states) {
    leave_out(turned, 0, 1);
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
  VectorXd x = contact_state(set, state_within(set, orbit, test.leg, test.at));
  if (const int own = set.frame().stops[test.contact].own; own < set.frame().n) x[own] = 0.0;
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

bool impact_speed(const TestValue& test) { return test.test == Test::speed && test.kind == mode::GuardKind::gap; }
bool gap(const TestValue& test) { return test.test == Test::guard && test.kind == mode::GuardKind::gap; }

double largest(const std::vector<TestValue>& tests, bool (*of)(const TestValue&)) {
  double all = 0.0;
  for (const TestValue& test : tests)
    if (of(test) && std::isfinite(test.value)) all = std::max(all, std::abs(test.value));
  return all;
}

/// How many impacts lose their speed from one orbit to the next?
int lost_impacts(const std::vector<TestValue>& was, const std::vector<TestValue>& is) {
  int count = 0;
  for (std::size_t i = 0; i < std::min(was.size(), is.size()); ++i)
    if (impact_speed(is[i]) && is[i].value < vanishing * was[i].value) ++count;
  return count;
}

/// None for a shape whose modes do not have the guards that end its legs.
std::vector<TestValue> values_if_any(const ModeSet& set, const Orbit& orbit) {
  try {
    return test_values(set, orbit);
  } catch (const NumericalError&) {
    return {};
  }
}

/// Where several impacts lose their speed together, as in symmetric orbits: without the others too.
Orbit without_all(const ModeSet& set, double largest_speed, Orbit orbit) {
  for (std::size_t most = orbit.legs(); most > 0; --most) {
    const std::vector<TestValue> tests = values_if_any(set, orbit);
    const auto next = ranges::find_if(tests, [&](const TestValue& test) {
      return impact_speed(test) && std::abs(test.value) < no_speed * largest_speed;
    });
    if (next == tests.end()) break;
    std::vector<Orbit> fewer = without_impact(set, orbit, orbit, *next);
    if (fewer.empty()) break;
    orbit = std::move(fewer.front());
  }
  return orbit;
}

/// Is it the gap of a stop that is struck where it is least?
bool is_struck_there(const Orbit& orbit, const TestValue& test) {
  const double beside = 1e-4 * (orbit.t.back() - orbit.t.front());
  const auto strikes = [&](const Leg& leg) {
    return leg.ending == Ending::guard && leg.kind == test.kind && leg.contact == test.contact;
  };
  const Leg& before = orbit.shape.legs[(test.leg + orbit.legs() - 1) % orbit.legs()];
  return (test.at < beside && strikes(before)) ||
         (orbit.duration(test.leg) - test.at < beside && strikes(orbit.shape.legs[test.leg]));
}

/// Where several gaps touch zero together: with an impact in each of the others too.
Orbit with_all(const ModeSet& set, double largest_gap, Orbit orbit) {
  constexpr int most_gaps = 16;
  for (int k = 0; k < most_gaps; ++k) {
    const std::vector<TestValue> tests = values_if_any(set, orbit);
    const auto next = ranges::find_if(tests, [&](const TestValue& test) {
      return gap(test) && std::abs(test.value) < no_gap * largest_gap && !is_struck_there(orbit, test);
    });
    if (next == tests.end()) break;
    orbit = std::move(with_impact(set, orbit, *next).front());
  }
  return orbit;
}

/// Does a slider begin to slip at the end of a leg?
bool begins_to_slip(const ModeSet& set, const Leg& leg) {
  if (!mode::of_corner(leg.kind)) return false;
  const mode::SliderRow* slider = set.frame().slider(leg.contact);
  return slider != nullptr && slider->rests(leg.states.pieces);
}

/// Where a slider begins to slip together with another one: after that one, if it came before it, or before. What has
/// died may have held the two together.
std::optional<Orbit> with_slips_exchanged(const ModeSet& set, Orbit orbit, int slider) {
  bool any = false;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    Leg& leg = orbit.shape.legs[i];
    Leg& before = orbit.shape.legs[(i + orbit.legs() - 1) % orbit.legs()];
    if (orbit.duration(i) > 0.0 || (leg.contact != slider && before.contact != slider)) continue;
    if (!begins_to_slip(set, before) || !begins_to_slip(set, leg) || before.contact == leg.contact) continue;
    const Leg first = before;
    const auto piece = orbit.shape.legs[(i + 1) % orbit.legs()].states.pieces[static_cast<std::size_t>(leg.contact)];
    before = leg;
    before.states = first.states;
    leg = first;
    leg.states.pieces[static_cast<std::size_t>(before.contact)] = piece;
    before.tied = first.tied;
    leg.tied = false;
    any = true;
  }
  return any ? std::optional(std::move(orbit)) : std::nullopt;
}

/// With a tie for each leg that has no length and is still there: what else has died may have kept two events apart, as
/// the slip of one slider where two have the same corners.
std::optional<Orbit> tied_together(const ModeSet& set, Orbit orbit) {
  return tie_sliders(set.frame(), orbit, rounding_of_instants(0.0)) ? std::optional(std::move(orbit)) : std::nullopt;
}

}  // namespace

std::vector<Orbit> sequences_of_same_orbit(const Problem& problem, const Orbit& before, const Orbit& orbit,
                                           const TestValue& test) {
  const ModeSet set(problem.family(), orbit.values);
  const std::vector<TestValue> was = test_values(ModeSet(problem.family(), before.values), before);
  std::vector<Orbit> shapes;
  const auto add = [&](const Orbit& all, const Orbit& one) {
    if (!(all.shape.legs == one.shape.legs)) shapes.push_back(all);
    shapes.push_back(one);
  };
  const int lost = lost_impacts(was, test_values(set, orbit));
  const bool several = lost > 1;
  for (const Orbit& fewer : without_impact(set, before, orbit, test))
    add(several ? without_all(set, largest(was, impact_speed), fewer) : fewer, fewer);
  for (const Orbit& more : with_impact(set, orbit, test)) add(with_all(set, largest(was, gap), more), more);
  const std::vector<bool> dead = dead_legs(before, orbit), at_once = with_ties(orbit, dead);
  ranges::copy(past_knots(set, orbit, dead), std::back_inserter(shapes));
  ranges::copy(without_legs(set, orbit, dead, !impact_speed(test)), std::back_inserter(shapes));
  if (at_once != dead) ranges::copy(without_legs(set, orbit, at_once, !impact_speed(test)), std::back_inserter(shapes));
  if (lost > 0 && !impact_speed(test))  // another margin is used up with their speed
    ranges::copy(without_legs(set, orbit, dead, false), std::back_inserter(shapes));
  std::vector<Orbit> all;
  for (const Orbit& shape : shapes) {
    if (auto tied = tied_together(set, shape)) all.push_back(std::move(*tied));
    all.push_back(shape);
    for (int slider = 0; slider < static_cast<int>(set.frame().characteristics.size()); ++slider)
      if (auto exchanged = with_slips_exchanged(set, shape, slider)) all.push_back(std::move(*exchanged));
  }
  return all;
}

}  // namespace slapstick::orbit
