#pragma once
/// The equations of a death (change/death.hpp) at an approximation to it, linearised.
#include "orbit/equations.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {

/// Unknowns, one a column: those of the orbit up to the first parameter, then the instants of the touches. Rows are
/// divided by their sizes, columns multiplied by the unknowns'. An equation that is always met has a row of rounding
/// alone, which stays small.
struct DeathEquations {
  /// @throws NumericalError, InputError as linearise
  DeathEquations(const Problem& problem, const Death& death);

  Linearised orbit;
  Eigen::VectorXd residual, noise;  ///< and the rounding of the residual
  Eigen::MatrixXd by, by_others;    ///< by_others: by the parameters but the first
  Eigen::VectorXd units, units_of_others;
  Eigen::Index parameter = 0;  ///< the first parameter's column
};

}  // namespace slapstick::orbit
