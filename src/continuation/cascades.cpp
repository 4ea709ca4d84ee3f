/// Which special points of a branch are the changes that gather at an onset of chatter.
#include <cmath>
#include <cstddef>

#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {
namespace {

/// The grazes on one side of an onset, from the nearest on, as long as each adds as many impacts and lies nearer to the
/// onset than the next.
std::vector<std::size_t> grazes_towards(const Branch& branch, std::size_t onset, std::ptrdiff_t step) {
  const auto impacts = [&](std::size_t i) { return branch.points[branch.special[i].after].impacts; };
  const auto away = [&](std::size_t i) { return std::abs(branch.special[i].value - branch.special[onset].value); };
  const auto count = static_cast<std::ptrdiff_t>(branch.special.size());
  std::vector<std::size_t> grazes;
  for (auto at = static_cast<std::ptrdiff_t>(onset) + step; at >= 0 && at < count; at += step) {
    const auto i = static_cast<std::size_t>(at);
    if (branch.special[i].type == SpecialType::CH) break;
    if (branch.special[i].type != SpecialType::GR) continue;
    if (!grazes.empty()) {
      const long added = impacts(grazes.back()) - impacts(i);
      const bool as_before = grazes.size() < 2 || added == impacts(grazes[0]) - impacts(grazes[1]);
      if (added < 1 || !as_before || away(i) <= away(grazes.back())) break;
    }
    grazes.push_back(i);
  }
  return grazes;
}

}  // namespace

std::vector<Cascade> cascades(const Branch& branch) {
  constexpr std::size_t fewest = 3;
  std::vector<Cascade> all;
  for (std::size_t onset = 0; onset < branch.special.size(); ++onset) {
    if (branch.special[onset].occurrence != Occurrence::onset) continue;
    for (const std::ptrdiff_t step : {-1, 1}) {
      const std::vector<std::size_t> grazes = grazes_towards(branch, onset, step);
      if (grazes.size() < fewest) continue;
      Cascade cascade{onset, std::min(grazes.front(), grazes.back()), std::max(grazes.front(), grazes.back()), 0,
                      branch.points[branch.special[grazes[0]].after].impacts -
                          branch.points[branch.special[grazes[1]].after].impacts};
      for (std::size_t i = cascade.first; i <= cascade.last; ++i)
        cascade.changes += changes_events(branch.special[i].type) ? 1 : 0;
      all.push_back(cascade);
    }
  }
  return all;
}

}  // namespace slapstick::orbit
