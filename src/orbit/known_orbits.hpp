#pragma once
/// The orbits that a search has come to, and whether another is one of them.
#include <vector>

#include "orbit/same_motion.hpp"

namespace slapstick::orbit {

inline constexpr double same_orbit = 1e-6;  ///< relative distance of the states of two orbits that are one

class KnownOrbits {
 public:
  explicit KnownOrbits(const Problem& problem) : problem_(problem) {}

  void add(const Orbit& orbit);
  /// Is it one of these? Equal legs tell soonest. Others may be the same motion: how many impacts of a chatter are legs
  /// of their own is a matter of where it was recorded.
  [[nodiscard]] bool has(const Orbit& orbit) const;
  [[nodiscard]] const std::vector<Orbit>& orbits() const { return orbits_; }

 private:
  /// The displacements at some phases: continuous, so that orbits whose prints differ are two.
  using Fingerprint = std::vector<Eigen::VectorXd>;
  [[nodiscard]] Fingerprint fingerprint(const Orbit& orbit) const;
  [[nodiscard]] static bool may_be_one(const Fingerprint& a, const Fingerprint& b);

  const Problem& problem_;
  std::vector<Orbit> orbits_;
  std::vector<Fingerprint> fingerprints_;
};

}  // namespace slapstick::orbit
