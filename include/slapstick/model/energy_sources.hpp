#pragma once
/// Which parts of a model can feed energy.
#include <string>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick {

/// The parts that can feed energy besides forces and belts, by kind and name or number: dampers of a negative
/// coefficient, polylines over the velocity whose force has the sign opposite to it somewhere, zones of a negative
/// coefficient, a damping matrix with a negative number on its diagonal, and friction whose normal force depends on
/// coordinates, which is a stiffness that is not symmetric. "damper 2", "characteristic 'valve'".
[[nodiscard]] std::vector<std::string> energy_sources(const Model& model);

}  // namespace slapstick
