/// Says which pair a picture shows, and where its stops are.
#include "relative_motion.hpp"

#include <cmath>
#include <utility>

#include "axis_text.hpp"
#include "base/text.hpp"

namespace slapstick::app {

// Stops first, then friction contacts, then compliant stops, then characteristics.
Sides sides_of(const Model& model, int contact) {
  const auto of = [](const auto& part) { return Sides{part.a, part.b, part.ratio}; };
  auto index = static_cast<std::size_t>(contact);
  if (index < model.stops.size()) return of(model.stops[index]);
  index -= model.stops.size();
  if (index < model.frictions.size()) return of(model.frictions[index]);
  index -= model.frictions.size();
  if (index < model.compliant_stops.size()) return of(model.compliant_stops[index]);
  return of(model.characteristics.at(index - model.compliant_stops.size()));
}

std::vector<double> limits_of(const Model& model, const Sides& sides) {
  std::vector<double> limits;
  const auto note = [&](const auto& stop) {
    if (const int sense = same_pair(stop, sides); sense != 0) limits.push_back(sense * stop.clearance);
  };
  for (const auto& stop : model.stops) note(stop);
  for (const auto& stop : model.compliant_stops) note(stop);
  return limits;
}

RelativeMotion::RelativeMotion(const Model& model, int contact) {
  if (contact >= 0) static_cast<Sides&>(*this) = sides_of(model, contact);
  if (a == ground) {
    std::swap(a, b);
    std::swap(ratio.a, ratio.b);
  }
  const auto names = state_names(model);
  const auto name = [&](int coordinate, double by, int offset) {
    return (by == 1.0 ? "" : shown(by) + " ") + axis_symbol(names[2 * static_cast<std::size_t>(coordinate) + offset]);
  };
  const auto difference = [&](int offset) {
    const std::string first = name(a, ratio.a, offset);
    if (b == ground) return first;
    return first + (ratio.b < 0.0 ? " + " : " \u2212 ") + name(b, std::abs(ratio.b), offset);
  };
  displacement = difference(0);
  velocity = difference(1);
  limits = limits_of(model, *this);
}

}  // namespace slapstick::app
