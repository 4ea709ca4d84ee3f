/// How intricate the boundary of basins is. Knows no mechanics: a basin is a number.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "slapstick/base/error.hpp"
#include "slapstick/sweep/basins.hpp"

namespace slapstick::sweep {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::int32_t basin_at(const Basins& basins, int ix, int iy) {
  return basins
      .of[static_cast<std::size_t>(iy) * static_cast<std::size_t>(basins.x.count) + static_cast<std::size_t>(ix)];
}

/// -sum p ln p of a box; NaN if a pixel belongs to no basin.
double entropy_of(const Basins& basins, int ix, int iy, int box) {
  std::map<std::int32_t, int> pixels;
  for (int dy = 0; dy < box; ++dy)
    for (int dx = 0; dx < box; ++dx) {
      const std::int32_t basin = basin_at(basins, ix + dx, iy + dy);
      if (basin < 0) return none;
      ++pixels[basin];
    }
  if (pixels.size() == 1) return 0.0;
  double entropy = 0.0;
  for (const auto& [basin, count] : pixels) {
    const double share = static_cast<double>(count) / (static_cast<double>(box) * box);
    entropy -= share * std::log(share);
  }
  return entropy;
}

}  // namespace

BasinEntropy basin_entropy(const Basins& basins, int box) {
  if (box < 2) throw InputError("basins: a box of the entropy needs two pixels a side at least");
  BasinEntropy found{.box = box};
  double sum = 0.0;
  for (int iy = 0; iy + box <= basins.y.count; iy += box)
    for (int ix = 0; ix + box <= basins.x.count; ix += box) {
      const double entropy = entropy_of(basins, ix, iy, box);
      if (std::isnan(entropy)) continue;
      ++found.boxes;
      found.on_boundary += entropy > 0.0 ? 1 : 0;
      sum += entropy;
    }
  found.whole = found.boxes > 0 ? sum / static_cast<double>(found.boxes) : none;
  found.boundary = found.on_boundary > 0 ? sum / static_cast<double>(found.on_boundary) : none;
  return found;
}

namespace {

/// A line of pixels: their basins, and how many changes of the basin lie before each. Those near the ends do not count.
struct Row {
  std::vector<std::int32_t> basin;
  std::vector<int> changes;
};

/// @param margin  pixels: changes nearer to an end are left out. Of all others every pair that they part is in the row
template <class BasinAt>
Row row_of(int count, int margin, const BasinAt& basin_of) {
  Row row;
  for (int k = 0; k < count; ++k) {
    row.basin.push_back(basin_of(k));
    const bool change = k > 0 && row.basin[static_cast<std::size_t>(k) - 1] != row.basin.back();
    const int before = row.changes.empty() ? 0 : row.changes.back();
    row.changes.push_back(before + (change && k >= margin && k <= count - margin ? 1 : 0));
  }
  return row;
}

/// Pairs of pixels so far apart that belong to different basins, with a change between them.
long parted(const Row& row, int distance) {
  long pairs = 0;
  for (std::size_t i = 0, j = static_cast<std::size_t>(distance); j < row.basin.size(); ++i, ++j)
    if (row.basin[i] >= 0 && row.basin[j] >= 0 && row.basin[i] != row.basin[j] && row.changes[i] != row.changes[j])
      ++pairs;
  return pairs;
}

/// Along both axes.
std::vector<Row> rows_of(const Basins& basins, int margin) {
  std::vector<Row> rows;
  for (int iy = 0; iy < basins.y.count; ++iy)
    rows.push_back(row_of(basins.x.count, margin, [&](int ix) { return basin_at(basins, ix, iy); }));
  for (int ix = 0; ix < basins.x.count; ++ix)
    rows.push_back(row_of(basins.y.count, margin, [&](int iy) { return basin_at(basins, ix, iy); }));
  return rows;
}

/// The slope of ln f over ln e by least squares, and its standard error.
void fit(Uncertainty& of) {
  of.exponent = of.error = none;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < of.distances.size(); ++i) {
    if (!(of.shares[i] > 0.0)) return;  // no boundary, or stripes of the grid's own step: no power of the distance
    x.push_back(std::log(of.distances[i]));
    y.push_back(std::log(of.shares[i]));
  }
  if (x.size() < 3) return;
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, left = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  of.exponent = xy / xx;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = y[i] - mean_y - of.exponent * (x[i] - mean_x);
    left += off * off;
  }
  of.error = std::sqrt(left / (n - 2.0) / xx);
}

}  // namespace

Uncertainty uncertainty(const Basins& basins) {
  constexpr int part = 8;  // the largest distance is at most so much of the shorter axis
  Uncertainty found;
  int most = 1;
  while (2 * most * part <= std::min(basins.x.count, basins.y.count)) most *= 2;
  const std::vector<Row> rows = rows_of(basins, most);
  for (int distance = 1; distance <= most; distance *= 2) {
    long uncertain = 0;
    for (const Row& row : rows) uncertain += parted(row, distance);
    found.distances.push_back(distance);
    found.shares.push_back(static_cast<double>(uncertain) / (2.0 * static_cast<double>(basins.of.size())));
  }
  fit(found);
  return found;
}

}  // namespace slapstick::sweep
