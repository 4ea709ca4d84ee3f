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

/// How many complete chatters has a cycle?
[[nodiscard]] int chatters(const Orbit& orbit);
/// Do impacts of one stop, and slips between them, lead from this leg to a chatter's sum? How many are flown one by one
/// does not matter.
[[nodiscard]] bool in_burst(const Orbit& orbit, std::size_t leg);
/// Is it one of those that are too short for their length and margins to be more than rounding?
[[nodiscard]] bool fades(const Orbit& orbit, std::size_t leg);
/// How many legs, except for those of bursts, shrink from one orbit of a shape to another to less than a part of their
/// lengths.
[[nodiscard]] int legs_shrunk(const Orbit& from, const Orbit& to, double left);
/// .. to next to nothing.
[[nodiscard]] inline int legs_gone(const Orbit& from, const Orbit& to) { return legs_shrunk(from, to, 0.1); }

}  // namespace slapstick::orbit
