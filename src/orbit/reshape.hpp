#pragma once
/// Behind a point where the events of an orbit change: the sequence of the motion there, and the orbits of that sequence.
#include "orbit/path.hpp"

namespace slapstick::orbit {

struct Reshaped {
  PathPoint point;     ///< a motion; its tangent leads away from the change
  bool folds = false;  ///< it lies on the side of the parameter from which the old branch came
};

/// @param change  where the events change; the old branch is followed along its tangent
/// @param test    the margin that is used up there
/// @returns empty if no orbit with the events of the motion beyond is found whose branch, followed back, comes to the change
[[nodiscard]] std::optional<Reshaped> reshape(const Problem& problem, const PathPoint& change, const TestValue& test,
                                              double range);

}  // namespace slapstick::orbit
