/// Says what a picture of a motion shows.
#include "shown_motion.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

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

/// "x_{1} − x_{2}"
std::string symbols(const std::string& name) {
  const std::size_t minus = name.find('-');
  if (minus == std::string::npos) return axis_symbol(name);
  return axis_symbol(name.substr(0, minus)) + " \u2212 " + axis_symbol(name.substr(minus + 1));
}

/// The quantity of a name, which is also added to those that the picture reads.
ShownNumber number_of(const std::string& name, const std::vector<Quantity>& all, const Model& model,
                      ShownMotion& shown) {
  using Kind = Quantity::Kind;
  Quantity quantity;
  try {
    quantity = find_quantity(all, name);
  } catch (const InputError& error) {
    throw InputError("--show: " + error.message());
  }
  if (quantity.at_impacts())
    throw InputError("--show: " + in_quotes(name) + " has values at impacts only; `measure` and `poincare` know it");
  ShownNumber number{with_unit(symbols(quantity.name), quantity.unit), {{shown.of.size()}}, {}};
  if (quantity.kind == Kind::displacement)
    number.limits = limits_of(model, {quantity.index, quantity.minus < 0 ? ground : quantity.minus});
  if (quantity.kind == Kind::gap) number.limits = {0.0};
  shown.of.push_back(std::move(quantity));
  return number;
}

/// r_a x_a - r_b x_b, or the same of the velocities.
ShownNumber number_of(const RelativeMotion& pair, Quantity::Kind kind, const std::string& label, ShownMotion& shown) {
  ShownNumber number{label, {}, {}};
  const auto add = [&](int coordinate, double factor) {
    if (coordinate == ground) return;
    number.terms.push_back({shown.of.size(), factor});
    Quantity quantity;
    quantity.kind = kind;
    quantity.index = coordinate;
    shown.of.push_back(std::move(quantity));
  };
  add(pair.a, pair.ratio.a);
  add(pair.b, -pair.ratio.b);
  return number;
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
  using Kind = Quantity::Kind;
  shown.numbers.push_back(
      number_of(pair, Kind::displacement, with_unit(pair.displacement, units.displacement(pair)), shown));
  shown.numbers.back().limits = pair.limits;
  shown.numbers.push_back(number_of(pair, Kind::velocity, with_unit(pair.velocity, units.velocity(pair)), shown));
  shown.panels = {{0, 1}, {ShownPanel::time, 0}, {ShownPanel::time, 1}};
  return shown;
}

namespace {

/// The numbers of --show, each once.
class Named {
 public:
  Named(const ChosenModel& chosen, ShownMotion& shown)
      : chosen_(chosen), all_(quantities(chosen.definition, chosen.overrides)), shown_(shown) {}

  int index_of(const std::string& name) {
    const auto known = ranges::find(names_, name);
    if (known == names_.end()) add(name);
    return static_cast<int>(ranges::find(names_, name) - names_.begin());
  }

  /// After all: the observer's quantities are the last, and observables behind them.
  void add_observer() {
    if (observed_.empty()) return;
    shown_.observer = std::make_shared<Observer>(chosen_.definition.observer(chosen_.overrides));
    for (const Quantity& one : shown_.observer->quantities()) shown_.of.push_back(one);
    for (const auto& [number, observable] : observed_) shown_.numbers[number].terms = {{shown_.of.size() + observable}};
  }

 private:
  void add(const std::string& name) {
    const std::vector<Observable>& observables = chosen_.definition.observables();
    const auto observable = ranges::find(observables, name, &Observable::name);
    names_.push_back(name);
    if (observable == observables.end()) return shown_.numbers.push_back(number_of(name, all_, chosen_.model, shown_));
    observed_.emplace_back(shown_.numbers.size(), static_cast<std::size_t>(observable - observables.begin()));
    shown_.numbers.push_back({with_unit(symbols(name), observable->unit), {}, {}});
  }

  const ChosenModel& chosen_;
  std::vector<Quantity> all_;
  ShownMotion& shown_;
  std::vector<std::string> names_;
  std::vector<std::pair<std::size_t, std::size_t>> observed_;  ///< number, observable
};

}  // namespace

ShownMotion shown_by_name(const std::string& text, const std::vector<int>& contacts, const ChosenModel& chosen) {
  ShownMotion shown{.contacts = contacts, .time = time_axis(chosen)};
  Named named(chosen, shown);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t colon = one.find(':');
    if (colon == std::string::npos) {
      shown.panels.push_back({ShownPanel::time, named.index_of(one)});
    } else {
      const int x = named.index_of(one.substr(0, colon));
      shown.panels.push_back({x, named.index_of(one.substr(colon + 1))});
    }
  }
  named.add_observer();
  constexpr std::size_t most = 12;
  if (shown.panels.size() > most) throw InputError("--show: a picture has at most 12 panels");
  return shown;
}

}  // namespace slapstick::app
