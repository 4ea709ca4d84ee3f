/// Models with the caller's values, and their starts.
#include "chosen.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

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

/// Six digits: for messages.
std::string shown(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", number);
  return text.data();
}

Overrides with(Overrides values, const std::string& name, double value) {
  values[name] = value;
  return values;
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

double value_of(const ModelDefinition& definition, const Overrides& values, const std::string& name) {
  const auto all = definition.values(values);
  const auto& groups = definition.groups();
  const auto group = std::ranges::find(groups, name, &Group::name);
  if (group == groups.end()) {
    const auto found = all.find(name);
    if (found != all.end()) return found->second;
    static_cast<void>(definition.values({{name, 1.0}}));  // says which name is nearest
    throw InputError("model '" + definition.name() + "' has no parameter '" + name + "'");
  }
  const double value = all.at(group->members.front());
  for (const std::string& member : group->members) {
    if (values.contains(member))
      throw InputError(member + " is set by itself and does not move with " + name + "; set " + name +
                       " instead, or name one of its members");
    if (all.at(member) != value)
      throw InputError("the members of " + name + " differ: " + listed(group->members) + "; set " + name +
                       ", or name one of them");
  }
  return value;
}

double value_inside(const ModelDefinition& definition, const Overrides& values, const std::string& name, double from,
                    double to) {
  const double value = value_of(definition, values, name);
  if (!(from < to)) throw InputError(name + ": the range " + shown(from) + " to " + shown(to) + " is empty");
  if (value < from || value > to)
    throw InputError(name + " = " + shown(value) + ", where the first orbit is sought, is outside " + shown(from) +
                     " to " + shown(to) + "; give a value inside by " + name + "=");
  for (const double end : {from, to}) static_cast<void>(definition.values(with(values, name, end)));
  return value;
}

std::vector<std::string> contact_names(const Model& model) {
  std::vector<std::string> names;
  for (const Stop& stop : model.stops) names.push_back(stop.name);
  for (const FrictionContact& friction : model.frictions) names.push_back(friction.name);
  for (const CompliantStop& stop : model.compliant_stops) names.push_back(stop.name);
  return names;
}

}  // namespace slapstick::python
