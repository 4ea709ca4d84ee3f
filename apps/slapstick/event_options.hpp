#pragma once
/// --event: which events are points of the event section, and what their return map shows.
#include <string>

#include "slapstick/section/event_section.hpp"

namespace slapstick::app {

/// Reads "stick", "release:belt". @throws InputError naming the argument, also of a kind that the contact, or every
/// contact of the model, cannot have
[[nodiscard]] EventChoice event_choice(const std::string& text, const System& system,
                                       const std::string& argument = "--event");

/// What the return map of these events is drawn in. At a stop the displacement is its clearance, always.
enum class Mapped {
  displacement,  ///< of friction contacts
  w,             ///< of impacts, and where a compliant stop begins or ends to act
  return_time    ///< at a stop with w = 0
};
[[nodiscard]] Mapped mapped_quantity(const EventChoice& events, const Model& model);

/// The contact whose displacement it is.
[[nodiscard]] int mapped_contact(const EventChoice& events, const Model& model);

}  // namespace slapstick::app
