/// Evaluates the observables of a model file along a motion.
#include "slapstick/io/observer.hpp"

#include "io/model_builder.hpp"

namespace slapstick {
namespace {

double displacement(const State& state, int end) {
  return end == ground ? 0.0 : state[2 * static_cast<std::size_t>(end)];
}

}  // namespace

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
    values.resize(definition->of("observable").size());
  }

  template <class AnyStop>
  void gap(const AnyStop& stop) {
    gaps.push_back({&names[gap_name(stop.name)], stop.a, stop.b, stop.clearance});
  }

  struct Gap {
    double* value;
    int a, b;
    double clearance;
  };

  std::shared_ptr<const Definition> definition;
  Values parameters;
  ModelBuilder builder;
  Model model;
  Values names;  // everything that an expression may name; the pointers below point into it
  std::vector<double*> states, bases;
  std::vector<Gap> gaps;
  double* time = nullptr;
  std::vector<double> values;
};

Observer::Observer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Observer::~Observer() = default;
Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;

const std::vector<double>& Observer::read(double time, const State& state) {
  auto& parts = *parts_;
  const auto& observables = parts.definition->of("observable");
  for (std::size_t i = 0; i < parts.states.size(); ++i) *parts.states[i] = state[i];
  for (std::size_t k = 0; k < parts.bases.size(); ++k) *parts.bases[k] = parts.builder.base(k, parts.model.omega, time);
  for (const auto& gap : parts.gaps)
    *gap.value = gap.clearance - (displacement(state, gap.a) - displacement(state, gap.b));
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
