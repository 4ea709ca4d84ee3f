/// Turns names of a model into the text of a picture, in gnuplot's enhanced notation.
#include "axis_text.hpp"

#include <set>
#include <vector>

#include "base/ranges.hpp"

namespace slapstick::app {

std::string axis_text(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == '_' ? std::string("\\_") : std::string(1, c);
  return text;
}

std::string parameter_axis(const ModelDefinition& definition, const std::string& name) {
  std::vector<std::string> members = {name};
  for (const Group& group : definition.groups())
    if (group.name == name) members = group.members;
  std::set<std::string> units;
  for (const Parameter& parameter : definition.parameters())
    if (ranges::find(members, parameter.name) != members.end()) units.insert(parameter.unit);
  const bool one = units.size() == 1 && !units.begin()->empty() && *units.begin() != "1";
  return axis_text(name) + (one ? " [" + axis_text(*units.begin()) + "]" : "");
}

std::string axis_symbol(const std::string& name) {
  if (name.size() > 2 && name.starts_with("v_")) return "v_{" + axis_symbol(name.substr(2)) + "}";
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == 1 && name.find_first_not_of("0123456789", digits) == std::string::npos)
    return name.substr(0, 1) + "_{" + name.substr(1) + "}";
  return axis_text(name);
}

}  // namespace slapstick::app
