#pragma once
/// Which parts of a model can feed energy.
#include <string>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick {

/// The parts that can feed energy besides forces and belts, by kind and name or number: dampers of a negative
/// coefficient; polylines over the velocity whose force has the sign opposite to it somewhere; zones of a negative
/// coefficient; a damping matrix that with the dampers is not positive semidefinite; and friction whose normal force
/// depends on coordinates, which is a stiffness that is not symmetric. "damper 2", "characteristic 'valve'".
[[nodiscard]] std::vector<std::string> energy_sources(const Model& model);

/// The parts whose force falls as the displacement grows, so that a rest may be unstable (buckling): springs of a
/// negative stiffness, polylines with a piece that falls, a stiffness matrix that with the springs is not positive
/// semidefinite. Such parts feed no energy.
[[nodiscard]] std::vector<std::string> falling_forces(const Model& model);

}  // namespace slapstick
