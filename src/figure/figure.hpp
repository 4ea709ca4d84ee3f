#pragma once
/// Figures from columns of numbers, for print: a gnuplot script, its data, a PNG and a PDF, side by side in one folder.
///
/// This layer computes no dynamics. The layer takes columns and decides ranges, ticks and margins, so that nothing is
/// cut off and stacked panels align. Large point clouds become a density raster (figure/raster.hpp); gnuplot draws
/// axes, text and lines. An author restyles a figure by editing `stem.gp` and running `gnuplot stem.gp` in its folder.
///
/// Text is UTF-8 in gnuplot's enhanced notation: `x_1`, `10^{-3}`, `{/:Italic x}`, `ω` or `{/Symbol w}`; write a
/// literal underscore as `\_`. Labels are data, never commands: quotes, backticks and line breaks in them are harmless.
/// Values that are not finite, and values <= 0 on a logarithmic axis, are never drawn; in a line they leave a break.
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace slapstick::figure {

/// sRGB, 0..255.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// After Okabe and Ito: distinguishable with every common colour vision deficiency. `dark_blue` and `vermillion` are
/// the pair for a forward and a backward sweep, shifted a little so that laid over each other they give a neutral dark.
namespace colours {
inline constexpr Colour black{0, 0, 0}, dark_blue{0, 60, 150}, vermillion{213, 80, 20}, green{0, 158, 115};
inline constexpr Colour orange{230, 159, 0}, sky_blue{86, 180, 233}, purple{204, 121, 167};
inline constexpr Colour grey{110, 110, 110}, light_grey{190, 190, 190};
}  // namespace colours

/// How points are drawn. `automatic`: as a raster if the panel has more than `raster_threshold` such points (and at
/// most 8 series), else as discs. `discs`: always. Rastered series of one panel share one image; where two named ones
/// overlap, the legend says "both".
enum class Drawing { automatic, discs, raster };
inline constexpr std::size_t raster_threshold = 20000;

/// The shape of a point that is drawn by itself; an image ignores it. Those after `star` are open.
enum class Marker { disc, square, triangle, diamond, star, circle, box, delta, nabla, cross };

/// A cloud of points (x[i], y[i]).
struct Points {
  std::vector<double> x{}, y{};
  std::string label{};  ///< entry in the legend; empty: none
  Colour colour = colours::dark_blue;
  Drawing drawing = Drawing::automatic;
  double diameter_mm = 0.4;  ///< of a disc; a raster ignores it
  Marker marker = Marker::disc;
  bool over_lines = false;  ///< drawn after the lines, which cover the other points; only with `discs`
};

struct Range {
  double min = 0, max = 1;  ///< min < max; both > 0 on a logarithmic axis
};

/// A chart: cells of equal size in data coordinates, each in one of up to 255 colours. The chart is drawn beneath all
/// else; the clouds of its panel are then discs.
struct Cells {
  Range x{}, y{};  ///< the rectangle that the cells fill, edge to edge
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> codes{};  ///< colours[code], row by row from the lowest y; `clear`: paper
  std::vector<Colour> colours{};
  static constexpr std::uint8_t clear = 255;
};

enum class Dash { solid, dashed, dotted, dash_dotted };

/// A polyline through (x[i], y[i]), in the order given; a NaN breaks it.
struct Line {
  std::vector<double> x{}, y{};
  std::string label{};
  Colour colour = colours::black;
  Dash dash = Dash::solid;
  double width_pt = 0.8;
};

/// The colour that a shaded span of this colour has on paper: for its entry in a legend.
constexpr Colour tint(Colour colour) {
  const auto pale = [](int ink) { return static_cast<std::uint8_t>(255 - 22 * (255 - ink) / 100); };
  return {pale(colour.red), pale(colour.green), pale(colour.blue)};
}

/// An annotation in data coordinates. Which of the three positions are given decides what it is:
/// x alone: a vertical line; x and x_end: a shaded span; y alone: a horizontal line; x and y: the label at that point.
/// Labels of vertical lines and spans stand above the frame, in as many rows as they need not to touch.
/// A mark outside the ranges is not drawn. Marks do not widen automatic ranges.
struct Mark {
  std::optional<double> x{}, x_end{}, y{};
  std::string label{};
  Colour colour = colours::grey;
};

/// A rectangle of a panel that is drawn again, enlarged: cells, points and lines, with numbers of its own. The inset
/// lies in the corner of the frame in which it hides least, covers no rectangle that is enlarged, and two lines join
/// both.
struct Inset {
  Range x{}, y{};
};
inline constexpr std::size_t most_insets = 4;  ///< of a panel: a corner each

/// An entry of the legend for what several series share, a style or a marker; it comes before those of the series.
struct Key {
  std::string label{};
  Colour colour = colours::black;
  std::optional<Marker> marker{};  ///< a point of this shape; without one a piece of a line
  double size = 0.8;               ///< of the point in mm, of the line in pt
  Dash dash = Dash::solid;
  int group = 0;  ///< of a legend below: each of the groups begins a row and has columns of its own
};

/// `automatic`: the corner inside the frame that holds no data, or a row above the frame if there is no such corner.
/// `below`: under the name of the x axis, in as many rows as the entries need; they make the figure higher, not the
/// frame lower. `none` also hides single series. Series without a label never appear.
enum class Legend { automatic, none, top_left, top_right, bottom_left, bottom_right, above, below };

/// One pair of axes. Without a range: y is the range of the data and 4 % on either side; x likewise, but without the 4
/// % if every series runs through x in one direction (time, a swept parameter), which then fills the frame.
struct Panel {
  std::string x_label{}, y_label{};
  std::string tag{};    ///< "(a)", above the frame at the left edge
  std::string title{};  ///< above the frame; journals prefer none
  std::optional<Range> x_range{}, y_range{};
  bool log_x = false, log_y = false;
  std::optional<Cells> cells{};  ///< on linear axes
  std::vector<Points> points{};
  std::vector<Line> lines{};  ///< drawn over the points
  std::vector<Mark> marks{};
  std::vector<Inset> insets{};  ///< on linear axes; a legend that is `automatic` then lies above
  std::vector<Key> keys{};
  Legend legend = Legend::automatic;
  double height_share = 1;   ///< frame height relative to the other rows; a row takes its largest
  bool joins_below = false;  ///< one x range with the panel beneath it, numbered and named there only
};

/// Panels row by row, left to right. 8.5 cm is one journal column, 17.5 cm two.
struct Figure {
  std::vector<Panel> panels{};
  int columns = 1;
  double width_cm = 8.5;
  /// default: `row_cm` per row with an x axis of its own, 3.8 cm for a row that shares it, and what legends below take
  std::optional<double> height_cm{};
  double row_cm = 5.6;
  bool share_x = false;   ///< every panel joins the one beneath it
  std::string caption{};  ///< a comment in the script; a journal sets captions in its own type
  std::string font = "DejaVu Sans";
  double font_pt = 8;
  int png_dpi = 300;
  std::optional<int>
      raster_dpi{};  ///< of density images; default: png_dpi, or twice that if there is a point for every pixel
};

/// `tex`: a picture for LaTeX (\input{stem.tex}), its lines in stem.pdf, its text set by LaTeX. `py`: a script for
/// matplotlib that reads the same data; it needs no gnuplot.
struct Formats {
  bool png = true, pdf = true, svg = false, tex = false, py = false;
  [[nodiscard]] bool of_gnuplot() const { return png || pdf || svg || tex; }
};

/// What was written. Paths of formats that were not asked for are empty.
struct Files {
  std::filesystem::path script, data;
  /// One per panel with a rastered series, stem-raster<panel>.png, and per inset of such a panel,
  /// stem-raster<panel>-inset<inset>.png.
  std::vector<std::filesystem::path> rasters;
  std::filesystem::path png, pdf, svg, tex, py;
};

/// Values beyond this count as not finite (gnuplot's own arithmetic on ranges would overflow).
inline constexpr double largest_coordinate = 1e150;

/// Whether a figure could be drawn, before the work that leads to it. @throws StorageError "gnuplot not found: install
/// gnuplot-nox"
void demand_gnuplot();

/// Whether a figure has room for all its parts, before the work that leads to its data: panels with their ranges, names
/// and insets say enough. @throws InputError as `write`
void demand_room(const Figure& figure);

/// Writes `<stem>.gp`, `<stem>-plot.csv` (a header row, then two columns per series drawn as vectors, numbers in
/// shortest round-trip form; no file if there is no such series), the raster images and the formats asked for. `stem`
/// is a path without extension whose folder exists. The script uses relative names only.
///
/// Everything is made and drawn in a scratch folder beside the target and renamed into place when gnuplot has
/// succeeded: an error leaves the files of an earlier call as they were, and no scratch. All bytes depend on the figure
/// only, but a PDF's, which hold its date. Calls may run at the same time.
///
/// @throws InputError    columns of different length, an empty figure, ranges or sizes that cannot be drawn; names
/// panel and series
/// @throws StorageError  folder missing or not writable; gnuplot missing ("gnuplot not found: install gnuplot-nox") or
/// failing Cost, PNG and PDF at 8.5 cm: 0.1 to 0.2 s for curves, 0.35 to 0.6 s with 500 000 points (one 2.5 GHz Xeon
/// core, shared; gnuplot takes nearly all of it). Twice the raster_dpi: 1 s and more.
///
/// @param beside  the name of the script, the data and the images without ending; "": the stem's
Files write(const Figure& figure, const std::filesystem::path& stem, Formats formats = {},
            const std::string& beside = {});

}  // namespace slapstick::figure
