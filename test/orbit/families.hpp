#pragma once
/// Model files as families, for tests.
#include "slapstick/continuation/sentences.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::orbit {

/// Why a branch or curve ends, for messages of tests.
inline std::string ended(const Branch& branch) { return sentence(branch); }
inline std::string ended(const Curve& curve) {
  return std::string(name(curve.down.kind)) + ", " + std::string(name(curve.up.kind));
}

}  // namespace slapstick::orbit

namespace slapstick::test {

/// A model with fixed overrides as a function of some parameters, its Problem, and the System at the values given.
struct Posed {
  Posed(const std::string& model, Overrides fixed, std::vector<std::string> parameters, std::vector<double> present)
      : definition(load_model(model)),
        overrides(std::move(fixed)),
        names(std::move(parameters)),
        values(std::move(present)),
        family(definition.family(names, overrides)),
        system(definition.build(at(values))),
        problem(orbit::pose(family, values)) {}
  Posed(const Posed&) = delete;
  Posed& operator=(const Posed&) = delete;

  [[nodiscard]] Overrides at(const std::vector<double>& v) const {
    Overrides all = overrides;
    for (std::size_t j = 0; j < names.size(); ++j) all[names[j]] = v.at(j);
    return all;
  }
  [[nodiscard]] State start() const { return definition.start(at(values)); }
  /// The orbit that the motion from the model's start settles on; or the one of n periods that it is near after the
  /// transient.
  [[nodiscard]] std::optional<orbit::Solution> settled(int n = 0, long transient = 500) const {
    if (n == 0) return orbit::settle(*problem, system, start(), {.transient = transient}).orbit;
    return orbit::orbit_near(*problem, Motion(system, start()), transient, n);
  }

  ModelDefinition definition;
  Overrides overrides;
  std::vector<std::string> names;
  std::vector<double> values;
  Family family;
  System system;
  std::shared_ptr<const orbit::Problem> problem;
};

}  // namespace slapstick::test
