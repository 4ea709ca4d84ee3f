/// Says which pair a picture shows, and where its stops are.
#include "relative_motion.hpp"

#include <tuple>
#include <utility>

#include "axis_text.hpp"

namespace slapstick::app {

std::pair<int, int> sides_of(
    const Model& model,
    int contact) {  // stops first, then friction contacts, then compliant stops, then characteristics
  const auto of = [](const auto& part) { return std::pair(part.a, part.b); };
  auto index = static_cast<std::size_t>(contact);
  if (index < model.stops.size()) return of(model.stops[index]);
  index -= model.stops.size();
  if (index < model.frictions.size()) return of(model.frictions[index]);
  index -= model.frictions.size();
  if (index < model.compliant_stops.size()) return of(model.compliant_stops[index]);
  return of(model.characteristics.at(index - model.compliant_stops.size()));
}

std::vector<double> limits_of(const Model& model, int a, int b) {
  std::vector<double> limits;
  const auto note = [&](const auto& stop) {
    if (stop.a == a && stop.b == b) limits.push_back(stop.clearance);
    if (stop.a == b && stop.b == a) limits.push_back(-stop.clearance);
  };
  for (const auto& stop : model.stops) note(stop);
  for (const auto& stop : model.compliant_stops) note(stop);
  return limits;
}

RelativeMotion::RelativeMotion(const Model& model, int contact) {
  if (contact >= 0) std::tie(a, b) = sides_of(model, contact);
  if (a == ground) std::swap(a, b);
  const auto names = state_names(model);
  const auto name = [&](int coordinate, int offset) {
    return axis_symbol(names[2 * static_cast<std::size_t>(coordinate) + offset]);
  };
  displacement = name(a, 0) + (b == ground ? "" : " \u2212 " + name(b, 0));
  velocity = name(a, 1) + (b == ground ? "" : " \u2212 " + name(b, 1));
  limits = limits_of(model, a, b);
}

}  // namespace slapstick::app
