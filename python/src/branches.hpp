#pragma once
/// Branches and special points as Python keeps them.
#include "orbits.hpp"

namespace slapstick::python {

struct FollowedBranch {
  SharedSetting setting;
  orbit::Branch branch;
  double from = 0.0, to = 0.0;
  bool complete = true;
};

/// A special point, with the branch that it lies on.
struct Special {
  std::shared_ptr<const FollowedBranch> of;
  std::size_t index = 0;

  [[nodiscard]] const orbit::SpecialPoint& point() const { return of->branch.special[index]; }
};

}  // namespace slapstick::python
