#pragma once
/// The gnuplot script of a figure.
#include <string>

#include "layout.hpp"
#include "table.hpp"

namespace slapstick::figure {

/// @param name     of the script and what it reads: ./name-plot.csv, ./name-raster<panel>.png
/// @param picture  of what it writes: ./picture.png, ..
std::string script(const Figure& figure, const Layout& layout, const Table& table, const std::string& name,
                   const std::string& picture, Formats formats);

/// File name of the table of lines and discs. Not name.csv: that is where a user's own table of the same study lies.
std::string table_name(const std::string& name);

/// File name of the image of a panel (counted from 0).
std::string raster_name(const std::string& name, std::size_t panel);
/// The same of an inset of a panel.
std::string inset_raster_name(const std::string& name, std::size_t panel, std::size_t inset);

}  // namespace slapstick::figure
