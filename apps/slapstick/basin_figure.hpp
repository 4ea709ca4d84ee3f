#pragma once
/// Pictures of basins of attraction.
#include "basin_options.hpp"
#include "figure/figure.hpp"

namespace slapstick::app {

/// The picture before there are basins.
[[nodiscard]] figure::Figure basin_outline(const BasinWish& wish);

/// A colour for each basin, its share in the legend, and the attractors' points of phase 0 on the plane.
[[nodiscard]] figure::Figure basin_figure(const BasinWish& wish, const sweep::Basins& basins);

/// "1-1-II", with its number where several attractors have this class: "1-1-II (2)".
[[nodiscard]] std::vector<std::string> basin_names(const sweep::Basins& basins);

}  // namespace slapstick::app
