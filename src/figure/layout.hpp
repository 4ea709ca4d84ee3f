#pragma once
/// Where everything stands on the paper, in cm from the lower left corner. Decided here and not by gnuplot, so that
/// frames of stacked panels align, the raster knows its pixels, and nothing is cut off.
#include <optional>
#include <string>
#include <vector>

#include "axis.hpp"
#include "figure/figure.hpp"

namespace slapstick::figure {

struct Box {
  double left = 0, right = 0, bottom = 0, top = 0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// The label of a mark above the frame: its middle, moved so that it stays on the paper, and its row (0 is the lowest).
struct MarkLabel {
  std::size_t mark = 0;
  double x_cm = 0;
  int row = 0;
};

/// An entry of a legend below the frame.
struct KeyPlace {
  Key key{};
  double x_cm = 0,
         text_cm = 0;  ///< of its sample's left end, from the left end of the panel's cell; of its text from there
  int row = 0;         ///< 0 is the highest
};

/// An inset on the paper.
struct InsetLayout {
  Axis x{}, y{};
  bool right = true, top = true;            ///< the corner; its numbers stand on these sides, where no line comes in
  Box outer{}, frame{};                     ///< with its numbers; its axes
  std::vector<Box> paper{};                 ///< what covers the panel: the frame, and a strip for each axis's numbers
  Box source{};                             ///< what is enlarged, as far as the panel shows it
  std::vector<int> joined{};                ///< corners of source and frame joined by lines: 2 * top + right
  int raster_width = 0, raster_height = 0;  ///< pixels
};

/// The corner of a box: 2 * top + right.
inline double corner_x(const Box& box, int corner) { return corner % 2 == 1 ? box.right : box.left; }
inline double corner_y(const Box& box, int corner) { return corner / 2 == 1 ? box.top : box.bottom; }

struct PanelLayout {
  Axis x{}, y{};
  Box frame{};
  double cell_left = 0;                     ///< cm; the tag stands here
  bool x_numbers = true;                    ///< false where a lower panel carries the shared axis
  bool raster = false;                      ///< points are drawn as one image
  int raster_width = 0, raster_height = 0;  ///< pixels
  Legend legend = Legend::none;             ///< never `automatic`
  std::vector<KeyPlace> keys{};             ///< of a legend below the frame ..
  int legend_rows = 0;                      ///< .. and their rows
  std::vector<MarkLabel> mark_labels{};
  int mark_rows = 0;
  std::vector<InsetLayout> insets{};
};

struct Layout {
  double width_cm = 0, height_cm = 0;
  double em_cm = 0;
  std::vector<PanelLayout> panels{};
};

/// @throws InputError if a panel has no room left for its frame
Layout lay_out(const Figure& figure);

/// Vertical distances in em, shared by the layout (which reserves them) and the script (which uses them).
namespace spacing {
inline constexpr double row = 1.25;                              ///< of text above the frame
inline constexpr double numbers = 1.65;                          ///< tick and number under the frame
inline constexpr double axis_label = 1.35;                       ///< below or left of the numbers
inline constexpr double edge = 0.45;                             ///< free paper
inline constexpr double tick = 0.75;                             ///< tick and gap left of the frame
inline constexpr double legend_font = 0.9;                       ///< relative to the figure's
inline constexpr double line_sample = 2.2, marker_sample = 1.0;  ///< of a legend below
inline constexpr double after_sample = 0.5, between_keys = 1.2;
inline constexpr double inset_font = 0.8;  ///< of the numbers of an inset, relative to the figure's
}  // namespace spacing

/// Rows of text above the frame: the title (or a lone tag), the legend if it stands there, mark labels.
int rows_above(const Panel& panel, const PanelLayout& layout);

/// Are its cells or its points drawn as an image?
bool wants_raster(const Panel& panel);
/// Whether a series is part of the image of such a panel.
inline bool in_raster(const Points& points) { return points.drawing != Drawing::discs; }

/// Of two named clouds in an image: the colour where both are, which is an entry of the legend too.
std::optional<Colour> colour_of_both(const Panel& panel);

/// The insets of a panel whose frame is known. The size of their images is not set yet.
/// @param where  what an error calls the panel. @throws InputError if an inset shows nothing of the panel, or has no
/// corner in which it is larger than what it shows
std::vector<InsetLayout> place_insets(const Panel& panel, const PanelLayout& layout, double em_cm,
                                      const std::string& where);

/// Number of entries that the legend would have.
int legend_entries(const Panel& panel);

/// A legend below the frame: the panel's keys, then those of its named series, in columns as wide as the widest of
/// their group.
std::vector<KeyPlace> place_keys(const Panel& panel, double cell_cm, double em_cm);

/// The corner of the frame without data, or `above`; what the caller asked for if it did.
Legend place_legend(const Panel& panel, const PanelLayout& layout, double em_cm);

}  // namespace slapstick::figure
