/// Reads --event, and says what the return map of these events shows.
#include "event_options.hpp"

#include <vector>

#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"
#include "base/text.hpp"
#include "stop_options.hpp"

namespace slapstick::app {
namespace {

using enum EventKind;
using Kinds = std::vector<EventKind>;

const Kinds of_stop = {impact, stick, release, graze, chatter};
const Kinds of_friction = {slip_plus, slip_minus, stick, release, graze};
const Kinds of_compliant_stop = {engage, disengage, separate};

bool holds(const Kinds& kinds, EventKind kind) { return ranges::find(kinds, kind) != kinds.end(); }

bool is_friction(const Model& model, int contact) {
  const int first = static_cast<int>(model.stops.size());
  return contact >= first && contact < first + static_cast<int>(model.frictions.size());
}

/// The kinds of event that the chosen contact can have, or any contact.
Kinds possible(const EventChoice& events, const Model& model) {
  const auto stops = static_cast<int>(model.stops.size());
  const auto chosen = [&](const Kinds& kinds) {
    if (!events.contact)
      return &kinds == &of_stop       ? !model.stops.empty()
             : &kinds == &of_friction ? !model.frictions.empty()
                                      : !model.compliant_stops.empty();
    const int contact = *events.contact;
    return &kinds == (contact < stops ? &of_stop : is_friction(model, contact) ? &of_friction : &of_compliant_stop);
  };
  Kinds all;
  for (std::size_t k = 0; k < event_kinds; ++k)
    for (const Kinds* kinds : {&of_stop, &of_friction, &of_compliant_stop})
      if (const auto kind = static_cast<EventKind>(k); chosen(*kinds) && holds(*kinds, kind) && !holds(all, kind))
        all.push_back(kind);
  return all;
}

}  // namespace

EventChoice event_choice(const std::string& text, const System& system) {
  EventChoice events;
  try {
    events = parse_event_choice(text, system);
  } catch (const InputError& error) {
    throw InputError("--event: " + std::string(error.what()));
  }
  const Kinds kinds = possible(events, system.model());
  if (holds(kinds, events.kind)) return events;
  std::string known;
  for (const EventKind kind : kinds) known += (known.empty() ? "" : ", ") + std::string(name(kind));
  throw InputError("--event: " +
                   (events.contact ? "contact " + in_quotes(system.contact_name(*events.contact))
                                   : "model " + in_quotes(system.model().name)) +
                   " cannot have " + in_quotes(std::string(name(events.kind))) +
                   (known.empty() ? ", it has no contacts" : "; it can have " + known));
}

int mapped_contact(const EventChoice& events, const Model& model) {
  if (events.contact) return *events.contact;
  if (holds(of_friction, events.kind) && !model.frictions.empty()) return static_cast<int>(model.stops.size());
  return shown_contact(model, {});
}

Mapped mapped_quantity(const EventChoice& events, const Model& model) {
  if (is_friction(model, mapped_contact(events, model))) return Mapped::displacement;
  return holds({impact, engage, disengage, separate}, events.kind) ? Mapped::w : Mapped::return_time;
}

}  // namespace slapstick::app
