#pragma once
/// Where the energy of a cycle comes from and goes: the powers of slapstick/model/quantity.hpp, integrated over it.
///
/// Threads and cost: as `measure` of the cycle. Source: docs/reference/measure.md.
#include <string>
#include <vector>

#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick {

/// In the model's units. `input` is the sum of all sinks, to rounding.
struct CycleEnergy {
  double input = 0.0;            ///< by forces and belts
  double damping = 0.0;          ///< in dampers, the damping matrix, compliant stops and other characteristics
  std::vector<double> friction;  ///< in each of `friction_names`
  std::vector<double> impacts;   ///< in each stop: F w of `power_NAME`
  [[nodiscard]] double balance() const;
};

/// Whose `friction` is, in its order: friction contacts, then Jenkins elements.
[[nodiscard]] std::vector<std::string> friction_names(const Model& model);

/// @throws NumericalError if a leg is too long for the rates of its mode
[[nodiscard]] CycleEnergy cycle_energy(const orbit::Problem& problem, const orbit::Orbit& orbit);

}  // namespace slapstick
