/// Which unit of time the numbers of a model without [scale] are in.
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/elementary.hpp"
#include "io/definition.hpp"
#include "io/scale.hpp"
#include "io/unit.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

constexpr std::array<const char*, 8> lengths = {"m", "km", "cm", "mm", "um", "nm", "in", "ft"};
constexpr std::array<const char*, 5> times = {"s", "ms", "us", "min", "h"};
constexpr std::array<const char*, 4> masses = {"kg", "g", "mg", "t"};

/// The numbers of a model, each with its power of time.
std::vector<std::pair<double, int>> numbers_of(const Model& model) {
  std::vector<std::pair<double, int>> all = {{model.omega, -1}};
  const auto add = [&](double number, int power) { all.emplace_back(number, power); };
  for (const Coordinate& coordinate : model.coordinates) add(coordinate.mass, 0);
  for (const Spring& spring : model.springs) add(spring.stiffness, -2);
  for (const Damper& damper : model.dampers) add(damper.coefficient, -1);
  for (const Force& force : model.forces) add(force.amplitude, -2), add(force.phase, 0);
  for (const FrictionContact& friction : model.frictions) {
    add(friction.belt_speed, -1);
    const int force = friction.normal ? 0 : -2;  // a coefficient has no unit
    add(friction.static_friction, force), add(friction.kinetic_friction, force);
    if (!friction.normal) continue;
    add(friction.normal->constant, -2);
    for (const NormalForce::Term& term : friction.normal->terms) add(term.stiffness, -2), add(term.damping, -1);
  }
  for (const Stop& stop : model.stops) {
    add(stop.clearance, 0), add(stop.restitution, 0);
    for (const Stop::Corner& corner : stop.corners) add(corner.speed, -1), add(corner.restitution, 0);
  }
  for (const CompliantStop& stop : model.compliant_stops)
    add(stop.clearance, 0), add(stop.stiffness, -2), add(stop.damping, -1);
  for (const Characteristic& one_of : model.characteristics) {
    const bool zones = one_of.over == Characteristic::Over::zones;
    const int time = one_of.over == Characteristic::Over::velocity ? -1 : 0;
    for (const Characteristic::Corner& corner : one_of.corners)
      add(corner.at, time), add(corner.force, zones ? -1 : -2);
    add(one_of.slope_below, zones ? -1 : -2 - time), add(one_of.slope_above, zones ? -1 : -2 - time);
  }
  for (const double number : model.mass) add(number, 0);
  for (const double number : model.damping) add(number, -1);
  for (const double number : model.stiffness) add(number, -2);
  return all;
}

/// By Euler's theorem on homogeneous functions: sum over the parameters p with b powers of time, b p dN/dp = power N
/// for every number N of the model.
bool changes_with_time(const ModelDefinition& definition) {
  constexpr double power_rounding = 1e-9;
  const std::map<std::string, double> values = definition.values();
  const auto wanted = numbers_of(definition.build());
  std::vector<double> sums(wanted.size(), 0.0);
  bool any = false;
  for (const Parameter& parameter : definition.parameters()) {
    if (parameter.unit.empty() || !parameter.expression.empty()) continue;  // an expression follows its parameters
    const int power = parse_unit(parameter.unit).powers[1];
    const double value = values.at(parameter.name);
    if (power == 0 || value == 0.0) continue;
    any = true;
    const auto rates = numbers_of(definition.rate(parameter.name));
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += power * value * rates[i].first;
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (!(std::abs(sums[i] - wanted[i].second * wanted[i].first) <= power_rounding * std::abs(wanted[i].first)))
      return false;
  return any;
}

/// The only units of time and of mass with which all these are products of one unit of length, one of time and one of
/// mass; empty where there is no such unit, or several.
std::pair<std::string, std::string> common_system(const std::vector<Unit>& units) {
  std::set<std::string> found, found_masses;
  for (const char* length : lengths)
    for (const char* time : times)
      for (const char* mass : masses) {
        const std::array<double, 3> one = {parse_unit(length).factor, parse_unit(time).factor, parse_unit(mass).factor};
        bool all = true;
        for (const Unit& unit : units) {
          double product = 1.0;
          for (std::size_t i = 0; i < 3; ++i) product *= fixed::power(one[i], unit.powers[i]);
          all = all && std::abs(unit.factor / product - 1.0) < 1e-12;
        }
        if (all) found.insert(time), found_masses.insert(mass);
      }
  const auto only = [](const std::set<std::string>& one) { return one.size() == 1 ? *one.begin() : std::string(); };
  return {only(found), only(found_masses)};
}

}  // namespace

StatedUnits ModelDefinition::stated_units() const {
  StatedUnits stated;
  std::vector<Unit> units;
  for (const Part& coordinate : definition_->of("coordinate")) {
    const auto own = coordinate.texts.find("unit");
    const bool none = own == coordinate.texts.end() || own->second == "1" || !definition_->scale.empty();
    stated.coordinates.push_back(none ? "" : own->second);
    if (!none && parse_unit(own->second).powers != Unit{}.powers) units.push_back(parse_unit(own->second));
  }
  for (const char* kind : {"maxwell", "jenkins"})
    for (const Part& element : definition_->of(kind)) {
      const std::string own = unit_of_inner(*definition_, element);
      stated.coordinates.push_back(own == "1" || !definition_->scale.empty() ? "" : own);
    }
  if (!definition_->scale.empty()) return stated;
  for (const Parameter& parameter : parameters())
    if (!parameter.unit.empty() && parse_unit(parameter.unit).powers != Unit{}.powers)
      units.push_back(parse_unit(parameter.unit));
  const auto [time, mass] = common_system(units);
  if (time.empty()) return stated;
  try {
    if (changes_with_time(*this)) stated.time = time, stated.mass = mass;
  } catch (const InputError&) {  // a kink: it has no rate
  }
  return stated;
}

}  // namespace slapstick
