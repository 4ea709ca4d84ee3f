#pragma once
/// Where a complete chatter begins or ends: infinitely many changes of events, each with an impact more, gather there.
#include "orbit/reshape.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::orbit {

/// The special point.
/// @param nearest  the orbit
[[nodiscard]] SpecialPoint onset(const Between& between, const Solution& nearest);

/// The end of a cascade: the places of its changes converge like a geometric series, whose ratio tends to the coefficient of restitution.
struct CascadeLimit {
  double value = 0.0;  ///< by Aitken's rule
  double error = 0.0;  ///< of it: what the last place has changed
  double ratio = 0.0;
  double left = 0.0;  ///< how far from it the cascade's last change but one is: the branch is nearer
};
/// @returns empty if the last grazes of a branch, as it was followed, are no cascade
[[nodiscard]] std::optional<CascadeLimit> cascade_limit(const Branch& branch);

/// Where a branch has left a chatter for a cascade, the onset by the cascade's own grazes, if that is better known.
void sharpen_onsets(Branch& branch);

/// Has the last stretch of a branch a chatter with so many more impacts than where it began that its onset is near?
[[nodiscard]] bool chatter_lengthens(const Branch& branch);

}  // namespace slapstick::orbit
