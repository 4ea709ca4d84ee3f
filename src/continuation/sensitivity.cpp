/// How special points move with other parameters: exact directions, and differences of what defines a point.
#include <array>
#include <cmath>
#include <functional>

#include "base/dense.hpp"
#include "change/death.hpp"
#include "continuation/crossing.hpp"
#include "continuation/special.hpp"
#include "orbit/extent.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Steps of the differences of a point's defining function, in units of arclength; the two that agree best are believed
/// if they agree at all.
constexpr std::array<double, 6> steps = {1e-3, 2e-4, 4e-5, 8e-6, 1.6e-6, 3.2e-7};
constexpr double agreement = 1e-3;

/// A difference quotient, and from which sides of a point it is.
struct Quotient {
  double value = std::nan("");
  bool one_sided = false;
};

/// d f / d h at zero from f(0) and values to both sides; where there are none to one side, as at a parameter's bound,
/// from two to the other. Second order.
Quotient quotient(const std::function<std::optional<double>(double)>& f, double at_zero, double h) {
  const std::optional<double> plus = f(h), minus = f(-h);
  if (plus && minus) return {(*plus - *minus) / (2.0 * h)};
  if (!plus && !minus) return {};
  const double side = plus ? h : -h;
  const std::optional<double> twice = f(2.0 * side);
  if (!twice) return {};
  return {(4.0 * (plus ? *plus : *minus) - *twice - 3.0 * at_zero) / (2.0 * side), true};
}

/// The ratio of two differences that changes least from step to step; unsettled if it never agrees with the one before.
Sensitivity best_ratio(const std::function<Quotient(double)>& ratio) {
  Sensitivity best{std::nan(""), Known::not_solved};
  double least = agreement, before = std::nan("");
  for (const double h : steps) {
    const Quotient now = ratio(h);
    if (std::isfinite(now.value) && best.known == Known::not_solved) best.known = Known::unsettled;
    const double change = std::abs(now.value - before) / std::max(std::abs(now.value), 1e-6);
    before = now.value;
    if (!(change < least)) continue;
    least = change;
    best = {now.value, now.one_sided ? Known::from_one_side : Known::from_both_sides};
  }
  return best;
}

/// A part of its unit by which another parameter is moved so that the orbit moves by no more than one of arclength. A
/// parameter that is zero has no size: the orbit says how far.
double part_of_unit(double value, const VectorXd& direction, Index column) {
  VectorXd others = direction;
  others[column] = 0.0;
  const double norm = others.norm(), most = value != 0.0 ? std::max(norm, 1.0) : norm;
  return most > 0.0 && std::isfinite(most) ? 1.0 / most : 1.0;
}

/// At a crossing the equations are singular: it is located at either side in each parameter.
std::vector<Sensitivity> crossing_sensitivity(const Problem& problem, const Orbit& orbit, double range) {
  constexpr double part = 1e-4;
  const VectorXd units = arclength_units(problem, orbit, range);
  const Linearised linear = linearise(problem, ModeSet(problem.family(), orbit.values), orbit);
  const Index own = linear.by.cols() - (problem.parameters() - 1);
  MatrixXd matrix = linear.by.leftCols(own) * units.head(own).asDiagonal();
  const VectorXd sizes = level_rows(matrix);
  const dense::LeastNorm solver(matrix);
  std::vector<Sensitivity> result;
  for (std::size_t j = 1; j < orbit.values.size(); ++j) {
    const Index column = problem.parameter_column(orbit.legs(), static_cast<Index>(j));
    const VectorXd response = solver.solve(VectorXd((-linear.by.col(column) * units[column]).cwiseQuotient(sizes)));
    VectorXd direction = VectorXd::Unit(linear.by.cols(), column);
    direction.head(own) = response;
    const double unit = units[column] * part_of_unit(orbit.values[j], direction, column);
    const auto place = [&](double h) -> std::optional<double> {
      std::vector<double> values = orbit.values;
      values[j] += h * unit;
      try {
        const auto found = crossing_near(problem, orbit, values, range);
        return found ? std::optional(found->point.orbit.parameter()) : std::nullopt;
      } catch (const InputError&) {  // no model there
      } catch (const NumericalError&) {
      }
      return std::nullopt;
    };
    const Quotient rate = quotient(place, orbit.parameter(), part);
    const Known known = !std::isfinite(rate.value) ? Known::not_solved
                        : rate.one_sided           ? Known::from_one_side
                                                   : Known::from_both_sides;
    result.push_back({rate.value / unit, known});
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

/// The directions on the solutions v(s, q) of the equations, s arclength: in which each parameter but the first moves
/// by its unit and s stays.
std::vector<VectorXd> directions(const Problem& problem, const Linearised& linear, const PathPoint& at) {
  MatrixXd matrix(linear.by.cols(), linear.by.cols());
  const Index rows = linear.by.rows();
  matrix.topRows(rows) = linear.by * at.units.asDiagonal();
  matrix.row(rows) = at.tangent.transpose();
  for (Index j = 1; j < problem.parameters(); ++j)
    matrix.row(rows + j) = Eigen::RowVectorXd::Unit(matrix.cols(), problem.parameter_column(at.orbit.legs(), j));
  std::vector<VectorXd> all;
  for (Index j = 1; j < problem.parameters(); ++j)
    all.emplace_back(dense::solve(matrix, VectorXd::Unit(matrix.rows(), rows + j)));
  return all;
}

/// How the parameter moves with each other one at a point of a branch when f(v) keeps its value on the solutions v(s,
/// q) of the equations, s arclength and q another parameter: ds/dq = -(df/dq) / (df/ds), and d
/// value / dq = dp/dq + dp/ds ds/dq. The directions are exact, the derivatives of f differences of points that solve
/// the equations: central, at a parameter's bound to one side.
std::vector<Sensitivity> moved_with(const Problem& problem, const PathPoint& at, double range,
                                    const std::function<double(const Watched&)>& f) {
  const std::size_t legs = at.orbit.legs();
  const ModeSet set(problem.family(), at.orbit.values);
  const Linearised linear = linearise(problem, set, at.orbit);
  const auto value_at = [&](const VectorXd& direction, double length) -> std::optional<double> {
    Orbit moved = at.orbit;
    move(problem, linear, length * direction.cwiseProduct(at.units), 0.0, moved);
    std::vector<Condition> conditions = fixed_parameters(problem, legs);
    conditions[0].row = at.tangent.cwiseQuotient(at.units).transpose();
    if (!solve(problem, moved, conditions).converged) return std::nullopt;
    try {
      return f(point_of(problem, moved, range, at.tangent).watched);
    } catch (const NumericalError&) {
      return std::nullopt;
    }
  };
  const auto rate = [&](const VectorXd& direction, double h) {
    return quotient([&](double length) { return value_at(direction, length); }, f(at.watched), h);
  };
  std::vector<Sensitivity> result;
  const Index place = problem.parameter_column(legs, 0);
  for (const VectorXd& direction : directions(problem, linear, at)) {
    const Index column = place + 1 + static_cast<Index>(result.size());
    const double part = part_of_unit(at.orbit.values[result.size() + 1], direction, column);
    Sensitivity moved = best_ratio([&](double h) {
      const Quotient by_other = rate(part * direction, h), along = rate(at.tangent, h);
      return Quotient{-by_other.value / (part * along.value), by_other.one_sided};
    });
    moved.value = (direction[place] + at.tangent[place] * moved.value) * at.units[place] / at.units[column];
    result.push_back(moved);
  }
  return result;
}

/// Where legs die the rates are exact. At a parameter's bound they are those of the side that there is.
std::vector<Sensitivity> death_sensitivity(const Problem& problem, Death death, const std::vector<double>& values) {
  constexpr double beside = 1e-6;  // of a parameter's value, or by itself where that is zero
  const double own = death.orbit.parameter();
  death.orbit.values = values;
  death.orbit.parameter() = own;
  const auto is_model = [&](std::size_t j, double sense) {
    std::vector<double> moved = values;
    moved[j] += sense * beside * (values[j] != 0.0 ? std::abs(values[j]) : 1.0);
    try {
      static_cast<void>(problem.family().model(moved));
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  std::vector<Sensitivity> result;
  for (const double rate : death_rates(problem, death)) {
    const std::size_t j = result.size() + 1;
    const Known known = !std::isfinite(rate)                    ? Known::unsettled
                        : is_model(j, 1.0) && is_model(j, -1.0) ? Known::from_both_sides
                                                                : Known::from_one_side;
    result.push_back({rate, known});
  }
  return result;
}

}  // namespace

std::string_view name(Known known) {
  switch (known) {
    case Known::from_both_sides:
      return "from_both_sides";
    case Known::from_one_side:
      return "from_one_side";
    case Known::unsettled:
      return "unsettled";
    case Known::not_solved:
      break;
  }
  return "not_solved";
}

std::vector<Sensitivity> sensitivities(const Family& full, const std::vector<double>& values, const SpecialPoint& point,
                                       double range) {
  const Problem problem(full, values);
  Orbit orbit = point.solution.orbit;
  if (!(range > 0.0)) range = values[0] != 0.0 ? std::abs(values[0]) : 1.0;
  orbit.values = values;
  if (point.death) return death_sensitivity(problem, *point.death, values);
  if (point.type == SpecialType::BP) return crossing_sensitivity(problem, orbit, range);
  if (point.occurrence == Occurrence::end_of_doubled) orbit = doubling(problem, orbit);
  const PathPoint at = point_of(problem, orbit, range, {});
  return moved_with(problem, at, range, [&](const Watched& watched) { return defining(point, watched); });
}

std::vector<double> sensitivity(const Family& full, const std::vector<double>& values, const SpecialPoint& point,
                                double range) {
  std::vector<double> rates;
  for (const Sensitivity& one : sensitivities(full, values, point, range)) rates.push_back(one.value);
  return rates;
}

}  // namespace slapstick::orbit
