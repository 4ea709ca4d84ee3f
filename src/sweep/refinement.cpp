/// Divides the cells of a grid of pixels where kinds differ.
#include "sweep/refinement.hpp"

#include <algorithm>

#include "base/ranges.hpp"

namespace slapstick::sweep {

Refinement::Refinement(int columns, int rows, int cell)
    : columns_(columns), kinds_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), unknown) {
  const std::vector<Interval> across = intervals(columns, cell);
  for (const Interval& y : intervals(rows, cell))
    for (const Interval& x : across) cells_.push_back({x, y});
}

std::vector<Refinement::Interval> Refinement::intervals(int count, int cell) {
  if (count == 1) return {{0, 0}};
  std::vector<Interval> all;
  for (int begin = 0; begin < count - 1; begin += cell) all.push_back({begin, std::min(begin + cell, count - 1)});
  return all;
}

std::vector<Refinement::Interval> Refinement::halves(const Interval& whole) {
  if (whole.end - whole.begin < 2) return {whole};
  const std::int32_t middle = whole.begin + (whole.end - whole.begin) / 2;
  return {{whole.begin, middle}, {middle, whole.end}};
}

bool Refinement::may_be_divided(const Cell& cell) const {
  return cell.x.end - cell.x.begin > 1 || cell.y.end - cell.y.begin > 1;
}

/// Inside of the rim of a cell that is whole no pixel is computed.
bool Refinement::is_mixed(const Cell& cell) const {
  const std::int32_t kind = kinds_[static_cast<std::size_t>(at(cell.x.begin, cell.y.begin))];
  const auto differs = [&](std::int32_t x, std::int32_t y) {
    const std::int32_t other = kinds_[static_cast<std::size_t>(at(x, y))];
    return other != unknown && other != kind;
  };
  for (std::int32_t x = cell.x.begin; x <= cell.x.end; ++x)
    if (differs(x, cell.y.begin) || differs(x, cell.y.end)) return true;
  for (std::int32_t y = cell.y.begin; y <= cell.y.end; ++y)
    if (differs(cell.x.begin, y) || differs(cell.x.end, y)) return true;
  return false;
}

void Refinement::demand_corners(const Cell& cell, std::vector<std::int32_t>& wanted) {
  for (const std::int32_t y : {cell.y.begin, cell.y.end}) {
    for (const std::int32_t x : {cell.x.begin, cell.x.end}) {
      std::int32_t& kind = kinds_[static_cast<std::size_t>(at(x, y))];
      if (kind == unknown) wanted.push_back(at(x, y));
      if (kind == unknown) kind = asked;
    }
  }
}

std::vector<std::int32_t> Refinement::wanted() {
  std::vector<std::int32_t> wanted;
  if (!begun_) {
    begun_ = true;
    for (const Cell& cell : cells_) demand_corners(cell, wanted);
    ranges::sort(wanted);
    return wanted;
  }
  // A division may ask for pixels that are known from a neighbour: then the next division follows at once.
  while (wanted.empty()) {
    std::vector<Cell> next, divided;
    for (const Cell& cell : cells_) (may_be_divided(cell) && is_mixed(cell) ? divided : next).push_back(cell);
    if (divided.empty()) break;
    for (const Cell& cell : divided)
      for (const Interval& y : halves(cell.y))
        for (const Interval& x : halves(cell.x)) {
          next.push_back({x, y});
          demand_corners(next.back(), wanted);
        }
    cells_ = std::move(next);
  }
  ranges::sort(wanted);
  return wanted;
}

std::vector<std::int32_t> Refinement::sources() const {
  std::vector<std::int32_t> sources(kinds_.size());
  for (const Cell& cell : cells_)
    for (std::int32_t y = cell.y.begin; y <= cell.y.end; ++y)
      for (std::int32_t x = cell.x.begin; x <= cell.x.end; ++x) {
        const auto place = static_cast<std::size_t>(at(x, y));
        sources[place] = kinds_[place] >= 0 ? at(x, y) : at(cell.x.begin, cell.y.begin);
      }
  return sources;
}

}  // namespace slapstick::sweep
