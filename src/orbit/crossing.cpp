#include "orbit/crossing.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "orbit/record.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int nodes = 8;             ///< of the interpolation; even: none is at the crossing itself
constexpr double amplitude = 2e-3;   ///< of the orbits beside a crossing, arclength
constexpr double difference = 1e-4;  ///< over which J is differentiated
constexpr double well_known = 1e-8;  ///< of the range: what the place may be uncertain by

/// All numbers of an orbit but its shape, in a row.
VectorXd numbers_of(const Orbit& orbit) {
  const Index size = orbit.x[0].size(), legs = static_cast<Index>(orbit.legs());
  VectorXd all(size * legs + legs + 1 + static_cast<Index>(orbit.values.size()) + orbit.advance.size());
  Index at = 0;
  for (const VectorXd& x : orbit.x) all.segment(size * at++, size) = x;
  all.tail(all.size() - size * legs) << VectorXd::Map(orbit.t.data(), legs + 1),
      VectorXd::Map(orbit.values.data(), static_cast<Index>(orbit.values.size())), orbit.advance;
  return all;
}

Orbit with_numbers(Orbit orbit, const VectorXd& all) {
  const Index size = orbit.x[0].size();
  const double* at = all.data();
  for (VectorXd& x : orbit.x) x = VectorXd::Map(at, size), at += size;
  for (double& t : orbit.t) t = *at++;
  for (double& value : orbit.values) value = *at++;
  orbit.advance = VectorXd::Map(at, orbit.advance.size());
  return orbit;
}

/// The polynomial through values at some places (barycentric form).
class Interpolant {
 public:
  explicit Interpolant(double half_width) : half_width_(half_width) {}

  void add(double place, VectorXd value) {
    places_.push_back(place);
    values_.push_back(std::move(value));
  }

  [[nodiscard]] VectorXd at(double s) const {
    VectorXd sum = VectorXd::Zero(values_[0].size());
    double weights = 0.0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      if (s == places_[k]) return values_[k];
      double weight = 1.0 / (s - places_[k]);
      for (std::size_t j = 0; j < places_.size(); ++j)
        if (j != k) weight *= half_width_ / (places_[k] - places_[j]);
      sum += weight * values_[k];
      weights += weight;
    }
    return sum / weights;
  }

  /// Is what the others lead to at the first and the last place much like what it is there?
  [[nodiscard]] bool smooth(const Interpolant& others) const {
    double size = 0.0;
    for (const VectorXd& value : values_) size = std::max(size, std::abs(value[0]));
    const auto off = [&](std::size_t k) { return std::abs(others.at(places_[k])[0] - values_[k][0]); };
    return std::max(off(0), off(places_.size() - 1)) < 0.1 * size;
  }

  /// The zero of the first component near a place, by the secant rule.
  [[nodiscard]] std::optional<double> zero(double near) const {
    double a = near - 0.1 * half_width_, b = near + 0.1 * half_width_, f_a = at(a)[0];
    for (int k = 0; k < 50; ++k) {
      const double f_b = at(b)[0];
      if (f_b == 0.0 || f_a == f_b || std::abs(b - a) < 1e-15) return b;
      const double next = b - f_b * (b - a) / (f_b - f_a);
      if (!(std::abs(next - near) < half_width_)) return std::nullopt;
      a = b;
      f_a = f_b;
      b = next;
    }
    return b;
  }

 private:
  double half_width_;
  std::vector<double> places_;
  std::vector<VectorXd> values_;
};

/// A leg without length solves its equation anywhere: such orbits are none of a branch.
bool has_an_empty_leg(const Orbit& orbit) {
  constexpr double rounding = 1e-13;  // of a cycle
  for (std::size_t leg = 0; leg < orbit.legs(); ++leg)
    if (!in_burst(orbit, leg) && std::abs(orbit.duration(leg)) < rounding * (orbit.t.back() - orbit.t.front()))
      return true;
  return false;
}

/// The determinant that is zero at a crossing, smooth along a branch: units, row and scales are those of one point.
class Determinant {
 public:
  Determinant(const Problem& problem, const PathPoint& base) : problem_(problem), base_(base) {
    MatrixXd matrix = at(base.orbit);
    scales_ = level_rows(matrix);
  }

  [[nodiscard]] double operator()(const Orbit& orbit) const {
    return (scales_.cwiseInverse().asDiagonal() * at(orbit)).partialPivLu().determinant();
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

std::optional<Located> locate_between(const Problem& problem, const PathPoint& from, double near, double half_width,
                                      double range, const std::function<double(const PathPoint&)>& f) {
  constexpr int enough = 6;  // near a singular point Newton's method may fail here and there
  Interpolant all(half_width), fewer(half_width), orbits(half_width), fewer_orbits(half_width);
  std::vector<std::pair<double, PathPoint>> points;
  for (int k = 0; k < nodes; ++k) {
    const double s = near + half_width * std::cos((2 * k + 1) * std::numbers::pi / (2 * nodes));
    auto point = step_to(problem, from, s, range);
    if (point && !has_an_empty_leg(point->orbit)) points.emplace_back(s, std::move(*point));
    if (static_cast<int>(points.size()) + nodes - 1 - k < enough) return std::nullopt;
  }
  for (const auto& [s, point] : points) {
    const VectorXd value = VectorXd::Constant(1, f(point));
    all.add(s, value);
    orbits.add(s, numbers_of(point.orbit));
    if (s == points.front().first || s == points.back().first) continue;
    fewer.add(s, value);
    fewer_orbits.add(s, numbers_of(point.orbit));
  }
  const std::optional<double> place = all.zero(near), check = fewer.zero(near);
  if (!place || !check || !all.smooth(fewer)) return std::nullopt;
  const auto orbit_at = [&](double s) { return with_numbers(from.orbit, orbits.at(s)); };
  const Orbit checked = with_numbers(from.orbit, fewer_orbits.at(*check));
  Located found{point_of(problem, orbit_at(*place), range, from.tangent), *place, 0.0};
  found.error = std::abs(checked.values[0] - found.point.orbit.values[0]);
  if (!(found.error < well_known * range)) return std::nullopt;
  const double beside = 0.1 * half_width;
  found.point.tangent = unknowns_between(problem, orbit_at(*place - beside), orbit_at(*place + beside))
                            .cwiseQuotient(found.point.units)
                            .normalized();
  found.point.watched.turn = found.point.tangent[problem.parameter_column(from.orbit.legs(), 0)];
  return found;
}

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

std::optional<Located> crossing_near(const Problem& problem, const Orbit& orbit, double range) {
  for (const double aside :
       {0.02, -0.02, 0.005, -0.005}) {  // of the range, on the branch, where the equations are regular
    Orbit start = orbit;
    start.values[0] -= aside * range;
    const std::optional<Orbit> beside = refine(problem, start);
    if (!beside) continue;
    const PathPoint from = point_of(problem, *beside, range, {});
    double near = aside / from.watched.turn;
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
  const Eigen::JacobiSVD<MatrixXd> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const MatrixXd null = svd.matrixV().rightCols(2);
  const VectorXd psi = svd.matrixU().rightCols(1).cwiseQuotient(scales);
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
