/// The quantities of a model file: units as far as the file states them, and the parameters.
#include <algorithm>
#include <cmath>

#include "io/unit.hpp"
#include "model/free_name.hpp"
#include "quantity/units.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick {
namespace {

using Kind = Quantity::Kind;

/// mass length^a / time^b, by its name where it has one: N, mJ, kW.
std::string composed(const StatedUnits& stated, const std::string& length, int a, int b) {
  if (stated.mass.empty() || stated.time.empty() || length.empty()) return "";
  const std::string over = length + (a == 2 ? "^2/" : "/") + stated.time + "^" + std::to_string(b);
  const Unit whole = parse_unit(stated.mass + " " + over);
  for (const char* name : {"N", "mN", "kN", "MN", "J", "mJ", "kJ", "W", "kW"})
    if (const Unit known = parse_unit(name);
        known.powers == whole.powers && std::abs(known.factor / whole.factor - 1.0) < 1e-12)
      return name;
  return stated.mass + " " + over;
}

/// Of some link: the lengths of its y then may have any unit.
bool has_ratios(const Model& model) {
  const auto some = [](const auto& links) {
    return std::any_of(links.begin(), links.end(), [](const auto& link) { return has_ratio(link); });
  };
  return some(model.springs) || some(model.dampers) || some(model.frictions) || some(model.stops) ||
         some(model.compliant_stops) || some(model.characteristics);
}

}  // namespace

namespace quantity {

std::array<int, 3> dimensions(const Quantity& quantity) {
  switch (quantity.kind) {
    case Kind::displacement:
    case Kind::gap:
      return {1, 0, 0};
    case Kind::velocity:
    case Kind::relative:
    case Kind::speed:
      return {1, -1, 0};
    case Kind::acceleration:
      return {1, -2, 0};
    case Kind::force:
    case Kind::normal:
      return {1, -2, 1};
    case Kind::power:
    case Kind::damping:
    case Kind::input:
      return {2, -3, 1};
    case Kind::kinetic:
    case Kind::potential:
    case Kind::loss:
      return {2, -2, 1};
    case Kind::impulse:
      return {1, -1, 1};
    case Kind::flight:
    case Kind::sliding:
    case Kind::parameter:
      break;
  }
  return {0, 0, 0};
}

std::string unit_of(const Quantity& quantity, const std::string& length, const StatedUnits& stated) {
  const auto [a, b, mass] = dimensions(quantity);
  if (a == 0 || length.empty()) return "";
  if (quantity.kind == Kind::impulse) {
    const std::string force = composed(stated, length, 1, 2);
    return force.empty() ? "" : force + " " + stated.time;
  }
  if (mass != 0) return composed(stated, length, a, -b);
  if (b == 0) return length;
  return stated.time.empty() ? "" : length + "/" + stated.time + (b == -2 ? "^2" : "");
}

std::string common_unit(const std::vector<std::string>& units) {
  const bool one =
      !units.empty() && std::all_of(units.begin(), units.end(), [&](const auto& unit) { return unit == units[0]; });
  return one ? units.front() : "";
}

}  // namespace quantity

std::vector<Quantity> quantities(const ModelDefinition& definition, const Overrides& overrides) {
  const Model model = definition.build(overrides);
  std::vector<Quantity> all = quantities(model);
  const StatedUnits stated = definition.stated_units();
  const std::string common = has_ratios(model) ? "" : quantity::common_unit(stated.coordinates);
  for (Quantity& one : all) {
    const bool own = one.kind <= Kind::acceleration;
    one.unit = quantity::unit_of(one, own ? stated.coordinates[static_cast<std::size_t>(one.index)] : common, stated);
  }
  const auto values = definition.values(overrides);
  for (const Parameter& parameter : definition.parameters())
    all.push_back({Kind::parameter, -1, -1, values.at(parameter.name), free_name(all, parameter.name), parameter.unit,
                   parameter.description});
  return all;
}

}  // namespace slapstick
