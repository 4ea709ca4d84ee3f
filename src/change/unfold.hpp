#pragma once
/// What lies beyond a change of events: the one door of this room. What finds the orbits there (reshape, coincident,
/// nearby_shapes) and what runs motions (jump) may be replaced behind it.
#include <functional>

#include "change/change.hpp"
#include "change/reshape.hpp"

namespace slapstick::orbit {

struct Unfolding {
  Passage passage = Passage::unknown;
  /// Orbits whose branches begin at the change. Where the branch goes on (persistence, fold), the first is its own; all
  /// others are born there. Passage same_events: the motion beyond says that nothing changes; its orbit.
  std::vector<HalfBranch> branches;
  std::optional<Jump> jump;  ///< passage jump
  /// Where the branch ends: orbits of others there. Passages merges and symmetric: first that in which it ends.
  std::vector<Orbit> others;
};

struct UnfoldOptions {
  double range = 1.0;  ///< of the parameter
  const std::atomic<bool>* stop = nullptr;
  bool simulate = true;  ///< where no orbit is found: what the motion does beyond, by running it; of a stable orbit
  /// Leads the branch of an orbit that was found at a distance from the change back to it.
  /// @param error  how well the change is known, for this orbit
  /// @returns whether the branch, so led, begins in the sense of the parameter from which the old one came; empty if it
  /// does not lead there
  std::function<std::optional<bool>(const HalfBranch& found, double error)> lead_back = {};
};

/// Does the branch end in an orbit of another one? Such an orbit is a shorter one several times over, or is its own
/// image where the branch's are not: images of the branch end there too.
/// Moves such orbits from `branches` to `others`, once over.
void find_met(const Problem& problem, const Orbit& before, Unfolding& found);

/// @param before  a point of the branch on the way to the change
[[nodiscard]] Unfolding unfold(const Problem& problem, const Orbit& before, const Change& change,
                               const UnfoldOptions& options);

}  // namespace slapstick::orbit
