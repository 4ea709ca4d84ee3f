#pragma once
/// The orbit of a model file, and its branch, for tests.
#include <stdexcept>

#include "families.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::test {

inline std::optional<orbit::Solution> settled(const ModelDefinition& definition, const Overrides& at,
                                              const State& start) {
  const auto problem = orbit::pose(definition.family({}, at), {});
  return orbit::settle(*problem, System(definition.build(at)), start, {.transient = 500}).orbit;
}
inline std::optional<orbit::Solution> settled(const ModelDefinition& definition, const Overrides& at) {
  return settled(definition, at, definition.start(at));
}

inline orbit::Branch followed(const ModelDefinition& definition, const std::string& name, double at, double from,
                              double to) {
  const auto first = settled(definition, {{name, at}});
  if (!first) throw std::runtime_error("no orbit");
  orbit::Orbit start = first->orbit;
  start.values = {at};
  return orbit::follow(*orbit::pose(definition.family({name}), {at}), start, {.from = from, .to = to});
}

}  // namespace slapstick::test
