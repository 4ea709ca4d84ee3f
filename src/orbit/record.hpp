#pragma once
/// From motions to orbits: the shape of a cycle as a motion shows it, and whether an orbit is one.
#include <optional>

#include "orbit/event_reader.hpp"
#include "orbit/mode_set.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

class Problem;

/// The orbit of n periods (0: of a free motion) from the first of these events to number k. Its equations need not be
/// met.
[[nodiscard]] Orbit orbit_of(const std::vector<Seen>& events, std::size_t k, int n);

/// An orbit of the shape that a motion has from its first event on: over the n periods after it, up to the same event
/// in the same modes nearest to n periods later (n = 0: up to the event nearest in state, within 400 events). Its
/// equations need not be met.
/// @returns empty if there is no such event, or the motion grazes; an orbit with one leg if there are no events within
/// n periods
[[nodiscard]] std::optional<Orbit> record(const Motion& start, int n, const std::atomic<bool>* stop = nullptr);

/// A motion that starts inside a leg, after this part of its length.
[[nodiscard]] Motion from_inside(const System& system, const ModeSet& set, const Orbit& orbit, std::size_t leg,
                                 double part);

struct Verification {
  bool is_motion = false;
  bool same_chatter = true;  ///< false: the same except for the number of impacts before a chatter is summed
  Orbit seen;                ///< then: the motion's own; without legs if its cycle was not found
  std::string why;           ///< "event 3: slip- pad where the orbit has stick pad"
};

/// Runs the certified simulator over every leg of a cycle, from the middle of each leg in which least is held to the
/// next, and compares events, modes and instants. Piece by piece, so that an unstable orbit is not lost on the way.
/// @param system  of the orbit's own parameters
[[nodiscard]] Verification verify(const System& system, const Orbit& orbit);

/// The same at the orbit's own parameters; false where there is no model.
[[nodiscard]] bool is_motion(const Problem& problem, const Orbit& orbit);

}  // namespace slapstick::orbit
