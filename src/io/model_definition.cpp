/// Answers what a model file says: parameters, values, model, start, observables.
#include <algorithm>
#include <cmath>

#include "base/nearest.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/definition.hpp"
#include "io/model_numbers.hpp"
#include "io/observed.hpp"
#include "io/scale.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

/// Values of all parameters: overrides, plain numbers, and expressions in the order in which they need each other.
class Evaluation {
 public:
  Evaluation(const Definition& definition, const Overrides& overrides)
      : definition_(definition), overrides_(overrides) {
    for (const auto* entries : {&definition.parameters, &definition.ones})
      for (const auto& entry : *entries) entries_[entry.shown.name] = &entry;
  }

  Values all() {
    for (const auto* entries : {&definition_.parameters, &definition_.ones})
      for (const auto& entry : *entries) need(entry.shown.name);
    return std::move(values_);
  }

 private:
  void need(const std::string& name) {
    if (values_.contains(name)) return;
    const auto& entry = *entries_.at(name);
    const auto given = overrides_.find(name);
    if (given != overrides_.end()) {
      values_[name] = given->second;
      return;
    }
    const auto where = [&] {
      return definition_.place(entry.value.line) +
             (is_one(entry) ? "scale: " + name.substr(scale_name({}).size()) : "parameter " + in_quotes(name)) + ": ";
    };
    double value = entry.value.number;
    if (const auto& expression = entry.value.expression) {
      if (std::find(open_.begin(), open_.end(), name) != open_.end())
        throw InputError(where() + "the value depends on itself: " + circle(name));
      open_.push_back(name);
      for (const auto& other : expression->names()) need(other);
      open_.pop_back();
      value = evaluated(*expression, where);
    }
    if (!entry.shown.admits(value))
      throw InputError(where() + "value = " + shown(value) + " is outside " + entry.shown.range());
    values_[name] = value;
  }

  [[nodiscard]] bool is_one(const ParameterEntry& entry) const {
    return ranges::any_of(definition_.ones, [&](const auto& one) { return &one == &entry; });
  }

  double evaluated(const Expression& expression, const LazyText& where) const {
    try {
      return expression.evaluate(values_);
    } catch (const InputError& error) {
      throw InputError(where() + error.what());
    }
  }

  /// "a -> b -> a"; the middle of a long one is left out.
  std::string circle(const std::string& name) const {
    std::string text;
    const auto first = std::find(open_.begin(), open_.end(), name);
    const auto count = open_.end() - first;
    for (auto each = first; each != open_.end(); ++each)
      if (count <= 8 || each - first < 4) text += *each + " -> ";
    return text + (count > 8 ? "... -> " : "") + name;
  }

  const Definition& definition_;
  const Overrides& overrides_;
  std::map<std::string, const ParameterEntry*> entries_;
  Values values_;
  std::vector<std::string> open_;  // being evaluated
};

/// A definition with its parameters' values, whose units are right.
struct Valued {
  Valued(const Definition& definition, const Overrides& given)
      : overrides(resolve(definition, given)),
        values(all_values(definition, overrides)),
        numbers(definition, values, overrides) {
    numbers.check();
  }
  Overrides overrides;
  Values values;
  ModelNumbers numbers;  // refers to the two above
};

void check_override(const Parameter& parameter, double value) {
  if (parameter.admits(value)) return;
  const std::string name = "parameter " + in_quotes(parameter.name) + " = " + shown(value);
  if (!std::isfinite(value)) throw InputError(name + " is not a finite number");
  throw InputError(name + " is outside " + parameter.range());
}

Observable shown_observable(const Part& part) {
  const auto& value = part.fields.find("value")->second;
  const auto unit = part.texts.find("unit");
  return {part.name, value.expression ? value.expression->text() : shown(value.number),
          unit == part.texts.end() ? "" : unit->second, part.description};
}

const Parameter* find_parameter(const Definition& definition, const std::string& name) {
  for (const auto& entry : definition.parameters)
    if (entry.shown.name == name) return &entry.shown;
  return nullptr;
}

const Group* find_group(const Definition& definition, const std::string& name) {
  for (const auto& entry : definition.groups)
    if (entry.shown.name == name) return &entry.shown;
  return nullptr;
}

}  // namespace

bool Parameter::admits(double number) const {
  return std::isfinite(number) && (min_open ? number > min : number >= min) &&
         (max_open ? number < max : number <= max);
}

std::string Parameter::range() const {
  std::string text = min_open || std::isinf(min) ? "(" : "[";
  text += shown(min) + ", " + shown(max);
  return text + (max_open || std::isinf(max) ? ")" : "]");
}

Values all_values(const Definition& definition, const Overrides& resolved) {
  return Evaluation(definition, resolved).all();
}

void refuse_parameter(const Definition& definition, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& entry : definition.parameters) known.push_back(entry.shown.name);
  for (const auto& entry : definition.groups) known.push_back(entry.shown.name);
  throw InputError("model " + in_quotes(definition.name) + " has no parameter " + in_quotes(name) +
                   suggestion(name, known));
}

Overrides resolve(const Definition& definition, const Overrides& overrides) {
  Overrides resolved;
  for (const auto& [name, value] : overrides)
    if (const auto* group = find_group(definition, name))
      for (const auto& member : group->members) {
        check_override(*find_parameter(definition, member), value);
        resolved[member] = value;
      }
  for (const auto& [name, value] : overrides) {
    if (find_group(definition, name) != nullptr) continue;
    const auto* parameter = find_parameter(definition, name);
    if (parameter == nullptr) refuse_parameter(definition, name);
    check_override(*parameter, value);
    resolved[name] = value;
  }
  return resolved;
}

ModelDefinition::ModelDefinition(std::shared_ptr<const Definition> definition) : definition_(std::move(definition)) {}

ModelDefinition ModelDefinition::parse(std::string_view text, const std::string& source) {
  auto definition = std::make_shared<Definition>(read_definition(text, source));
  const auto values = all_values(*definition, {});
  for (auto& entry : definition->parameters) {
    entry.shown.value = values.at(entry.shown.name);
    definition->shown_parameters.push_back(entry.shown);
  }
  for (const auto& entry : definition->groups) definition->shown_groups.push_back(entry.shown);
  for (const auto& part : definition->of("observable")) definition->shown_observables.push_back(shown_observable(part));
  ModelDefinition model{std::move(definition)};
  (void)model.start();  // also builds
  (void)observed_quantities(*model.definition_, model.build());
  (void)model.physical();
  return model;
}

const std::string& ModelDefinition::name() const { return definition_->name; }
const std::string& ModelDefinition::summary() const { return definition_->summary; }
const std::string& ModelDefinition::notes() const { return definition_->notes; }
const std::vector<Parameter>& ModelDefinition::parameters() const { return definition_->shown_parameters; }
const std::vector<Group>& ModelDefinition::groups() const { return definition_->shown_groups; }
const std::vector<Observable>& ModelDefinition::observables() const { return definition_->shown_observables; }

std::map<std::string, double> ModelDefinition::values(const Overrides& overrides) const {
  auto values = all_values(*definition_, resolve(*definition_, overrides));
  for (const auto& one : definition_->ones) values.erase(one.shown.name);
  return values;
}

Model ModelDefinition::build(const Overrides& overrides) const {
  const Valued valued(*definition_, overrides);
  return ModelBuilder(*definition_, valued.values, &valued.numbers).model();
}

State ModelDefinition::start(const Overrides& overrides) const {
  const Valued valued(*definition_, overrides);
  ModelBuilder builder(*definition_, valued.values, &valued.numbers);
  return builder.start(builder.model());
}

std::vector<LaidLaw> ModelDefinition::laid_laws(const Overrides& overrides) const {
  const Valued valued(*definition_, overrides);
  return ModelBuilder(*definition_, valued.values, &valued.numbers).laid_laws();
}

std::optional<PhysicalUnits> ModelDefinition::physical(const Overrides& overrides) const {
  return physical_units(*definition_, all_values(*definition_, resolve(*definition_, overrides)));
}

std::string ModelDefinition::to_toml(const Overrides& overrides) const {
  (void)start(overrides);  // the text must load again
  (void)physical(overrides);
  return print_definition(*definition_, resolve(*definition_, overrides));
}

}  // namespace slapstick
