/// Follows the branches that begin at special points: each once, and one of each two that are images of one another.
#include <cmath>

#include "base/ranges.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {
namespace {

/// The orbit that Newton's method knows best: the most stable one, away from where branches meet.
const Orbit& best_known(const Branch& branch) {
  const auto largest = [](const Solution& point) {
    return point.multipliers.empty() ? 0.0 : std::abs(point.multipliers.front());
  };
  return ranges::min_element(branch.points, {}, largest)->orbit;
}

/// Is it on one of the branches, or the image of one?
bool is_known(const Problem& problem, const std::vector<Branch>& branches, const Orbit& orbit,
              std::vector<std::size_t>& images) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (lies_on(problem, branches[b], orbit)) return true;
    if (!image_lies_on(problem, branches[b], orbit)) continue;
    images.push_back(b);
    return true;
  }
  return false;
}

}  // namespace

bool follow_born(const Problem& problem, std::vector<Branch>& branches, const Orbit& born,
                 const ContinuationOptions& options, std::vector<std::size_t>& images) {
  if (born.parameter() < options.from || born.parameter() > options.to || is_known(problem, branches, born, images))
    return false;
  Branch branch = follow(problem, born, options);
  if (is_known(problem, branches, best_known(branch), images)) return false;
  branches.push_back(std::move(branch));
  return true;
}

}  // namespace slapstick::orbit
