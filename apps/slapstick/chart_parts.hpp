#pragma once
/// What pictures over a grid of pixels share.
#include <string>

#include "figure/figure.hpp"
#include "slapstick/sweep/map.hpp"

namespace slapstick::app {

/// The rectangle of pixels whose middles are the values of the axis.
[[nodiscard]] figure::Range edges(const sweep::GridAxis& axis);

/// An entry of the legend for a colour of cells; paper has a rim.
[[nodiscard]] figure::Key swatch(const std::string& label, figure::Colour colour);

/// "12.3 %", and no zero for what is there.
[[nodiscard]] std::string percent(long part, long whole);

}  // namespace slapstick::app
