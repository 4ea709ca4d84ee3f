/// Evaluates the observables of a model file along a motion.
#include "slapstick/io/observer.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "io/model_builder.hpp"
#include "io/observed.hpp"
#include "model/fault.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

bool names_quantity(const Definition& definition, const std::string& name) {
  if (std::find(definition.observed.begin(), definition.observed.end(), name) != definition.observed.end())
    return false;
  for (const Part& part : definition.of("coordinate"))
    if (name == "a" + velocity_name(part.name).substr(1)) return true;
  const auto& rules = quantity_rules();
  return std::any_of(rules.begin(), rules.end(), [&](const QuantityRule& rule) {
    const std::size_t at = rule.name.find("NAME");
    if (at == std::string_view::npos) return name == rule.name;
    const bool known = rule.of == QuantityRule::Of::coordinate || rule.kind == Quantity::Kind::gap;  // all are observed
    return at > 0 && !known && name.size() > at && name.starts_with(rule.name.substr(0, at));
  });
}

std::vector<std::string> observable_names(const Definition& definition, const std::string& expression) {
  std::vector<std::string> all = definition.observed;
  try {
    const Expression read(expression);
    for (const std::string& name : read.names())
      if (names_quantity(definition, name)) all.push_back(name);
  } catch (const InputError&) {  // who reads the expression says what is wrong
  }
  return all;
}

std::vector<Quantity> observed_quantities(const Definition& definition, const Model& model) {
  const std::vector<Quantity> all = quantities(model);
  std::vector<Quantity> found;
  for (const auto& part : definition.of("observable")) {
    const Scalar& scalar = part.fields.find("value")->second;
    if (!scalar.expression) continue;
    for (const std::string& name : scalar.expression->names()) {
      const auto same = [&](const Quantity& one) { return one.name == name; };
      if (!names_quantity(definition, name) || std::any_of(found.begin(), found.end(), same)) continue;
      try {
        found.push_back(find_quantity(all, name));
      } catch (const InputError& error) {
        throw InputError(definition.place(scalar.line), "observable " + in_quotes(part.name) + ": " + error.message());
      }
      if (found.back().at_impacts())
        throw InputError(definition.place(scalar.line), "observable " + in_quotes(part.name) + ": " + in_quotes(name) +
                                                            " is a quantity at impacts: no function of time");
    }
  }
  return found;
}

struct Observer::Parts {
  Parts(std::shared_ptr<const Definition> from, Values numbers)
      : definition(std::move(from)),
        parameters(std::move(numbers)),
        builder(*definition, parameters),
        names(parameters) {
    model = builder.model();
    for (const auto& name : state_names(model)) states.push_back(&names[name]);
    for (const auto& base : definition->of("base")) bases.push_back(&names[base.name]);
    for (const auto& stop : model.stops) gap(stop);
    for (const auto& stop : model.compliant_stops) gap(stop);
    time = &names["time"];
    for (const Quantity& quantity : observed_quantities(*definition, model)) {
      quantities.push_back(quantity);
      read_there.push_back(&names[quantity.name]);
    }
    values.resize(definition->of("observable").size());
  }

  template <class AnyStop>
  void gap(const AnyStop& stop) {
    gaps.push_back({&names[gap_name(stop.name)], stop.a, stop.b, stop.ratio, stop.clearance});
  }

  struct Gap {
    double* value;
    int a, b;
    Ratio ratio;
    double clearance;
  };

  std::shared_ptr<const Definition> definition;
  Values parameters;
  ModelBuilder builder;
  Model model;
  Values names;  // everything that an expression may name; the pointers below point into it
  std::vector<double*> states, bases;
  std::vector<Gap> gaps;
  std::vector<Quantity> quantities;
  std::vector<double*> read_there;  // of the quantities
  double* time = nullptr;
  std::vector<double> values;
};

Observer::Observer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Observer::~Observer() = default;
Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;

const std::vector<Quantity>& Observer::quantities() const { return parts_->quantities; }

const std::vector<double>& Observer::read(double time, const State& state, const std::vector<double>& numbers) {
  auto& parts = *parts_;
  if (numbers.size() != parts.quantities.size())
    throw InputError("observer: " + std::to_string(parts.quantities.size()) + " quantities are needed, not " +
                     std::to_string(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) *parts.read_there[i] = numbers[i];
  const auto& observables = parts.definition->of("observable");
  for (std::size_t i = 0; i < parts.states.size(); ++i) *parts.states[i] = state[i];
  for (std::size_t k = 0; k < parts.bases.size(); ++k) *parts.bases[k] = parts.builder.base(k, parts.model.omega, time);
  for (const auto& gap : parts.gaps) *gap.value = gap.clearance - relative(gap, state, 0);
  *parts.time = time;
  for (std::size_t i = 0; i < observables.size(); ++i) {
    const auto& scalar = observables[i].fields.find("value")->second;
    parts.values[i] = scalar.expression ? scalar.expression->value(parts.names) : scalar.number;
  }
  return parts.values;
}

Observer ModelDefinition::observer(const Overrides& overrides) const {
  return Observer(
      std::make_unique<Observer::Parts>(definition_, all_values(*definition_, resolve(*definition_, overrides))));
}

}  // namespace slapstick
