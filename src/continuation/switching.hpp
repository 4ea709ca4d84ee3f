#pragma once
/// From a period doubling to the orbit of twice the length.
#include <vector>

#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

class Problem;

/// The cycle of twice the length that is born at a PD, to follow from; none if it is not found.
/// @param range  of the parameter, arclength's unit of it
[[nodiscard]] std::vector<Orbit> doubled(const Problem& problem, const Orbit& pd, double range);

}  // namespace slapstick::orbit
