/// Gathers what a table's file says of all its rows.
#include "table_facts.hpp"

#include <algorithm>

#include "axis_units.hpp"
#include "stop_options.hpp"

namespace slapstick::app {

TableFacts table_facts(const ChosenModel& chosen, const std::string& varied) {
  TableFacts facts;
  facts.attributes = {{"program", "slapstick"}, {"version", SLAPSTICK_VERSION}, {"model", chosen.model.name}};
  std::vector<std::string> members = {varied};
  for (const Group& group : chosen.definition.groups())
    if (group.name == varied) members = group.members;
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides))
    if (std::find(members.begin(), members.end(), name) == members.end())
      facts.attributes.push_back({"parameter_" + name, value});
  for (const Parameter& parameter : chosen.definition.parameters())
    if (parameter.name == members.front() && parameter.unit != "1") facts.units[varied] = parameter.unit;
  const AxisUnits units(chosen.definition, chosen.model);
  const std::vector<std::string> names = state_names(chosen.model);
  for (int i = 0; i < chosen.model.size(); ++i) {
    facts.units[names[2 * static_cast<std::size_t>(i)]] = units.displacement(i, ground);
    facts.units[names[2 * static_cast<std::size_t>(i) + 1]] = units.velocity(i, ground);
  }
  facts.units["time"] = units.time();
  facts.units["w"] = units.speed(stop_contacts(chosen.model));
  return facts;
}

}  // namespace slapstick::app
