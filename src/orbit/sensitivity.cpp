#include <array>
#include <cmath>
#include <functional>

#include "orbit/crossing.hpp"
#include "orbit/dying.hpp"
#include "orbit/extent.hpp"
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
  const auto ratio_at = [&](double h) {
    try {
      return ratio(h);
    } catch (const NumericalError&) {  // too far
      return std::nan("");
    }
  };
  double best = std::nan(""), least = agreement, before = std::nan("");
  for (const double h : steps) {
    const double now = ratio_at(h);
    const double change = std::abs(now - before) / std::max(std::abs(now), 1e-6);
    if (change < least) {
      least = change;
      best = now;
    }
    before = now;
  }
  return best;
}

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

/// How the parameter moves with each other one at a point of a branch when f(v) keeps its value on the solutions v(s, q) of the equations, s arclength and q
/// another parameter: ds/dq = -(df/dq) / (df/ds), and d value / dq = dp/dq + dp/ds ds/dq. The directions are exact, the derivatives of f central
/// differences of points that solve the equations.
std::vector<double> moved_with(const Problem& problem, const PathPoint& at, double range,
                               const std::function<double(const Watched&)>& f) {
  const std::size_t legs = at.orbit.legs();
  const ModeSet set(problem.family(), at.orbit.values);
  const Linearised linear = linearise(problem, set, at.orbit);
  const auto value_at = [&](const VectorXd& direction, double length) {
    Orbit moved = at.orbit;
    move(problem, linear, length * direction.cwiseProduct(at.units), 0.0, moved);
    std::vector<Condition> conditions = fixed_parameters(problem, legs);
    conditions[0].row = at.tangent.cwiseQuotient(at.units).transpose();
    if (!solve(problem, moved, conditions).converged)
      throw NumericalError("sensitivity: no orbit beside the special point");
    return f(point_of(problem, moved, range, at.tangent).watched);
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

/// The rates of all parameters at points of a branch, and the lengths there of a leg that dies.
struct Rates {
  std::vector<double> lengths;
  std::vector<std::vector<double>> of;  ///< a list for each parameter
  std::vector<double> least;            ///< of each: what is next to nothing

  /// Extrapolated to no length; not a number if one point less says otherwise.
  [[nodiscard]] double limit(std::size_t j) const {
    const double all = at_zero(lengths, of[j]),
                 fewer = at_zero({lengths.begin(), lengths.end() - 1}, {of[j].begin(), of[j].end() - 1});
    return std::abs(all - fewer) < agreement * size(j) ? all : std::nan("");
  }
  [[nodiscard]] double size(std::size_t j) const {
    double most = least[j];
    for (const double rate : of[j]) most = std::max(most, std::abs(rate));
    return most;
  }
};

/// With a leg's length kept.
std::vector<double> moved_with_leg(const Problem& problem, const PathPoint& at, std::size_t leg) {
  const ModeSet set(problem.family(), at.orbit.values);
  const std::vector<VectorXd> all = directions(problem, linearise(problem, set, at.orbit), at);
  const Index place = problem.parameter_column(at.orbit.legs(), 0);
  std::vector<double> rates;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double along = growth(problem, at, all[j], leg) / growth(problem, at, at.tangent, leg);
    rates.push_back((all[j][place] - at.tangent[place] * along) * at.units[place] /
                    at.units[problem.parameter_column(at.orbit.legs(), static_cast<Index>(j) + 1)]);
  }
  return rates;
}

/// Where legs shrink to nothing the equations are singular: the sensitivity of the parameter at which one of them has some length, ever shorter,
/// extrapolated to none. Another parameter may part what vanishes there together: it is believed if the margins that do say the same.
std::vector<double> death_sensitivity(const Problem& problem, const Orbit& orbit, double range) {
  constexpr std::size_t most = 7, fewest = 4;
  constexpr double falls = 0.5;  // from the farthest point to the nearest, what vanishes there
  const std::vector<PathPoint> points = away_from_death(problem, point_of(problem, orbit, range, {}), range, most);
  if (points.size() < fewest) throw NumericalError("sensitivity: too few orbits beside the special point");
  const std::size_t leg = dying_leg(problem, points.front()), others = orbit.values.size() - 1;
  const auto rates_by = [&](const std::function<std::vector<double>(const PathPoint&)>& moved) {
    Rates rates{{}, std::vector<std::vector<double>>(others), {}};
    const VectorXd& units = points.front().units;
    for (std::size_t j = 0; j < others; ++j)
      rates.least.push_back(1e-3 * range / units[problem.parameter_column(orbit.legs(), static_cast<Index>(j) + 1)]);
    for (const PathPoint& at : points) {
      const std::vector<double> here = moved(at);
      rates.lengths.push_back(at.orbit.duration(leg));
      for (std::size_t j = 0; j < others; ++j) rates.of[j].push_back(here[j]);
    }
    return rates;
  };
  const Rates rates = rates_by([&](const PathPoint& at) { return moved_with_leg(problem, at, leg); });
  std::vector<double> result;
  for (std::size_t j = 0; j < others; ++j) result.push_back(rates.limit(j));
  std::vector<bool> confirmed(others, false);
  const std::vector<TestValue>& near = points.front().watched.tests;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i].test == Test::duration || !(near[i].value < falls * points.back().watched.tests[i].value)) continue;
    const Rates kept = rates_by([&](const PathPoint& at) {
      return moved_with(problem, at, range, [i](const Watched& watched) { return watched.tests[i].value; });
    });
    for (std::size_t j = 0; j < others; ++j) {
      const double off = std::abs(kept.limit(j) - result[j]), close = agreement * std::max(kept.size(j), rates.size(j));
      if (off > close) result[j] = std::nan("");
      if (off <= close) confirmed[j] = true;
    }
  }
  for (std::size_t j = 0; j < others; ++j)
    if (!confirmed[j]) result[j] = std::nan("");
  return result;
}

}  // namespace

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
  return moved_with(problem, at, range, [&](const Watched& watched) { return defining(point, watched); });
}

}  // namespace slapstick::orbit
