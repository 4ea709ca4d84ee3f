#include <array>
#include <cmath>
#include <functional>

#include "orbit/crossing.hpp"
#include "orbit/dying.hpp"
#include "orbit/extent.hpp"
#include "orbit/record.hpp"
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

/// The orbit that doubles, from the doubled one.
Orbit doubling(const Problem& problem, const Orbit& doubled) {
  constexpr double merged = 1e-3;  // near enough for Newton's method
  std::optional<Orbit> orbit = refine(problem, once(problem, doubled, merged));
  if (!orbit) throw NumericalError("sensitivity: the orbit that doubles was not found from the doubled one");
  return *orbit;
}

}  // namespace

namespace {

/// The directions on the solutions v(s, q) of the equations, s arclength: in which each parameter but the first moves by its unit and s stays.
std::vector<VectorXd> directions(const Problem& problem, const Linearised& linear, const PathPoint& at) {
  MatrixXd matrix(linear.by.cols(), linear.by.cols());
  const Index rows = linear.by.rows();
  matrix.topRows(rows) = linear.by * at.units.asDiagonal();
  matrix.row(rows) = at.tangent.transpose();
  for (Index j = 1; j < problem.parameters(); ++j)
    matrix.row(rows + j) = Eigen::RowVectorXd::Unit(matrix.cols(), problem.parameter_column(at.orbit.legs(), j));
  const Eigen::PartialPivLU<MatrixXd> solver(matrix);
  std::vector<VectorXd> all;
  for (Index j = 1; j < problem.parameters(); ++j)
    all.emplace_back(solver.solve(VectorXd::Unit(matrix.rows(), rows + j)));
  return all;
}

/// Where legs shrink to nothing the equations are singular: the sensitivity of the parameter at which one of them has some length, ever shorter,
/// extrapolated to none.
std::vector<double> death_sensitivity(const Problem& problem, const Orbit& orbit, double range) {
  const std::vector<PathPoint> points = away_from_death(problem, point_of(problem, orbit, range, {}), range, 7);
  const Index place = problem.parameter_column(orbit.legs(), 0);
  const std::size_t leg = dying_leg(problem, points.front());
  std::vector<double> lengths;
  std::vector<std::vector<double>> rates(static_cast<std::size_t>(problem.parameters()) - 1);
  for (const PathPoint& at : points) {
    const ModeSet set(problem.family(), at.orbit.values);
    const std::vector<VectorXd> all = directions(problem, linearise(problem, set, at.orbit), at);
    lengths.push_back(at.orbit.duration(leg));
    for (std::size_t j = 0; j < all.size(); ++j) {
      const double along = growth(problem, at, all[j], leg) / growth(problem, at, at.tangent, leg);
      const Index column = problem.parameter_column(orbit.legs(), static_cast<Index>(j) + 1);
      rates[j].push_back((all[j][place] - at.tangent[place] * along) * at.units[place] / at.units[column]);
    }
  }
  if (lengths.size() < 4) throw NumericalError("sensitivity: too few orbits beside the special point");
  std::vector<double> result;
  for (std::size_t j = 0; j < rates.size(); ++j) {
    const std::vector<double>& rate = rates[j];
    const double all = at_zero(lengths, rate),
                 fewer = at_zero({lengths.begin(), lengths.end() - 1}, {rate.begin(), rate.end() - 1});
    double size =
        1e-3 * range / points.front().units[problem.parameter_column(orbit.legs(), static_cast<Index>(j) + 1)];
    for (const double r : rate) size = std::max(size, std::abs(r));
    result.push_back(std::abs(all - fewer) < agreement * size ? all : std::nan(""));
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
  const double range = std::max(1e-3, std::abs(values[0]));
  const double own = orbit.values[0];
  orbit.values = values;
  if (point.beside) {
    orbit.values[0] = own;
    return death_sensitivity(problem, orbit, range);
  }
  if (point.type == SpecialType::BP) return crossing_sensitivity(problem, orbit, range);
  if (point.birth) orbit = doubling(problem, orbit);
  const PathPoint at = point_of(problem, orbit, range, {});
  const std::size_t legs = orbit.legs();
  const ModeSet set(problem.family(), orbit.values);
  const Linearised linear = linearise(problem, set, orbit);
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
  Index j = 0;
  for (const VectorXd& direction : directions(problem, linear, at)) {
    ++j;
    const double ds = best_ratio([&](double h) { return -rate(direction, h) / rate(at.tangent, h); });
    const double moved = (direction[place] + at.tangent[place] * ds) * at.units[place];
    result.push_back(moved / at.units[problem.parameter_column(legs, j)]);
  }
  return result;
}

}  // namespace slapstick::orbit
