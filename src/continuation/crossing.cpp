/// Branch points: located by interpolation, found again at other parameters, and the branch that crosses.
#include "continuation/crossing.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "base/dense.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double amplitude = 2e-3;   ///< of the orbits beside a crossing, arclength
constexpr double difference = 1e-4;  ///< over which J is differentiated

/// The determinant that is zero at a crossing, smooth along a branch: units, row and scales are those of one point.
class Determinant {
 public:
  Determinant(const Problem& problem, const PathPoint& base) : problem_(problem), base_(base) {
    MatrixXd matrix = at(base.orbit);
    scales_ = level_rows(matrix);
  }

  [[nodiscard]] double operator()(const Orbit& orbit) const {
    return dense::determinant(scales_.cwiseInverse().asDiagonal() * at(orbit));
  }

 private:
  [[nodiscard]] MatrixXd at(const Orbit& orbit) const {
    const ModeSet set(problem_.family(), orbit.values);
    return bordered(problem_, linearise(problem_, set, orbit), orbit.legs(), base_.units, base_.tangent);
  }

  const Problem& problem_;
  const PathPoint& base_;
  VectorXd scales_;
};

}  // namespace

std::optional<Located> locate_crossing(const Problem& problem, const PathPoint& from, double near, double range) {
  const Determinant determinant(problem, from);
  for (const double half_width : {0.01, 0.003, 0.03}) {
    auto found = locate_between(problem, from, near, half_width, range,
                                [&](const PathPoint& point) { return determinant(point.orbit); });
    if (!found) continue;
    found->point.watched.cross = 0.0;
    return found;
  }
  return std::nullopt;
}

namespace {

/// A crossing with the tangent of the branch that is followed over the parameter: of the plane of null directions that
/// which has most of it. A branch that breaks a symmetry has none.
PathPoint on_own_branch(const Problem& problem, const Linearised& linear, const Orbit& crossing, double range) {
  PathPoint at;
  at.orbit = crossing;
  at.units = arclength_units(problem, crossing, range);
  const VectorXd parameter = VectorXd::Unit(linear.by.cols(), problem.parameter_column(crossing.legs(), 0));
  const MatrixXd matrix = bordered(problem, linear, crossing.legs(), at.units, parameter);
  MatrixXd J = matrix.topRows(matrix.rows() - 1);
  level_rows(J);
  const MatrixXd null = dense::right_singular_vectors(J).rightCols(2);
  at.tangent = (null * (null.transpose() * parameter)).normalized();
  return at;
}

}  // namespace

std::optional<Located> crossing_near(const Problem& problem, const Orbit& crossing, const std::vector<double>& values,
                                     double range) {
  const Linearised linear = linearise(problem, ModeSet(problem.family(), crossing.values), crossing);
  const PathPoint at = on_own_branch(problem, linear, crossing, range);
  for (const double aside : {0.02, -0.02, 0.005, -0.005}) {  // arclength, to where the equations are regular
    Orbit beside = crossing;
    move(problem, linear, aside * at.tangent.cwiseProduct(at.units), 0.0, beside);
    beside.parameter() += values[0] - crossing.parameter();
    std::copy(values.begin() + 1, values.end(), beside.values.begin() + 1);
    std::vector<Condition> conditions = fixed_parameters(problem, beside.legs());
    conditions[0].row = at.tangent.cwiseQuotient(at.units).transpose();
    if (!solve(problem, beside, conditions, 12).converged) continue;
    const PathPoint from = point_of(problem, beside, range, at.tangent);
    double near = -aside;
    for (int k = 0; k < 5 && std::abs(near) < 10.0 * std::abs(aside); ++k) {
      auto found = locate_crossing(problem, from, near, range);
      if (!found) break;
      if (std::abs(found->length - near) < 1e-3) return found;
      near = found->length;
    }
  }
  return std::nullopt;
}

std::vector<Orbit> crossing_branch(const Problem& problem, const PathPoint& at) {
  const ModeSet set(problem.family(), at.orbit.values);
  const Linearised here = linearise(problem, set, at.orbit);
  const std::size_t legs = at.orbit.legs();
  const auto jacobian = [&](const Linearised& there) {
    const MatrixXd matrix = bordered(problem, there, legs, at.units, at.tangent);
    return MatrixXd(matrix.topRows(matrix.rows() - 1));
  };
  MatrixXd J = jacobian(here);
  const VectorXd scales = level_rows(J);
  const dense::SingularVectors vectors = dense::singular_vectors(J);
  const MatrixXd null = vectors.right.rightCols(2);
  const VectorXd psi = vectors.left.rightCols(1).cwiseQuotient(scales);
  const VectorXd own = (null * (null.transpose() * at.tangent)).normalized();
  const VectorXd in_plane = null.transpose() * own;
  const VectorXd other = null.col(0) * -in_plane[1] + null.col(1) * in_plane[0];
  const auto displaced = [&](double length) {
    Orbit orbit = at.orbit;
    move(problem, here, length * other.cwiseProduct(at.units), 0.0, orbit);
    return jacobian(linearise(problem, ModeSet(problem.family(), orbit.values), orbit));
  };
  const MatrixXd rate = (displaced(difference) - displaced(-difference)) / (2.0 * difference);
  const double mixed = psi.dot(rate * own), square = psi.dot(rate * other);
  const VectorXd direction = (2.0 * mixed * other - square * own).normalized();
  std::vector<Orbit> beside;
  if (!direction.allFinite() || std::abs(direction.dot(other)) < 1e-3) return beside;
  for (const double sense : {1.0, -1.0}) {
    Orbit orbit = at.orbit;
    move(problem, here, sense * amplitude * direction.cwiseProduct(at.units), 0.0, orbit);
    std::vector<Condition> conditions = fixed_parameters(problem, legs);
    conditions[0].row = direction.cwiseQuotient(at.units).transpose();
    if (solve(problem, orbit, conditions, 12).converged) beside.push_back(std::move(orbit));
  }
  return beside;
}

}  // namespace slapstick::orbit
