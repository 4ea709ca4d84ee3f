#pragma once
/// The events of a batch's run held against those of a Motion.
#include <cmath>
#include <string>
#include <vector>

#include "slapstick/flow/motion.hpp"
#include "slapstick/sweep/batch.hpp"

namespace slapstick {

/// All events of a Motion up to `periods`, in windows of at most `cap` periods.
inline std::vector<Event> events_of(const Model& model, const State& start, int periods, double cap = INFINITY) {
  const System system(model, {cap});
  Motion motion(system, start);
  std::vector<Event> events;
  while (motion.advance({periods, 0.0}) == Outcome::event) events.push_back(motion.event());
  return events;
}

/// How many events agree in kind, contact and time, to `tolerance` periods, before the first that does not.
inline std::size_t agreeing(const std::vector<Event>& a, const std::vector<Event>& b, double tolerance) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && a[i].kind == b[i].kind && a[i].contact == b[i].contact &&
         std::abs(a[i].time.since(b[i].time)) <= tolerance)
    ++i;
  return i;
}

inline std::string text_of(const Event& event) {
  return std::string(name(event.kind)) + " of " + std::to_string(event.contact) + " at " +
         std::to_string(event.time.period) + " + " + std::to_string(event.time.fraction) + " w " +
         std::to_string(event.w);
}

}  // namespace slapstick
