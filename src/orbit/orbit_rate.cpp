/// Differentiates an orbit by its parameters.
#include "orbit/orbit_rate.hpp"

#include "base/dense.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<OrbitRate> orbit_rates(const Problem& problem, const ModeSet& set, const Orbit& orbit) {
  constexpr double singular = 1e-13;
  const std::size_t legs = orbit.legs();
  const Linearised at = linearise(problem, set, orbit);
  const Index own = at.by.cols() - problem.parameters();
  const VectorXd units = sizes(problem, orbit);
  MatrixXd matrix = at.by.leftCols(own) * units.head(own).asDiagonal();
  const VectorXd rows = level_rows(matrix);
  if (!matrix.allFinite() || !(dense::reciprocal_condition(matrix) > singular))
    throw NumericalError("the orbit has no derivative by a parameter: it is at a fold or one of a family, where the "
                         "equations are singular; change a parameter a little");
  std::vector<OrbitRate> rates;
  for (Index j = 0; j < problem.parameters(); ++j) {
    const Index column = problem.parameter_column(legs, j);
    VectorXd change = VectorXd::Unit(at.by.cols(), column);
    change.head(own) =
        units.head(own).cwiseProduct(dense::solve(matrix, VectorXd((-at.by.col(column)).cwiseQuotient(rows))));
    OrbitRate rate;
    for (std::size_t i = 0; i < legs; ++i) rate.x.push_back(at.states[i] * change);
    for (std::size_t i = 0; i <= legs; ++i) rate.t.push_back(change[problem.instant_column(i)]);
    rates.push_back(std::move(rate));
  }
  return rates;
}

}  // namespace slapstick::orbit
