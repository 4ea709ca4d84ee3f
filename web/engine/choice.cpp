/// Reads the page's model, and builds it with the values of the sliders.
#include "choice.hpp"

#include <algorithm>

#include "io/builtin.hpp"
#include "slapstick/base/error.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::web {

Choice Choice::of(const std::string& source, Overrides set, State start) {
  const bool is_text = source.find('\n') != std::string::npos;
  return {is_text ? ModelDefinition::parse(source, "line") : load_model(source), std::move(set), std::move(start)};
}

Model Choice::model(const Overrides& more) const {
  Overrides values = set;
  for (const auto& [name, value] : more) values[name] = value;
  try {
    return definition.build(values);
  } catch (const InputError& error) {
    if (values.empty()) throw;
    throw InputError(error.message());
  }
}

State Choice::start_at(const Overrides& more) const {
  if (!start.empty()) {
    State state = start;
    sweep::undo_rounding(model(more), state);
    return state;
  }
  Overrides values = set;
  for (const auto& [name, value] : more) values[name] = value;
  return definition.start(values);
}

std::string text_of(const Choice& choice) {
  if (choice.set.empty())
    for (const BuiltinModel& model : builtin_model_files())
      if (model.name == choice.definition.name()) return std::string(model.text);
  return choice.definition.to_toml(choice.set);
}

std::vector<Quantity> quantities_of(const Choice& choice, const std::string& names) {
  std::vector<Quantity> found;
  const std::vector<Quantity> all = quantities(choice.definition, choice.set);
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    found.push_back(find_quantity(all, names.substr(begin, end - begin)));
    begin = end + 1;
  }
  return found;
}

}  // namespace slapstick::web
