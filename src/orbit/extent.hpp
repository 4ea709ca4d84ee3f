#pragma once
/// How far the states of an orbit vary over its cycle, by which distances between states are measured: they depend neither on units nor on where the
/// origin lies, and a motion that drifts along a translation of the model is as good as one that does not.
#include "orbit/equations.hpp"

namespace slapstick::orbit {

class Extent {
 public:
  /// From some instants of each leg.
  /// @throws as the family and System
  Extent(const Problem& problem, const Orbit& orbit);

  /// The largest range of a velocity over the cycle.
  [[nodiscard]] double velocity() const { return velocity_; }
  /// The distance of two contact states modulo translations: the largest of displacements and of velocities, each against the largest range of one over
  /// the cycle. Where nothing varies, as at rest, against the states themselves.
  [[nodiscard]] double distance(Eigen::VectorXd a, Eigen::VectorXd b) const;

 private:
  const flow::Translations* translations_;
  Eigen::Index velocities_;
  double displacement_ = 0.0, velocity_ = 0.0;
};

/// The legs of which an orbit is a whole number of equal cycles, one after another, if there are fewer than its own.
/// @param tolerance  of distances between states, and of instants against the cycle
[[nodiscard]] std::optional<std::size_t> repeats(const Problem& problem, const Orbit& orbit, double tolerance);

/// Of an orbit that is a shorter one several times over, that one.
[[nodiscard]] Orbit once(const Problem& problem, Orbit orbit, double tolerance);

/// Has an orbit become one of equal cycles that another of its branch is not? Forced at even harmonics only, every orbit may be two equal halves.
[[nodiscard]] bool becomes_shorter(const Problem& problem, const Orbit& before, const Orbit& orbit, double tolerance);

}  // namespace slapstick::orbit
