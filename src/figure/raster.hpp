#pragma once
/// Density rasters: how 500 000 points become a legible image of a few hundred kilobytes.
///
/// 1. count the points per pixel;
/// 2. spread by one pixel: each pixel takes the maximum of its 3x3 neighbourhood, so that a lone branch stays visible
///    in print;
/// 3. equalise: the tone of a count c is the fraction of non-empty pixels (of all series together) whose count is <= c.
///    So the faint structure of a chaotic band and the dark line of a periodic orbit are both legible whatever the
///    number of points;
/// 4. colour: tone 0 is transparent, tones up to 1 run from a tint to the full colour. Where series overlap their
///    colours multiply like inks: what only one sweep finds keeps its colour, what both find is dark.
#include <cstdint>
#include <string>
#include <vector>

#include "figure/figure.hpp"

namespace slapstick::figure {

/// The rectangle of the plane that a raster covers, edge to edge. A logarithmic axis needs min > 0.
struct Window {
  Range x{}, y{};
  bool log_x = false, log_y = false;
};

/// `width * height` numbers, row by row from the top left.
struct Counts {
  int width = 0, height = 0;
  std::vector<std::uint32_t> values{};
};

/// Points per pixel. Pixels are half-open [left, right) x [bottom, top) except that the window's own upper edges belong
/// to the last pixel. Points outside the window or not finite are left out. Counts saturate at `largest_count`.
/// @throws InputError if width or height is not positive, or x and y differ in length
Counts count_points(const std::vector<double>& x, const std::vector<double>& y, const Window& window, int width,
                    int height);
inline constexpr std::uint32_t largest_count = (1u << 20) - 1;

/// Every pixel takes the maximum of itself and its up to eight neighbours.
void spread_one_pixel(Counts& counts);

/// tone[c] for every count c up to the largest in `series`, from the joint histogram of their non-zero pixels:
/// tone[0] = 0, never decreasing, in (0, 1] for counts that occur, 1 for the largest.
std::vector<double> equalised_tones(const std::vector<Counts>& series);

/// What is put on the paper: an ink of this colour and opacity 0..255.
struct Ink {
  Colour colour{255, 255, 255};
  std::uint8_t opacity = 0;
  friend bool operator==(const Ink&, const Ink&) = default;
};

/// An image with at most 256 inks; rows from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels{};
  std::vector<Ink> inks{};  ///< inks[0] is clear paper
};

/// Series (same size each) and their colours -> one image. Each series has as many tones as 256 inks allow: 255 for
/// one, 15 for two, 5 for three. @throws InputError if there are none or more than `largest_series_count`, or sizes
/// differ
Raster blend(const std::vector<Counts>& series, const std::vector<Colour>& colours);
inline constexpr std::size_t largest_series_count = 8;

/// The cells that a window shows, on width x height pixels: each has the colour of the cell that its centre lies in.
Raster picture_of(const Cells& cells, const Window& window, int width, int height);

/// The image as a PNG file (indexed colour, transparency).
std::string encode_png(const Raster& raster);

}  // namespace slapstick::figure
