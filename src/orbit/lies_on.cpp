#include "orbit/lies_on.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick::orbit {

using Eigen::VectorXd;

bool between(const Orbit& a, const Orbit& b, const Orbit& orbit) {
  constexpr double same = 1e-3;  // of an orbit's size: between two points the branch is nearly straight
  const double part = (orbit.values[0] - a.values[0]) / (b.values[0] - a.values[0]);
  if (!(part >= 0.0 && part <= 1.0) || a.legs() != orbit.legs() || !(a.shape.legs == b.shape.legs)) return false;
  for (std::size_t shift = 0; shift < a.legs(); ++shift) {
    bool equal = true;
    for (std::size_t i = 0; equal && i < a.legs(); ++i) {
      const std::size_t k = (i + shift) % a.legs();
      const VectorXd x = (1.0 - part) * a.x[k] + part * b.x[k];
      const double t = (1.0 - part) * a.t[k] + part * b.t[k];
      equal = a.shape.legs[k] == orbit.shape.legs[i] &&
              (x - orbit.x[i]).norm() < same * std::max(x.norm(), orbit.x[i].norm()) &&
              (orbit.shape.n == 0 || std::abs(std::remainder(t - orbit.t[i], 1.0)) < same);
    }
    if (equal) return true;
  }
  return false;
}

bool lies_on_first(std::size_t count, const Branch& branch, const Orbit& orbit) {
  for (std::size_t i = 0; i + 1 < count; ++i)
    if (between(branch.points[i].orbit, branch.points[i + 1].orbit, orbit)) return true;
  return false;
}

bool lies_on(const Branch& branch, const Orbit& orbit) { return lies_on_first(branch.points.size(), branch, orbit); }

}  // namespace slapstick::orbit
