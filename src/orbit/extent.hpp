#pragma once
/// How far the states of an orbit vary over its cycle, by which distances between states are measured: they depend
/// neither on units nor on where the origin lies, and a motion that drifts along a translation of the model is as good
/// as one that does not.
#include "orbit/equations.hpp"

namespace slapstick::orbit {

class Extent {
 public:
  /// From some instants of each leg.
  /// @throws as the family and System
  Extent(const Problem& problem, const Orbit& orbit);

  /// The largest range of a velocity over the cycle.
  [[nodiscard]] double velocity() const { return velocity_; }
  /// The distance of two contact states modulo translations: the largest of displacements and of velocities, each
  /// against the largest range of one over the cycle. Where nothing varies, as at rest, against the states themselves.
  [[nodiscard]] double distance(Eigen::VectorXd a, Eigen::VectorXd b) const;

 private:
  const flow::Translations* translations_;
  Eigen::Index velocities_;
  double displacement_ = 0.0, velocity_ = 0.0;
};

/// Of how many equal parts, one after another, an orbit is made: 1 of most.
/// Forced at even harmonics only, an orbit of one period may be two equal halves.
/// @param tolerance  of distances between states, and of instants against the cycle
[[nodiscard]] int equal_parts(const Problem& problem, const Orbit& orbit, double tolerance);

/// How many times over an orbit is a shorter one, of whole forcing periods.
[[nodiscard]] int times_over(const Problem& problem, const Orbit& orbit, double tolerance);

/// Of an orbit that is a shorter one several times over, that one.
[[nodiscard]] Orbit once(const Problem& problem, Orbit orbit, double tolerance);

/// Has an orbit become one of more equal parts than another of its branch?
[[nodiscard]] bool becomes_shorter(const Problem& problem, const Orbit& before, const Orbit& orbit, double tolerance);

}  // namespace slapstick::orbit
