#pragma once
/// Legs of an orbit that have hardly a length: those of a chatter's burst, and those that shrink to nothing along a
/// branch. A leg without length solves its equation anywhere, so every search along a branch asks for them.
///
/// Legs of a burst are short by nature, and tied legs have no length at all: neither counts as *shrunk*.
#include <vector>

#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// How many complete chatters has a cycle?
[[nodiscard]] int chatters(const Orbit& orbit);
/// Do impacts of one stop, and slips between them, lead from this leg to a chatter's sum? How many are flown one by one
/// does not matter.
[[nodiscard]] bool in_burst(const Orbit& orbit, std::size_t leg);
/// Is a leg of a burst too short for its length and margins to be more than rounding?
[[nodiscard]] bool is_rounding_leg(const Orbit& orbit, std::size_t leg);

/// Is a leg, outside of bursts, shorter than this part of the cycle?
[[nodiscard]] bool has_leg_below(const Orbit& orbit, double part);
/// How many legs, from one orbit of a shape to another, shrink to less than this part of their lengths?
[[nodiscard]] int shrunk_legs(const Orbit& from, const Orbit& to, double part);
constexpr double dead = 1e-2;        ///< of a leg's length
constexpr double hardly_left = 0.1;  ///< of a leg that dies with another, as the root of the way to there
/// Which legs die on the way from one orbit of a shape to another, so that less than this part of their length is left?
[[nodiscard]] std::vector<bool> dead_legs(const Orbit& from, const Orbit& to, double part = dead);
/// .. and the tied legs before and after them, which end at the same instant: where sliders of one pair turn back
/// together.
[[nodiscard]] std::vector<bool> with_ties(const Orbit& orbit, std::vector<bool> dead);

}  // namespace slapstick::orbit
