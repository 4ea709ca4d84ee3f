#pragma once
/// The bifurcation curves of a map in its picture, and in words.
#include "figure/figure.hpp"
#include "slapstick/chart/curves.hpp"

namespace slapstick::app {

/// Draws them over every panel of a chart, in a style for each type.
void draw_curves(const chart::Curves& found, figure::Figure& figure);

/// A line for each curve and one for what is left, on standard error.
void report_curves(const chart::Curves& found);

}  // namespace slapstick::app
