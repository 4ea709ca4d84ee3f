#include "orbit/onset.hpp"

#include <array>
#include <cmath>

namespace slapstick::orbit {

SpecialPoint onset(const Between& between, const Solution& nearest) {
  SpecialPoint special;
  special.type = SpecialType::CH;
  special.value = 0.5 * (between.from + between.to);
  special.error = std::abs(between.to - between.from);
  special.solution = nearest;
  special.what = between.release ? "a contact that has rested lets go, into a complete chatter"
                                 : "infinitely many changes gather at the onset of a complete chatter";
  return special;
}

std::optional<CascadeLimit> cascade_limit(const Branch& branch) {
  constexpr std::size_t used = 4;
  constexpr double slowest = 0.95, alike = 0.1;  // of the ratios of neighbouring distances
  std::array<double, used> places{};
  std::array<long, used> impacts{};
  std::size_t count = 0;
  for (auto special = branch.special.rbegin(); special != branch.special.rend() && count < used; ++special) {
    if (special->type != SpecialType::GR) continue;
    places[count] = special->value;
    impacts[count++] = branch.points[special->after].impacts;
  }
  if (count < used) return std::nullopt;
  for (std::size_t i = 0; i + 1 < used; ++i)
    if (impacts[i] != impacts[i + 1] + 1) return std::nullopt;
  const auto distance = [&](std::size_t i) { return places[i] - places[i + 1]; };
  const double ratio = distance(0) / distance(1), before = distance(1) / distance(2);
  if (!(ratio > 0.0 && ratio < slowest) || std::abs(ratio - before) > alike) return std::nullopt;
  const auto limit = [&](std::size_t i, double q) { return places[i] + distance(i) * q / (1.0 - q); };
  return CascadeLimit{limit(0, ratio), std::abs(limit(0, ratio) - limit(1, before)), ratio};
}

bool chatter_lengthens(const Branch& branch) {
  constexpr double much = 1.2;
  std::size_t first = branch.points.size();
  while (first > 0 && branch.points[first - 1].chatter) --first;
  if (first == branch.points.size()) return false;
  return static_cast<double>(branch.points.back().orbit.legs()) >=
         much * static_cast<double>(branch.points[first].orbit.legs());
}

}  // namespace slapstick::orbit
