#pragma once
/// Branches as a table for people, in the manner of AUTO: a line for each end and special point.
#include <string>
#include <vector>

#include "slapstick/orbit/branch.hpp"

namespace slapstick::app {

[[nodiscard]] std::string branch_table(const std::vector<orbit::Branch>& branches, const std::string& parameter);

/// Follows what is born at the special points of the branches so far, and of those, until there are `most` branches.
void follow_born(const orbit::Problem& problem, std::vector<orbit::Branch>& branches, std::size_t most,
                 const orbit::ContinuationOptions& how);

}  // namespace slapstick::app
