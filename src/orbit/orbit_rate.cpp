/// Differentiates an orbit by its parameters.
#include "orbit/orbit_rate.hpp"

#include "base/dense.hpp"
#include "orbit/kept.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// From leg to leg, by the parameter j: dt_{i+1} = -dh / h_t, dx_{i+1} = d after. What the solution of the equations
/// says of x_0 and t_0 is kept. Behind it the gap that a guard ends at is exactly zero. So instants of a chatter's last
/// impacts, where guards fall slowly, do not take over the rounding of the states.
OrbitRate carried(const ModeSet& set, const Orbit& orbit, const std::vector<LegValue>& legs, Index j, OrbitRate rate) {
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const Leg& leg = orbit.shape.legs[i];
    const LegValue& value = legs[i];
    if (leg.ending != Ending::cut) {
      const double dh =
          value.h.by_state().row(0).dot(rate.x[i]) + value.h.by_begin()[0] * rate.t[i] + value.h.by_parameter()(0, j);
      if (const double slope = value.h.by_end()[0]; slope != 0.0) rate.t[i + 1] = -dh / slope;
    }
    if (i + 1 == orbit.legs()) break;
    rate.x[i + 1] = value.after.by_state() * rate.x[i] + value.after.by_begin() * rate.t[i] +
                    value.after.by_end() * rate.t[i + 1] + value.after.by_parameter().col(j);
    if (leg.ending != Ending::guard || leg.kind != mode::GuardKind::gap) continue;
    const int own = set.frame().stops[static_cast<std::size_t>(leg.contact)].own;
    if (own < set.frame().n) rate.x[i + 1][own] = 0.0;
  }
  return rate;
}

}  // namespace

std::vector<OrbitRate> orbit_rates(const Problem& problem, const ModeSet& set, const Orbit& orbit) {
  constexpr double singular = 1e-13;
  if (!differentiable(orbit.shape))
    throw NumericalError(
        "the orbit has no derivative: contacts that act on each other meet their events at one instant, "
        "and what comes first decides; change a parameter a little");
  const std::size_t legs = orbit.legs();
  const Linearised at = linearise(problem, set, orbit);
  demand_off_limits(problem, set, orbit, at.kept);
  const Index own = at.by.cols() - problem.parameters();
  const VectorXd units = sizes(problem, orbit);
  MatrixXd matrix = at.by.leftCols(own) * units.head(own).asDiagonal();
  const VectorXd rows = level_rows(matrix);
  if (!matrix.allFinite() || !(dense::reciprocal_condition(matrix) > singular))
    throw NumericalError(
        "the orbit has no derivative by a parameter: the orbit is at a fold or one of a family, where the "
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
    rates.push_back(carried(set, orbit, at.legs, j, std::move(rate)));
  }
  return rates;
}

}  // namespace slapstick::orbit
