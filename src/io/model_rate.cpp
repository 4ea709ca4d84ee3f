/// Differentiates a model file with respect to a parameter.

#include "base/ranges.hpp"
#include "io/model_builder.hpp"

namespace slapstick {
namespace {

/// What moves with a parameter or group: itself, or the members that have no override of their own.
std::vector<std::string> moved_by(const Definition& definition, const std::string& name, const Overrides& overrides) {
  for (const auto& entry : definition.parameters)
    if (entry.shown.name == name) return {name};
  std::vector<std::string> members;
  for (const auto& entry : definition.groups) {
    if (entry.shown.name != name) continue;
    ranges::copy_if(entry.shown.members, std::back_inserter(members),
                    [&](const auto& member) { return !overrides.contains(member); });
    return members;
  }
  refuse_parameter(definition, name);
}

/// Derivatives of all parameters: 1 of those that move, and what expressions make of it.
class ParameterRates {
 public:
  /// @param fixed  parameters that are set and so follow no expression
  ParameterRates(const Definition& definition, const Values& values, const Overrides& fixed,
                 const std::vector<std::string>& moved)
      : values_(values), fixed_(fixed) {
    for (const auto& name : moved) rates_[name] = {values.at(name), 1.0, true};
    for (const auto* entries : {&definition.parameters, &definition.ones})
      for (const auto& entry : *entries) entries_[entry.shown.name] = &entry;
    for (const auto& [name, unused] : values) follow(name);
  }

  [[nodiscard]] const Duals& all() const { return rates_; }

 private:
  void follow(const std::string& name) {
    if (rates_.contains(name)) return;
    Dual number{values_.at(name)};
    if (const auto& expression = entries_.at(name)->value.expression; expression && !fixed_.contains(name)) {
      for (const auto& other : expression->names()) follow(other);
      const Dual found = expression->differentiated(rates_);
      number.rate = found.rate;
      number.varies = found.varies;
    }
    rates_[name] = number;
  }

  const Values& values_;
  const Overrides& fixed_;
  std::map<std::string, const ParameterEntry*> entries_;
  Duals rates_;
};

}  // namespace

Model ModelDefinition::rate(const std::string& parameter, const Overrides& overrides) const {
  const auto moved = moved_by(*definition_, parameter, overrides);
  (void)build(overrides);
  const Overrides fixed = resolve(*definition_, overrides);
  const Values values = all_values(*definition_, fixed);
  const ParameterRates rates(*definition_, values, fixed, moved);
  return ModelBuilder(*definition_, values, rates.all()).rate();
}

Family ModelDefinition::family(const std::vector<std::string>& parameters, const Overrides& overrides) const {
  const auto with = [parameters, overrides](const std::vector<double>& values) {
    Overrides all = overrides;
    for (std::size_t i = 0; i < parameters.size(); ++i) all[parameters[i]] = values.at(i);
    return all;
  };
  return {parameters, [own = *this, with](const std::vector<double>& values) { return own.build(with(values)); },
          [own = *this, with, parameters](const std::vector<double>& values, std::size_t which) {
            return own.rate(parameters.at(which), with(values));
          }};
}

}  // namespace slapstick
