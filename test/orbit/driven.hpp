#pragma once
/// Files of driven machines, and the cycles that they settle on.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "families.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::test {

/// A file's family at its own values, and the orbit that its start settles on.
struct Driven {
  Driven(const std::string& text, std::vector<std::string> names, std::vector<double> at)
      : definition(ModelDefinition::parse(text, "f.toml")),
        values(std::move(at)),
        family(definition.family(names, {})),
        system(family.model(values)),
        problem(orbit::pose(family, values)),
        start(definition.start()),
        orbit(orbit::settle(*problem, system, start).orbit) {}

  [[nodiscard]] Measured of(const std::string& name) const { return measure(*problem, orbit->orbit, {quantity(name)}); }
  /// Of a statistic of the cycle, by the central difference of its orbits.
  [[nodiscard]] double difference(std::size_t parameter, double h, const Quantity& quantity, const char* of) const {
    const auto at = [&](double by) {
      orbit::Orbit guess = orbit->orbit;
      guess.values = values;
      guess.values[parameter] += by;
      const auto there_problem = orbit::pose(family, guess.values);
      const auto there = orbit::refine(*there_problem, guess);
      EXPECT_TRUE(there);
      return statistic(measure(*there_problem, *there, {quantity}).of.front(), of);
    };
    return (at(h) - at(-h)) / (2.0 * h);
  }
  [[nodiscard]] Quantity quantity(const std::string& name) const {
    return find_quantity(quantities(system.model()), name);
  }

  ModelDefinition definition;
  std::vector<double> values;
  Family family;
  System system;
  std::shared_ptr<const orbit::Problem> problem;
  State start;
  std::optional<orbit::Solution> orbit;
};

}  // namespace slapstick::test
