/// Turns the end of a mode into events, by the rules of flow/changes.hpp.
#include "batch/report.hpp"

#include "flow/changes.hpp"

namespace slapstick::batch {

using mode::CompliantState;
using mode::GuardKind;

namespace {

/// A compliant stop at its gap, or whose force has come to zero.
EventKind kind_of(const Action& action, CompliantState old) {
  const bool pushes = action.jump == Jump::force_zero && old == CompliantState::detached;
  if (old == CompliantState::off || pushes) return EventKind::engage;
  return old == CompliantState::detached ? EventKind::separate : EventKind::disengage;
}

/// What has ended, as a guard of a motion.
flow::Ended ended_of(const Shape& shape, const Action& action, const mode::ContactStates& old) {
  flow::Ended ended;
  ended.contact = action.contact;
  switch (action.jump) {
    case Jump::impact:
      ended.kind = GuardKind::gap;
      ended.struck = std::uint32_t{1} << action.stop;
      break;
    case Jump::gap_zero:
    case Jump::force_zero:
      ended.kind = GuardKind::engage;
      ended.contact = action.stop;
      ended.own = kind_of(action, old.compliant[static_cast<std::size_t>(action.stop)]);
      break;
    case Jump::velocity_zero:
      ended.kind = GuardKind::slip;
      ended.reversal = true;
      break;
    default:
      ended.kind = action.contact < shape.stops ? GuardKind::press : GuardKind::stick_above;
      ended.own = EventKind::release;
  }
  if (mode::of_friction(*ended.kind)) ended.contact -= shape.stops;
  return ended;
}

}  // namespace

void report(const Shape& shape, const Model& model, const mode::Frame& frame, const Ending& ending, int next,
            Instant time, const double* u, std::vector<Event>& events) {
  const Action& action = shape.action_of(ending.mode, ending.slot, ending.side);
  const mode::ContactStates old = states_of(shape, ending.mode), now = states_of(shape, next);
  if (action.jump == Jump::impact) events.push_back({EventKind::impact, action.contact, time, ending.w, 0.0});
  const auto tell = [&](EventKind kind, int contact) {
    const int compliant = contact - shape.stops - shape.frictions;
    double w = 0.0;
    if (compliant >= 0) {
      const mode::ContactRow& row = frame.compliant[static_cast<std::size_t>(compliant)];
      w = contact == action.contact ? ending.w : row.sign * u[row.own];
    }
    events.push_back({kind, contact, time, w, 0.0});
  };
  flow::Changes(model, frame, ended_of(shape, action, old), old, now, tell).tell();
}

}  // namespace slapstick::batch
