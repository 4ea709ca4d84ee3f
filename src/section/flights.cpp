/// Walks a motion from one change of its mode to the next.
#include "section/flights.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "section/outlook.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {

double patience(const System& system) {
  constexpr double windows = 1e6;
  return windows / system.windows_per_period();
}

namespace {

/// Whether it is proven that no event follows.
bool ends(const Motion& motion) { return outlook(flow::Translations(motion.system()), motion).no_event; }

double largest_number(const Motion& motion) {
  double largest = 0.0;
  const std::span<const double> X = motion.engine().extended();
  for (const double x : X.first(2 * static_cast<std::size_t>(motion.system().compiled().frame().d)))
    largest = std::max(largest, std::abs(x));
  return largest;
}

/// When a flight without an event is asked about: after 1024 windows and four times as many each time, so that asking
/// costs less than flying; before if the motion has grown much, so that nothing overflows.
class Looks {
 public:
  explicit Looks(const Motion& motion)
      : start_(motion.time()), each_(1.0 / motion.system().windows_per_period()), size_(largest_number(motion)) {}

  [[nodiscard]] Instant next() const { return start_.plus(windows_ * each_); }
  /// At `next`. Shall it be asked?
  bool pass(const Motion& motion) {
    constexpr double first_look = 1024.0, great_growth = 1e6;
    const bool asks = windows_ >= first_look || largest_number(motion) > great_growth * size_;
    windows_ *= 4.0;
    return asks;
  }

 private:
  Instant start_;
  double each_, size_, windows_ = 64.0;
};

}  // namespace

bool beyond_bounds(const Motion& motion) {
  constexpr double bound = 1e100;
  return largest_number(motion) > bound;
}

std::optional<FlightKind> next_change(Motion& motion, Stop stop) {
  const System system = motion.system();
  const long seen = motion.counters().segments;
  const Instant end = motion.time().plus(patience(system));
  Looks looks(motion);
  if (system.compiled().mode(motion.mode_id()).guards().empty()) return std::nullopt;
  while (!stopped(stop)) {
    const Instant stage = std::min(next_stage(system, motion.time(), end), looks.next());
    if (motion.advance(stage) != Outcome::event) {
      if (stage >= end) return std::nullopt;
      if (stage < looks.next()) continue;
      if (looks.pass(motion) && ends(motion)) return std::nullopt;
      continue;
    }
    const Event& event = motion.event();
    if (motion.counters().segments == seen) continue;  // a further event of the instant before
    if (event.kind == EventKind::graze) continue;
    const bool changes = event.kind == EventKind::chatter || motion.segment().mode != motion.mode_id();
    if (beyond_bounds(motion)) return std::nullopt;
    if (changes || !motion.strikes().empty()) return FlightKind{motion.mode_id(), event.kind, event.contact};
  }
  return std::nullopt;
}

std::optional<Flight> next_flight(Motion& motion, const std::optional<FlightKind>& kind, Stop stop) {
  std::optional<FlightKind> begun = next_change(motion, stop);
  for (int others = 0; begun && others < most_others; ++others) {
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
