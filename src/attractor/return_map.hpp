#pragma once
/// The n-period stroboscopic map in contact coordinates modulo the model's translations, with its Jacobian, and its fixed points by
/// Newton's method.
#include <optional>

#include "attractor/cycle.hpp"
#include "attractor/translations.hpp"

namespace slapstick::attractor {

struct MapValue {
  Eigen::VectorXd image;     ///< representative of its class
  Eigen::MatrixXd jacobian;  ///< of the classes
  Eigen::VectorXd advance;   ///< along each translation
};

/// P_n(x) of a representative x from phase 0 and its derivative through all events.
MapValue return_map(const Translations& translations, const Eigen::VectorXd& x, int n, Stop stop);

struct FixedPoint {
  Eigen::VectorXd x;
  std::vector<std::complex<double>> multipliers;  ///< largest modulus first
  [[nodiscard]] bool stable() const { return multipliers.empty() || std::abs(multipliers.front()) < 1.0; }
};

/// Eigenvalues, largest modulus first.
std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& jacobian);

/// Newton's method on P_n(x) = x from `x`; empty if it does not reach 1e-11 of `scale` in 12 steps, leaves the stops' side or is stopped.
std::optional<FixedPoint> fixed_point(const Translations& translations, Eigen::VectorXd x, int n,
                                      const Eigen::VectorXd& scale, Stop stop);

}  // namespace slapstick::attractor
