#pragma once
/// The contact state with which a leg begins: that of the leg before, with what the mode holds still set to what it
/// holds.
#include "orbit/mode_flow.hpp"
#include "orbit/mode_set.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// Of an extended jet. Held are velocities, zero or a belt's, and the gaps of closed stops, zero. Contacts whose number
/// is not among the first n are held by what is least to change of the others.
/// @param next  the leg that begins
[[nodiscard]] Jet contact_jet(const ModeSet& set, const Leg& next, const Jet& X);

}  // namespace slapstick::orbit
