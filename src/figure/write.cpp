/// From a figure to files: check, lay out, draw in a scratch folder, move into place.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/ranges.hpp"
#include "figure/figure.hpp"
#include "figure/raster.hpp"
#include "gnuplot.hpp"
#include "latex.hpp"
#include "layout.hpp"
#include "matplotlib.hpp"
#include "script.hpp"
#include "slapstick/base/error.hpp"
#include "table.hpp"

namespace slapstick::figure {
namespace {

namespace fs = std::filesystem;

/// A hidden folder beside the target (so that renaming is atomic), gone when the object is.
class Scratch {
 public:
  Scratch(const fs::path& folder, const std::string& name) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw StorageError("no such folder: " + folder.string());
    std::string path = (folder / ("." + name + "-XXXXXX")).string();
    if (mkdtemp(path.data()) == nullptr)
      throw StorageError("cannot write into " + folder.string() + ": " + std::strerror(errno));
    path_ = path;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

  void save(const std::string& name, const std::string& contents) const {
    std::ofstream out(path_ / name, std::ios::binary);
    out.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    out.close();
    if (!out)
      throw StorageError("cannot write " + name + " in " + path_.parent_path().string() + ": " + std::strerror(errno));
  }

 private:
  fs::path path_;
};

void check(bool good, const std::string& message) {
  if (!good) throw InputError("figure: " + message);
}

void check_range(const std::optional<Range>& range, bool log, const std::string& where) {
  if (!range) return;
  check(range->min < range->max && resolvable(*range),
        where + " range needs min < max, both finite and far enough apart to be numbered");
  check(!log || range->min > 0, where + " range must be positive on a logarithmic axis");
}

void check_cells(const Panel& panel, const std::string& where) {
  const Cells& cells = *panel.cells;
  check(!panel.log_x && !panel.log_y, where + ": cells need linear axes");
  check(cells.columns > 0 && cells.rows > 0 &&
            cells.codes.size() == static_cast<std::size_t>(cells.columns) * static_cast<std::size_t>(cells.rows),
        where + ": cells need a code each");
  check(ranges::all_of(cells.codes,
                       [&](std::uint8_t code) { return code == Cells::clear || code < cells.colours.size(); }) &&
            cells.colours.size() <= Cells::clear,
        where + ": a cell has a code without a colour");
  check(ranges::none_of(panel.points, in_raster), where + ": points over cells must be discs");
}

void check_panel(const Panel& panel, const std::string& where) {
  const auto lengths = [&](const auto& series, const std::string& kind, std::size_t index) {
    const std::string name =
        where + ", " + kind + " " + std::to_string(index + 1) + (series.label.empty() ? "" : " (" + series.label + ")");
    check(series.x.size() == series.y.size(),
          name + ": x has " + std::to_string(series.x.size()) + " values, y has " + std::to_string(series.y.size()));
  };
  for (std::size_t i = 0; i < panel.points.size(); ++i) lengths(panel.points[i], "points", i);
  if (panel.cells) check_cells(panel, where);
  for (std::size_t i = 0; i < panel.lines.size(); ++i) lengths(panel.lines[i], "line", i);
  check(ranges::count_if(panel.points, in_raster) <= static_cast<std::ptrdiff_t>(largest_series_count) ||
            !std::any_of(panel.points.begin(), panel.points.end(),
                         [](const Points& p) { return p.drawing == Drawing::raster; }),
        where + ": an image holds at most 8 series of points");
  check_range(panel.x_range, panel.log_x, where + ": x");
  check_range(panel.y_range, panel.log_y, where + ": y");
  check(panel.insets.size() <= most_insets, where + ": more than 4 insets");
  check(panel.insets.empty() || (!panel.log_x && !panel.log_y), where + ": insets need linear axes");
  for (std::size_t i = 0; i < panel.insets.size(); ++i) {
    const std::string inset = where + ", inset " + std::to_string(i + 1);
    check_range(panel.insets[i].x, false, inset + ": x");
    check_range(panel.insets[i].y, false, inset + ": y");
  }
  check(panel.height_share > 0 && std::isfinite(panel.height_share), where + ": height_share must be positive");
  for (const Mark& mark : panel.marks)
    check(mark.x || (mark.y && !mark.x_end), where + ": a mark needs x or y (and x if it has x_end)");
}

void check_figure(const Figure& figure, const Formats& formats) {
  check(!figure.panels.empty(), "no panels");
  check(figure.columns >= 1, "columns must be at least 1");
  check(formats.of_gnuplot() || formats.py, "no format asked for");
  check(!formats.tex || !(formats.png || formats.pdf || formats.svg), "a picture for LaTeX is drawn by itself");
  check(figure.width_cm > 0 && figure.width_cm <= 100, "width_cm must be in (0, 100]");
  check(!figure.height_cm || (*figure.height_cm > 0 && *figure.height_cm <= 100), "height_cm must be in (0, 100]");
  check(figure.font_pt >= 3 && figure.font_pt <= 40, "font_pt must be in [3, 40]");
  const auto sensible = [](int dpi) { return dpi >= 50 && dpi <= 1200; };
  check(sensible(figure.png_dpi) && sensible(figure.raster_dpi.value_or(300)),
        "png_dpi and raster_dpi must be in [50, 1200]");
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    check_panel(figure.panels[i], "panel " + std::to_string(i + 1));
}

std::string draw_raster(const Panel& panel, const Axis& x, const Axis& y, int width, int height) {
  const Window window{x.range, y.range, x.log, y.log};
  if (panel.cells) return encode_png(picture_of(*panel.cells, window, width, height));
  std::vector<Counts> counts;
  std::vector<Colour> colours;
  for (const Points& points : panel.points) {
    if (!in_raster(points)) continue;
    counts.push_back(count_points(points.x, points.y, window, width, height));
    spread_one_pixel(counts.back());
    colours.push_back(points.colour);
  }
  return encode_png(blend(counts, colours));
}

/// Everything that can be known to fail is found before the first file moves.
void check_movable(const Scratch& scratch, const fs::path& folder, const std::vector<std::string>& names) {
  for (const auto& name : names) {
    std::error_code error;
    if (!fs::exists(scratch.path() / name, error)) throw StorageError("gnuplot did not write " + name);
    if (fs::is_directory(folder / name, error))
      throw StorageError("cannot write " + (folder / name).string() + ": a folder has this name");
  }
}

void move_into_place(const Scratch& scratch, const fs::path& folder, const std::string& name) {
  const fs::path target = folder / name;
  std::error_code error;
  fs::rename(scratch.path() / name, target, error);
  if (error) throw StorageError("cannot write " + target.string() + ": " + error.message());
}

void check_name(const std::string& name, const fs::path& stem) {
  check(!name.empty() && name != "." && name != "..", "the stem '" + stem.string() + "' names no file");
  check(std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }),
        "the stem holds a control character");
}

}  // namespace

void demand_room(const Figure& figure) {
  check_figure(figure, {});
  static_cast<void>(lay_out(figure));
}

Files write(const Figure& figure, const fs::path& stem, Formats formats, const std::string& beside) {
  check_figure(figure, formats);
  const std::string picture = stem.filename().string(), name = beside.empty() ? picture : beside;
  check_name(picture, stem);
  check_name(name, stem);
  const fs::path folder = stem.has_parent_path() ? stem.parent_path() : fs::path(".");
  const Layout layout = lay_out(figure);
  const Table table = tabulate(figure, layout);

  const Scratch scratch(folder, name);
  std::vector<std::string> names;
  const auto save = [&](const std::string& file, const std::string& contents) {
    scratch.save(file, contents);
    names.push_back(file);
  };
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const PanelLayout& at = layout.panels[i];
    if (!at.raster) continue;
    save(raster_name(name, i), draw_raster(figure.panels[i], at.x, at.y, at.raster_width, at.raster_height));
    for (std::size_t k = 0; k < at.insets.size(); ++k)
      save(inset_raster_name(name, i, k), draw_raster(figure.panels[i], at.insets[k].x, at.insets[k].y,
                                                      at.insets[k].raster_width, at.insets[k].raster_height));
  }
  const std::size_t raster_count = names.size();
  if (!table.series.empty()) save(table_name(name), to_csv(table));
  if (formats.py) save(picture + ".py", matplotlib_script(figure, layout, table, name, picture));
  if (formats.of_gnuplot()) {
    save(name + ".gp",
         script(formats.tex ? translated(figure, Dialect::latex) : figure, layout, table, name, picture, formats));
    run_gnuplot(scratch.path(), name + ".gp");
  }
  for (const auto& [wanted, ending] :
       {std::pair{formats.png, ".png"}, std::pair{formats.pdf, ".pdf"}, std::pair{formats.svg, ".svg"},
        std::pair{formats.tex, "-tex.pdf"}, std::pair{formats.tex, ".tex"}})
    if (wanted) names.push_back(picture + ending);

  check_movable(scratch, folder, names);
  for (const auto& file : names) move_into_place(scratch, folder, file);
  const auto path = [&](bool exists, const char* ending) { return exists ? folder / (picture + ending) : fs::path(); };
  Files files{.script = path(formats.of_gnuplot(), ".gp").empty() ? fs::path() : folder / (name + ".gp"),
              .data = table.series.empty() ? fs::path() : folder / table_name(name),
              .rasters = {},
              .png = path(formats.png, ".png"),
              .pdf = path(formats.pdf || formats.tex, formats.tex ? "-tex.pdf" : ".pdf"),
              .svg = path(formats.svg, ".svg"),
              .tex = path(formats.tex, ".tex"),
              .py = path(formats.py, ".py")};
  for (std::size_t i = 0; i < raster_count; ++i) files.rasters.push_back(folder / names[i]);
  return files;
}

}  // namespace slapstick::figure
