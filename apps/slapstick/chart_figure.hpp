#pragma once
/// Pictures of maps: a chart of the classes with their shares of the area, and charts of quantities.
#include "figure/figure.hpp"
#include "inset_options.hpp"
#include "map_options.hpp"

namespace slapstick::app {

/// What --show may name: "class", "exponent", "multiplier", "n", "p", "attractors", and the words of --of.
/// @returns the words of `show`, or "class" and those of --of if it is empty. @throws InputError naming --show
[[nodiscard]] std::vector<std::string> shown_columns(const MapWish& wish, const std::string& show);

/// --inset of a map. @throws InputError naming --inset
[[nodiscard]] std::vector<NamedInset> chart_insets(const MapWish& wish, const InsetOptions& options);

struct ChartLook {
  std::vector<std::string> columns;  ///< as of `shown_columns`
  std::vector<NamedInset> insets;
};

/// The picture before there is a map: its panels and insets, without cells.
[[nodiscard]] figure::Figure chart_outline(const MapWish& wish, const ChartLook& look);

/// A panel for each column, in each direction. The legend of classes has their shares of all pixels; a class beyond the
/// ten largest is among the others.
[[nodiscard]] figure::Figure chart_figure(const MapWish& wish, const sweep::Map& map, const ChartLook& look);

}  // namespace slapstick::app
