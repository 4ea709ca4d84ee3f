#pragma once
/// The gnuplot script of a figure.
#include <string>

#include "layout.hpp"
#include "table.hpp"

namespace slapstick::figure {

/// @param name  file name stem; the script reads and writes ./name-plot.csv, ./name-raster<panel>.png, ./name.png, ...
std::string script(const Figure& figure, const Layout& layout, const Table& table, const std::string& name,
                   Formats formats);

/// File name of the table of lines and discs. Not name.csv: that is where a user's own table of the same study lies.
std::string table_name(const std::string& name);

/// File name of the image of a panel (counted from 0).
std::string raster_name(const std::string& name, std::size_t panel);

}  // namespace slapstick::figure
