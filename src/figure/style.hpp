#pragma once
/// Markers and lines in gnuplot's words.
#include <string>

#include "figure/figure.hpp"

namespace slapstick::figure {

/// "pt 7 ps 0.5 lw 0.6 lc rgb '#000000'"
std::string point_style(Marker marker, double diameter_mm, Colour colour);

/// "lw 0.8 dt solid lc rgb '#000000'"
std::string line_style(double width_pt, Dash dash, Colour colour);

}  // namespace slapstick::figure
