#pragma once
/// Runs of the engine in the form in which tests compare them event by event; oracle_runs.hpp has those of the oracle.
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::testing {

/// SLAPSTICK_CAMPAIGN=N makes the long tests N times as long.
inline long campaign() {
  const char* scale = std::getenv("SLAPSTICK_CAMPAIGN");
  return scale == nullptr ? 1 : std::max(1L, std::atol(scale));
}

inline Instant after(const Motion& motion, double time) { return motion.time().plus(time / motion.system().period()); }

/// All events of the next `time` time units.
inline std::vector<Event> run(Motion& motion, double time, long most = 10'000'000) {
  std::vector<Event> events;
  const Instant end = after(motion, time);
  while (most-- > 0 && motion.advance(end) == Outcome::event) events.push_back(motion.event());
  return events;
}

inline std::string kinds(const std::vector<Event>& events) {
  std::string all;
  for (const Event& event : events) all += std::string(all.empty() ? "" : " ") + std::string(name(event.kind));
  return all;
}

inline double seconds(const Event& event, const Motion& motion) { return event.time.seconds(motion.system().period()); }

/// One event as both programs see it.
struct Seen {
  std::string kind;
  bool at_stop = false;
  double time = 0.0;
  double w = 0.0;
};

/// The engine's events, one per instant (the first), without grazes of forces: the oracle's convention.
inline std::vector<Seen> engine_events(Motion& motion, double time, std::size_t most = 10'000'000) {
  std::vector<Seen> seen;
  const Instant start = motion.time(), end = after(motion, time);
  const auto stops = static_cast<int>(motion.system().model().stops.size());
  Instant last{-1, 0.0};
  for (std::size_t all = 0; all < most + 100 && seen.size() < most && motion.advance(end) == Outcome::event; ++all) {
    const Event& event = motion.event();
    const bool force = motion.engine().hit_guard() != nullptr &&
                       motion.engine().hit_guard()->kind != mode::GuardKind::gap &&
                       motion.engine().hit_guard()->kind != mode::GuardKind::slip;
    if ((event.time == last && event.kind != EventKind::chatter) || (event.kind == EventKind::graze && force)) continue;
    last = event.time;
    seen.push_back({std::string(name(event.kind)), event.contact < stops,
                    event.time.since(start) * motion.system().period(), event.w});
  }
  return seen;
}

/// Compares two lists; the oracle bounces on for longer than the engine before it sums a chatter, and those bounces are
/// passed over.
struct Comparison {
  std::size_t events = 0;
  double worst = 0.0;    ///< largest difference of two times
  std::string mismatch;  ///< the first event that differs in kind, or empty
};

inline Comparison compare(const std::vector<Seen>& engine, const std::vector<Seen>& reference) {
  Comparison result;
  std::size_t j = 0;
  const auto text = [](const Seen& e) {
    return e.kind + (e.at_stop ? " (stop) at " : " (friction) at ") + std::to_string(e.time);
  };
  for (std::size_t i = 0; i < engine.size(); ++i, ++j) {
    while (engine[i].kind == "chatter" && j < reference.size() && reference[j].kind != "chatter") ++j;
    if (j >= reference.size() || engine[i].kind != reference[j].kind || engine[i].at_stop != reference[j].at_stop) {
      result.mismatch = "event " + std::to_string(i) + ": " + text(engine[i]) + " instead of " +
                        (j < reference.size() ? text(reference[j]) : "nothing");
      return result;
    }
    result.worst = std::max(result.worst, std::abs(engine[i].time - reference[j].time));
    ++result.events;
  }
  if (j < reference.size()) result.mismatch = "missing: " + text(reference[j]);
  return result;
}

}  // namespace slapstick::testing
