/// Checks that the expressions of a model with [scale] have no unit.
#include "io/model_numbers.hpp"

#include <cmath>

#include "base/elementary.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/scale.hpp"
#include "io/unit.hpp"

namespace slapstick {
namespace {

constexpr int finer = 12;  // log2 of how many other units make one

const ParameterEntry* entry_of(const Definition& definition, const std::string& name) {
  for (const auto* entries : {&definition.parameters, &definition.ones})
    for (const auto& entry : *entries)
      if (entry.shown.name == name) return &entry;
  return nullptr;
}

/// What makes a number of the model of one with this unit: " / scale_length * scale_time^2".
std::string division(const std::array<int, 3>& powers) {
  std::string text;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (powers[i] == 0) continue;
    text += (powers[i] > 0 ? " / " : " * ") + scale_name(scale_keys()[i]);
    if (std::abs(powers[i]) > 1) text += "^" + std::to_string(std::abs(powers[i]));
  }
  return text;
}

}  // namespace

ModelNumbers::ModelNumbers(const Definition& definition, const Values& values, const Overrides& overrides)
    : definition_(definition), values_(values), overrides_(overrides) {
  for (std::size_t i = 0; i < scale_keys().size(); ++i) {
    const auto found = definition.scale.find(scale_keys()[i]);
    if (found == definition.scale.end()) continue;
    const Scalar& one = found->second.value;
    View view{i, (one.expression ? one.expression->value(values) : one.number) != 1.0, {}};
    for (const auto& [name, value] : values) measured(name, view);
    views_.push_back(std::move(view));
  }
}

/// The parameter's number in the view's units. One without a unit is a number of the model, or what its expression
/// makes of others.
double ModelNumbers::measured(const std::string& name, View& view) const {
  if (const auto known = view.values.find(name); known != view.values.end()) return known->second;
  const ParameterEntry& entry = *entry_of(definition_, name);
  double value = values_.at(name);
  if (!entry.shown.unit.empty()) {
    value = std::ldexp(value, finer * parse_unit(entry.shown.unit).powers[view.dimension]);
  } else if (entry.value.expression && !overrides_.contains(name)) {
    for (const auto& other : entry.value.expression->names()) measured(other, view);
    value = entry.value.expression->value(view.values);
  }
  return view.values[name] = value;
}

/// The unit of an expression's value; nothing if it has none because numbers of both kinds are added in it. `others`:
/// names that are no parameters.
std::optional<ModelNumbers::Powers> ModelNumbers::powers(const Expression& expression, const Values& others) const {
  const auto with = [&](const Values& parameters) {
    Values all = parameters;
    all.insert(others.begin(), others.end());
    return expression.value(all);
  };
  Powers found{};
  const double value = with(values_);
  if (!std::isfinite(value)) return found;
  for (const View& view : views_) {
    const double changed = with(view.values);
    if (std::abs(changed - value) <= 1e-9 * std::abs(value)) continue;
    const double power = fixed::log2(changed / value) / finer;
    const bool whole = std::abs(power - std::round(power)) < 1e-9;
    if (!whole && view.scaled) return std::nullopt;
    if (whole) found[view.dimension] = static_cast<int>(std::round(power));
  }
  return found;
}

/// In none of the dimensions where that makes a difference.
bool ModelNumbers::without_unit(const Powers& powers) const {
  return ranges::none_of(views_, [&](const View& view) { return view.scaled && powers[view.dimension] != 0; });
}

/// "v in mm/s, m in kg"
std::string ModelNumbers::with_units(const Expression& expression) const {
  std::string text;
  for (const auto& name : expression.names())
    if (const auto* entry = entry_of(definition_, name); entry && !entry->shown.unit.empty())
      text += (text.empty() ? "" : ", ") + name + " in " + entry->shown.unit;
  return text;
}

void ModelNumbers::demand(const Expression& expression) const { demand(expression, {}); }

void ModelNumbers::demand(const Expression& expression, const Values& others) const {
  if (views_.empty()) return;
  const auto unit = powers(expression, others);
  if (unit && without_unit(*unit)) return;
  const std::string what = "expression " + in_quotes(expression.text()) + ": ", in = with_units(expression);
  if (!unit)
    throw InputError(what + "the expression mixes numbers that have a unit" + (in.empty() ? "" : " (" + in + ")") +
                     " with numbers of the model: divide each by scale_length, scale_time or scale_mass first");
  const bool one = expression.text().find_first_of("+-*/^?<>=&|") == std::string::npos;
  throw InputError(what + "its value is in " + unit_of_scale(definition_, *unit) +
                   ", and a model with [scale] calculates in units of its own: write " +
                   in_quotes((one ? expression.text() : "(" + expression.text() + ")") + division(*unit)));
}

/// A number that is written out is in the unit; an expression of parameters has to be.
void ModelNumbers::demand_unit(const Scalar& scalar, const Powers& wanted, const std::string& unit,
                               const std::string& where) const {
  if (!scalar.expression) return;
  const auto found = powers(*scalar.expression, {});
  if (found == wanted || found == Powers{}) return;
  throw InputError(definition_.place(scalar.line), where + ": expression " + in_quotes(scalar.expression->text()) +
                                                       ": its value is not in " + unit + " (" +
                                                       with_units(*scalar.expression) + ")");
}

void ModelNumbers::check() const {
  if (views_.empty()) return;  // units are labels
  for (const auto& entry : definition_.parameters)
    if (!entry.shown.unit.empty() && !overrides_.contains(entry.shown.name))
      demand_unit(entry.value, parse_unit(entry.shown.unit).powers, entry.shown.unit,
                  "parameter " + in_quotes(entry.shown.name));
  for (const auto& [key, entry] : definition_.scale)
    demand_unit(entry.value, parse_unit(entry.unit).powers, entry.unit, "scale: " + key);
  for (const auto& part : definition_.of("observable")) check_observable(part);
}

/// With arbitrary numbers for the state, of both signs because gaps decide between two formulas.
void ModelNumbers::check_observable(const Part& part) const {
  const Scalar& value = part.fields.find("value")->second;
  if (!value.expression) return;
  for (const double sign : {1.0, -1.0}) {
    Values others;
    for (const auto& name : value.expression->names())
      if (!values_.contains(name)) others[name] = sign * (0.37 + 0.11 * static_cast<double>(others.size()));
    try {
      demand(*value.expression, others);
    } catch (const InputError& error) {
      throw InputError(definition_.place(value.line), part_label("observable", 0, part) + ": value: " + error.what());
    }
  }
}

}  // namespace slapstick
