/// Tangents, steps along a branch, and the functions that are watched on it.
#include "orbit/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// The direction along which the equations stay solved.
VectorXd tangent_at(const Problem& problem, const Linearised& at, std::size_t legs, const VectorXd& units,
                    const VectorXd& forward) {
  VectorXd last = forward;
  if (last.size() == 0) {  // of a matrix with one row too few the last singular vector
    MatrixXd matrix = bordered(problem, at, legs, units, VectorXd::Unit(at.by.cols(), 0));
    level_rows(matrix);
    last = dense::right_singular_vectors(matrix.topRows(matrix.rows() - 1)).rightCols(1);
    if (last[problem.parameter_column(legs, 0)] < 0.0) last = -last;
  }
  MatrixXd matrix = bordered(problem, at, legs, units, last);
  level_rows(matrix);
  VectorXd tangent = dense::solve(matrix, VectorXd::Unit(matrix.rows(), matrix.rows() - 1));
  tangent.normalize();
  return tangent.dot(last) < 0.0 ? VectorXd(-tangent) : tangent;
}

/// Each but once.
std::vector<std::complex<double>> distinct(const std::vector<std::complex<double>>& multipliers) {
  // Half of the digits, of 1 + |mu|: a double one is known to no more where two pairs meet.
  const double equal = std::sqrt(std::numeric_limits<double>::epsilon());
  std::vector<std::complex<double>> once;
  for (const auto& mu : multipliers)
    if (ranges::none_of(once, [&](const auto& other) { return std::abs(other - mu) <= equal * (1.0 + std::abs(mu)); }))
      once.push_back(mu);
  return once;
}

}  // namespace

double flip_function(const std::vector<std::complex<double>>& multipliers) {
  std::complex<double> product = 1.0;
  for (const auto& mu : multipliers) product *= (mu + 1.0) / (1.0 + std::abs(mu));
  return product.real();
}

double torus_function(const std::vector<std::complex<double>>& multipliers) {
  std::complex<double> product = 1.0;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = i + 1; j < multipliers.size(); ++j) {
      const std::complex<double> p = multipliers[i] * multipliers[j];
      product *= (p - 1.0) / (1.0 + std::abs(p));
    }
  return product.real();
}

MatrixXd bordered(const Problem& problem, const Linearised& at, std::size_t legs, const VectorXd& units,
                  const VectorXd& last_row) {
  const Index others = problem.parameters() - 1;
  MatrixXd matrix(at.by.rows() + others + 1, at.by.cols());
  matrix.topRows(at.by.rows()) = at.by * units.asDiagonal();
  for (Index j = 0; j < others; ++j)
    matrix.row(at.by.rows() + j) = RowVectorXd::Unit(at.by.cols(), problem.parameter_column(legs, j + 1));
  matrix.bottomRows(1) = last_row.transpose();
  return matrix;
}

VectorXd arclength_units(const Problem& problem, const Orbit& orbit, double range) {
  VectorXd units = sizes(problem, orbit);
  const auto instants = static_cast<Index>(orbit.t.size());
  units.segment(problem.instant_column(0), instants) *= std::sqrt(static_cast<double>(instants));
  units.head(problem.numbers()) = units.head(problem.numbers()).cwiseMax(problem.least_sizes());
  units[problem.parameter_column(orbit.legs(), 0)] = range;
  return units;
}

PathPoint point_of(const Problem& problem, Orbit orbit, double range, const VectorXd& forward) {
  PathPoint point;
  const ModeSet set(problem.family(), orbit.values);
  const Linearised at = linearise(problem, set, orbit);
  point.units = arclength_units(problem, orbit, range);
  point.tangent = tangent_at(problem, at, orbit.legs(), point.units, forward);
  point.watched.turn = point.tangent[problem.parameter_column(orbit.legs(), 0)];
  MatrixXd crossing = bordered(problem, at, orbit.legs(), point.units, point.tangent);
  level_rows(crossing);
  point.watched.cross = dense::determinant(crossing);
  point.watched.multipliers = multipliers(problem, set, orbit, at.legs);
  point.watched.kept = at.kept;
  for (std::size_t i = 0; i < at.kept.size(); ++i) drop_kept_direction(point.watched.multipliers);
  if (ranges::any_of(orbit.shape.legs, &Leg::tied)) point.watched.multipliers = distinct(point.watched.multipliers);
  point.watched.flip = flip_function(point.watched.multipliers);
  point.watched.torus = torus_function(point.watched.multipliers);
  point.watched.tests = test_values(set, orbit);
  point.orbit = std::move(orbit);
  return point;
}

PathPoint reversed(PathPoint point) {
  point.tangent = -point.tangent;
  point.watched.turn = -point.watched.turn;
  point.watched.cross = -point.watched.cross;
  return point;
}

VectorXd unknowns_between(const Problem& problem, const Orbit& a, const Orbit& b) {
  VectorXd between(problem.unknowns(a.legs()));
  between.head(problem.numbers()) = problem.translations().numbers(b.x[0] - a.x[0]);
  for (std::size_t i = 0; i <= a.legs(); ++i) between[problem.instant_column(i)] = b.t[i] - a.t[i];
  for (Index j = 0; j < problem.parameters(); ++j)
    between[problem.parameter_column(a.legs(), j)] =
        b.values[static_cast<std::size_t>(j)] - a.values[static_cast<std::size_t>(j)];
  return between;
}

double arclength(const Problem& problem, const PathPoint& from, const Orbit& to) {
  return from.tangent.dot(unknowns_between(problem, from.orbit, to).cwiseQuotient(from.units));
}

std::optional<PathPoint> step_to(const Problem& problem, const PathPoint& from, double length, double range, int* steps,
                                 std::string* why) {
  try {
    Orbit orbit = from.orbit;
    const ModeSet set(problem.family(), orbit.values);
    const Linearised at = linearise(problem, set, orbit);
    const VectorXd change = length * from.tangent.cwiseProduct(from.units);
    move(problem, at, change, 0.0, orbit);
    std::vector<Condition> conditions = fixed_parameters(problem, orbit.legs());
    conditions[0].row = from.tangent.cwiseQuotient(from.units).transpose();
    const NewtonResult result = solve(problem, orbit, conditions, 8);
    if (steps != nullptr) *steps = result.steps;
    if (why != nullptr && !result.refusal.empty()) *why = result.refusal;
    if (!result.converged) return std::nullopt;
    return point_of(problem, std::move(orbit), range, from.tangent);
  } catch (const InputError& error) {
    if (why != nullptr) *why = error.what();
  } catch (const NumericalError& error) {
    if (why != nullptr) *why = error.what();
  }
  return std::nullopt;
}

namespace {

/// What rounding leaves of a located place: on a smooth branch the middle of three near points lies in the middle.
double rounding_at(const Problem& problem, const PathPoint& from, const Located& located, double length, double range,
                   const std::function<double(const Watched&)>& f) {
  constexpr double beside = 1e-5;  // of the step: over so much the branch is straight to 1e-12
  const double h = beside * length;
  const auto left = step_to(problem, from, located.length - h, range),
             right = step_to(problem, from, located.length + h, range);
  if (!left || !right) return 0.0;
  const auto off = [](double a, double middle, double b) { return 0.5 * std::abs(a + b - 2.0 * middle); };
  const double f_left = f(left->watched), f_right = f(right->watched), f_here = f(located.point.watched);
  const double v_left = left->orbit.parameter(), v_right = right->orbit.parameter(),
               v_here = located.point.orbit.parameter();
  const double across = f_right != f_left ? std::abs((v_right - v_left) / (f_right - f_left)) : 0.0;
  return off(v_left, v_here, v_right) + across * off(f_left, f_here, f_right);
}

}  // namespace

std::optional<Located> locate(const Problem& problem, const PathPoint& from, double length, double range,
                              const std::function<double(const Watched&)>& f, double f_to) {
  constexpr double place_rounding = 1e-13;
  const double f_from = f(from.watched);
  double a = 0.0, b = length, f_a = f_from, f_b = f_to;
  std::optional<Located> best;
  double value = from.orbit.parameter();
  int side = 0;
  for (int k = 0; k < 60; ++k) {
    double s = (a * f_b - b * f_a) / (f_b - f_a);
    if (!std::isfinite(s) || k > 40) s = 0.5 * (a + b);
    std::optional<PathPoint> point = step_to(problem, from, s, range);
    if (!point) return best;
    const double f_s = f(point->watched), change = std::abs(point->orbit.parameter() - value);
    value = point->orbit.parameter();
    best = Located{std::move(*point), s, change};
    // A first step is next to none where f is hardly more than zero at its beginning.
    const bool arrived = change <= place_rounding * range && std::abs(f_s) < 0.1 * std::abs(f_from);
    if (f_s == 0.0 || arrived || b - a <= place_rounding) break;
    const bool left = (f_s > 0.0) == (f_a > 0.0);
    (left ? a : b) = s;
    (left ? f_a : f_b) = f_s;
    // Illinois: the end that stays is halved, so that it moves next time.
    if (left && side == 1) f_b *= 0.5;
    if (!left && side == -1) f_a *= 0.5;
    side = left ? 1 : -1;
  }
  if (best) best->error = std::max(best->error, rounding_at(problem, from, *best, length, range, f));
  return best;
}

}  // namespace slapstick::orbit
