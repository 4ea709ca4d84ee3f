/// Zeros on a branch where its equations are singular, by interpolation of its points to either side.
#include "orbit/interpolate.hpp"

#include <cmath>
#include <numbers>

#include "orbit/short_legs.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double well_known = 1e-8;  ///< of the range: what the place may be uncertain by
constexpr int nodes = 8;             ///< of the interpolation; even: no node is at the crossing itself
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

}  // namespace

std::optional<Located> locate_between(const Problem& problem, const PathPoint& from, double near, double half_width,
                                      double range, const std::function<double(const PathPoint&)>& f) {
  constexpr double no_length = 1e-13;  // of a cycle: the orbit solves its equations, and lies on no branch
  constexpr int least_points = 6;      // near a singular point Newton's method may fail here and there
  Interpolant all(half_width), fewer(half_width), orbits(half_width), fewer_orbits(half_width);
  std::vector<std::pair<double, PathPoint>> points;
  for (int k = 0; k < nodes; ++k) {
    const double s = near + half_width * std::cos((2 * k + 1) * std::numbers::pi / (2 * nodes));
    auto point = step_to(problem, from, s, range);
    if (point && !has_leg_below(point->orbit, no_length)) points.emplace_back(s, std::move(*point));
    if (static_cast<int>(points.size()) + nodes - 1 - k < least_points) return std::nullopt;
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
  found.error = std::abs(checked.parameter() - found.point.orbit.parameter());
  if (!(found.error < well_known * range)) return std::nullopt;
  const double beside = 0.1 * half_width;
  found.point.tangent = unknowns_between(problem, orbit_at(*place - beside), orbit_at(*place + beside))
                            .cwiseQuotient(found.point.units)
                            .normalized();
  found.point.watched.turn = found.point.tangent[problem.parameter_column(from.orbit.legs(), 0)];
  return found;
}

}  // namespace slapstick::orbit
