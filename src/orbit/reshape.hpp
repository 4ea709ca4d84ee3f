#pragma once
/// Behind a point where the events of an orbit change: the sequence of the motion there, and the orbits of that sequence.
#include "orbit/path.hpp"

namespace slapstick::orbit {

struct Reshaped {
  PathPoint point;       ///< a motion; its tangent leads away from the change
  bool folds = false;    ///< it lies on the side of the parameter from which the old branch came
  bool renewed = false;  ///< the same motion, whose chatter is summed from another impact on: no change
  /// A complete chatter begins or ends between these values of the parameter; infinitely many changes gather there.
  std::optional<std::pair<double, double>> gathering;
};

/// @param before  a point of the old branch on the way to
/// @param change  .. where the events change
/// @param test    the margin that is used up there
/// @returns the orbits with the events of the motion beyond whose branches, followed back, come to the change
[[nodiscard]] std::vector<Reshaped> reshape(const Problem& problem, const Orbit& before, const PathPoint& change,
                                            const TestValue& test, double range);

/// What the motion settles on behind a change, in words: the label of an orbit, or that it is none within some hundred periods. Empty if that cannot
/// be seen.
[[nodiscard]] std::string behind(const Problem& problem, const Orbit& before, const PathPoint& change, double range);

}  // namespace slapstick::orbit
