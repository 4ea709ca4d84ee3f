/// Writes insets in gnuplot's commands.
#include "inset_script.hpp"

#include <vector>

#include "commands.hpp"
#include "script.hpp"
#include "text.hpp"

namespace slapstick::figure {
namespace {

struct Stroke {
  const char* width;
  const char* colour;
};

/// Over cells a dark line has a white rim: so the line is seen on light and dark ones alike.
std::vector<Stroke> strokes(const Panel& panel) {
  const Stroke rim{"1.6", "#ffffff"}, line{"0.6", "#000000"};
  return panel.cells ? std::vector{rim, line} : std::vector{line};
}

std::string rectangle(const Box& box, const Layout& whole) {
  return "  set object rectangle from " + screen_place(whole, box.left, box.bottom) + " to " +
         screen_place(whole, box.right, box.top);
}

}  // namespace

std::string source_commands(const Panel& panel, const PanelLayout& at, const Layout& whole) {
  std::string out;
  for (const auto& [width, colour] : strokes(panel))
    for (const InsetLayout& inset : at.insets)
      out +=
          rectangle(inset.source, whole) + " front fillstyle empty border lc rgb '" + colour + "' lw " + width + "\n";
  return out;
}

std::string inset_commands(const DrawnPanel& drawn, std::size_t inset, double font_pt, bool latex) {
  const InsetLayout& at = drawn.at.insets[inset];
  std::string out =
      "\n  # ---- inset " + std::to_string(inset + 1) + " of panel " + std::to_string(drawn.index + 1) + "\n";
  out += frame_commands(at.frame, drawn.whole);
  for (const Box& paper : at.paper)
    out += rectangle(paper, drawn.whole) + " behind noclip fillcolor rgb '#ffffff' fillstyle solid noborder\n";
  for (const auto& [width, colour] : strokes(drawn.panel))
    for (const int corner : at.joined)
      out += "  set arrow from " + screen_place(drawn.whole, corner_x(at.source, corner), corner_y(at.source, corner)) +
             " to " + screen_place(drawn.whole, corner_x(at.frame, corner), corner_y(at.frame, corner)) +
             " nohead back lw " + width + " lc rgb '" + colour + "'\n";
  const std::string font = fixed(font_pt * spacing::inset_font, 2);
  out += "  set tics scale 0.5, 0.25 font '," + font + "'; set clip two\n";
  out += axis_commands("x", at.x, !at.top, latex) + axis_commands("y", at.y, !at.right, latex);
  // Numbers stand on the outer sides, where no line comes in.
  if (at.top) out += axis_commands("x2", at.x, true, latex);
  if (at.right) out += axis_commands("y2", at.y, true, latex);
  out += std::string("  set ") + (at.top ? "x2tics font '," + font + "' offset 0, -0.4" : "xtics offset 0, 0.4") +
         "; set " + (at.right ? "y2tics font '," + font + "' offset -0.6, 0" : "ytics offset 0.6, 0") + "\n";
  std::vector<std::string> parts;
  if (drawn.at.raster)
    parts.push_back(
        image_part(inset_raster_name(drawn.name, drawn.index, inset), at.x, at.y, at.raster_width, at.raster_height));
  series_parts(
      drawn.panel, drawn.series, table_name(drawn.name), [](const std::string&) { return std::string(" notitle"); },
      parts);
  return out + plot_command(parts) +
         "  unset x2tics; unset y2tics; unset mx2tics; unset my2tics; set tics scale 0.8, 0.4 font '' offset 0, 0; "
         "unset clip two\n";
}

}  // namespace slapstick::figure
