#pragma once
/// Branches as a table for people, in the manner of AUTO: a line for each end and special point.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slapstick/orbit/branch.hpp"

namespace slapstick::app {

/// d param / d each name, of the special points of one branch in their order.
struct Sensitivities {
  std::vector<std::string> names;  ///< none: not asked for
  std::vector<std::vector<double>> rates;
};

/// @param sensitivities  of each branch
[[nodiscard]] std::string branch_table(const std::vector<orbit::Branch>& branches, const std::string& parameter,
                                       const std::vector<Sensitivities>& sensitivities);

/// The classes before and behind a change of events through which the branch goes on, in the order of its points.
[[nodiscard]] std::optional<std::pair<std::string, std::string>> classes_around(const orbit::Branch& branch,
                                                                                const orbit::SpecialPoint& special);

/// Follows what is born at the special points of the branches so far, and of those, until there are `most` branches.
void follow_born(const orbit::Problem& problem, std::vector<orbit::Branch>& branches, std::size_t most,
                 const orbit::ContinuationOptions& how);

}  // namespace slapstick::app
