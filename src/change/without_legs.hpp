#pragma once
/// An orbit without some of its legs: those that have shrunk to nothing, and the events that are no more with them.
#include <vector>

#include "orbit/mode_set.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// The cycle of one leg without its event, from phase 0.
[[nodiscard]] Orbit uncut(const ModeSet& set, const Orbit& orbit);

/// Leaves out `count` legs, the first of them `leg`; and `count` events and states, the first those at the end of leg
/// 0.
void leave_out(Orbit& orbit, std::ptrdiff_t leg, std::ptrdiff_t count);

/// An orbit with fewer legs, and the legs of the longer one that begin with the same events; none for a cycle without
/// events.
struct Shortened {
  Orbit orbit;
  std::vector<std::size_t> starts;
};

/// Without the dead legs. Between two legs of one mode: those are one leg. Between two stops of one velocity:
/// the second is the first's. Between another event and an impact that keeps a speed: the impact is all. Between two
/// crossings of one line: what lies between them.
/// @param dead  of each leg: has it no length?
/// @param impacts_stay  impacts keep their speed
/// @returns the orbit with one run of such legs left out, with two .. : the shortest first
[[nodiscard]] std::vector<Shortened> shortened(const ModeSet& set, const Orbit& orbit, const std::vector<bool>& dead,
                                               bool impacts_stay);
[[nodiscard]] std::vector<Orbit> without_legs(const ModeSet& set, const Orbit& orbit, const std::vector<bool>& dead,
                                              bool impacts_stay);

}  // namespace slapstick::orbit
