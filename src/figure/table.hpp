#pragma once
/// The columns that the script plots as vectors, and the CSV text that holds them.
#include <cstddef>
#include <string>
#include <vector>

#include "layout.hpp"

namespace slapstick::figure {

/// Two neighbouring columns of the CSV; NaN in an empty or undrawable cell.
struct Series {
  std::string name{};
  const std::vector<double>* x = nullptr;
  const std::vector<double>* y = nullptr;
  bool log_x = false, log_y = false;
};

/// Which points and lines of a panel are drawn as vectors and have something to draw, in the order in which they are
/// drawn.
struct PanelSeries {
  std::vector<std::size_t> points{}, lines{};
  std::size_t first_column = 1;  ///< of the CSV, counted from 1; two per series
};

struct Table {
  std::vector<Series> series{};
  std::vector<PanelSeries> panels{};
};

Table tabulate(const Figure& figure, const Layout& layout);

/// A header row, then as many rows as the longest series has values.
std::string to_csv(const Table& table);

}  // namespace slapstick::figure
