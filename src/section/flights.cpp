/// Walks a motion from one change of its mode to the next.
#include "section/flights.hpp"

#include "flow/compiled_system.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {

double patience(const System& system) {
  constexpr double windows = 1e6;
  return windows / system.windows_per_period();
}

std::optional<FlightKind> next_change(Motion& motion, Stop stop) {
  const long seen = motion.counters().segments;
  const Instant end = motion.time().plus(patience(motion.system()));
  Instant stage = motion.time();
  while (!stopped(stop)) {
    stage = next_stage(motion.system(), stage, end);
    if (motion.advance(stage) != Outcome::event) {
      if (stage >= end) return std::nullopt;
      continue;
    }
    const Event& event = motion.event();
    if (motion.counters().segments == seen) continue;  // a further event of the instant before
    if (event.kind == EventKind::graze) continue;
    const bool changes = event.kind == EventKind::chatter || motion.segment().mode != motion.mode_id();
    if (changes || !motion.strikes().empty()) return FlightKind{motion.mode_id(), event.kind, event.contact};
  }
  return std::nullopt;
}

std::optional<Flight> next_flight(Motion& motion, const std::optional<FlightKind>& kind, Stop stop) {
  std::optional<FlightKind> begun = next_change(motion, stop);
  while (begun) {
    Flight flight{*begun, motion, motion.time(), {}};
    begun = next_change(motion, stop);
    flight.end = motion.time();
    if (begun && (!kind || flight.kind == *kind) && flight.begin < flight.end) return flight;
  }
  return std::nullopt;
}

int held(const System& system, ModeId mode) {
  int count = 0;
  for (int i = 0; i < system.compiled().frame().n; ++i) count += system.compiled().mode(mode).steady(i);
  return count;
}

}  // namespace slapstick::section
