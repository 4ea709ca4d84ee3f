#pragma once
/// Other sequences of events of which the orbit at a change is an orbit too: at a graze an impact of no speed is the
/// same as none, and a leg that has shrunk to nothing may be left out. An event that meets a point of a signal may come
/// before it or behind.
#include "orbit/equations.hpp"
#include "orbit/margins.hpp"

namespace slapstick::orbit {

/// @param before  the same orbit at some distance from the change
/// @param orbit   .. at the change
/// @param test    the margin that is used up at the change
/// @returns the orbit in its other shapes: those without what has vanished first
[[nodiscard]] std::vector<Orbit> sequences_of_same_orbit(const Problem& problem, const Orbit& before,
                                                         const Orbit& orbit, const TestValue& test);

/// Has the slip in this leg, of contacts that stick in another one, died out from one orbit to the next? An
/// impact has set them off, and what is left of their motion dies away.
[[nodiscard]] bool slip_dies(const ModeSet& set, const Orbit& before, const Orbit& orbit, std::size_t leg,
                             std::size_t other);

}  // namespace slapstick::orbit
