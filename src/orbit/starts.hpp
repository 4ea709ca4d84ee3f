#pragma once
/// Where the motions of a search begin: random admissible states around what a first motion is like over its first
/// periods.
#include <optional>
#include <random>

#include "flow/translations.hpp"

namespace slapstick::orbit {

class Starts {
 public:
  /// Follows a motion for some periods: the mean and the ranges of its displacements and velocities, between events and
  /// at them. What the motion leaves at rest has the size that the forces alone would give it in a period.
  /// @param stop as run_to
  /// @param unit of a free motion: what stands for a period, in periods of the clock
  Starts(const flow::Translations& translations, Motion motion, const std::atomic<bool>* stop,
         std::optional<double> unit = {});

  /// A state in contact coordinates: the mean and `spread` normal deviates of the ranges; no stop is overlapped.
  [[nodiscard]] Eigen::VectorXd draw(std::mt19937& random, double spread) const;

  /// The largest range of a displacement for all displacements, and of a velocity for all velocities.
  [[nodiscard]] const Eigen::VectorXd& sizes() const { return sizes_; }

 private:
  void see(const Motion& motion);
  void set_sizes();
  [[nodiscard]] Eigen::VectorXd gaps(const Eigen::VectorXd& x) const;

  const flow::Translations& translations_;
  Eigen::VectorXd low_, high_, sum_;
  long seen_ = 0;
  double unit_ = 1.0;
  Eigen::VectorXd ranges_, sizes_;
};

}  // namespace slapstick::orbit
