/// Reads MODEL, --set and --state.
#include "model_options.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {

void ModelOptions::declare(Arguments& arguments) {
  arguments.positional("MODEL", source, "a built-in model (see `slapstick models`) or a .toml model file");
  arguments.repeated("--set", sets, "NAME=VALUE", "give a parameter of the model another value; may be repeated");
}

void ModelOptions::declare_state(Arguments& arguments) {
  arguments.text("--state", state, "x1=..,v1=..", "initial state; what is not named is the model's own start");
}

ChosenModel ModelOptions::load() const { return with_sets(load_model(source)); }

ChosenModel ModelOptions::with_sets(ModelDefinition definition) const {
  Overrides overrides;
  for (const std::string& set : sets) {
    const auto [name, text] = name_and_text("--set", set, "NAME=VALUE");
    if (!overrides.emplace(name, parse_number("--set " + name, text)).second)
      throw InputError("--set: " + in_quotes(name) + " is set twice");
  }
  Model model = blaming(overrides, [&](const Overrides& values) { return definition.build(values); });
  return {std::move(definition), std::move(overrides), std::move(model)};
}

namespace {

/// What helps somebody whose model begins behind one of its stops.
std::string start_advice(const ChosenModel& chosen, const Overrides& values) {
  const Model& model = chosen.model;
  try {
    static_cast<void>(chosen.definition.start(values));
    return {};
  } catch (const BehindStop&) {
  } catch (const InputError&) {
    return {};
  }
  return "; begin elsewhere, by --state " + state_names(model).front() + "=.. or under [start] in the model file";
}

/// The model's own start, with parameter values `more` on top of --set.
State own_start(const ChosenModel& chosen, const Overrides& more) {
  try {
    return blaming(chosen.overrides, [&](Overrides values) {
      values.insert(more.begin(), more.end());
      return chosen.definition.start(values);
    });
  } catch (const InputError& error) {
    Overrides values = chosen.overrides;
    values.insert(more.begin(), more.end());
    throw InputError(error.place(), error.message() + start_advice(chosen, values));
  }
}

}  // namespace

State ModelOptions::start(const ChosenModel& chosen, const Overrides& more) const {
  Overrides overrides = more;
  overrides.insert(chosen.overrides.begin(), chosen.overrides.end());
  if (state.empty()) return own_start(chosen, more);
  State start(2 * static_cast<std::size_t>(chosen.model.size()), 0.0);
  try {
    start = chosen.definition.start(overrides);
  } catch (const InputError&) {  // the model's own start does not fit these values; the user's may
  }
  const std::vector<std::string> names = state_names(chosen.model);
  std::set<std::string> seen;
  for (const std::string& part : split(state, ',')) {
    if (!seen.empty() && !part.empty() && part.find_first_not_of("0123456789") == std::string::npos)
      throw InputError("--state: " + in_quotes(state) + ": " + in_quotes(part) + " has no name" +
                       number_advice("0," + part));
    const auto [name, text] = name_and_text("--state", part, "NAME=NUMBER,..");
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw InputError("--state: unknown name " + in_quotes(name) + state_suggestion(name, names));
    if (!seen.insert(name).second) throw InputError("--state: " + in_quotes(name) + " is given twice");
    start[static_cast<std::size_t>(found - names.begin())] = parse_number("--state " + name, text);
  }
  try {
    validate(more.empty() ? chosen.model : chosen.definition.build(overrides), start);
  } catch (const InputError& error) {
    throw InputError(std::string("--") + error.what());  // "--state: stop 'stop' is violated: .."
  }
  return start;
}

InputError blame(const Overrides& sets, const std::function<bool(const Overrides&)>& works, const InputError& error) {
  if (sets.empty() || !works({})) return error;  // the values are not the cause
  std::string decisive, all;
  for (const auto& [name, value] : sets) {
    const std::string argument = "--set " + name + "=" + shown(value);
    Overrides others = sets;
    others.erase(name);
    if (works(others)) decisive += (decisive.empty() ? "" : ", ") + argument;
    all += (all.empty() ? "" : ", ") + argument;
  }
  return InputError((decisive.empty() ? all : decisive) + ": " + error.message());
}

std::pair<std::string, std::string> name_and_text(const std::string& argument, const std::string& text,
                                                  const std::string& form) {
  const auto equals = text.find('=');
  const bool plain =
      in_quotes(text.substr(0, equals)) == "'" + text.substr(0, equals) + "'";  // messages repeat the name
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size() || !plain)
    throw InputError(argument + ": " + in_quotes(text) + " is not of the form " + form);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace slapstick::app
