#pragma once
/// The paper's system as plain data, from eq. (2); symbols as in docs/reference/notation.md.
#include "slapstick/flow/system.hpp"

namespace slapstick::test {

struct PaperParameters {
  double omega = 2.2, static_friction = 0.15, kinetic_friction = 0.15, restitution = 0.8, clearance = 0.0;
};

inline Model paper_model(const PaperParameters& parameters) {
  constexpr double mass_ratio = 10.0, stiffness_ratio = 5.0, dashpot_ratio = 5.0, damping_ratio = 0.1;
  Model model;
  model.name = "paper";
  model.coordinates = {{"x1", 1.0}, {"x2", mass_ratio}};
  model.springs = {{0, 1, 1.0}, {1, ground, stiffness_ratio}};
  model.dampers = {{0, 1, 2.0 * damping_ratio}, {1, ground, 2.0 * damping_ratio * dashpot_ratio}};
  model.forces = {{0, 1, 1.0, 0.0}};
  model.frictions = {{"friction", 0, 1, 0.0, parameters.static_friction, parameters.kinetic_friction}};
  model.stops = {{"stop", 0, 1, parameters.clearance, parameters.restitution}};
  model.omega = parameters.omega;
  return model;
}

inline const State paper_start = {-0.5, 0.0, 0.0, 0.0};

}  // namespace slapstick::test
