#pragma once
/// What happens at one instant, part by part: each guard that was zero, with the impacts and the changes of contact
/// states that are its own.
///
/// Several guards are zero at one instant where machines are symmetric, or stand side by side. A contact belongs to the
/// first guard whose pair shares a mass with it, an impact to the gap of a stop that is struck. Crossings of a
/// continuous field come first.
/// Derivatives (saltation.hpp) and the legs of orbits (orbit/record.hpp) are made of these parts.
///
/// Cost: a comparison for each guard and contact; some small allocations.
#include <span>
#include <vector>

#include "mode/frame.hpp"
#include "mode/mode.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::flow {

class Engine;

struct InstantPart {
  int guard = 0;                        ///< of the mode before the instant
  std::vector<Motion::Strike> strikes;  ///< in order; stops that do not act on each other are apart
  mode::ContactStates after;            ///< once this part is done, and those before it
};

/// @param engine    has ended a segment, at the zero of a guard
/// @param backward  the guards in the reverse order: the parts as they would be if the last came first
[[nodiscard]] std::vector<InstantPart> parts_of_instant(const Engine& engine, bool backward = false);

/// Each strike as strikes of stops that do not act on each other.
[[nodiscard]] std::vector<Motion::Strike> separated_strikes(const mode::Frame& frame,
                                                            std::span<const Motion::Strike> strikes);

/// Does the guard end a piece of a continuous field? Such a crossing owns nothing but its own contact's state.
[[nodiscard]] bool passes_smoothly(const Model& model, const mode::Guard& guard);

/// Do two guards' pairs share a mass?
[[nodiscard]] bool share_mass(const mode::Frame& frame, const mode::Guard& a, const mode::Guard& b);

}  // namespace slapstick::flow
