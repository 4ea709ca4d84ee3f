#pragma once
/// Ties: legs without length, between events of one instant that do not act on each other.
#include "orbit/equations.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

/// Of the cycle: what Newton's method leaves of the length of a tied leg. An instant gathers the errors of a state; a
/// bound far above them would hide what a parameter takes apart.
/// @param left  its last step
[[nodiscard]] double rounding_of_instants(double left);

/// A tied leg has no length, to what rounding leaves; one that has got a length is a leg as any other.
/// @param rounding  of the cycle
void settle_ties(Orbit& orbit, double rounding);

/// Ties legs without length between the ends of sliders' slips and rests: a motion that has not settled yet may show
/// one after the other what its cycle does at one instant, as sliders of one pair that turn back together. Of other
/// events a leg without length may be no more than a root that its equation always has.
/// @returns whether there are any
bool tie_sliders(const mode::Frame& frame, Orbit& orbit, double rounding);

}  // namespace slapstick::orbit
