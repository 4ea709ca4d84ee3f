#pragma once
/// Branches as a table for people, in the manner of AUTO: a line for each end and special point.
#include <string>
#include <vector>

#include "slapstick/orbit/branch.hpp"

namespace slapstick::app {

[[nodiscard]] std::string branch_table(const std::vector<orbit::Branch>& branches, const std::string& parameter);

/// Follows the doubled orbits of the period doublings of the branches so far, until there are `most` branches.
void follow_doublings(const orbit::Problem& problem, std::vector<orbit::Branch>& branches, std::size_t most,
                      const orbit::ContinuationOptions& how);

}  // namespace slapstick::app
