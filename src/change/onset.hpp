#pragma once
/// Where a complete chatter begins or ends: infinitely many changes of events, each with an impact more, gather there.
#include "change/cascade_law.hpp"
#include "change/reshape.hpp"

namespace slapstick::orbit {

/// The special point.
/// @param nearest  the orbit
[[nodiscard]] SpecialPoint onset(const OnsetInterval& between, const Solution& nearest);

/// The end of a cascade, where a complete chatter begins.
struct CascadeLimit {
  double value = 0.0;
  double error = 0.0;
  double ratio = 0.0;  ///< of the last two distances between changes
  double left = 0.0;   ///< how far from it the cascade's last change but one is: the branch is nearer
  double began = 0.0;  ///< how far from it the cascade's first change is
};
/// @param exact  the onset by its own equations (change/onset_orbit.hpp), if it is known; else it is set to them. Where
///               they cannot be made, the limit is taken from the places of the changes (change/cascade_law.hpp)
/// @returns empty if the last grazes of a branch, as it was followed, are no cascade
[[nodiscard]] std::optional<CascadeLimit> cascade_limit(const Problem& problem, const std::vector<Solution>& points,
                                                        const std::vector<SpecialPoint>& special,
                                                        std::optional<PlaceLimit>& exact);

/// The onset ahead of an orbit with a complete chatter, by its own equations.
[[nodiscard]] std::optional<PlaceLimit> chatter_limit(const Problem& problem, const Orbit& orbit);

/// Where the limit of a chatter meets the point of a signal that ends the rest after it: that rest has no length.
[[nodiscard]] std::optional<PlaceLimit> knot_limit(const Problem& problem, const Orbit& chattering);

/// Where a branch has left a chatter for a cascade, the onset by its own equations or by the cascade's grazes, if that
/// is better known.
void sharpen_onsets(const Problem& problem, const std::vector<Solution>& points, std::vector<SpecialPoint>& special);

/// Times as many legs: a burst has lengthened. A look for its onset costs as much as a step: with a smaller number the
/// looks add up, with a larger one the onset comes late.
constexpr double longer_burst = 1.2;
/// Has the chatter of a branch's last stretch gained enough legs since the stretch began for its onset to be near?
[[nodiscard]] bool chatter_lengthens(const std::vector<Solution>& points);

}  // namespace slapstick::orbit
