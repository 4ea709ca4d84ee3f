#pragma once
/// An event that comes to pass a point of a signal: the two change places.
#include <vector>

#include "orbit/mode_set.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// Where a leg has shrunk to nothing between an event and a point of a signal, in either order: the orbit in the other
/// order, with a leg of no length between the two. The contacts' states are then those of the other side of the event,
/// since a point at which none changes does not ask for their mode.
/// @param dead  of each leg: has it no length?
[[nodiscard]] std::vector<Orbit> past_knots(const ModeSet& set, const Orbit& orbit, const std::vector<bool>& dead);

/// Does nothing happen at the point of a signal that ends a leg: no pulse, no step, and the same slope on both sides?
/// Such points are there so that no line is too long (mode/drive.hpp), or stand on a straight line of a file.
[[nodiscard]] bool is_idle_knot(const Model& model, const Itinerary& shape, std::size_t leg);

}  // namespace slapstick::orbit
