#pragma once
/// A number that is known of a system, and how the engine is asked for it: entries of published cases (this folder) and
/// of the failure catalogue (../catalogue) have in common
///
///     "model", "set"    a built-in model, or a file beside the entry's; its parameters (numbers or expressions of
///                       those before)
///     "start"           the state by name, at "time" (or in the "period" of that number); what is not named is the
///                       model's own start
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::library {

using Entry = nlohmann::ordered_json;
using Values = std::map<std::string, double>;

/// A number, or an expression of `values`.
double number(const Entry& json, const Values& values);

/// The entries of a file in JSON; models that are files (*.toml) are looked for beside it.
std::vector<Entry> read_entries(const std::string& path);

/// One case with its parameters set, ready to run.
struct Setup {
  /// @param extra  parameters that win over the entry's
  /// @param given  names that the entry's expressions may use besides
  Setup(const Entry& entry, const Overrides& extra = {}, const Values& given = {}, SystemOptions options = {});

  const Entry& entry;
  Overrides overrides;
  ModelDefinition definition;
  System system;
  Values values;  ///< what was given, parameters and T
  State start;
  Instant begin;
};

}  // namespace slapstick::library
