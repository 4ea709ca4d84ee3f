#pragma once
/// An event that comes to pass a point of a signal: the two change places.
#include <vector>

#include "orbit/mode_set.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// Where a leg has shrunk to nothing between an event and a point of a signal, in either order: the orbit in the other
/// order, with a leg of no length between the two. The contacts' states are then those of the other side of the event,
/// since a point at which none changes does not ask for their mode.
/// @param gone  of each leg: has it no length?
[[nodiscard]] std::vector<Orbit> past_knots(const ModeSet& set, const Orbit& orbit, const std::vector<bool>& gone);

}  // namespace slapstick::orbit
