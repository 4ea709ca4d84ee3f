#pragma once
/// The n-period stroboscopic map in contact coordinates modulo the model's translations, with its Jacobian, and its
/// fixed points by Newton's method.
#include <atomic>
#include <optional>

#include "flow/contact_state.hpp"
#include "flow/translations.hpp"

namespace slapstick::section {

/// A wish to stop; null: there is none. Whatever stops early for it returns something meaningless: the caller looks at
/// the flag itself.
using Stop = const std::atomic<bool>*;

/// Distance of two contact states, positions and velocities each relative to `scale` (same layout).
[[nodiscard]] double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& scale);

struct MapValue {
  Eigen::VectorXd image;     ///< representative of its class
  Eigen::MatrixXd jacobian;  ///< of the classes
  Eigen::VectorXd advance;   ///< along each translation
};

/// P_n(x) of a representative x from phase 0 and its derivative through all events.
MapValue return_map(const flow::Translations& translations, const Eigen::VectorXd& x, int n, Stop stop);

struct FixedPoint {
  Eigen::VectorXd x;
  Eigen::MatrixXd jacobian;                       ///< of the classes
  std::vector<std::complex<double>> multipliers;  ///< largest modulus first
  [[nodiscard]] bool stable() const { return multipliers.empty() || std::abs(multipliers.front()) < 1.0; }
};

/// Newton's method on P_n(x) = x from `x`; empty if it does not reach 1e-11 of `scale` in 40 steps, hardly nears it for
/// four, leaves the stops' side or is stopped. Beside a doubling the steps shrink by two thirds each until they are as
/// small as the doubled orbit.
std::optional<FixedPoint> fixed_point(const flow::Translations& translations, Eigen::VectorXd x, int n,
                                      const Eigen::VectorXd& scale, Stop stop);

}  // namespace slapstick::section
