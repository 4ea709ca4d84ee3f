#pragma once
/// Cycles begin at any of their events: comparisons that do not depend on which.
#include <cstddef>

#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// Can b be begun at an event from which on its legs are those of a, and alike(shift) holds? Leg i of a is then leg
/// (i + shift) mod k of b.
template <class Alike>
bool from_some_event(const Orbit& a, const Orbit& b, const Alike& alike) {
  const std::size_t k = a.legs();
  if (b.legs() != k) return false;
  for (std::size_t shift = 0; shift < k; ++shift) {
    std::size_t same = 0;
    while (same < k && a.shape.legs[same] == b.shape.legs[(same + shift) % k]) ++same;
    if (same == k && alike(shift)) return true;
  }
  return false;
}

/// Do two cycles have the same legs, wherever they begin?
[[nodiscard]] inline bool same_cycle(const Orbit& a, const Orbit& b) {
  return from_some_event(a, b, [](std::size_t) { return true; });
}

}  // namespace slapstick::orbit
