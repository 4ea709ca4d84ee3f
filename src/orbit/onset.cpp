#include "orbit/onset.hpp"

#include <cmath>
#include <vector>

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

namespace {

constexpr std::size_t used = 4;  ///< changes of a cascade from which its limit is taken

/// From the nearest grazes, in which each adds an impact to the next one's; between equal stops one at each. Empty if they are no cascade.
std::optional<CascadeLimit> limit_of(const Branch& branch, const std::vector<const SpecialPoint*>& grazes) {
  constexpr double slowest = 0.95, alike = 0.1;  // of the ratios of neighbouring distances
  constexpr double known = 0.5;                  // of the last of them
  if (grazes.size() < used) return std::nullopt;
  const auto impacts = [&](std::size_t i) { return branch.points[grazes[i]->after].impacts; };
  const long added = impacts(0) - impacts(1);
  for (std::size_t i = 0; i + 1 < used; ++i)
    if (added < 1 || impacts(i) - impacts(i + 1) != added) return std::nullopt;
  const auto distance = [&](std::size_t i) { return grazes[i]->value - grazes[i + 1]->value; };
  const double ratio = distance(0) / distance(1), before = distance(1) / distance(2);
  if (!(ratio > 0.0 && ratio < slowest) || std::abs(ratio - before) > alike) return std::nullopt;
  const auto limit = [&](std::size_t i, double q) { return grazes[i]->value + distance(i) * q / (1.0 - q); };
  const CascadeLimit found{limit(0, ratio), std::abs(limit(0, ratio) - limit(1, before)), ratio,
                           std::abs(limit(0, ratio) - grazes[1]->value)};
  return found.error < known * std::abs(distance(0)) ? std::optional(found) : std::nullopt;
}

/// The first grazes of a range of special points.
template <class Iterator>
std::vector<const SpecialPoint*> grazes_of(Iterator point, Iterator end) {
  std::vector<const SpecialPoint*> grazes;
  for (; point != end && grazes.size() < used; ++point)
    if (point->type == SpecialType::GR) grazes.push_back(&*point);
  return grazes;
}

}  // namespace

std::optional<CascadeLimit> cascade_limit(const Branch& branch) {
  return limit_of(branch, grazes_of(branch.special.rbegin(), branch.special.rend()));
}

void sharpen_onsets(Branch& branch) {
  for (auto onset = branch.special.begin(); onset != branch.special.end(); ++onset) {
    if (onset->type != SpecialType::CH) continue;
    const auto limit = limit_of(branch, grazes_of(onset, branch.special.end()));
    if (!limit || limit->error >= onset->error || std::abs(limit->value - onset->value) > 10.0 * onset->error) continue;
    onset->value = limit->value;
    onset->error = limit->error;
  }
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
