#pragma once
/// Sets of eigenvalues or multipliers are compared one by one, each with the nearest that is left of the other set.
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

namespace slapstick::neutral {

using Spectrum = std::vector<std::complex<double>>;

/// Takes out of a set the value that is nearest to another one; nothing of an empty set.
inline std::optional<std::complex<double>> take_nearest(Spectrum& set, std::complex<double> wanted) {
  const auto nearest = std::ranges::min_element(set, {}, [&](const auto& value) { return std::abs(value - wanted); });
  if (nearest == set.end()) return std::nullopt;
  const std::complex<double> taken = *nearest;
  set.erase(nearest);
  return taken;
}

}  // namespace slapstick::neutral
