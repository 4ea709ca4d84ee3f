/// Whether an orbit is one of those that a search has come to before.
#include "orbit/known_orbits.hpp"

#include <algorithm>
#include <cmath>

#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int fingerprint_phases = 5;  ///< of a period, in a fingerprint

/// Are two cycles the same, begun at another event or in another period?
bool same_from_some_event(const Extent& extent, const Orbit& a, const Orbit& b) {
  return from_some_event(a, b, [&](std::size_t shift) {
    return extent.distance(a.x[0], b.x[shift]) <= same_orbit &&
           (a.shape.n == 0 || std::abs(std::remainder(a.t[0] - b.t[shift], 1.0)) < same_orbit);
  });
}

}  // namespace

KnownOrbits::Fingerprint KnownOrbits::fingerprint(const Orbit& orbit) const {
  const ModeSet set(constant_family(problem_.family().model(orbit.values)), {});
  const Index n = set.frame().n;
  Fingerprint all;
  std::size_t leg = 0;
  for (int k = 0; k < fingerprint_phases * orbit.shape.n; ++k) {
    const double t = std::ceil(orbit.t.front()) + static_cast<double>(k) / fingerprint_phases;
    const double within = t < orbit.t.back() ? t : t - orbit.shape.n;
    if (within < t) leg = 0;
    while (leg + 1 < orbit.legs() && orbit.t[leg + 1] <= within) ++leg;
    VectorXd x = contact_state(set, state_within(set, orbit, leg, within - orbit.t[leg]));
    problem_.translations().take_out(x);
    all.push_back(x.head(n));
  }
  return all;
}

/// In the same or another period.
bool KnownOrbits::may_be_one(const Fingerprint& a, const Fingerprint& b) {
  constexpr double fingerprint_tolerance = 1e-4;  // a hundred times what makes two orbits one
  if (a.size() != b.size()) return false;
  double size = 0.0;
  for (const VectorXd& x : a) size = std::max(size, x.cwiseAbs().maxCoeff());
  for (std::size_t shift = 0; shift < a.size(); shift += fingerprint_phases) {
    double apart = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
      apart = std::max(apart, (a[k] - b[(k + shift) % b.size()]).cwiseAbs().maxCoeff());
    if (apart <= fingerprint_tolerance * size) return true;
  }
  return a.empty();
}

void KnownOrbits::add(const Orbit& orbit) {
  orbits_.push_back(orbit);
  fingerprints_.push_back(fingerprint(orbit));
}

bool KnownOrbits::has(const Orbit& orbit) const {
  const Extent extent(problem_, orbit);
  const Fingerprint own = fingerprint(orbit);
  for (std::size_t i = 0; i < orbits_.size(); ++i) {
    if (orbits_[i].shape.n != orbit.shape.n || !may_be_one(own, fingerprints_[i])) continue;
    if (same_from_some_event(extent, orbit, orbits_[i]) || apart(problem_, orbit, orbits_[i]) < same_orbit) return true;
  }
  return false;
}

}  // namespace slapstick::orbit
