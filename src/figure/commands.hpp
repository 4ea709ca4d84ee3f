#pragma once
/// gnuplot's commands that panels and their insets share. Each ends its line.
#include <functional>
#include <string>
#include <vector>

#include "layout.hpp"
#include "table.hpp"

namespace slapstick::figure {

/// "screen 0.1, screen 0.2": a place on the paper.
std::string screen_place(const Layout& layout, double x_cm, double y_cm);

/// Forgets the labels and lines of what was plotted before, and sets the frame of what comes.
std::string frame_commands(const Box& frame, const Layout& layout);

/// Range, ticks and numbers of an axis: "x", "y2". @param latex  the numbers are set by LaTeX
std::string axis_commands(const std::string& name, const Axis& axis, bool numbers, bool latex);

/// The image of a file as part of a plot. On linear axes the image lies in data coordinates; gnuplot cannot do that on
/// logarithmic ones, where the image fills the frame, on axes x2 and y2 of 0 to 1.
std::string image_part(const std::string& file, const Axis& x, const Axis& y, int width, int height);

/// The columns of a panel that are drawn as vectors, in the order in which they are drawn.
/// @param title  what a part says of a series with such a label: " title 'up'"
void series_parts(const Panel& panel, const PanelSeries& series, const std::string& file,
                  const std::function<std::string(const std::string&)>& title, std::vector<std::string>& parts);

/// `plot` with its parts; axes alone if there are none.
std::string plot_command(std::vector<std::string> parts);

}  // namespace slapstick::figure
