/// Reads --event, and says what the return map of these events shows.
#include "event_options.hpp"

#include <set>
#include <vector>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "stop_options.hpp"

namespace slapstick::app {
namespace {

using enum EventKind;
using Kinds = std::vector<EventKind>;

bool holds(const Kinds& kinds, EventKind kind) { return ranges::find(kinds, kind) != kinds.end(); }

bool is_friction(const Model& model, int contact) {
  const int first = static_cast<int>(model.stops.size());
  return contact >= first && contact < first + static_cast<int>(model.frictions.size());
}

/// The kinds of event that a contact can have.
Kinds kinds_of(const Model& model, std::size_t contact) {
  if (contact < model.stops.size()) return {impact, stick, release, graze, chatter};
  contact -= model.stops.size();
  if (contact < model.frictions.size()) {
    Kinds kinds = {slip_plus, slip_minus, stick, release, graze};
    if (model.frictions[contact].normal) kinds.insert(kinds.end(), {unload, load});
    return kinds;
  }
  contact -= model.frictions.size();
  if (contact >= model.compliant_stops.size()) return {corner, graze};
  Kinds kinds = {engage, disengage, separate};
  if (model.compliant_stops[contact].bounded) kinds.push_back(corner);
  return kinds;
}

/// The kinds of event that the chosen contact can have, or any contact, in the order of their enumeration.
Kinds possible(const EventChoice& events, const Model& model) {
  const std::size_t contacts =
      model.stops.size() + model.frictions.size() + model.compliant_stops.size() + model.characteristics.size();
  std::set<EventKind> all;
  for (std::size_t contact = 0; contact < contacts; ++contact) {
    if (events.contact && static_cast<std::size_t>(*events.contact) != contact) continue;
    for (const EventKind kind : kinds_of(model, contact)) all.insert(kind);
  }
  return {all.begin(), all.end()};
}

}  // namespace

EventChoice event_choice(const std::string& text, const System& system, const std::string& argument) {
  EventChoice events;
  try {
    events = parse_event_choice(text, system);
  } catch (const InputError& error) {
    throw InputError(argument + ": " + std::string(error.what()));
  }
  const Kinds kinds = possible(events, system.model());
  if (holds(kinds, events.kind)) return events;
  std::string known;
  for (const EventKind kind : kinds) known += (known.empty() ? "" : ", ") + std::string(name(kind));
  throw InputError(argument + ": " +
                   (events.contact ? "contact " + in_quotes(system.contact_name(*events.contact))
                                   : "model " + in_quotes(system.model().name)) +
                   " cannot have " + in_quotes(name(events.kind)) +
                   (known.empty() ? ", and the model has no contacts" : "; the model can have " + known));
}

int mapped_contact(const EventChoice& events, const Model& model) {
  if (events.contact) return *events.contact;
  const std::size_t friction = model.stops.size();
  if (!model.frictions.empty() && holds(kinds_of(model, friction), events.kind)) return static_cast<int>(friction);
  return shown_contact(model, {});
}

Mapped mapped_quantity(const EventChoice& events, const Model& model) {
  if (is_friction(model, mapped_contact(events, model))) return Mapped::displacement;
  return holds({impact, engage, disengage, separate}, events.kind) ? Mapped::w : Mapped::return_time;
}

}  // namespace slapstick::app
