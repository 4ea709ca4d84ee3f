#pragma once
/// Branches as a table for people, in the manner of AUTO: a line for each end and special point.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orbit_options.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::app {

/// d param / d each name, of the special points of one branch in their order.
struct Sensitivities {
  std::vector<std::string> names;  ///< none: not asked for
  std::vector<std::vector<orbit::Sensitivity>> rates;
};

/// The special point at which a branch was born.
struct Birth {
  std::size_t branch = 0;  ///< index of the branch that the point is on
  orbit::SpecialType type = orbit::SpecialType::PD;
  double value = 0.0;  ///< of the parameter
};

/// What a branch is followed in.
struct Followed {
  std::string parameter;
  ParameterRange range;
  const System* system = nullptr;  ///< whose contacts are named
  bool all_changes = false;        ///< false: the changes of a cascade towards a chatter are told with its onset
};

/// Where branches come from.
struct Lineage {
  std::vector<std::optional<Birth>> births;  ///< of each branch; the first has none
  /// Of each special point of each branch: the branches whose images begin there.
  std::vector<std::vector<std::vector<std::size_t>>> images;
};

/// @param sensitivities  of each branch
[[nodiscard]] std::string branch_table(const std::vector<orbit::Branch>& branches, const Followed& in,
                                       const std::vector<Sensitivities>& sensitivities, const Lineage& lineage);

/// ", the image of branch 2 is born"
[[nodiscard]] std::string image_words(const std::vector<std::size_t>& branches);

/// Does a special point lie before the first point of its branch, which ends there?
[[nodiscard]] bool begins_at(const orbit::Branch& branch, const orbit::SpecialPoint& special);

/// Follows what is born at the special points of the branches so far, and of those, until there are `most` branches.
[[nodiscard]] Lineage follow_born(const orbit::Problem& problem, std::vector<orbit::Branch>& branches, std::size_t most,
                                  const orbit::ContinuationOptions& how);

}  // namespace slapstick::app
