/// Says what a picture of a motion shows.
#include "shown_motion.hpp"

#include <numeric>

#include "axis_text.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick::app {
namespace {

std::string time_axis(const ChosenModel& chosen) {
  return chosen.model.forced() ? "t / T" : with_unit("t", AxisUnits(chosen.definition, chosen.model).time());
}

double entry(const State& state, int coordinate, int offset) {
  return coordinate < 0 ? 0.0 : state[2 * static_cast<std::size_t>(coordinate) + static_cast<std::size_t>(offset)];
}

/// "x_{1} − x_{2}"
std::string symbols(const std::string& name) {
  const std::size_t minus = name.find('-');
  if (minus == std::string::npos) return axis_symbol(name);
  return axis_symbol(name.substr(0, minus)) + " \u2212 " + axis_symbol(name.substr(minus + 1));
}

double clearance_of(const Model& model, int contact) {
  const auto index = static_cast<std::size_t>(contact);
  if (index < model.stops.size()) return model.stops[index].clearance;
  return model.compliant_stops.at(index - model.stops.size() - model.frictions.size()).clearance;
}

double belt_speed_of(const Model& model, int contact) {
  const std::size_t index = static_cast<std::size_t>(contact) - model.stops.size();
  return index < model.frictions.size() ? model.frictions[index].belt_speed : 0.0;
}

/// The number of a contact that is a gap or a relative velocity.
std::function<double(const State&)> of_contact(const Model& model, const Quantity& quantity, int contact) {
  const Sides sides = sides_of(model, contact);
  if (quantity.kind == Quantity::Kind::gap)
    return [sides, clearance = clearance_of(model, contact)](const State& state) {
      return clearance - relative(sides, state, 0);
    };
  return [sides, belt = belt_speed_of(model, contact)](const State& state) { return relative(sides, state, 1) - belt; };
}

ShownNumber number_of(const std::string& name, const std::vector<Quantity>& all, const Model& model) {
  using Kind = Quantity::Kind;
  Quantity quantity;
  try {
    quantity = find_quantity(all, name);
  } catch (const InputError& error) {
    throw InputError("--show: " + error.message());
  }
  ShownNumber shown{with_unit(symbols(quantity.name), quantity.unit), {}, {}};
  if (quantity.kind == Kind::displacement || quantity.kind == Kind::velocity) {
    const int offset = quantity.kind == Kind::velocity ? 1 : 0;
    shown.of = [a = quantity.index, b = quantity.minus, offset](const State& state) {
      return entry(state, a, offset) - entry(state, b, offset);
    };
    if (offset == 0) shown.limits = limits_of(model, {quantity.index, quantity.minus < 0 ? ground : quantity.minus});
  } else if (quantity.kind == Kind::gap || quantity.kind == Kind::relative) {
    shown.of = of_contact(model, quantity, quantity.index);
    if (quantity.minus >= 0)
      shown.of = [first = shown.of, second = of_contact(model, quantity, quantity.minus)](const State& state) {
        return first(state) - second(state);
      };
    if (quantity.kind == Kind::gap) shown.limits = {0.0};
  } else {
    throw InputError("--show: " + in_quotes(name) +
                     " is no displacement, velocity or gap; `measure` and the tables know the others");
  }
  return shown;
}

}  // namespace

std::vector<int> all_contacts(const Model& model) {
  std::vector<int> all(model.stops.size() + model.frictions.size() + model.compliant_stops.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> contacts_of(const RelativeMotion& pair, const Model& model) {
  std::vector<int> contacts = all_contacts(model);
  std::erase_if(contacts, [&](int contact) { return same_pair(sides_of(model, contact), pair) == 0; });
  return contacts;
}

ShownMotion shown_pair(const RelativeMotion& pair, const ChosenModel& chosen) {
  const AxisUnits units(chosen.definition, chosen.model);
  ShownMotion shown{.contacts = contacts_of(pair, chosen.model), .time = time_axis(chosen)};
  shown.numbers.push_back({with_unit(pair.displacement, units.displacement(pair)),
                           [pair](const State& state) { return pair.y(state); }, pair.limits});
  shown.numbers.push_back(
      {with_unit(pair.velocity, units.velocity(pair)), [pair](const State& state) { return pair.w(state); }, {}});
  shown.panels = {{0, 1}, {ShownPanel::time, 0}, {ShownPanel::time, 1}};
  return shown;
}

ShownMotion shown_by_name(const std::string& text, const std::vector<int>& contacts, const ChosenModel& chosen) {
  const std::vector<Quantity> all = quantities(chosen.definition, chosen.overrides);
  ShownMotion shown{.contacts = contacts, .time = time_axis(chosen)};
  std::vector<std::string> names;
  const auto index_of = [&](const std::string& name) {
    const auto known = ranges::find(names, name);
    if (known != names.end()) return static_cast<int>(known - names.begin());
    shown.numbers.push_back(number_of(name, all, chosen.model));
    names.push_back(name);
    return static_cast<int>(names.size()) - 1;
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t colon = one.find(':');
    if (colon == std::string::npos) {
      shown.panels.push_back({ShownPanel::time, index_of(one)});
    } else {
      const int x = index_of(one.substr(0, colon));
      shown.panels.push_back({x, index_of(one.substr(colon + 1))});
    }
  }
  constexpr std::size_t most = 12;
  if (shown.panels.size() > most) throw InputError("--show: a picture has at most 12 panels");
  return shown;
}

}  // namespace slapstick::app
