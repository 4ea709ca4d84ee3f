#pragma once
/// What events and states of a motion leave behind as named values, for the expressions of entries.
#include "library/case.hpp"

namespace slapstick::library {

inline Instant after(const Motion& motion, double time) { return motion.time().plus(time / motion.system().period()); }

/// Is this event a `kind`? "impact", "impact@stop" (of the contact of that name), "turn" (any velocity reversal),
/// "event" (anything).
bool is(const Event& event, const std::string& kind, const System& system);

/// The state by its names, each with the suffix.
void note_state(Values& values, const System& system, std::span<const double> state, const std::string& suffix);

/// The last event of a motion: t, phase, w and the state just before it, each with the suffix.
void note_event(Values& values, const Motion& motion, const std::string& suffix);

/// impacts, chatters, sticks, turns, engagements and largest_stick: zero, and after one more event.
void start_counts(Values& values);
void count(const Motion& motion, Values& values);

}  // namespace slapstick::library
