/// Writes a figure as a script for matplotlib.
#include "matplotlib.hpp"

#include "base/ranges.hpp"
#include "latex.hpp"
#include "script.hpp"
#include "text.hpp"

namespace slapstick::figure {
namespace {

/// A Python string.
std::string py_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "'";
}

std::string py_label(const std::string& enhanced) { return py_text(translate(enhanced, Dialect::matplotlib)); }

std::string py_dash(Dash dash) {
  switch (dash) {
    case Dash::dashed:
      return "(0, (6, 3))";
    case Dash::dotted:
      return "(0, (1.2, 1.6))";
    case Dash::dash_dotted:
      return "(0, (6, 2, 1.2, 2))";
    case Dash::solid:
      break;
  }
  return "'-'";
}

/// matplotlib's letter of a marker, and whether it is open.
std::pair<std::string, bool> py_marker(Marker marker) {
  switch (marker) {
    case Marker::square:
      return {"s", false};
    case Marker::triangle:
      return {"^", false};
    case Marker::diamond:
      return {"D", false};
    case Marker::star:
      return {"*", false};
    case Marker::circle:
      return {"o", true};
    case Marker::box:
      return {"s", true};
    case Marker::delta:
      return {"^", true};
    case Marker::nabla:
      return {"v", true};
    case Marker::cross:
      return {"x", false};
    case Marker::disc:
      break;
  }
  return {"o", false};
}

std::string point_arguments(Marker marker, double diameter_mm, Colour colour) {
  const auto [sign, open] = py_marker(marker);
  const std::string ink = quote_colour(colour);
  return "linestyle='none', marker='" + sign + "', markersize=" + fixed(diameter_mm * 72 / 25.4, 3) + ", color=" + ink +
         ", markeredgewidth=" + (open || marker == Marker::cross ? "0.6" : "0") +
         (open ? ", markerfacecolor='none'" : "");
}

std::string line_arguments(double width_pt, Dash dash, Colour colour) {
  return "linestyle=" + py_dash(dash) + ", linewidth=" + number(width_pt) + ", color=" + quote_colour(colour);
}

class PyPanel {
 public:
  PyPanel(const Figure& figure, const Layout& layout, const Table& table, const std::string& name, std::size_t index)
      : panel_(figure.panels[index]),
        at_(layout.panels[index]),
        whole_(layout),
        series_(table.panels[index]),
        name_(name),
        index_(index) {}

  std::string text() {
    const Box& frame = at_.frame;
    out_ = "\n# ---- panel " + std::to_string(index_ + 1) + "\n";
    out_ += "axes = figure.add_axes([" + fixed(frame.left / whole_.width_cm, 5) + ", " +
            fixed(frame.bottom / whole_.height_cm, 5) + ", " + fixed(frame.width() / whole_.width_cm, 5) + ", " +
            fixed(frame.height() / whole_.height_cm, 5) + "])\n";
    if (at_.x.log) line("axes.set_xscale('log')");
    if (at_.y.log) line("axes.set_yscale('log')");
    if (at_.raster) raster("axes", raster_name(name_, index_));
    for (const Mark& mark : panel_.marks) draw(mark);
    series("axes", true);
    entries();
    line("axes.set_xlim(" + number(at_.x.range.min) + ", " + number(at_.x.range.max) + ")");
    line("axes.set_ylim(" + number(at_.y.range.min) + ", " + number(at_.y.range.max) + ")");
    if (at_.x_numbers)
      line("axes.set_xlabel(" + py_label(panel_.x_label) + ")");
    else
      line("axes.tick_params(labelbottom=False)");
    line("axes.set_ylabel(" + py_label(panel_.y_label) + ")");
    if (!panel_.title.empty()) line("axes.set_title(" + py_label(panel_.title) + ", loc='left')");
    if (!panel_.tag.empty())
      line("axes.annotate(" + py_label(panel_.tag) +
           ", (0, 1), (-25, 4), xycoords='axes fraction', textcoords='offset points')");
    legend();
    for (std::size_t i = 0; i < at_.insets.size(); ++i) inset(i);
    return out_;
  }

 private:
  void line(const std::string& command) { out_ += command + "\n"; }

  /// The image fills the frame, whatever the axes are.
  void raster(const std::string& axes, const std::string& file) {
    line(axes + ".imshow(pyplot.imread(" + py_text(file) + "), extent=(0, 1, 0, 1), transform=" + axes +
         ".transAxes, aspect='auto', zorder=0)");
  }

  /// On white paper, over all else of the panel; its numbers stand on the outer sides.
  void inset(std::size_t i) {
    const InsetLayout& inset = at_.insets[i];
    const auto share = [](double length, double whole) { return fixed(length / whole, 5); };
    const auto corner = [&](const Box& box) {
      return share(box.left - at_.frame.left, at_.frame.width()) + ", " +
             share(box.bottom - at_.frame.bottom, at_.frame.height());
    };
    const auto size = [&](const Box& box) {
      return share(box.width(), at_.frame.width()) + ", " + share(box.height(), at_.frame.height());
    };
    for (const Box& paper : inset.paper)
      line("axes.add_patch(pyplot.Rectangle((" + corner(paper) + "), " + size(paper) +
           ", transform=axes.transAxes, color='white', linewidth=0, zorder=4))");
    line("inset = axes.inset_axes([" + corner(inset.frame) + ", " + size(inset.frame) + "])");
    if (at_.raster) raster("inset", inset_raster_name(name_, index_, i));
    series("inset", false);
    const auto range = [](const Range& shown) { return "(" + number(shown.min) + ", " + number(shown.max) + ")"; };
    line("inset.set(xlim=" + range(inset.x.range) + ", ylim=" + range(inset.y.range) + ")");
    line("inset.xaxis.set_major_locator(ticker.MultipleLocator(" + number(inset.x.step) + "))");
    line("inset.yaxis.set_major_locator(ticker.MultipleLocator(" + number(inset.y.step) + "))");
    line(std::string("inset.tick_params(labelsize=") + fixed(whole_.em_cm * 72 / 2.54 * spacing::inset_font, 2) +
         ", pad=1.5, length=2" + (inset.top ? ", labeltop=True, labelbottom=False" : "") +
         (inset.right ? ", labelright=True, labelleft=False" : "") + ")");
    line("axes.indicate_inset_zoom(inset, edgecolor='black', alpha=1, linewidth=0.6)");
  }

  void draw(const Mark& mark) {
    const std::string colour = ", color=" + quote_colour(mark.colour),
                      thin = colour + ", linewidth=0.5, linestyle=(0, (8, 4))";
    if (mark.x && mark.x_end)
      line("axes.axvspan(" + number(*mark.x) + ", " + number(*mark.x_end) + colour +
           ", alpha=0.22, linewidth=0, zorder=0)");
    else if (mark.x && !mark.y)
      line("axes.axvline(" + number(*mark.x) + thin + ")");
    else if (mark.y && !mark.x)
      line("axes.axhline(" + number(*mark.y) + thin + ")");
    if (mark.label.empty()) return;
    if (mark.x && mark.y && !mark.x_end)
      return line("axes.text(" + number(*mark.x) + ", " + number(*mark.y) + ", " + py_label(mark.label) +
                  ", ha='center', va='center', fontsize=small, clip_on=True" + colour + ")");
    if (mark.x)
      line("axes.text(" + number(mark.x_end ? 0.5 * (*mark.x + *mark.x_end) : *mark.x) + ", 1.02, " +
           py_label(mark.label) + ", transform=axes.get_xaxis_transform(), ha='center', va='bottom', fontsize=small" +
           colour + ")");
    else
      line("axes.text(0.99, " + number(*mark.y) + ", " + py_label(mark.label) +
           ", transform=axes.get_yaxis_transform(), ha='right', va='bottom', fontsize=small" + colour + ")");
  }

  /// @param named  with the entries of the legend
  void series(const std::string& axes, bool named) {
    std::size_t column = series_.first_column - 1;
    const auto columns = [&] {
      const std::string text = "data[:, " + std::to_string(column) + "], data[:, " + std::to_string(column + 1) + "], ";
      column += 2;
      return text;
    };
    const auto label = [&](const std::string& text) { return !named ? std::string() : entry(text); };
    for (const std::size_t i : series_.points) {
      const Points& points = panel_.points[i];
      line(axes + ".plot(" + columns() + point_arguments(points.marker, points.diameter_mm, points.colour) +
           label(points.label) + (points.over_lines ? ", zorder=3)" : ", zorder=1)"));
    }
    for (const std::size_t i : series_.lines) {
      const Line& drawn = panel_.lines[i];
      line(axes + ".plot(" + columns() + line_arguments(drawn.width_pt, drawn.dash, drawn.colour) + label(drawn.label) +
           ", zorder=2)");
    }
  }

  static std::string entry(const std::string& label) {
    return label.empty() ? std::string() : ", label=" + py_label(label);
  }

  /// Entries of the legend that no series draws.
  void entries() {
    for (const Points& points : panel_.points)
      if (at_.raster && !points.label.empty() && in_raster(points))
        line("axes.plot([], [], linestyle='none', marker='s', markersize=4, color=" + quote_colour(points.colour) +
             entry(points.label) + ")");
    for (const Key& key : panel_.keys)
      line("axes.plot([], [], " +
           (key.marker ? point_arguments(*key.marker, key.size, key.colour)
                       : line_arguments(key.size, key.dash, key.colour)) +
           entry(key.label) + ")");
  }

  /// In the columns that the layout has found room for, from the left edge of the panel's part of the paper.
  void legend_below(const std::string& how) {
    const auto columns = ranges::count_if(at_.keys, [](const KeyPlace& place) { return place.row == 0; });
    const double under_em = at_.x_numbers ? spacing::numbers + (panel_.x_label.empty() ? 0 : spacing::axis_label) : 0;
    line("axes.legend(loc='upper left', bbox_to_anchor=(" +
         fixed((at_.cell_left + (at_.keys.empty() ? 0.0 : at_.keys.front().x_cm)) / whole_.width_cm, 5) + ", " +
         fixed((at_.frame.bottom - under_em * whole_.em_cm) / whole_.height_cm, 5) +
         "), bbox_transform=figure.transFigure, ncol=" + std::to_string(columns) +
         ", columnspacing=1.2, labelspacing=0.25, borderpad=0, borderaxespad=0, handletextpad=0.3, handlelength=1.6" +
         how + ")");
  }

  void legend() {
    const std::string how = ", fontsize=small, frameon=False";
    switch (at_.legend) {
      case Legend::none:
      case Legend::automatic:
        return;
      case Legend::above:
        return line("axes.legend(loc='lower right', bbox_to_anchor=(1, 1), ncol=" +
                    std::to_string(legend_entries(panel_)) + how + ")");
      case Legend::below:
        return legend_below(how);
      case Legend::top_left:
        return line("axes.legend(loc='upper left'" + how + ")");
      case Legend::top_right:
        return line("axes.legend(loc='upper right'" + how + ")");
      case Legend::bottom_left:
        return line("axes.legend(loc='lower left'" + how + ")");
      case Legend::bottom_right:
        return line("axes.legend(loc='lower right'" + how + ")");
    }
  }

  const Panel& panel_;
  const PanelLayout& at_;
  const Layout& whole_;
  const PanelSeries& series_;
  const std::string& name_;
  std::size_t index_;
  std::string out_;
};

}  // namespace

std::string matplotlib_script(const Figure& figure, const Layout& layout, const Table& table, const std::string& name,
                              const std::string& picture) {
  std::string out =
      "#!/usr/bin/env python3\n\"\"\"Written by slapstick. Change it at will, and draw in this folder: python3 SCRIPT "
      "[FILE.pdf ..]\"\"\"\n";
  out +=
      "import sys\n\nimport matplotlib\nmatplotlib.use('Agg')\nimport numpy\nfrom matplotlib import pyplot, ticker\n\n";
  out += "pyplot.rcParams.update({'font.size': " + number(figure.font_pt) + ", 'font.family': " + py_text(figure.font) +
         ", 'xtick.direction': 'in', 'ytick.direction': 'in', 'xtick.top': True, 'ytick.right': True, "
         "'axes.linewidth': 0.5, 'axes.titlesize': 'medium', 'axes.labelpad': 2})\n";
  out += "small = " + number(figure.font_pt * spacing::legend_font) + "\n";
  if (!table.series.empty())
    out += "data = numpy.genfromtxt(" + py_text(table_name(name)) + ", delimiter=',', skip_header=1, ndmin=2)\n";
  out += "figure = pyplot.figure(figsize=(" + fixed(layout.width_cm / 2.54, 4) + ", " +
         fixed(layout.height_cm / 2.54, 4) + "))\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i) out += PyPanel(figure, layout, table, name, i).text();
  return out + "\nfor file in sys.argv[1:] or [" + py_text(picture + "-py.pdf") +
         "]:\n    figure.savefig(file, dpi=" + std::to_string(figure.png_dpi) + ")\n";
}

}  // namespace slapstick::figure
