/// Bursts of chatter by their events, shrunk legs by their lengths.
#include "orbit/short_legs.hpp"

#include <bit>
#include <cmath>

#include "base/ranges.hpp"

namespace slapstick::orbit {
namespace {

double cycle_length(const Orbit& orbit) { return orbit.t.back() - orbit.t.front(); }

/// Has the leg a length that a branch may take from it?
bool may_shrink(const Orbit& orbit, std::size_t leg) { return !orbit.tied(leg) && !in_burst(orbit, leg); }

bool has_shrunk(const Orbit& from, const Orbit& to, std::size_t leg, double part) {
  return may_shrink(to, leg) && to.duration(leg) < part * from.duration(leg);
}

}  // namespace

int chatters(const Orbit& orbit) {
  int count = 0;
  for (const Leg& leg : orbit.shape.legs)
    if (leg.ending == Ending::chatter) count += std::popcount(leg.chattering);
  return count;
}

bool in_burst(const Orbit& orbit, std::size_t leg) {
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const Leg& next = orbit.shape.legs[(leg + i) % orbit.legs()];
    if (next.ending == Ending::chatter) return true;
    if (next.ending == Ending::cut || next.ending == Ending::knot) return false;
    if (next.kind != mode::GuardKind::gap && next.kind != mode::GuardKind::slip) return false;
  }
  return false;
}

bool is_rounding_leg(const Orbit& orbit, std::size_t leg) {
  constexpr double short_flight = 1e-6;  // of a cycle
  return in_burst(orbit, leg) && std::abs(orbit.duration(leg)) < short_flight * cycle_length(orbit);
}

bool has_leg_below(const Orbit& orbit, double part) {
  for (std::size_t leg = 0; leg < orbit.legs(); ++leg)
    if (may_shrink(orbit, leg) && std::abs(orbit.duration(leg)) < part * cycle_length(orbit)) return true;
  return false;
}

int shrunk_legs(const Orbit& from, const Orbit& to, double part) {
  int count = 0;
  for (std::size_t leg = 0; leg < to.legs(); ++leg) count += has_shrunk(from, to, leg, part) ? 1 : 0;
  return count;
}

std::vector<bool> dead_legs(const Orbit& from, const Orbit& to, double part) {
  std::vector<bool> all;
  for (std::size_t leg = 0; leg < to.legs(); ++leg) all.push_back(has_shrunk(from, to, leg, part));
  return all;
}

std::vector<bool> with_ties(const Orbit& orbit, std::vector<bool> dead) {
  const std::size_t legs = orbit.legs();
  for (std::size_t i = 0; i < 2 * legs; ++i) {
    const std::size_t after = i % legs, before = (2 * legs - 1 - i) % legs;
    if (orbit.tied(after) && dead[(after + legs - 1) % legs]) dead[after] = true;
    if (orbit.tied(before) && dead[(before + 1) % legs]) dead[before] = true;
  }
  return dead;
}

}  // namespace slapstick::orbit
