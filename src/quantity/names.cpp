/// Names the quantities of a model, with units and meanings.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "io/unit.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick {
namespace {

using Kind = Quantity::Kind;

/// The name, or where another quantity has it already NAME_2: nothing is left out, and the list shows both.
std::string free_name(const std::vector<Quantity>& all, const std::string& name) {
  const auto taken = [&](const std::string& wanted) {
    return std::any_of(all.begin(), all.end(), [&](const Quantity& one) { return one.name == wanted; });
  };
  std::string free = name;
  for (int k = 2; taken(free); ++k) free = name + "_" + std::to_string(k);
  return free;
}

/// Gathers quantities.
class List {
 public:
  explicit List(const Model& model) : model_(model) {}

  void coordinates();
  void contacts();
  void whole();
  void impacts();
  [[nodiscard]] std::vector<Quantity> take() { return std::move(all_); }

 private:
  void add(Kind kind, int index, const std::string& name, const std::string& meaning) {
    all_.push_back({kind, index, -1, 0.0, free_name(all_, name), "", meaning});
  }
  void of_stop(int contact, const std::string& name, bool rigid);
  void contact(int number, const std::string& name, const std::string& what, bool gap);

  const Model& model_;
  std::vector<Quantity> all_;
};

void List::coordinates() {
  const std::vector<std::string> names = state_names(model_);
  for (int i = 0; i < model_.size(); ++i) {
    const std::string &x = names[2 * static_cast<std::size_t>(i)], &v = names[2 * static_cast<std::size_t>(i) + 1];
    add(Kind::displacement, i, x, "displacement of " + x);
    add(Kind::velocity, i, v, "velocity of " + x);
    add(Kind::acceleration, i, "a" + v.substr(1), "acceleration of " + x + "; impacts are impulses in it");
  }
}

void List::contact(int number, const std::string& name, const std::string& what, bool gap) {
  if (gap) add(Kind::gap, number, "gap_" + name, "gap of " + what);
  add(Kind::relative, number, "w_" + name, "relative velocity of " + what);
}

void List::contacts() {
  int number = 0;
  for (const Stop& stop : model_.stops) {
    const std::string what = "stop " + stop.name;
    contact(number, stop.name, what, true);
    add(Kind::force, number, "F_" + stop.name, "press of " + what + ": 0 when open, impulses at impacts");
    add(Kind::power, number, "power_" + stop.name, "power that " + what + " takes: impulses at impacts");
    ++number;
  }
  for (const FrictionContact& friction : model_.frictions) {
    const std::string what = "friction contact " + friction.name;
    contact(number, friction.name, what, false);
    add(Kind::force, number, "F_" + friction.name, "force of " + what + ": friction in slip, the holding force in stick");
    add(Kind::power, number, "power_" + friction.name, "power that " + what + " dissipates");
    ++number;
  }
  for (const CompliantStop& stop : model_.compliant_stops) {
    const std::string what = "compliant stop " + stop.name;
    contact(number, stop.name, what, true);
    add(Kind::force, number, "F_" + stop.name, "press of " + what + ": 0 when it does not act");
    add(Kind::power, number, "power_" + stop.name, "power that " + what + " dissipates");
    ++number;
  }
  for (const Characteristic& one_of : model_.characteristics) {
    const std::string what = "characteristic " + one_of.name;
    contact(number, one_of.name, what, false);
    add(Kind::force, number, "F_" + one_of.name, "force of " + what);
    if (one_of.over != Characteristic::Over::displacement)
      add(Kind::power, number, "power_" + one_of.name, "power that " + what + " dissipates");
    ++number;
  }
}

void List::whole() {
  add(Kind::kinetic, -1, "kinetic_energy", "kinetic energy of all masses");
  add(Kind::potential, -1, "potential_energy", "energy in springs, compliant stops and characteristics");
  add(Kind::input, -1, "power_in", "power that forces and belts bring");
  if (!model_.dampers.empty() || !model_.damping.empty())
    add(Kind::damping, -1, "power_damping", "power that dampers and the damping matrix dissipate");
}

void List::impacts() {
  const bool rigid = !model_.stops.empty();
  if (!rigid && model_.compliant_stops.empty()) return;
  add(Kind::speed, -1, "w", "at impacts of all stops: speed just before");
  if (rigid) add(Kind::impulse, -1, "impulse", "at impacts of all rigid stops: impulse of the stop");
  if (rigid) add(Kind::loss, -1, "energy_lost", "at impacts of all rigid stops: energy lost");
  add(Kind::flight, -1, "flight", "at impacts: time since the impact before, in forcing periods");
  add(Kind::sliding, -1, "sliding", "at impacts: time of slip since the impact before, in forcing periods");
  for (std::size_t i = 0; i < model_.stops.size(); ++i) of_stop(static_cast<int>(i), model_.stops[i].name, true);
  const auto first = model_.stops.size() + model_.frictions.size();
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i)
    of_stop(static_cast<int>(first + i), model_.compliant_stops[i].name, false);
}

/// The same of one stop. `w_NAME` is its relative velocity at any time, so the speed of its impacts is `speed_NAME`.
void List::of_stop(int contact, const std::string& name, bool rigid) {
  const std::string at = rigid ? "at impacts of " + name + ": " : "when " + name + " is met: ";
  add(Kind::speed, contact, "speed_" + name, at + "speed just before");
  if (rigid) add(Kind::impulse, contact, "impulse_" + name, at + "impulse");
  if (rigid) add(Kind::loss, contact, "energy_lost_" + name, at + "energy lost");
  add(Kind::flight, contact, "flight_" + name, at + "time since the one before, in forcing periods");
  add(Kind::sliding, contact, "sliding_" + name, at + "time of slip since the one before, in forcing periods");
}

/// mass length^a / time^b, by its name where it has one: N, mJ, kW.
std::string composed(const StatedUnits& stated, const std::string& length, int a, int b) {
  if (stated.mass.empty() || stated.time.empty() || length.empty()) return "";
  const std::string over = length + (a == 2 ? "^2/" : "/") + stated.time + "^" + std::to_string(b);
  const Unit whole = parse_unit(stated.mass + " " + over);
  for (const char* name : {"N", "mN", "kN", "MN", "J", "mJ", "kJ", "W", "kW"})
    if (const Unit known = parse_unit(name); known.powers == whole.powers && std::abs(known.factor / whole.factor - 1.0) < 1e-12) return name;
  return stated.mass + " " + over;
}

/// The unit of a quantity where lengths are `length`; those of forces and energies as far as the file states a mass.
std::string unit_of(const Quantity& quantity, const std::string& length, const StatedUnits& stated) {
  const std::string& time = stated.time;
  const auto over_time = [&](const char* power) { return length.empty() || time.empty() ? "" : length + "/" + time + power; };
  const std::string force = composed(stated, length, 1, 2);
  switch (quantity.kind) {
    case Kind::displacement:
    case Kind::gap:
      return length;
    case Kind::velocity:
    case Kind::relative:
    case Kind::speed:
      return over_time("");
    case Kind::acceleration:
      return over_time("^2");
    case Kind::force:
      return force;
    case Kind::power:
    case Kind::damping:
    case Kind::input:
      return composed(stated, length, 2, 3);
    case Kind::kinetic:
    case Kind::potential:
    case Kind::loss:
      return composed(stated, length, 2, 2);
    case Kind::impulse:
      return force.empty() ? "" : force + " " + time;
    case Kind::flight:
    case Kind::sliding:
    case Kind::parameter:
      return "";
  }
  return "";
}

/// The unit of all coordinates, if they have one.
std::string common(const std::vector<std::string>& units) {
  const bool one = !units.empty() && std::all_of(units.begin(), units.end(), [&](const auto& unit) { return unit == units[0]; });
  return one ? units.front() : "";
}

const Quantity* known(const std::vector<Quantity>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

bool has_difference(Kind kind) { return kind <= Kind::force; }

}  // namespace

std::string_view name(Quantity::Kind kind) {
  constexpr std::array<std::string_view, 17> words = {
      "displacement", "velocity", "acceleration", "gap",    "velocity", "force",  "power",  "power",    "power",
      "energy",       "energy",   "impact",       "impact", "impact",   "impact", "impact", "parameter"};
  return words[static_cast<std::size_t>(kind)];
}

std::vector<Quantity> quantities(const Model& model) {
  List list(model);
  list.coordinates();
  list.contacts();
  list.whole();
  list.impacts();
  return list.take();
}

std::vector<Quantity> quantities(const ModelDefinition& definition, const Overrides& overrides) {
  std::vector<Quantity> all = quantities(definition.build(overrides));
  const StatedUnits stated = definition.stated_units();
  for (Quantity& one : all) {
    const bool own = one.kind <= Kind::acceleration;
    one.unit = unit_of(one, own ? stated.coordinates[static_cast<std::size_t>(one.index)] : common(stated.coordinates),
                       stated);
  }
  const auto values = definition.values(overrides);
  for (const Parameter& parameter : definition.parameters())
    all.push_back({Kind::parameter, -1, -1, values.at(parameter.name), free_name(all, parameter.name), parameter.unit, parameter.description});
  return all;
}

Quantity find_quantity(const std::vector<Quantity>& all, const std::string& name) {
  if (const Quantity* const one = known(all, name)) return *one;
  for (std::size_t dash = name.find('-'); dash != std::string::npos; dash = name.find('-', dash + 1)) {
    const Quantity *const a = known(all, name.substr(0, dash)), *const b = known(all, name.substr(dash + 1));
    if (a == nullptr || b == nullptr) continue;
    if (a->kind != b->kind || !has_difference(a->kind))
      throw InputError(in_quotes(name) + ": a difference is of two displacements, velocities, accelerations, gaps or forces");
    return {a->kind, a->index, b->index, 0.0, name, a->unit == b->unit ? a->unit : "", a->meaning + ", minus " + b->meaning};
  }
  std::vector<std::string> names;
  for (const Quantity& one : all) names.push_back(one.name);
  throw InputError("no quantity " + in_quotes(name) + suggestion(name, names) + " ('slapstick quantities' lists them)");
}

}  // namespace slapstick
