#pragma once
/// MODEL, --set and --state: what most verbs begin with.
#include <functional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::app {

/// A model with the user's values.
struct ChosenModel {
  ModelDefinition definition;
  Overrides overrides;
  Model model;
};

struct ModelOptions {
  std::string source;             ///< MODEL
  std::vector<std::string> sets;  ///< --set
  std::string state;              ///< --state

  void declare(Arguments& arguments);        ///< MODEL and --set
  void declare_state(Arguments& arguments);  ///< --state
  /// @throws InputError naming the argument
  [[nodiscard]] ChosenModel load() const;
  /// The same, of a definition that was read before; MODEL is not looked at.
  [[nodiscard]] ChosenModel with_sets(ModelDefinition definition) const;
  /// The start: the model's own, with the numbers of --state in place of it. `more` are parameter values on top of
  /// --set.
  [[nodiscard]] State start(const ChosenModel& chosen, const Overrides& more = {}) const;
};

/// Why `error` happened, as a person at the command line sees it. Before the message stand the values of --set without
/// any one of which `works` is true (all of them if no single one decides). The line of the model file, where nothing
/// is wrong, is left out.
[[nodiscard]] InputError blame(const Overrides& sets, const std::function<bool(const Overrides&)>& works,
                               const InputError& error);

/// make(sets), with the values of --set named if it throws an InputError because of them.
template <class Make>
[[nodiscard]] auto blaming(const Overrides& sets, const Make& make) {
  try {
    return make(sets);
  } catch (const InputError& error) {
    const auto works = [&](const Overrides& values) {
      try {
        (void)make(values);
        return true;
      } catch (const InputError&) {
        return false;
      }
    };
    throw blame(sets, works, error);
  }
}

/// Splits "NAME=TEXT". @throws InputError naming the argument
[[nodiscard]] std::pair<std::string, std::string> name_and_text(const std::string& argument, const std::string& text,
                                                                const std::string& form);

}  // namespace slapstick::app
