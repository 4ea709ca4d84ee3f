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

constexpr double hold_together = 1e-10;  ///< a residual, or what a rate leaves of one: more equations than unknowns
constexpr double death_rounding = 1e-9;  ///< steps of Newton's method below it that no longer shrink are rounding

/// Are the equations met?
[[nodiscard]] bool holds_together(const Problem& problem, const Death& death);

/// The longest entry of a step, and of what the orbit's inner states have to make good.
[[nodiscard]] double length(const Problem& problem, const DeathEquations& at, const Eigen::VectorXd& step);

/// Moves a death by a fraction of a step, in units of the unknowns and then of the parameters that follow the first.
void move(const Problem& problem, const DeathEquations& at, const Eigen::VectorXd& step, double fraction, Death& death);

}  // namespace slapstick::orbit
