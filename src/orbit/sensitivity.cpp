#include <array>
#include <cmath>
#include <functional>

#include "orbit/crossing.hpp"
#include "orbit/special.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Steps of the differences of a point's defining function, in units of arclength; the two that agree best are believed if they agree at all.
constexpr std::array<double, 6> steps = {1e-3, 2e-4, 4e-5, 8e-6, 1.6e-6, 3.2e-7};
constexpr double agreement = 1e-3;

/// The ratio of two differences that changes least from step to step; not a number if it never settles.
double best_ratio(const std::function<double(double)>& ratio) {
  double best = std::nan(""), least = agreement, before = std::nan("");
  for (const double h : steps) {
    double now = std::nan("");
    try {
      now = ratio(h);
    } catch (const NumericalError&) {  // too far
    }
    const double change = std::abs(now - before) / std::max(std::abs(now), 1e-6);
    if (change < least) {
      least = change;
      best = now;
    }
    before = now;
  }
  return best;
}

}  // namespace

namespace {

/// At a crossing the equations are singular: it is located at either side in each parameter.
std::vector<double> crossing_sensitivity(const Problem& problem, const Orbit& orbit, double range) {
  constexpr double part = 1e-4;
  std::vector<double> result;
  for (std::size_t j = 1; j < orbit.values.size(); ++j) {
    const double h = part * std::max(std::abs(orbit.values[j]), 1e-2);
    Orbit low = orbit, high = orbit;
    low.values[j] -= h;
    high.values[j] += h;
    const auto below = crossing_near(problem, low, range), above = crossing_near(problem, high, range);
    result.push_back(below && above ? (above->point.orbit.values[0] - below->point.orbit.values[0]) / (2.0 * h)
                                    : std::nan(""));
  }
  return result;
}

}  // namespace

/// On the solutions v(s, q) of the equations, s arclength and q another parameter, f(v) = 0 keeps the point what it is:
/// ds/dq = -(df/dq) / (df/ds), and d value / dq = dp/dq + dp/ds ds/dq. The directions are exact, the derivatives of f central differences
/// of points that solve the equations.
std::vector<double> sensitivity(const Family& full, const std::vector<double>& values, const SpecialPoint& point) {
  const Problem problem(full, values);
  Orbit orbit = point.solution.orbit;
  orbit.values = values;
  const double range = std::max(1e-3, std::abs(values[0]));
  if (point.type == SpecialType::BP) return crossing_sensitivity(problem, orbit, range);
  const PathPoint at = point_of(problem, orbit, range, {});
  const std::size_t legs = orbit.legs();
  const ModeSet set(problem.family(), orbit.values);
  const Linearised linear = linearise(problem, set, orbit);
  const auto along = [&](Index parameter) {  // at the same place of the branch, another parameter moves by its unit
    MatrixXd matrix(linear.by.cols(), linear.by.cols());
    const Index rows = linear.by.rows();
    matrix.topRows(rows) = linear.by * at.units.asDiagonal();
    matrix.row(rows) = at.tangent.transpose();
    for (Index j = 1; j < problem.parameters(); ++j)
      matrix.row(rows + j) = Eigen::RowVectorXd::Unit(matrix.cols(), problem.parameter_column(legs, j));
    VectorXd right = VectorXd::Zero(matrix.rows());
    right[rows + parameter] = 1.0;
    return VectorXd(matrix.partialPivLu().solve(right));
  };
  const auto value_at = [&](const VectorXd& direction, double length) {
    Orbit moved = orbit;
    move(problem, linear, length * direction.cwiseProduct(at.units), 0.0, moved);
    std::vector<Condition> conditions = fixed_parameters(problem, legs);
    conditions[0].row = at.tangent.cwiseQuotient(at.units).transpose();
    if (!solve(problem, moved, conditions).converged)
      throw NumericalError("sensitivity: no orbit beside the special point");
    return defining(point, point_of(problem, moved, range, at.tangent).watched);
  };
  const auto rate = [&](const VectorXd& direction, double h) {
    return (value_at(direction, h) - value_at(direction, -h)) / (2.0 * h);
  };
  std::vector<double> result;
  const Index place = problem.parameter_column(legs, 0);
  for (Index j = 1; j < problem.parameters(); ++j) {
    const VectorXd direction = along(j);
    const double ds = best_ratio([&](double h) { return -rate(direction, h) / rate(at.tangent, h); });
    const double moved = (direction[place] + at.tangent[place] * ds) * at.units[place];
    result.push_back(moved / at.units[problem.parameter_column(legs, j)]);
  }
  return result;
}

}  // namespace slapstick::orbit
