#pragma once
/// A rule applied to an answer, and what then differs from another one.
#include <optional>
#include <string>

#include "neutral/answer.hpp"
#include "neutral/edits.hpp"

namespace slapstick::neutral {

struct Difference {
  std::string what;   ///< in words, with both values
  double time = 0.0;  ///< of the first motion; 0 where the difference is not of a trajectory
};

/// The earliest difference of the second answer from the first, transformed by the rule; nothing if they agree.
/// @param tolerance  as a part of the largest number of the same dimension; 0: the same bits
[[nodiscard]] std::optional<Difference> difference(const Answer& first, const Answer& second, const Rule& rule,
                                                   double grid, double tolerance);

}  // namespace slapstick::neutral
