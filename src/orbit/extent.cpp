/// Measures how far the states of an orbit vary, and distances by that.
#include "orbit/extent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slapstick::orbit {

using Eigen::Index;
using Eigen::VectorXd;

Extent::Extent(const Problem& problem, const Orbit& orbit)
    : translations_(&problem.translations()), velocities_(problem.translations().velocities()) {
  constexpr int samples = 4;  // of each leg: at its events an orbit may be next to nothing
  const ModeSet set(constant_family(problem.family().model(orbit.values)), {});
  VectorXd low = VectorXd::Constant(problem.numbers(), INFINITY), high = -low;
  for (std::size_t i = 0; i < orbit.legs(); ++i)
    for (int k = 0; k <= samples; ++k) {
      VectorXd x = contact_state(set, state_within(set, orbit, i, orbit.duration(i) * k / samples));
      translations_->take_out(x);
      const VectorXd numbers = translations_->numbers(x);
      low = low.cwiseMin(numbers);
      high = high.cwiseMax(numbers);
    }
  const VectorXd range = high - low;
  const Index displacements = range.size() - velocities_;
  if (displacements > 0) displacement_ = range.head(displacements).maxCoeff();
  velocity_ = range.tail(velocities_).maxCoeff();
  const double away = displacements > 0 ? low.cwiseAbs().cwiseMax(high.cwiseAbs()).head(displacements).maxCoeff() : 0.0,
               cycle = (orbit.t.back() - orbit.t.front()) * set.period();
  if (at_rest(displacement_ / cycle, away, cycle)) displacement_ = 0.0;
  if (at_rest(velocity_, away, cycle)) velocity_ = 0.0;
}

double Extent::distance(VectorXd a, VectorXd b) const {
  translations_->take_out(a);
  translations_->take_out(b);
  const VectorXd left = translations_->numbers(a), right = translations_->numbers(b);
  const double whole = left.cwiseAbs().cwiseMax(right.cwiseAbs()).maxCoeff();
  const auto part = [&](const VectorXd& of_left, const VectorXd& of_right, double range) {
    if (of_left.size() == 0) return 0.0;
    const double apart = (of_left - of_right).cwiseAbs().maxCoeff();
    return apart > 0.0 ? apart / (range > 0.0 ? range : whole) : 0.0;
  };
  const Index displacements = left.size() - velocities_;
  return std::max(part(left.head(displacements), right.head(displacements), displacement_),
                  part(left.tail(velocities_), right.tail(velocities_), velocity_));
}

int equal_parts(const Problem& problem, const Orbit& orbit, double tolerance) {
  const std::size_t legs = orbit.legs();
  const double cycle = orbit.t.back() - orbit.t.front();
  std::optional<Extent> extent;
  for (std::size_t part = 1; part < legs; ++part) {
    if (legs % part != 0) continue;
    const double shorter = cycle * static_cast<double>(part) / static_cast<double>(legs);
    bool same = true;
    for (std::size_t i = 0; same && i + part < legs; ++i) {
      same = orbit.shape.legs[i] == orbit.shape.legs[i + part] &&
             std::abs(orbit.t[i + part] - orbit.t[i] - shorter) <= tolerance * cycle;
      if (!same) break;
      if (!extent) extent.emplace(problem, orbit);
      same = extent->distance(orbit.x[i], orbit.x[i + part]) <= tolerance;
    }
    if (same) return static_cast<int>(legs / part);
  }
  return 1;
}

int times_over(const Problem& problem, const Orbit& orbit, double tolerance) {
  return std::gcd(equal_parts(problem, orbit, tolerance), orbit.shape.n);  // without forcing n is 0: all of them
}

Orbit once(const Problem& problem, Orbit orbit, double tolerance) {
  const int times = times_over(problem, orbit, tolerance);
  const std::size_t legs = orbit.legs() / static_cast<std::size_t>(times);
  orbit.shape.legs.resize(legs);
  orbit.x.resize(legs);
  orbit.t.resize(legs + 1);
  orbit.shape.n /= times;
  return orbit;
}

bool becomes_shorter(const Problem& problem, const Orbit& before, const Orbit& orbit, double tolerance) {
  constexpr double same_part = 1e-7;
  if (before.shape.legs[0].ending == Ending::cut) return false;  // one without events has no legs that could be equal
  return equal_parts(problem, orbit, tolerance) > equal_parts(problem, before, same_part);
}

}  // namespace slapstick::orbit
