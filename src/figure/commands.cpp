/// Writes gnuplot's commands that panels and their insets share.
#include "commands.hpp"

#include "latex.hpp"
#include "style.hpp"
#include "text.hpp"

namespace slapstick::figure {

std::string screen_place(const Layout& layout, double x_cm, double y_cm) {
  return "screen " + fixed(x_cm / layout.width_cm, 5) + ", screen " + fixed(y_cm / layout.height_cm, 5);
}

std::string frame_commands(const Box& frame, const Layout& layout) {
  return "  unset label; unset arrow; unset object; unset logscale; unset key\n  set lmargin at screen " +
         fixed(frame.left / layout.width_cm, 5) + "; set rmargin at screen " + fixed(frame.right / layout.width_cm, 5) +
         "\n  set bmargin at screen " + fixed(frame.bottom / layout.height_cm, 5) + "; set tmargin at screen " +
         fixed(frame.top / layout.height_cm, 5) + "\n";
}

std::string axis_commands(const std::string& name, const Axis& axis, bool numbers, bool latex) {
  std::string out = axis.log ? "  set logscale " + name + "\n" : "";
  out += "  set " + name + "range [" + number(axis.range.min) + ":" + number(axis.range.max) + "]\n";
  out += "  set format " + name + " " + quote(!numbers ? "" : latex ? latex_format(axis.format) : axis.format) + "\n";
  std::string ticks = "autofreq";
  if (!axis.ticks.empty()) {
    ticks.clear();
    for (const double tick : axis.ticks) ticks += (ticks.empty() ? "(" : ", ") + number(tick);
    ticks += ")";
  } else if (axis.step > 0) {
    ticks = number(axis.step);
  }
  return out + "  set " + name + "tics " + ticks + "; set m" + name + "tics " +
         (axis.log ? "default" : std::to_string(axis.minor)) + "\n";
}

std::string image_part(const std::string& file, const Axis& x, const Axis& y, int width, int height) {
  const bool fill = x.log || y.log;
  const Range across = fill ? Range{0, 1} : x.range, up = fill ? Range{0, 1} : y.range;
  const double dx = (across.max - across.min) / width, dy = (up.max - up.min) / height;
  return quote_file(file) + " binary filetype=png origin=(" + number(across.min + 0.5 * dx) + "," +
         number(up.min + 0.5 * dy) + ") dx=" + number(dx) + " dy=" + number(dy) + " using 1:2:3:4" +
         (fill ? " axes x2y2" : "") + " with rgbalpha notitle";
}

void series_parts(const Panel& panel, const PanelSeries& series, const std::string& file,
                  const std::function<std::string(const std::string&)>& title, std::vector<std::string>& parts) {
  std::size_t column = series.first_column;
  const auto columns = [&] {
    const std::string text =
        quote_file(file) + " skip 1 using " + std::to_string(column) + ":" + std::to_string(column + 1);
    column += 2;
    return text;
  };
  std::vector<std::string> on_top;
  for (const std::size_t i : series.points) {
    const Points& points = panel.points[i];
    (points.over_lines ? on_top : parts)
        .push_back(columns() + " with points " + point_style(points.marker, points.diameter_mm, points.colour) +
                   title(points.label));
  }
  for (const std::size_t i : series.lines) {
    const Line& drawn = panel.lines[i];
    parts.push_back(columns() + " with lines " + line_style(drawn.width_pt, drawn.dash, drawn.colour) +
                    title(drawn.label));
  }
  parts.insert(parts.end(), on_top.begin(), on_top.end());
}

std::string plot_command(std::vector<std::string> parts) {
  if (parts.empty()) parts.push_back("NaN notitle");  // draws the axes
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i)
    out += "  " + std::string(i == 0 ? "plot " : "     ") + parts[i] + (i + 1 < parts.size() ? ", \\" : "") + "\n";
  return out;
}

}  // namespace slapstick::figure
