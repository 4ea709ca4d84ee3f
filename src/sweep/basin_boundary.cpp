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

/// Pairs of pixels at a distance along one axis, and those of two basins.
struct Pairs {
  long all = 0, differ = 0;

  void add(std::int32_t a, std::int32_t b) {
    if (a < 0 || b < 0) return;
    ++all;
    differ += a != b ? 1 : 0;
  }
};

/// @param margin  so many pixels at the end of each axis begin no pair: the same pixels begin those of all distances
Pairs pairs_at(const Basins& basins, int distance, int margin) {
  Pairs pairs;
  for (int iy = 0; iy < basins.y.count; ++iy)
    for (int ix = 0; ix < basins.x.count; ++ix) {
      const std::int32_t here = basin_at(basins, ix, iy);
      if (ix + margin < basins.x.count) pairs.add(here, basin_at(basins, ix + distance, iy));
      if (iy + margin < basins.y.count) pairs.add(here, basin_at(basins, ix, iy + distance));
    }
  return pairs;
}

/// The slope of ln f over ln e by least squares, and its standard error.
void fit(Uncertainty& of) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < of.distances.size(); ++i) {
    if (!(of.shares[i] > 0.0)) continue;
    x.push_back(std::log(of.distances[i]));
    y.push_back(std::log(of.shares[i]));
  }
  of.exponent = of.error = none;
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
  const int most = std::min(basins.x.count, basins.y.count) / part;
  int margin = 1;
  while (2 * margin <= most) margin *= 2;
  for (int distance = 1; distance <= std::max(most, 1) && distance <= margin; distance *= 2) {
    const Pairs pairs = pairs_at(basins, distance, margin);
    if (pairs.all == 0) continue;
    found.distances.push_back(distance);
    found.shares.push_back(static_cast<double>(pairs.differ) / static_cast<double>(pairs.all));
  }
  fit(found);
  return found;
}

}  // namespace slapstick::sweep
