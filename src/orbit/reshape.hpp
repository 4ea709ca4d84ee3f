#pragma once
/// Behind a point where the events of an orbit change: the sequence of the motion there, and the orbits of that sequence.
#include "orbit/path.hpp"

namespace slapstick::orbit {

struct Reshaped {
  PathPoint point;                   ///< a motion; its tangent leads away from the change
  bool folds = false;                ///< it lies on the side of the parameter from which the old branch came
  std::optional<Located> gathering;  ///< where its complete chatter begins, infinitely many changes behind this one
};

/// @param change  where the events change; the old branch is followed along its tangent
/// @param test    the margin that is used up there
/// @returns the orbits with the events of the motion beyond whose branches, followed back, come to the change
[[nodiscard]] std::vector<Reshaped> reshape(const Problem& problem, const PathPoint& change, const TestValue& test,
                                            double range);

/// What the motion settles on behind a change, in a word: the label of an orbit. Empty if on none within some hundred periods.
[[nodiscard]] std::string behind(const Problem& problem, const PathPoint& change, double range);

}  // namespace slapstick::orbit
