#pragma once
/// The points of a branch near one another: tangent, predictor, corrector, and the functions whose zeros are special
/// points.
#include "orbit/equations.hpp"
#include "orbit/margins.hpp"

namespace slapstick::orbit {

/// The units of arclength: sizes of the orbit (or of Problem::least_sizes), the range of the parameter, and for all
/// instants together a period: a cycle of many legs is measured as one of few.
[[nodiscard]] Eigen::VectorXd arclength_units(const Problem& problem, const Orbit& orbit, double range);

/// The equations, all parameters but the first fixed, and one row more; the unknowns in units of arclength.
[[nodiscard]] Eigen::MatrixXd bordered(const Problem& problem, const Linearised& at, std::size_t legs,
                                       const Eigen::VectorXd& units, const Eigen::VectorXd& last_row);

/// prod (mu + 1) / (1 + |mu|): zero at a period doubling. No factor is greater than 1, however large or many the
/// multipliers are.
[[nodiscard]] double flip_function(const std::vector<std::complex<double>>& multipliers);
/// prod (mu_i mu_j - 1) / (1 + |mu_i mu_j|) of all pairs: zero at a torus, and at two real multipliers whose product is
/// 1.
[[nodiscard]] double torus_function(const std::vector<std::complex<double>>& multipliers);

/// What is watched along a branch.
struct Watched {
  double turn = 0.0;   ///< the tangent's component in the parameter: zero at a fold
  double cross = 0.0;  ///< determinant bordered by the tangent: zero where branches cross
  double flip = 0.0;   ///< flip_function
  double torus = 0.0;  ///< torus_function
  /// Of an orbit with tied legs each but once: those of equal machines pass the unit circle together, and a function
  /// that counts them all would be zero without a change of sign.
  /// Without those of what is kept.
  std::vector<std::complex<double>> multipliers;
  std::vector<Eigen::Index> kept;  ///< Linearised::kept
  std::vector<TestValue> tests;
};

struct PathPoint {
  Orbit orbit;
  Eigen::VectorXd units;
  Eigen::VectorXd tangent;  ///< of length 1 in `units`, in the direction in which the branch is followed
  Watched watched;
};

/// A point of a branch from an orbit that solves its equations.
/// @param forward  a direction it shall not turn against, in the unknowns divided by `units`; empty: the parameter
/// grows
[[nodiscard]] PathPoint point_of(const Problem& problem, Orbit orbit, double range, const Eigen::VectorXd& forward);

/// The same point, followed the other way.
[[nodiscard]] PathPoint reversed(PathPoint point);

/// From one orbit of a branch to another of the same events: numbers of x_0, instants, parameters.
[[nodiscard]] Eigen::VectorXd unknowns_between(const Problem& problem, const Orbit& a, const Orbit& b);

/// The length with which step_to leads from a point to an orbit of the branch.
[[nodiscard]] double arclength(const Problem& problem, const PathPoint& from, const Orbit& to);

/// The point at an arclength from another; empty if Newton's method does not get there. `steps`: Newton's; `why`: set
/// where the model is refused.
[[nodiscard]] std::optional<PathPoint> step_to(const Problem& problem, const PathPoint& from, double length,
                                               double range, int* steps = nullptr, std::string* why = nullptr);

/// The zero of a function of the points between `from` and the point at `length`, where it has the other sign.
struct Located {
  PathPoint point;
  double length = 0.0;
  double error = 0.0;  ///< of the parameter: its last change, or what rounding leaves
};
[[nodiscard]] std::optional<Located> locate(const Problem& problem, const PathPoint& from, double length, double range,
                                            const std::function<double(const Watched&)>& f, double f_to);

}  // namespace slapstick::orbit
