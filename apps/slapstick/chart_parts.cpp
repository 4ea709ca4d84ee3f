/// Edges, swatches and shares of charts.
#include "chart_parts.hpp"

#include <cstdio>

#include "chart_colours.hpp"

namespace slapstick::app {

figure::Range edges(const sweep::GridAxis& axis) {
  const double half = 0.5 * (axis.to - axis.from) / (axis.count - 1);
  return {axis.from - half, axis.to + half};
}

figure::Key swatch(const std::string& label, figure::Colour colour) {
  constexpr double swatch_mm = 2.2;
  const bool paper = colour == undecided_colour;  // white on white: only its rim is seen
  return {.label = label,
          .colour = paper ? figure::colours::black : colour,
          .marker = paper ? figure::Marker::box : figure::Marker::square,
          .size = swatch_mm};
}

std::string percent(long part, long whole) {
  char text[32];
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  std::snprintf(text, sizeof text, share >= 10.0 ? "%.0f %%" : share >= 0.095 ? "%.1f %%" : "< 0.1 %%", share);
  return text;
}

}  // namespace slapstick::app
