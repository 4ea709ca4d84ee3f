/// Compares, rotates and describes sequences of events.
#include "slapstick/orbit/itinerary.hpp"

#include <algorithm>

#include "base/ranges.hpp"

namespace slapstick::orbit {

bool same_end(const Leg& a, const Leg& b) {
  const auto same_strike = [](const Motion::Strike& p, const Motion::Strike& q) {
    return p.stops == q.stops && p.to_rest == q.to_rest;
  };
  const bool cut = a.ending == Ending::cut, has_guard = !cut && a.ending != Ending::knot;
  return a.ending == b.ending && (!has_guard || a.kind == b.kind) && (cut || a.contact == b.contact) &&
         a.chattering == b.chattering && ranges::equal(a.strikes, b.strikes, same_strike);
}

bool operator==(const Leg& a, const Leg& b) { return a.states == b.states && a.lines == b.lines && same_end(a, b); }

void rotate(Orbit& orbit, std::size_t first) {
  const std::size_t k = orbit.legs();
  const double cycle = orbit.t[k] - orbit.t[0];
  std::vector<double> t(orbit.t.begin() + static_cast<std::ptrdiff_t>(first), orbit.t.end() - 1);
  for (std::size_t i = 0; i <= first; ++i) t.push_back(orbit.t[i] + cycle);
  const double zero = orbit.shape.n == 0 ? t.front() : 0.0;
  for (double& instant : t) instant -= zero;
  orbit.t = std::move(t);
  std::vector<Leg>& legs = orbit.shape.legs;
  std::rotate(orbit.x.begin(), orbit.x.begin() + static_cast<std::ptrdiff_t>(first), orbit.x.end());
  std::rotate(legs.begin(), legs.begin() + static_cast<std::ptrdiff_t>(first), legs.end());
}

std::vector<std::size_t> ended_at_start(const Itinerary& shape, std::size_t leg) {
  const std::size_t k = shape.legs.size();
  std::vector<std::size_t> ended;
  do {
    leg = (leg + k - 1) % k;
    ended.push_back(leg);
  } while (shape.legs[leg].tied && ended.size() < k);
  return ended;
}

std::vector<std::size_t> ended_at_end(const Itinerary& shape, std::size_t leg) {
  const std::size_t k = shape.legs.size();
  std::vector<std::size_t> ended = {leg};
  for (std::size_t next = (leg + 1) % k; shape.legs[next].tied && ended.size() < k; next = (next + 1) % k)
    ended.push_back(next);
  return ended;
}

bool differentiable(const Itinerary& shape) { return ranges::all_of(shape.legs, &Leg::differentiable); }

int returns(const Itinerary& shape) {
  const auto alike = [](const Leg& a, const Leg& b) {
    return a.states == b.states && a.event == b.event && a.event_contact == b.event_contact;
  };
  std::ptrdiff_t rarest = 0;
  for (const Leg& leg : shape.legs) {
    if (leg.ending == Ending::cut) continue;
    const auto count =
        std::count_if(shape.legs.begin(), shape.legs.end(), [&](const Leg& other) { return alike(leg, other); });
    rarest = rarest == 0 ? count : std::min(rarest, count);
  }
  return static_cast<int>(rarest);
}

std::string describe(const Itinerary& shape, const System& system) {
  std::string text;
  for (const Leg& leg : shape.legs) {
    if (leg.ending == Ending::cut) return "no events";
    text += (text.empty() ? "" : ", ") + std::string(name(leg.event)) + " " + system.contact_name(leg.event_contact);
  }
  return text;
}

}  // namespace slapstick::orbit
