#pragma once
/// What motions near an orbit that is no longer one look like: guesses of the orbits beyond a change.
#include <vector>

#include "orbit/equations.hpp"

namespace slapstick::orbit {

/// Cycles of other shapes that motions from inside the legs show, each shape once: whole cycles, and, from about the
/// leg at which the events change, pieces in place of the orbit's own. None where there is no model.
[[nodiscard]] std::vector<Orbit> guess_sequences(const Problem& problem, const Orbit& orbit, std::size_t changed);

}  // namespace slapstick::orbit
