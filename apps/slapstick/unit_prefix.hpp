#pragma once
/// Axes in units of a handy size: 0.004 m as 4 mm.
#include "figure/figure.hpp"

namespace slapstick::app {

/// Axes whose names end in "[m]", "[m/s]", "[N]", .. and whose numbers are all small or large get a prefix, with what
/// is drawn on them. Axes of one name get the same. Units that have a prefix, and logarithmic axes, stay.
void use_prefixes(figure::Figure& figure);

}  // namespace slapstick::app
