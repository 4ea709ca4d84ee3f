/// Turns the end of a mode into events, by the rules of flow/engine_events.cpp.
#include "batch/report.hpp"

namespace slapstick::batch {

using mode::CompliantState;
using mode::FrictionState;
using mode::StopState;

namespace {

EventKind kind_of(const Action& action, const mode::ContactStates& old, const mode::ContactStates& now) {
  switch (action.jump) {
    case Jump::impact:
      return EventKind::impact;
    case Jump::land:
    case Jump::let_off: {
      const auto i = static_cast<std::size_t>(action.stop);
      const bool pushes = action.jump == Jump::let_off && old.compliant[i] == CompliantState::detached;
      if (old.compliant[i] == CompliantState::off || pushes) return EventKind::engage;
      return old.compliant[i] == CompliantState::detached ? EventKind::separate : EventKind::disengage;
    }
    default:
      (void)now;
      return EventKind::release;
  }
}

/// Contacts that the event has let go on other pairs than its own.
void report_released(const Action& action, const mode::Frame& frame, const mode::ContactStates& old, const mode::ContactStates& now, Event event,
                     std::vector<Event>& events) {
  if (old.stops.size() + old.frictions.size() < 3) return;
  const bool on_pair = action.jump != Jump::land && action.jump != Jump::let_off;
  const auto of_event = [&](const mode::ContactRow& contact) { return on_pair && contact.own == action.own; };
  event.kind = EventKind::release;
  event.w = 0.0;
  for (std::size_t i = 0; i < now.frictions.size(); ++i) {
    event.contact = static_cast<int>(old.stops.size() + i);
    if (old.frictions[i] == FrictionState::stick && now.frictions[i] != FrictionState::stick && !of_event(frame.frictions[i])) events.push_back(event);
  }
  for (std::size_t i = 0; i < now.stops.size(); ++i) {
    event.contact = static_cast<int>(i);
    const bool struck = action.jump == Jump::impact && static_cast<std::size_t>(action.stop) == i;
    if (old.stops[i] == StopState::closed && now.stops[i] == StopState::open && !struck && !of_event(frame.stops[i])) events.push_back(event);
  }
}

}  // namespace

void report(const Shape& shape, const mode::Frame& frame, int mode, int slot, int side, int next, Instant time, double w,
            std::vector<Event>& events) {
  const Action& action = shape.action_of(mode, slot, side);
  const mode::ContactStates old = states_of(shape, mode), now = states_of(shape, next);
  Event event{EventKind::impact, action.contact, time, w, 0.0};
  if (action.jump != Jump::rest) {
    event.kind = kind_of(action, old, now);
    events.push_back(event);
  }
  event.w = 0.0;
  bool stuck = false;
  for (std::size_t i = 0; i < now.frictions.size(); ++i) {
    event.contact = shape.stops + static_cast<int>(i);
    const bool sticks = now.frictions[i] == FrictionState::stick, stuck_before = old.frictions[i] == FrictionState::stick;
    const bool itself = action.jump == Jump::rest && action.contact == event.contact;
    event.kind = sticks ? EventKind::stick : now.frictions[i] == FrictionState::slip_plus ? EventKind::slip_plus : EventKind::slip_minus;
    const bool turned = action.jump == Jump::rest && !sticks && (itself || (old.frictions[i] != now.frictions[i] && !stuck_before));
    if (turned || (sticks && !stuck_before)) events.push_back(event);
    stuck = stuck || (sticks && !stuck_before);
  }
  event.kind = EventKind::stick;
  for (std::size_t i = 0; i < now.stops.size() && !stuck; ++i) {
    event.contact = static_cast<int>(i);
    if (now.stops[i] == StopState::closed && old.stops[i] == StopState::open) events.push_back(event);
  }
  report_released(action, frame, old, now, event, events);
}

}  // namespace slapstick::batch
