#include "library/case.hpp"

#include <filesystem>
#include <fstream>

#include "io/expression.hpp"

namespace slapstick::library {
namespace {

Overrides overrides_of(const Entry& entry, const Overrides& extra, Values known) {
  Overrides overrides;
  const Entry set = entry.value("set", Entry::object());
  for (const auto& [name, value] : set.items()) known[name] = overrides[name] = number(value, known);
  for (const auto& [name, value] : extra) overrides[name] = value;
  return overrides;
}

}  // namespace

double number(const Entry& json, const Values& values) {
  return json.is_string() ? Expression(json.get<std::string>()).evaluate(values) : json.get<double>();
}

std::vector<Entry> read_entries(const std::string& path) {
  std::vector<Entry> all;
  for (Entry& entry : Entry::parse(std::ifstream(path))) {
    const auto model = entry.at("model").get<std::string>();
    if (model.ends_with(".toml")) entry["model"] = std::filesystem::path(path).replace_filename(model).string();
    all.push_back(std::move(entry));
  }
  return all;
}

Setup::Setup(const Entry& entry_, const Overrides& extra, const Values& given, SystemOptions options)
    : entry(entry_),
      overrides(overrides_of(entry_, extra, given)),
      definition(load_model(entry_.at("model").get<std::string>())),
      system(definition.build(overrides), options),
      values(definition.values(overrides)),
      start(definition.start(overrides)) {
  values.insert(given.begin(), given.end());
  values["T"] = system.period();
  const auto names = state_names(system.model());
  const Entry at = entry.value("start", Entry::object());
  for (const auto& [name, value] : at.items()) {
    if (name == "time") {
      begin = begin.plus(number(value, values) / system.period());
      continue;
    }
    if (name == "period") {
      begin.period = static_cast<std::int64_t>(number(value, values));
      continue;
    }
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end()) throw std::invalid_argument("no state '" + name + "'");
    start[static_cast<std::size_t>(place - names.begin())] = number(value, values);
  }
}

}  // namespace slapstick::library
