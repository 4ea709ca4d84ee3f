#pragma once
/// A motion flight by flight: from one change of mode, or impact, to the next. What changes nothing, as a graze, ends
/// no flight.
#include <optional>

#include "section/return_map.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::section {

/// What a flight begins with, and the mode that it is in.
struct FlightKind {
  ModeId mode = 0;
  EventKind event = EventKind::impact;
  int contact = 0;
  friend bool operator==(const FlightKind&, const FlightKind&) = default;
};

/// A flight, and the motion just after its beginning.
struct Flight {
  FlightKind kind;
  Motion at_begin;
  Instant begin, end;
  [[nodiscard]] Instant middle() const { return begin.plus(0.5 * end.since(begin)); }
};

/// Is a coordinate or velocity beyond 1e100? No machine's is, and the squares of such numbers overflow soon.
[[nodiscard]] bool beyond_bounds(const Motion& motion);

/// How long a motion is waited for that has no event, in periods: some million windows, a fraction of a second.
[[nodiscard]] double patience(const System& system);

/// Moves a motion on to the next end of a flight. @returns the kind of the flight that begins there; nothing if it is
/// proven that there is no next end (section/outlook.hpp), if none comes within `patience`, beyond bounds, or if
/// stopped
[[nodiscard]] std::optional<FlightKind> next_change(Motion& motion, Stop stop);

/// Flights of other kinds after which one is no longer waited for: the motion has left it. With fewer a kind that comes
/// rarely would be given up, with more a motion that has left it is flown in vain for more than a second.
constexpr int most_others = 10'000;

/// Moves on to the end of the next flight of positive length that is of the kind, or of any.
/// @returns nothing if the motion goes on in one mode, has left the kind, or was stopped
[[nodiscard]] std::optional<Flight> next_flight(Motion& motion, const std::optional<FlightKind>& kind, Stop stop);

/// How many pairs a mode holds: relative velocities of contacts in stick, and of closed stops.
[[nodiscard]] int held(const System& system, ModeId mode);

}  // namespace slapstick::section
