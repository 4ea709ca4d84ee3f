/// Writes the gnuplot script of a figure.
#include "script.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "commands.hpp"
#include "inset_script.hpp"
#include "style.hpp"
#include "text.hpp"

namespace slapstick::figure {
namespace {

std::string comment(const std::string& text) {
  std::string out = "# ";
  for (const char c : text)
    out += c == '\n' ? std::string("\n# ") : std::string(1, static_cast<unsigned char>(c) < 0x20 ? ' ' : c);
  return out + "\n";
}

/// The commands of one panel.
class PanelScript {
 public:
  PanelScript(const Figure& figure, const Layout& layout, const Table& table, const std::string& name,
              std::size_t index, bool latex)
      : panel_(figure.panels[index]),
        at_(layout.panels[index]),
        whole_(layout),
        series_(table.panels[index]),
        name_(name),
        index_(index),
        font_pt_(figure.font_pt),
        latex_(latex),
        small_font_(fixed(figure.font_pt * spacing::legend_font, 2)) {}

  std::string text() {
    out_ = "\n  # ---- panel " + std::to_string(index_ + 1) + "\n";
    out_ += frame_commands(at_.frame, whole_);
    out_ += axis_commands("x", at_.x, at_.x_numbers, latex_) + axis_commands("y", at_.y, true, latex_);
    words();
    marks();
    legend();
    out_ += source_commands(panel_, at_, whole_);
    plot();
    for (std::size_t i = 0; i < at_.insets.size(); ++i)
      out_ += inset_commands({panel_, at_, whole_, series_, name_, index_}, i, font_pt_, latex_);
    return out_;
  }

 private:
  void line(const std::string& command) { out_ += "  " + command + "\n"; }

  void label(const std::string& text, double x_cm, double y_cm, const std::string& how) {
    if (!text.empty()) line("set label " + quote(text) + " at " + screen_place(whole_, x_cm, y_cm) + " " + how);
  }

  void words() {
    const double em = whole_.em_cm;
    const Box& frame = at_.frame;
    if (at_.x_numbers)
      label(panel_.x_label, 0.5 * (frame.left + frame.right),
            frame.bottom - (spacing::numbers + 0.5 * spacing::axis_label) * em,
            "center" + font_to_fit(panel_.x_label, frame.width()));
    const double y_label_x =
        at_.cell_left + (spacing::edge + 0.5 * spacing::axis_label) * em;  // in line with the panels above and below
    label(panel_.y_label, y_label_x, 0.5 * (frame.bottom + frame.top),
          "center rotate by 90" + font_to_fit(panel_.y_label, frame.height()));
    const double top_row = frame.top + row_em(std::max(rows_above(panel_, at_) - 1, 0)) * em;
    label(panel_.tag, at_.cell_left + spacing::edge * em, top_row, "left");
    label(panel_.title, frame.left, top_row, "left");
  }

  /// An axis label longer than its axis is set smaller rather than cut off.
  std::string font_to_fit(const std::string& text, double length_cm) const {
    const double share = length_cm / (width_em(text) * whole_.em_cm);
    return share >= 1 ? "" : " font '," + fixed(font_pt_ * std::max(share, 0.6), 2) + "'";
  }

  /// Middle of a row of text above the frame, in em.
  static double row_em(int row) { return 0.15 + spacing::row * (row + 0.5); }

  void marks() {
    for (const Mark& mark : panel_.marks) mark_lines(mark);
    for (const MarkLabel& at : at_.mark_labels) {
      const Mark& mark = panel_.marks[at.mark];
      label(mark.label, at.x_cm, at_.frame.top + row_em(at.row) * whole_.em_cm,
            "center font '," + small_font_ + "'" + " textcolor rgb " + quote_colour(mark.colour));
    }
  }

  void mark_lines(const Mark& mark) {
    const std::string colour = " rgb " + quote_colour(mark.colour);
    const std::string thin = " nohead front lw 0.5 dt (10,6) lc" + colour;
    if (mark.x && mark.x_end) {
      const double from = std::max(*mark.x, at_.x.range.min), to = std::min(*mark.x_end, at_.x.range.max);
      if (from < to)
        line("set object rectangle from " + number(from) + ", graph 0 to " + number(to) + ", graph 1 behind fillcolor" +
             colour + " fillstyle solid 0.22 noborder");
    } else if (mark.x && !mark.y) {
      if (at_.x.shows(*mark.x))
        line("set arrow from " + number(*mark.x) + ", graph 0 to " + number(*mark.x) + ", graph 1" + thin);
    } else if (mark.y && !mark.x) {
      if (at_.y.shows(*mark.y))
        line("set arrow from graph 0, first " + number(*mark.y) + " to graph 1, first " + number(*mark.y) + thin);
      if (at_.y.shows(*mark.y) && !mark.label.empty())
        line("set label " + quote(mark.label) + " at graph 1, first " + number(*mark.y) +
             " right offset -0.7, 0.8 front boxed font '," + small_font_ + "'" + " textcolor" + colour);
    } else if (mark.x && mark.y && at_.x.shows(*mark.x) && at_.y.shows(*mark.y)) {
      line("set label " + quote(mark.label) + " at " + number(*mark.x) + ", " + number(*mark.y) +
           " center front boxed font '," + small_font_ + "'" + " textcolor" + colour);
    }
  }

  void legend() {
    if (at_.legend == Legend::none) return;
    if (at_.legend == Legend::below) return legend_below();
    const auto named = [](const Line& l) { return !l.label.empty(); };
    const bool has_lines =
        ranges::any_of(panel_.lines, named) || ranges::any_of(panel_.keys, [](const Key& key) { return !key.marker; });
    const std::string common = std::string(" Left reverse samplen ") + (has_lines ? "1.6" : "0.4") +
                               " spacing 1.05 height 0.2 width 0 font '," + small_font_ + "'";
    if (at_.legend == Legend::above) {
      const double y = at_.frame.top + row_em(at_.mark_rows) * whole_.em_cm;
      line("set key at " + screen_place(whole_, at_.frame.right, y) + " right center horizontal maxcols " +
           std::to_string(legend_entries(panel_)) + " maxrows 1" + common);
      return;
    }
    const bool right = at_.legend == Legend::top_right || at_.legend == Legend::bottom_right;
    const bool top = at_.legend == Legend::top_right || at_.legend == Legend::top_left;
    line(std::string("set key inside vertical ") + (top ? "top " : "bottom ") + (right ? "right" : "left") + common);
  }

  void legend_below() {
    const double axis_em = at_.x_numbers ? spacing::numbers + (panel_.x_label.empty() ? 0 : spacing::axis_label) : 0;
    const double font_cm = spacing::legend_font * whole_.em_cm;
    for (const KeyPlace& place : at_.keys) {
      const double y = at_.frame.bottom - (axis_em + spacing::row * (place.row + 0.5)) * whole_.em_cm;
      const double from = at_.cell_left + place.x_cm, text = from + place.text_cm;
      const double to = text - spacing::after_sample * font_cm;
      const Key& key = place.key;
      if (key.marker)
        line("set label '' at " + screen_place(whole_, 0.5 * (from + to), y) + " point " +
             point_style(*key.marker, key.size, key.colour));
      else
        line("set arrow from " + screen_place(whole_, from, y) + " to " + screen_place(whole_, to, y) + " nohead " +
             line_style(key.size, key.dash, key.colour));
      label(key.label, text, y, "left font '," + small_font_ + "'");
    }
  }

  void plot() {
    std::vector<std::string> parts;
    if (at_.raster) raster_parts(parts);
    if (at_.legend != Legend::none && at_.legend != Legend::below) key_parts(parts);
    series_parts(
        panel_, series_, table_name(name_), [&](const std::string& label) { return title(label); }, parts);
    out_ += plot_command(parts);
  }

  void key_parts(std::vector<std::string>& parts) const {
    for (const Key& key : panel_.keys) {
      const std::string style = key.marker ? "points " + point_style(*key.marker, key.size, key.colour)
                                           : "lines " + line_style(key.size, key.dash, key.colour);
      parts.push_back("keyentry with " + style + title(key.label));
    }
  }

  void raster_parts(std::vector<std::string>& parts) {
    const bool fill = at_.x.log || at_.y.log;
    if (fill) line("set x2range [0:1]; set y2range [0:1]  # the frame; the image knows the ranges of x and y above");
    parts.push_back(image_part(raster_name(name_, index_), at_.x, at_.y, at_.raster_width, at_.raster_height));
    for (const Points& points : panel_.points)
      if (!points.label.empty() && in_raster(points))
        parts.push_back("keyentry with points pt 5 ps 0.6 lc rgb " + quote_colour(points.colour) + title(points.label));
    if (const auto both = colour_of_both(panel_))
      parts.push_back("keyentry with points pt 5 ps 0.6 lc rgb " + quote_colour(*both) + title("both"));
  }

  std::string title(const std::string& label) const {
    const bool elsewhere = at_.legend == Legend::none || at_.legend == Legend::below;
    return label.empty() || elsewhere ? " notitle" : " title " + quote(label);
  }

  const Panel& panel_;
  const PanelLayout& at_;
  const Layout& whole_;
  const PanelSeries& series_;
  const std::string& name_;
  std::size_t index_;
  double font_pt_;
  bool latex_;
  std::string small_font_, out_;
};

/// One line per format. Line widths come out in pt and text in font_pt in all of them (gnuplot's units differ by
/// format).
std::string terminals(const Figure& figure, const Layout& layout, Formats formats) {
  const std::string font = " enhanced font " + quote(figure.font + "," + number(figure.font_pt));
  const auto scaled = [](double text, double lines, double dashes, double points) {
    return " fontscale " + fixed(text, 4) + " linewidth " + fixed(lines, 4) + " dashlength " + fixed(dashes, 1) +
           " pointscale " + fixed(points, 4);
  };
  const auto pixels = [&](double dpi) {
    return std::to_string(std::lround(layout.width_cm / 2.54 * dpi)) + "," +
           std::to_string(std::lround(layout.height_cm / 2.54 * dpi));
  };
  constexpr double pdf_dashes =
      1.3;  // of lines of 0.7 pt as long as in the PNG, measured; pdfcairo has one length for all thinner than 1 pt
  std::string out;
  if (formats.png)
    out += "  if (format eq 'png') { set terminal pngcairo size " + pixels(figure.png_dpi) + font +
           scaled(figure.png_dpi / 96.0, figure.png_dpi / 72.0, 2, figure.png_dpi / 72.0) + " }\n";
  if (formats.pdf)
    out += "  if (format eq 'pdf') { set terminal pdfcairo size " + fixed(layout.width_cm, 3) + "cm," +
           fixed(layout.height_cm, 3) + "cm" + font + scaled(0.75, 2, pdf_dashes, 1) + " }\n";
  if (formats.tex)
    out += "  if (format eq 'tex') { set terminal cairolatex pdf size " + fixed(layout.width_cm, 3) + "cm," +
           fixed(layout.height_cm, 3) + "cm font ',8' linewidth 2 dashlength " + fixed(pdf_dashes, 1) +
           " pointscale 1 }\n";
  if (formats.svg)
    out += "  if (format eq 'svg') { set terminal svg size " + pixels(96) + font +
           " fontscale 1.3333 linewidth 1.3333 }\n";
  return out;
}

/// The command of gnuplot that gives a file another name: names are words of the shell, in double quotes, in a string
/// of gnuplot, in which an apostrophe stands twice.
std::string rename_command(const std::string& from, const std::string& to) {
  std::string out = "system('mv --";
  for (const std::string& name : {from, to}) {
    out += " \"";
    for (const char c : name) {
      if (std::string_view("$`\"\\").find(c) != std::string_view::npos) out += '\\';
      out += c == '\'' ? "''" : std::string(1, c);
    }
    out += "\"";
  }
  return out + "')\n";
}

std::string format_list(Formats formats) {
  std::string out;
  for (const auto& [wanted, name] : {std::pair{formats.png, "png"}, std::pair{formats.pdf, "pdf"},
                                     std::pair{formats.svg, "svg"}, std::pair{formats.tex, "tex"}})
    if (wanted) out += (out.empty() ? "" : " ") + std::string(name);
  return out;
}

}  // namespace

std::string table_name(const std::string& name) { return name + "-plot.csv"; }

std::string raster_name(const std::string& name, std::size_t panel) {
  return name + "-raster" + std::to_string(panel + 1) + ".png";
}

std::string inset_raster_name(const std::string& name, std::size_t panel, std::size_t inset) {
  return name + "-raster" + std::to_string(panel + 1) + "-inset" + std::to_string(inset + 1) + ".png";
}

std::string script(const Figure& figure, const Layout& layout, const Table& table, const std::string& name,
                   const std::string& picture, Formats formats) {
  std::string out =
      comment("Written by slapstick. Change it at will and redraw with gnuplot 5.4 or later, in this folder:");
  out += comment("  gnuplot " + name + ".gp");
  if (!figure.caption.empty()) out += comment("\n" + figure.caption);
  out += std::string("reset\nset encoding utf8\n") + (formats.tex ? "" : "set minussign\n") +
         "set datafile separator comma\n";
  out += "do for [format in " + quote(format_list(formats)) + "] {\n" + terminals(figure, layout, formats);
  out += "  set output " + quote_file(picture + (formats.tex ? "-tex." : ".")) + " . format\n";
  out += "  set border 15 lw 0.5 front; set tics front in scale 0.8, 0.4 mirror; unset x2tics; unset y2tics\n";
  out += "  set style textbox opaque fillcolor rgb '#40ffffff' noborder margins 1, 0.8\n";
  out += "  set multiplot\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    out += PanelScript(figure, layout, table, name, i, formats.tex).text();
  // The lines lie in a file beside that is called like the text: a-tex.pdf, for a.pdf is the picture of another format.
  const std::string rename = formats.tex ? rename_command("./" + picture + "-tex.tex", "./" + picture + ".tex") : "";
  return out + "\n  unset multiplot\n  unset output\n}\n" + rename;
}

}  // namespace slapstick::figure
