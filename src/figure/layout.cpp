/// Places panels, axes and legends on the paper.
#include "layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/ranges.hpp"
#include "figure/raster.hpp"
#include "slapstick/base/error.hpp"
#include "text.hpp"

namespace slapstick::figure {
namespace {

constexpr double shared_row_height_cm = 3.8;
constexpr double padding = 0.04;        // of an automatic range
constexpr double least_frame_cm = 1.0;  // below this no axis is legible

struct Grid {
  int columns = 1, rows = 1;
  explicit Grid(const Figure& figure)
      : columns(std::min(figure.columns, static_cast<int>(figure.panels.size()))),
        rows((static_cast<int>(figure.panels.size()) + columns - 1) / columns) {}
  int column(std::size_t panel) const { return static_cast<int>(panel) % columns; }
  int row(std::size_t panel) const { return static_cast<int>(panel) / columns; }
};

bool is_lowest(const Figure& figure, const Grid& grid, std::size_t panel) {
  return panel + static_cast<std::size_t>(grid.columns) >= figure.panels.size();
}

/// The PNG's resolution (no resampling), or twice that where the points can fill it: one per pixel on average. With
/// fewer, a finer image shows the noise of the counts instead of the density, and takes longer.
int suitable_dpi(const Panel& panel, const Box& frame, int png_dpi) {
  double points = 0;
  for (const auto& series : panel.points) points += static_cast<double>(series.x.size());
  const double square_inches = frame.width() * frame.height() / (2.54 * 2.54);
  return points >= square_inches * 4.0 * png_dpi * png_dpi ? 2 * png_dpi : png_dpi;
}

void add_x(Extent& extent, const Panel& panel) {
  for (const auto& points : panel.points) extent.add(points.x, panel.log_x);
  for (const auto& line : panel.lines) extent.add(line.x, panel.log_x);
}

/// Does it leave its x axis to the panel beneath it?
bool joins_below(const Figure& figure, const Grid& grid, std::size_t panel) {
  return (figure.share_x || figure.panels[panel].joins_below) && !is_lowest(figure, grid, panel);
}

/// The range of a panel, or of those in one column that it is joined to.
Range x_range(const Figure& figure, const Grid& grid, std::size_t index) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  std::size_t first = index;
  while (first >= columns && joins_below(figure, grid, first - columns)) first -= columns;
  Extent extent;
  for (std::size_t i = first;; i += columns) {
    if (figure.panels[i].x_range) return *figure.panels[i].x_range;
    add_x(extent, figure.panels[i]);
    if (!joins_below(figure, grid, i)) break;
  }
  return padded(extent, extent.one_way ? 0.0 : padding, figure.panels[index].log_x);
}

Range y_range(const Panel& panel) {
  if (panel.y_range) return *panel.y_range;
  Extent extent;
  for (const auto& points : panel.points) extent.add(points.y, panel.log_y);
  for (const auto& line : panel.lines) extent.add(line.y, panel.log_y);
  return padded(extent, padding, panel.log_y);
}

double left_margin_em(const Panel& panel, const Axis& y) {
  return spacing::edge + (panel.y_label.empty() ? 0 : spacing::axis_label) + y.label_em + spacing::tick;
}

double below_em(const Panel& panel, const PanelLayout& layout) {
  const double legend = layout.legend_rows * spacing::row;
  if (!layout.x_numbers) return legend + spacing::edge;
  return legend + spacing::numbers + (panel.x_label.empty() ? 0 : spacing::axis_label) + spacing::edge;
}

void size_legend_below(const Figure& figure, const Grid& grid, std::size_t index, Layout& layout) {
  PanelLayout& at = layout.panels[index];
  if (figure.panels[index].legend != Legend::below) return;
  at.keys = place_keys(figure.panels[index], layout.width_cm / grid.columns, layout.em_cm);
  at.legend_rows = at.keys.empty() ? 0 : at.keys.back().row + 1;
}

/// Greedy rows: each label goes to the lowest row where it touches no earlier one.
void place_mark_labels(const Panel& panel, PanelLayout& layout, double em_cm, double paper_right) {
  struct Taken {
    double left, right;
    int row;
  };
  std::vector<Taken> taken;
  for (std::size_t i = 0; i < panel.marks.size(); ++i) {
    const Mark& mark = panel.marks[i];
    if (!mark.x || mark.label.empty() || (mark.y && !mark.x_end)) continue;
    const double from = std::max(*mark.x, layout.x.range.min),
                 to = std::min(mark.x_end.value_or(*mark.x), layout.x.range.max);
    if (!(from <= to)) continue;
    const double half = 0.5 * spacing::legend_font * em_cm * width_em(mark.label);
    const double middle = layout.frame.left + 0.5 * (layout.x.place(from) + layout.x.place(to)) * layout.frame.width();
    const double x = std::min(middle, std::max(paper_right - half, layout.frame.left));
    const auto touches = [&](int row) {
      return std::any_of(taken.begin(), taken.end(), [&](const Taken& t) {
        return t.row == row && x - half < t.right + 0.4 * em_cm && x + half > t.left - 0.4 * em_cm;
      });
    };
    int row = 0;
    while (touches(row)) ++row;
    taken.push_back({x - half, x + half, row});
    layout.mark_labels.push_back({i, x, row});
    layout.mark_rows = std::max(layout.mark_rows, row + 1);
  }
}

/// Frames across: one left margin per column of panels, wide enough for the widest y axis in it.
void place_columns(const Figure& figure, const Grid& grid, Layout& layout) {
  const double em = layout.em_cm, cell = layout.width_cm / grid.columns;
  std::vector<double> left(grid.columns, 0.0), right(grid.columns, 0.0);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const int c = grid.column(i);
    left[c] = std::max(left[c], left_margin_em(figure.panels[i], layout.panels[i].y) * em);
    right[c] = std::max(right[c], (0.5 * layout.panels[i].x.label_em + spacing::edge) * em);
  }
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const int c = grid.column(i);
    PanelLayout& panel = layout.panels[i];
    panel.cell_left = c * cell;
    panel.frame.left = c * cell + left[c];
    panel.frame.right = (c + 1) * cell - right[c];
    if (panel.frame.width() < least_frame_cm)
      throw InputError("the picture is too narrow for panel " + std::to_string(i + 1) +
                       ": a greater width is needed, or fewer panels");
  }
}

/// Frames downwards: what the text above and below needs is taken off first, the rest is shared out.
void place_rows(const Figure& figure, const Grid& grid, Layout& layout) {
  const double em = layout.em_cm;
  std::vector<double> above(grid.rows, 0.0), below(grid.rows, 0.0), share(grid.rows, 0.0);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const int r = grid.row(i);
    const int rows = rows_above(figure.panels[i], layout.panels[i]);
    above[r] = std::max(above[r], (spacing::edge + 0.15 + spacing::row * rows) * em);
    below[r] = std::max(below[r], below_em(figure.panels[i], layout.panels[i]) * em);
    share[r] = std::max(share[r], figure.panels[i].height_share);
  }
  double free = layout.height_cm, shares = 0;
  for (int r = 0; r < grid.rows; ++r) free -= above[r] + below[r], shares += share[r];
  double top = layout.height_cm;
  for (int r = 0; r < grid.rows; ++r) {
    const double height = free * share[r] / shares;
    if (!(height >= least_frame_cm))
      throw InputError("the picture is too low for row " + std::to_string(r + 1) +
                       " of its panels: a greater height is needed, or fewer rows");
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
      if (grid.row(i) == r)
        layout.panels[i].frame.top = top - above[r], layout.panels[i].frame.bottom = top - above[r] - height;
    top -= above[r] + height + below[r];
  }
}

/// Images of the panel and of its insets.
void size_images(const Figure& figure, std::size_t index, PanelLayout& at) {
  const Panel& panel = figure.panels[index];
  const auto pixels = [&](const Box& frame, int& width, int& height) {
    const int dpi = figure.raster_dpi.value_or(suitable_dpi(panel, frame, figure.png_dpi));
    width = static_cast<int>(std::lround(frame.width() / 2.54 * dpi));
    height = static_cast<int>(std::lround(frame.height() / 2.54 * dpi));
  };
  at.raster = wants_raster(panel);
  pixels(at.frame, at.raster_width, at.raster_height);
  for (InsetLayout& inset : at.insets) pixels(inset.frame, inset.raster_width, inset.raster_height);
}

void choose_y_axes(const Figure& figure, const Grid& grid, Layout& layout) {
  double mean_share = 0;
  for (const Panel& panel : figure.panels) mean_share += panel.height_share / static_cast<double>(figure.panels.size());
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    const double legend_cm = layout.panels[i].legend_rows * spacing::row * layout.em_cm;
    const double height_cm =
        0.75 * (layout.height_cm / grid.rows - legend_cm) * panel.height_share / mean_share;  // near enough
    layout.panels[i].y = with_ticks(y_range(panel), panel.log_y, most_labels(height_cm, 1.7 * layout.em_cm));
  }
}

void choose_x_axes(const Figure& figure, const Grid& grid, Layout& layout) {
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    PanelLayout& panel = layout.panels[i];
    const Range range = x_range(figure, grid, i);
    const double width_cm = panel.frame.width() > 0 ? panel.frame.width() : 0.8 * layout.width_cm / grid.columns;
    int labels = 8;
    do panel.x = with_ticks(range, figure.panels[i].log_x, labels);
    while (--labels >= 1 && most_labels(width_cm, (panel.x.label_em + 0.7) * layout.em_cm) <= labels);
  }
}

double default_height(const Figure& figure, const Grid& grid, const Layout& layout) {
  std::vector<int> legend_rows(grid.rows, 0);
  std::vector<double> heights(grid.rows, shared_row_height_cm);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const int row = grid.row(i);
    legend_rows[row] = std::max(legend_rows[row], layout.panels[i].legend_rows);
    if (!joins_below(figure, grid, i)) heights[row] = figure.row_cm;
  }
  const double legends = std::accumulate(legend_rows.begin(), legend_rows.end(), 0) * spacing::row * layout.em_cm;
  return legends + std::accumulate(heights.begin(), heights.end(), 0.0);
}

}  // namespace

bool wants_raster(const Panel& panel) {
  if (panel.cells) return true;
  std::size_t free = 0;
  for (const Points& points : panel.points) {
    if (points.drawing == Drawing::raster) return true;
    if (points.drawing == Drawing::automatic) free += points.x.size();
  }
  return free > raster_threshold &&
         ranges::count_if(panel.points, in_raster) <= static_cast<std::ptrdiff_t>(largest_series_count);
}

int rows_above(const Panel& panel, const PanelLayout& layout) {
  const int head = (panel.title.empty() ? 0 : 1) + (layout.legend == Legend::above ? 1 : 0);
  return std::max(head + layout.mark_rows, panel.tag.empty() ? 0 : 1);
}

Layout lay_out(const Figure& figure) {
  const Grid grid(figure);
  Layout layout{figure.width_cm, 0, figure.font_pt * 2.54 / 72, std::vector<PanelLayout>(figure.panels.size())};
  for (std::size_t i = 0; i < figure.panels.size(); ++i) size_legend_below(figure, grid, i, layout);
  layout.height_cm = figure.height_cm.value_or(default_height(figure, grid, layout));
  choose_y_axes(figure, grid, layout);
  for (int pass = 0; pass < 2; ++pass) {  // the margin depends on the numbers, the numbers on what the margins leave
    choose_x_axes(figure, grid, layout);
    place_columns(figure, grid, layout);
  }
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    layout.panels[i].x_numbers = !joins_below(figure, grid, i);
    place_mark_labels(figure.panels[i], layout.panels[i], layout.em_cm, layout.width_cm);
  }
  place_rows(figure, grid, layout);  // twice: a legend may claim a row
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    layout.panels[i].legend = place_legend(figure.panels[i], layout.panels[i], layout.em_cm);
  place_rows(figure, grid, layout);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    PanelLayout& panel = layout.panels[i];
    panel.insets = place_insets(figure.panels[i], panel, layout.em_cm, "panel " + std::to_string(i + 1));
    size_images(figure, i, panel);
  }
  return layout;
}

}  // namespace slapstick::figure
