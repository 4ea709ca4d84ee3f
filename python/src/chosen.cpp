/// Models with the caller's values, and their starts.
#include "chosen.hpp"

#include <algorithm>

#include "slapstick/base/error.hpp"

namespace slapstick::python {
namespace {

/// make(values); an error that the file's own values do not have is the caller's, not the file's.
template <class Make>
auto blaming(const Overrides& values, const Make& make) {
  try {
    return make(values);
  } catch (const InputError& error) {
    if (values.empty()) throw;
    try {
      static_cast<void>(make(Overrides{}));
    } catch (const InputError&) {
      throw error;
    }
    throw InputError(error.message());
  }
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The numbers of `named` in place of those of the model's own start, or of rest if that does not fit the values.
State with_named(const ModelDefinition& definition, const Overrides& values, const Model& model,
                 const Overrides& named) {
  State state(2 * static_cast<std::size_t>(model.size()), 0.0);
  try {
    state = definition.start(values);
  } catch (const InputError&) {
  }
  const std::vector<std::string> names = state_names(model);
  for (const auto& [name, value] : named) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw InputError("start: unknown name '" + name + "'; known: " + listed(names));
    state[static_cast<std::size_t>(found - names.begin())] = value;
  }
  return state;
}

}  // namespace

Model build(const ModelDefinition& definition, const Overrides& values) {
  return blaming(values, [&](const Overrides& of) { return definition.build(of); });
}

State start_of(const ModelDefinition& definition, const Overrides& values, const std::optional<Start>& start) {
  if (!start) return blaming(values, [&](const Overrides& of) { return definition.start(of); });
  const Model model = build(definition, values);
  const auto* named = std::get_if<Overrides>(&*start);
  State state = named != nullptr ? with_named(definition, values, model, *named) : std::get<State>(*start);
  validate(model, state);
  return state;
}

std::vector<std::string> contact_names(const Model& model) {
  std::vector<std::string> names;
  for (const Stop& stop : model.stops) names.push_back(stop.name);
  for (const FrictionContact& friction : model.frictions) names.push_back(friction.name);
  for (const CompliantStop& stop : model.compliant_stops) names.push_back(stop.name);
  for (const Characteristic& one_of : model.characteristics) names.push_back(one_of.name);
  return names;
}

}  // namespace slapstick::python
