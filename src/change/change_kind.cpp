/// Names a change of events, by the margin that is used up and by the sequences on both sides.
#include "change/change_kind.hpp"

#include <algorithm>
#include <optional>

#include "orbit/short_legs.hpp"

namespace slapstick::orbit {
namespace {

using mode::FrictionState;

bool sticks(const Leg& leg, int friction) { return leg.states.frictions[friction] == FrictionState::stick; }

/// The legs about one.
struct Neighbours {
  const Leg& before;
  const Leg& leg;
  const Leg& next;
};

Neighbours about(const Itinerary& shape, std::size_t leg) {
  const std::size_t count = shape.legs.size();
  return {shape.legs[(leg + count - 1) % count], shape.legs[leg], shape.legs[(leg + 1) % count]};
}

/// The friction contact whose stick or reversal is gained or lost, or goes on without a slip, where a leg shrinks to
/// nothing; -1 if there is no such contact.
int stick_at_stake(const TestValue& test, const Itinerary& shape) {
  const auto [before, leg, next] = about(shape, test.leg);
  if (test.starts_at_end && mode::of_friction(test.kind)) return test.contact;
  for (int i = 0; i < static_cast<int>(leg.states.frictions.size()); ++i)
    if (leg.states.frictions[i] != before.states.frictions[i] && leg.states.frictions[i] != next.states.frictions[i] &&
        !sticks(before, i) && !sticks(next, i))
      return i;
  return -1;
}

/// What a run of states that comes or goes between two others is.
Sliding kind_of_run(FrictionState before, FrictionState run, FrictionState next) {
  constexpr FrictionState stick = FrictionState::stick;
  if (run == stick) return before != next ? Sliding::crossing : Sliding::grazing;
  const int held = (before == stick ? 1 : 0) + (next == stick ? 1 : 0);
  return held == 2 ? Sliding::adding : held == 1 ? Sliding::switching : Sliding::grazing;
}

/// The states of one contact over a cycle, those that follow one another without a change as one, and how long each
/// lasts.
template <class State>
struct Run {
  State state;
  double duration;
};

template <class State, class Of>
std::vector<Run<State>> runs(const Orbit& orbit, const Of& state_of) {
  std::vector<Run<State>> all;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const State state = state_of(orbit.shape.legs[i].states);
    if (all.empty() || all.back().state != state) all.push_back({state, 0.0});
    all.back().duration += orbit.duration(i);
  }
  if (all.size() > 1 && all.front().state == all.back().state) {
    all.front().duration += all.back().duration;
    all.pop_back();
  }
  return all;
}

template <class State>
bool same_cycle(const std::vector<Run<State>>& a, const std::vector<Run<State>>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t shift = 0; shift < std::max<std::size_t>(1, a.size()); ++shift) {
    std::size_t same = 0;
    while (same < a.size() && a[same].state == b[(same + shift) % b.size()].state) ++same;
    if (same == a.size()) return true;
  }
  return false;
}

using Slides = std::vector<Run<FrictionState>>;

/// Without one of its runs.
Slides without(const Slides& slides, std::size_t run) {
  Slides fewer;
  for (std::size_t k = 1; k < slides.size(); ++k) {
    const auto& next = slides[(run + k) % slides.size()];
    if (fewer.empty() || fewer.back().state != next.state) fewer.push_back(next);
  }
  if (fewer.size() > 1 && fewer.front().state == fewer.back().state) fewer.pop_back();
  return fewer;
}

/// By the shortest of the runs without which the longer sequence is the shorter one; where there is no such run, as in
/// symmetric orbits, which change in several places at once, by the shortest. In a burst of impacts there are shorter
/// ones.
Sliding kind_between(const Slides& a, const Slides& b, bool chatters) {
  const Slides& longer = a.size() > b.size() ? a : b;
  const Slides& shorter = a.size() > b.size() ? b : a;
  if (longer.size() == shorter.size()) return Sliding::unchanged;
  std::optional<std::size_t> added, shortest;
  for (std::size_t k = 0; k < longer.size(); ++k) {
    const auto briefer = [&](std::optional<std::size_t> other) {
      return !other || longer[k].duration < longer[*other].duration;
    };
    if (briefer(shortest)) shortest = k;
    if (briefer(added) && same_cycle(without(longer, k), shorter)) added = k;
  }
  if (!added && chatters) return Sliding::unchanged;
  const std::size_t run = added ? *added : *shortest, count = longer.size();
  return kind_of_run(longer[(run + count - 1) % count].state, longer[run].state, longer[(run + 1) % count].state);
}

/// Impacts and engagements over a cycle, of each stop.
std::vector<long> strikes(const Orbit& orbit) {
  std::vector<long> count(orbit.shape.legs[0].states.stops.size(), 0);
  for (const Leg& leg : orbit.shape.legs)
    for (const Motion::Strike& strike : leg.strikes)
      for (std::size_t stop = 0; stop < count.size(); ++stop) count[stop] += (strike.stops >> stop) & 1U;
  return count;
}

template <class State>
bool states_differ(const Orbit& a, const Orbit& b, std::vector<State> mode::ContactStates::*of) {
  for (std::size_t i = 0; i < (a.shape.legs[0].states.*of).size(); ++i) {
    const auto state = [i, of](const mode::ContactStates& states) { return (states.*of)[i]; };
    if (!same_cycle(runs<State>(a, state), runs<State>(b, state))) return true;
  }
  return false;
}

/// How many impacts of a complete chatter are legs of their own says nothing.
bool stops_differ(const Orbit& a, const Orbit& b) {
  if (chatters(a) + chatters(b) > 0) return false;
  return strikes(a) != strikes(b) || states_differ(a, b, &mode::ContactStates::stops) ||
         states_differ(a, b, &mode::ContactStates::compliant) || states_differ(a, b, &mode::ContactStates::pieces);
}

}  // namespace

SpecialType type_of(const TestValue& test, const Itinerary& shape) {
  if (test.test == Test::duration) return stick_at_stake(test, shape) >= 0 ? SpecialType::SL : SpecialType::CO;
  if (test.kind == mode::GuardKind::press) return SpecialType::GR;
  if (test.test == Test::no_stick || mode::of_friction(test.kind)) return SpecialType::SL;
  return SpecialType::GR;
}

UsedMargin used(const TestValue& test) {
  using Kind = UsedMargin::Kind;
  const Kind kind = test.test == Test::guard      ? Kind::least
                    : test.test == Test::speed    ? Kind::speed
                    : test.test == Test::duration ? Kind::duration
                                                  : Kind::no_stick;
  return {kind, test.leg, test.kind, test.contact, test.test == Test::guard && test.at == 0.0};
}

Sliding kind_of_sliding(const TestValue& test, const Itinerary& shape) {
  if (test.kind == mode::GuardKind::press) return Sliding::unchanged;
  if (test.test == Test::no_stick) return Sliding::crossing;
  if (test.test == Test::speed) return Sliding::unchanged;
  if (test.test == Test::guard) {
    if (test.kind == mode::GuardKind::slip) return Sliding::grazing;
    if (test.kind == mode::GuardKind::stick_above || test.kind == mode::GuardKind::stick_below)
      return test.at == 0.0 ? Sliding::switching : Sliding::adding;
    return Sliding::unchanged;
  }
  const int friction = stick_at_stake(test, shape);
  if (friction < 0) return Sliding::unchanged;
  const auto [before, leg, next] = about(shape, test.leg);
  const auto of = [friction](const Leg& which) { return which.states.frictions[friction]; };
  return kind_of_run(of(before), of(leg), of(next));
}

ChangeOfEvents compare_events(const Orbit& here, const Orbit& beyond) {
  ChangeOfEvents change;
  const bool chatter = chatters(here) + chatters(beyond) > 0;
  for (std::size_t i = 0; i < here.shape.legs[0].states.frictions.size(); ++i) {
    const auto of = [i](const mode::ContactStates& states) { return states.frictions[i]; };
    const Slides a = runs<FrictionState>(here, of), b = runs<FrictionState>(beyond, of);
    if (same_cycle(a, b)) continue;
    change.type = SpecialType::SL;
    if (change.sliding == Sliding::unchanged) change.sliding = kind_between(a, b, chatter);
  }
  if (stops_differ(here, beyond)) return {SpecialType::GR, Sliding::unchanged};
  return change;
}

}  // namespace slapstick::orbit
