/// Steps from a period doubling to the orbit of twice the length.
#include "continuation/switching.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/dense.hpp"
#include "orbit/extent.hpp"
#include "orbit/path.hpp"
#include "orbit/record.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the first orbit beyond a PD, in units of arclength: where its events change soon, so near that it is a motion.
constexpr std::array amplitudes = {1e-3, 1e-4, 1e-5};

/// An orbit run through twice.
Orbit twice(const Orbit& orbit) {
  Orbit two = orbit;
  const double cycle = orbit.t.back() - orbit.t.front();
  two.shape.n *= 2;
  two.shape.legs.insert(two.shape.legs.end(), orbit.shape.legs.begin(), orbit.shape.legs.end());
  two.x.insert(two.x.end(), orbit.x.begin(), orbit.x.end());
  for (std::size_t i = 1; i <= orbit.legs(); ++i) two.t.push_back(orbit.t[i] + cycle);
  two.advance *= 2.0;
  return two;
}

/// The direction that solves the linearised equations at a fixed parameter, with the smallest residual: there the new
/// branch leaves.
VectorXd new_direction(const Problem& problem, const Orbit& orbit, const VectorXd& units) {
  const ModeSet set(problem.family(), orbit.values);
  const Linearised at = linearise(problem, set, orbit);
  MatrixXd matrix(at.by.rows() + problem.parameters(), at.by.cols());
  matrix.topRows(at.by.rows()) = at.by * units.asDiagonal();
  matrix.bottomRows(problem.parameters()).setZero();
  matrix.bottomRightCorner(problem.parameters(), problem.parameters()).setIdentity();
  level_rows(matrix);
  return dense::right_singular_vectors(matrix).rightCols(1);
}

}  // namespace

std::vector<Orbit> doubled(const Problem& problem, const Orbit& pd, double range) {
  const Orbit two = twice(pd);
  const VectorXd units = arclength_units(problem, two, range);
  const VectorXd direction = new_direction(problem, two, units);
  const Linearised at = linearise(problem, ModeSet(problem.family(), two.values), two);
  std::vector<Condition> conditions = fixed_parameters(problem, two.legs());
  conditions[0].row = direction.cwiseQuotient(units).transpose();
  std::vector<Orbit> found;
  for (const double amplitude : amplitudes) {
    Orbit orbit = two;
    move(problem, at, amplitude * direction.cwiseProduct(units), 0.0, orbit);
    if (!solve(problem, orbit, conditions, 12).converged || equal_parts(problem, orbit, 0.01 * amplitude) > 1) break;
    if (is_motion(problem, orbit)) return {orbit};
    if (found.empty()) found.push_back(std::move(orbit));
  }
  return found;
}

}  // namespace slapstick::orbit
