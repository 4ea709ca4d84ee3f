/// Which events of an orbit are one instant's.
#include "orbit/ties.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick::orbit {
namespace {

bool has_length(const Orbit& orbit, std::size_t leg, double rounding) {
  return std::abs(orbit.duration(leg)) > rounding * (orbit.t.back() - orbit.t.front());
}

/// Does a slider begin or cease to slip at the end of a leg? Each moves itself only.
bool of_slider(const mode::Frame& frame, const Leg& leg) {
  return leg.ending == Ending::guard && frame.slider(leg.kind, leg.contact) != nullptr;
}

}  // namespace

double rounding_of_instants(double left) { return 100.0 * std::max(left, enough_step); }

void settle_ties(Orbit& orbit, double rounding) {
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    if (!orbit.tied(i)) continue;
    if (has_length(orbit, i, rounding))
      orbit.shape.legs[i].tied = false;
    else
      orbit.t[i + 1] = orbit.t[i];
  }
}

bool tie_sliders(const mode::Frame& frame, Orbit& orbit, double rounding) {
  bool any = false;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    Leg& leg = orbit.shape.legs[i];
    const Leg& before = orbit.shape.legs[(i + orbit.legs() - 1) % orbit.legs()];
    if (leg.tied || has_length(orbit, i, rounding) || before.contact == leg.contact) continue;
    if (!of_slider(frame, before) || !of_slider(frame, leg)) continue;
    any = leg.tied = true;
  }
  settle_ties(orbit, rounding);
  return any;
}

}  // namespace slapstick::orbit
