/// Leaves legs of no length out of an orbit's event sequence.
#include "change/without_legs.hpp"

#include <algorithm>
#include <cmath>

#include "orbit/leg_flow.hpp"

namespace slapstick::orbit {
namespace {

template <class List>
void cut(List& list, std::ptrdiff_t from, std::ptrdiff_t count) {
  list.erase(list.begin() + from, list.begin() + from + count);
}

}  // namespace

Orbit uncut(const ModeSet& set, const Orbit& orbit) {
  Orbit plain = orbit;
  plain.x = {contact_state(set, state_within(set, orbit, 0, std::ceil(orbit.t[0]) - orbit.t[0]))};
  plain.shape.legs.resize(1);
  plain.shape.legs[0].ending = Ending::cut;
  plain.shape.legs[0].strikes.clear();
  plain.t = {0.0, static_cast<double>(orbit.shape.n)};
  return plain;
}

void leave_out(Orbit& orbit, std::ptrdiff_t leg, std::ptrdiff_t count) {
  cut(orbit.shape.legs, leg, count);
  cut(orbit.x, 1, count);
  cut(orbit.t, 1, count);
}

namespace {

/// An orbit, and which of its legs have shrunk to nothing.
struct Shrunk {
  Orbit orbit;
  std::vector<bool> dead;
  std::vector<std::size_t> starts;

  void begin_with(std::size_t leg) {
    rotate(orbit, leg);
    std::rotate(dead.begin(), dead.begin() + static_cast<std::ptrdiff_t>(leg), dead.end());
    std::rotate(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(leg), starts.end());
  }
  /// How many there are next to each other after the first leg.
  [[nodiscard]] std::size_t run() const {
    return static_cast<std::size_t>(std::find(dead.begin() + 1, dead.end(), false) - dead.begin()) - 1;
  }
  void leave_out(std::ptrdiff_t leg, std::ptrdiff_t count) {
    orbit::leave_out(orbit, leg, count);
    cut(dead, 1, count);
    cut(starts, 1, count);
  }
};

/// Takes over the state of the contact that a crossing is about.
void take_state(mode::ContactStates& states, const mode::ContactStates& from, const Leg& crossing) {
  const auto at = static_cast<std::size_t>(crossing.contact);
  if (mode::of_corner(crossing.kind)) states.pieces[at] = from.pieces[at];
  if (mode::of_load(crossing.kind)) states.frictions[at] = from.frictions[at];
  if (mode::of_bound(crossing.kind)) states.compliant[at] = from.compliant[at];
}

/// Does a leg begin in another state of a contact than this one?
bool has_changed(const Leg& leg, const mode::ContactStates& from, const Leg& crossing) {
  mode::ContactStates as_before = leg.states;
  take_state(as_before, from, crossing);
  return !(as_before == leg.states);
}

/// Is a line crossed at the end of one leg and crossed back at that of another one, so that the contact is as it was? A
/// slider that comes to rest with its pair turns back without an event of its own.
bool crosses_and_back(const std::vector<Leg>& legs, std::size_t there, std::size_t back) {
  const Leg& first = legs[there];
  return mode::of_crossing(first.kind) && has_changed(legs[back], first.states, first) &&
         !has_changed(legs[back + 1], first.states, first);
}

/// Among the events from the end of the first leg to that of the last dead one a line is crossed and crossed back: both
/// crossings go, what lies between them stays. @returns false if there are none
bool uncross(Shrunk& turned) {
  std::vector<Leg>& legs = turned.orbit.shape.legs;
  const std::size_t run = turned.run();
  for (std::size_t there = 0; there < run; ++there)
    for (std::size_t back = there + 1; back <= run; ++back) {
      if (!crosses_and_back(legs, there, back)) continue;
      const Leg first = legs[there];
      const bool own_event = mode::of_crossing(legs[back].kind) && legs[back].contact == first.contact;
      for (std::size_t i = there + 1; i <= back; ++i) take_state(legs[i].states, first.states, first);
      turned.leave_out(static_cast<std::ptrdiff_t>(there), 1);
      if (own_event) turned.leave_out(static_cast<std::ptrdiff_t>(back) - 1, 1);
      legs[there].tied = there > 0 || first.tied;
      return true;
    }
  return false;
}

/// One event in place of two: the end of the first leg, and that of the last dead leg after it. @returns false
/// if no such event is known
bool unite(Shrunk& turned, bool impacts_stay) {
  Leg& first = turned.orbit.shape.legs[0];
  Leg& last = turned.orbit.shape.legs[turned.run()];
  const auto count = static_cast<std::ptrdiff_t>(turned.run());
  const bool first_strikes = impacts_stay && !first.strikes.empty(),
             last_strikes = impacts_stay && !last.strikes.empty();
  if (first_strikes && last_strikes) return false;
  if (first_strikes) {  // an impact takes over the other event
    turned.leave_out(1, count);
    return true;
  }
  const bool stops = first.kind == mode::GuardKind::slip && last.kind == first.kind && last.contact == first.contact;
  const std::size_t next = (turned.run() + 1) % turned.orbit.legs();
  if (!last_strikes && first.states == turned.orbit.shape.legs[next].states) {  // neither
    turned.leave_out(0, count + 1);
    return true;
  }
  if (!first_strikes && !last_strikes && uncross(turned)) return true;
  if (!last_strikes && !stops) return false;
  last.states = first.states;
  turned.leave_out(0, count);
  return true;
}

}  // namespace

std::vector<Shortened> shortened(const ModeSet& set, const Orbit& orbit, const std::vector<bool>& dead,
                                 bool impacts_stay) {
  Shrunk all{orbit, dead, {}};
  for (std::size_t i = 0; i < orbit.legs(); ++i) all.starts.push_back(i);
  std::vector<Shortened> shapes;  // one place after another; in symmetric orbits legs vanish in several together
  for (std::size_t i = 0; i < all.orbit.legs(); ++i) {
    Shrunk turned = all;
    turned.begin_with(i);
    if (turned.run() == 0) continue;
    if (turned.run() + 1 == turned.orbit.legs()) {
      if (orbit.shape.n == 0) return {};
      return {Shortened{uncut(set, turned.orbit), {}}};
    }
    if (!unite(turned, impacts_stay)) continue;
    shapes.insert(shapes.begin(), Shortened{turned.orbit, turned.starts});
    all = std::move(turned);
    i = static_cast<std::size_t>(-1);
  }
  return shapes;
}

std::vector<Orbit> without_legs(const ModeSet& set, const Orbit& orbit, const std::vector<bool>& dead,
                                bool impacts_stay) {
  std::vector<Orbit> shapes;
  for (Shortened& one : shortened(set, orbit, dead, impacts_stay)) shapes.push_back(std::move(one.orbit));
  return shapes;
}

}  // namespace slapstick::orbit
