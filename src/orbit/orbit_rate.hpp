#pragma once
/// How an orbit moves with each parameter while the others stay, by the implicit function theorem on its equations.
///
/// Source: docs/developers/architecture.md, section 9; Dankowicz and Schilder (2013). Cost: a linearisation and an
/// elimination.
#include <Eigen/Core>
#include <vector>

#include "orbit/equations.hpp"

namespace slapstick::orbit {

/// By one parameter.
struct OrbitRate {
  std::vector<Eigen::VectorXd> x;  ///< of Orbit::x
  std::vector<double> t;           ///< of Orbit::t
};

/// @param set  with the derivatives of the problem's family at the orbit's values
/// @returns one for each parameter of the family
/// @throws NumericalError where the equations are singular: at a fold, and for one of a family of orbits
[[nodiscard]] std::vector<OrbitRate> orbit_rates(const Problem& problem, const ModeSet& set, const Orbit& orbit);

}  // namespace slapstick::orbit
