#pragma once
/// Where a complete chatter begins or ends: infinitely many changes of events, each with an impact more, gather there.
#include "change/reshape.hpp"

namespace slapstick::orbit {

/// The special point.
/// @param nearest  the orbit
[[nodiscard]] SpecialPoint onset(const OnsetInterval& between, const Solution& nearest);

/// The end of a cascade, to which the places of its changes converge by the law of the stop that chatters (change/cascade_law.hpp).
struct CascadeLimit {
  double value = 0.0;
  double error =
      0.0;  ///< of it: what is left of its last change, what its last rate makes of it, and the changes' own errors
  double ratio = 0.0;  ///< of the last two distances between changes
  double left = 0.0;   ///< how far from it the cascade's last change but one is: the branch is nearer
};
/// @returns empty if the last grazes of a branch, as it was followed, are no cascade
[[nodiscard]] std::optional<CascadeLimit> cascade_limit(const Problem& problem, const std::vector<Solution>& points,
                                                        const std::vector<SpecialPoint>& special);

/// Where a branch has left a chatter for a cascade, the onset by the cascade's own grazes, if that is better known.
void sharpen_onsets(const Problem& problem, const std::vector<Solution>& points, std::vector<SpecialPoint>& special);

/// Has the last stretch of a branch a chatter with so many more impacts than where it began that its onset is near?
[[nodiscard]] bool chatter_lengthens(const std::vector<Solution>& points);

}  // namespace slapstick::orbit
