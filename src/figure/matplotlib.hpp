#pragma once
/// A figure as a script for matplotlib.
#include <string>

#include "layout.hpp"
#include "table.hpp"

namespace slapstick::figure {

/// Python 3 with numpy and matplotlib. Frames stand where gnuplot's do.
/// @param name     of what it reads: ./name-plot.csv, ./name-raster<panel>.png
/// @param picture  the script writes ./picture-py.pdf, or the files that its arguments name
std::string matplotlib_script(const Figure& figure, const Layout& layout, const Table& table, const std::string& name,
                              const std::string& picture);

}  // namespace slapstick::figure
