#pragma once
/// The mean of a sequence of growth rates, and how well it is known.
#include <vector>

namespace slapstick::attractor {

inline constexpr int batches = 20;

struct Mean {
  double value = 0.0, error = 0.0;
};

/// Of 20 batches of equal length; the error is the standard error of their means. What is left over at the end is not
/// used.
/// @param rates  at least 20
[[nodiscard]] Mean batch_mean(const std::vector<double>& rates);

}  // namespace slapstick::attractor
