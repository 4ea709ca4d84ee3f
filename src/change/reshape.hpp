#pragma once
/// Beyond a point where the events of an orbit change: the sequence of the motion there, and the orbits of that
/// sequence.
#include "change/change.hpp"

namespace slapstick::orbit {

/// Two values of the parameter about the onset of a complete chatter. Infinitely many changes gather there, unless it
/// is a release: a contact that has rested lets go, and the chatter is there at once.
struct OnsetInterval {
  double from = 0.0, to = 0.0;
  bool release = false;
  bool knot = false;  ///< a point of a signal meets the chatter's limit: the onset is the change itself
};

/// Is a leg the rest after a chatter's limit that a point of a signal ends?
[[nodiscard]] bool rests_to_knot(const Itinerary& shape, std::size_t leg);

/// Of the range: how well a change is known at worst, where nothing is said.
constexpr double place_tolerance = 1e-10;
/// Of the range: events that begin as near to a change as this begin there.
constexpr double same_change = 1e-7;

struct HalfBranch {
  PathPoint point;                     ///< a motion; its tangent leads away from the change
  bool folds = false;                  ///< the branch lies on the side of the parameter from which the old branch came
  bool renewed = false;                ///< the same motion, whose chatter is summed from another impact on: no change
  std::optional<OnsetInterval> onset;  ///< of a complete chatter, which begins or ends there
  double length = 0.0;                 ///< from the change to there; 0 where that is not known
  double distance_from_change =
      0.0;             ///< how far from the change its events begin, in the parameter: else changes lie between ..
  double error = 0.0;  ///< .. and how well that is known
};

/// @param before  a point of the old branch on the way to
/// @param change  .. where the events change
/// @param test    the margin that is used up there; empty: none, the orbit's equations lead no further
/// @param nearest  how far from the change the motion is first looked at, of the range
/// @returns the orbits with the events of the motion beyond whose branches, followed back, come to the change, or near
/// it
[[nodiscard]] std::vector<HalfBranch> find_branches_beyond(const Problem& problem, const Orbit& before,
                                                           const PathPoint& change,
                                                           const std::optional<TestValue>& test, double range,
                                                           const std::atomic<bool>* stop, double nearest = 1e-6);

/// Of these, those whose shape the orbit at the change has already: what is left where impacts lose their speed and
/// legs their length.
[[nodiscard]] std::vector<HalfBranch> branches_at(const Problem& problem, const Orbit& before, const PathPoint& change,
                                                  const TestValue& test, double range);

/// .. of some orbits with other events which the orbit at the change is too.
[[nodiscard]] std::vector<HalfBranch> branches_at(const Problem& problem, const PathPoint& change,
                                                  const std::vector<Orbit>& shapes, double range);

/// Has a branch come to orbits that lie beside each other at the same parameter, so that they cannot be followed? Those
/// in which something rests where it did at `from` can.
[[nodiscard]] bool one_of_family(const Problem& problem, const PathPoint& from, const PathPoint& point, double range);

/// Does more rest all along than before? The orbit is one of a family: the one whose sliders and bodies rest where they
/// came to rest.
[[nodiscard]] bool rests_more(const PathPoint& before, const PathPoint& next);

/// Is the orbit at a change, in another shape, one of a family? Those lie beside it at the same parameter: there is no
/// branch to follow.
[[nodiscard]] bool begins_family(const Problem& problem, const Orbit& before, const PathPoint& change,
                                 const TestValue& test);

/// The orbit with a complete chatter beyond a cascade, whose every change adds an impact.
/// @param last  a point of the branch near the end of the cascade, or already beyond it: the orbit found is not between
/// the two  @param limit  the value of the parameter where the changes gather
[[nodiscard]] std::optional<HalfBranch> beyond_cascade(const Problem& problem, const PathPoint& last, double limit,
                                                       double range, const std::atomic<bool>* stop);

}  // namespace slapstick::orbit
