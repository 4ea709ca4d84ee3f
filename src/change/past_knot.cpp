/// Lets an event and a point of a signal that meet change places.
#include "change/past_knot.hpp"

#include "orbit/leg_flow.hpp"

namespace slapstick::orbit {
namespace {

/// What ends a leg, for another leg.
void take_end(Leg& leg, const Leg& from) {
  const mode::ContactStates states = leg.states;
  const std::vector<int> lines = leg.lines;
  leg = from;
  leg.states = states;
  leg.lines = lines;
}

/// The second leg is dead. The first one's end was before it, and comes after it.
///
///     states a, lines 1 | event | states b, lines 1 | point | states b, lines 2
///     states a, lines 1 | point | states a, lines 2 | event | states b, lines 2
Orbit exchanged(const ModeSet& set, const Orbit& orbit, std::size_t first) {
  const std::size_t second = (first + 1) % orbit.legs(), next = (first + 2) % orbit.legs();
  const Leg &a = orbit.shape.legs[first], &b = orbit.shape.legs[second];
  Orbit other = orbit;
  Leg &front = other.shape.legs[first], &back = other.shape.legs[second];
  take_end(front, b);
  take_end(back, a);
  if (a.ending == Ending::knot) {
    back.states = orbit.shape.legs[next].states;
    back.lines = a.lines;
    other.x[second] = orbit.x[next];
  } else {
    back.states = a.states;
    back.lines = orbit.shape.legs[next].lines;
    other.x[second] = contact_state(set, state_within(set, orbit, first, orbit.duration(first)));
  }
  return other;
}

bool may_pass(const Leg& a, const Leg& b, const Leg& next) {
  if (a.tied || b.tied || (a.ending == Ending::knot) == (b.ending == Ending::knot)) return false;
  const Leg& event = a.ending == Ending::knot ? b : a;
  if (event.ending != Ending::guard) return false;
  return a.ending == Ending::knot ? a.states == b.states : b.states == next.states;
}

}  // namespace

std::vector<Orbit> past_knots(const ModeSet& set, const Orbit& orbit, const std::vector<bool>& dead) {
  std::vector<Orbit> shapes;
  const std::size_t k = orbit.legs();
  for (std::size_t i = 0; i < k && k > 2; ++i) {
    const std::size_t before = (i + k - 1) % k, next = (i + 1) % k;
    if (!dead[i] || !may_pass(orbit.shape.legs[before], orbit.shape.legs[i], orbit.shape.legs[next])) continue;
    Orbit turned = orbit;
    rotate(turned, before);
    shapes.push_back(exchanged(set, turned, 0));
  }
  return shapes;
}

bool is_idle_knot(const Model& model, const Itinerary& shape, std::size_t leg) {
  const Leg &before = shape.legs[leg], &behind = shape.legs[(leg + 1) % shape.legs.size()];
  if (before.ending != Ending::knot) return false;
  for (std::size_t k = 0; k < model.signals.size(); ++k)
    if (before.lines[k] != behind.lines[k] &&
        !mode::goes_straight_on(model.signals[k], before.lines[k], behind.lines[k]))
      return false;
  return true;
}

}  // namespace slapstick::orbit
