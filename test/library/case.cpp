#include "library/case.hpp"

#include <fstream>

#include "io/expression.hpp"

namespace slapstick::library {
namespace {

Overrides overrides_of(const Entry& entry, const Overrides& extra) {
  Overrides overrides;
  const Entry set = entry.value("set", Entry::object());
  for (const auto& [name, value] : set.items()) overrides[name] = number(value, overrides);
  for (const auto& [name, value] : extra) overrides[name] = value;
  return overrides;
}

}  // namespace

double number(const Entry& json, const Values& values) {
  return json.is_string() ? Expression(json.get<std::string>()).evaluate(values) : json.get<double>();
}

const std::vector<Entry>& all_cases() {
  static const auto cases = [] {
    std::vector<Entry> all;
    for (const char* file : {"cases.json", "own_cases.json"})
      for (Entry& entry : Entry::parse(std::ifstream(std::string(SLAPSTICK_CASES) + file))) all.push_back(entry);
    return all;
  }();
  return cases;
}

Setup::Setup(const Entry& entry_, const Overrides& extra)
    : entry(entry_),
      overrides(overrides_of(entry_, extra)),
      definition(load_model(entry_.at("model").get<std::string>())),
      system(definition.build(overrides)),
      values(definition.values(overrides)),
      start(definition.start(overrides)) {
  values["T"] = system.period();
  const auto names = state_names(system.model());
  const Entry at = entry.value("start", Entry::object());
  for (const auto& [name, value] : at.items()) {
    if (name == "time") {
      begin = Instant{}.plus(number(value, values) / system.period());
      continue;
    }
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end()) throw std::invalid_argument("no state '" + name + "'");
    start[static_cast<std::size_t>(place - names.begin())] = number(value, values);
  }
}

}  // namespace slapstick::library
