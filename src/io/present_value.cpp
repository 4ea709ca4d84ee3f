/// What a parameter or group is now, and where it may go from there.
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "io/definition.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

/// The one value that the members of a group have. A member that is set by itself would not move with it.
double value_of_group(const Group& group, const Overrides& overrides, const std::map<std::string, double>& values,
                      const std::string& set) {
  std::string all;
  for (const std::string& member : group.members) {
    if (overrides.contains(member))
      throw InputError(member + " is set by itself and does not move with " + group.name + "; set " + group.name +
                       " instead, or name one of its members");
    all += (all.empty() ? "" : ", ") + member + " = " + shown(values.at(member));
  }
  const double value = values.at(group.members.front());
  if (ranges::any_of(group.members, [&](const std::string& member) { return values.at(member) != value; }))
    throw InputError("the members of " + group.name + " differ: " + all + "; give them one value by " + set +
                     group.name + "=VALUE, or name one of them");
  return value;
}

/// The parameters that a name stands for.
std::vector<std::string> members(const std::vector<Group>& groups, const std::string& name) {
  const auto group = ranges::find(groups, name, &Group::name);
  return group == groups.end() ? std::vector{name} : group->members;
}

}  // namespace

double ModelDefinition::present_value(const std::string& parameter, const Overrides& overrides,
                                      const std::string& set) const {
  const std::map<std::string, double> present = values(overrides);
  const auto group = ranges::find(groups(), parameter, &Group::name);
  if (group != groups().end()) return value_of_group(*group, overrides, present, set);
  const auto found = present.find(parameter);
  if (found != present.end()) return found->second;
  static_cast<void>(values({{parameter, 1.0}}));  // names the nearest
  throw InputError("model " + in_quotes(name()) + " has no parameter " + in_quotes(parameter));
}

void ModelDefinition::check_range(const std::string& parameter, const Overrides& overrides, double from, double to,
                                  const std::string& set) const {
  const double value = present_value(parameter, overrides, set);
  if (!(from < to)) throw InputError("the range of " + parameter + ": " + shown(from) + " is not below " + shown(to));
  if (value < from || value > to)
    throw InputError(parameter + " = " + shown(value) + ", where the first orbit is sought, is outside " + shown(from) +
                     " to " + shown(to) + "; give a value inside by " + set + parameter + "=VALUE");
  for (const std::string& member : members(groups(), parameter)) {
    const auto own = ranges::find(parameters(), member, &Parameter::name);
    if (own == parameters().end()) continue;
    for (const double end : {from, to})
      if (!own->admits(end)) throw InputError(parameter + " = " + shown(end) + " is outside " + own->range());
  }
}

}  // namespace slapstick
