#pragma once
/// A model's settled cycle, for tests of what is measured on it.
#include <gtest/gtest.h>

#include <string>

#include "slapstick/orbit/search.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick::test {

struct SettledCycle {
  explicit SettledCycle(const ModelDefinition& definition, const Overrides& values = {})
      : all(quantities(definition, values)),
        model(definition.build(values)),
        system(model),
        problem(orbit::pose(definition.family({}, values), {})) {
    orbit::Settled settled = orbit::settle(*problem, system, definition.start(values));
    if (!settled.orbit) throw std::runtime_error("the motion settles on no cycle");
    solution = *settled.orbit;
  }

  [[nodiscard]] Quantity named(const std::string& name) const { return find_quantity(all, name); }
  /// The motion at the cycle's phase 0; its end a cycle later.
  [[nodiscard]] Motion motion() const { return {system, orbit::at_phase_zero(*problem, solution.orbit)}; }
  [[nodiscard]] Instant end() const { return Instant{}.plus(solution.cycle / system.period()); }

  std::vector<Quantity> all;
  Model model;
  System system;
  std::shared_ptr<const orbit::Problem> problem;
  orbit::Solution solution;
};

}  // namespace slapstick::test
