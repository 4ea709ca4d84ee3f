/// What lies beyond a change of events, from the orbits that are found there and the motions that are run there.
#include "change/unfold.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "change/jump.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/short_legs.hpp"

namespace slapstick::orbit {
namespace {

/// Two orbits whose chatters differ only in impacts of the size of rounding are the same orbit: the one from which the
/// branch comes.
bool is_chatter_as_it_came(const Problem& problem, const Orbit& before, const HalfBranch& next) {
  constexpr double same_burst = 1e-6;  // of a leg's state
  if (!next.folds || chatters(before) == 0 || chatters(next.point.orbit) == 0) return false;
  Orbit own = before;
  own.values = next.point.orbit.values;
  const std::optional<Orbit> there = refine(problem, own);
  return there && resembles(problem, *there, next.point.orbit, same_burst);
}

/// Of orbits whose events begin away from the change one that is led back to the change comes first. The others are not
/// born there.
void keep_born(const Change& change, const UnfoldOptions& options, std::vector<HalfBranch>& found) {
  const auto error = [&](const HalfBranch& next) {
    return change.special.error + next.error + place_tolerance * options.range;
  };
  // A place that is known worse than `most` may be none. Where no orbit begins at a better one, it is led back to it.
  double most = same_change * options.range;
  const auto apart = [&](const HalfBranch& next) {
    return !next.onset && !next.renewed && next.distance_from_change > std::min(error(next), most);
  };
  if (!options.lead_back || !ranges::all_of(found, apart)) most = INFINITY;
  std::stable_partition(found.begin(), found.end(), [&](const HalfBranch& next) { return !apart(next); });
  std::size_t led = 0;
  if (!found.empty() && options.lead_back && apart(found.front()))
    for (std::size_t i = 0; i < found.size() && led == 0; ++i) {
      const std::optional<bool> folds = options.lead_back(found[i], error(found[i]));
      if (!folds) continue;
      found[i].folds = *folds;
      std::swap(found[0], found[i]);
      led = 1;
    }
  const auto far = [&](const HalfBranch& next) {
    return apart(next) && next.distance_from_change > same_change * options.range;
  };
  found.erase(std::remove_if(found.begin() + static_cast<std::ptrdiff_t>(led), found.end(), far), found.end());
}

/// No orbit begins there.
void explain(const Problem& problem, const Orbit& before, const Change& change, double range, bool family,
             Unfolding& found) {
  if (found.jump && !family) {
    found.passage = Passage::jump;
  } else if (family || begins_family(problem, before, change.at, change.test)) {
    found.passage = Passage::family;
    found.jump.reset();
  } else if (departs(problem, change.at, change.test, range)) {
    found.passage = Passage::jump;
    found.jump = Jump{Jump::Kind::departs, {}, 0};
  }
}

}  // namespace

void find_met(const Problem& problem, const Orbit& before, Unfolding& found) {
  constexpr double newton_rounding = 1e-6;  // of orbits that Newton's method gave
  const auto ends_in = [&](const HalfBranch& next) {
    const Orbit& orbit = next.point.orbit;
    const bool shorter = times_over(problem, orbit, newton_rounding) > times_over(problem, before, newton_rounding);
    if (!shorter && !breaks_symmetry(problem, before, orbit)) return false;
    found.passage = shorter ? Passage::merges : Passage::symmetric;
    found.others.push_back(once(problem, orbit, newton_rounding));
    return true;
  };
  std::erase_if(found.branches, ends_in);
}

Unfolding unfold(const Problem& problem, const Orbit& before, const Change& change, const UnfoldOptions& options) {
  Unfolding found;
  std::vector<HalfBranch>& branches = found.branches;
  branches = find_branches_beyond(problem, before, change.at, change.test, options.range, options.stop);
  const auto of_family = [&](const HalfBranch& next) { return one_of_family(problem, next.point, options.range); };
  bool family = std::erase_if(branches, of_family) > 0;
  std::erase_if(branches, [&](const HalfBranch& next) { return is_chatter_as_it_came(problem, before, next); });
  keep_born(change, options, branches);
  // A symmetric branch goes on with symmetric orbits; others are born there.
  const auto breaks = [&](const HalfBranch& next) { return breaks_symmetry(problem, next.point.orbit, before); };
  std::stable_partition(branches.begin(), branches.end(), [&](const HalfBranch& next) { return !breaks(next); });
  const bool own = !branches.empty() && !breaks(branches.front());
  if (!own && !family && options.simulate) {
    MotionBeyond motion = run_beyond(problem, change.at, options.range, options.stop);
    found.jump = std::move(motion.jump);
    family = motion.family || (motion.next && of_family(*motion.next));
    if (motion.next && !family && (branches.empty() || !breaks(*motion.next)))
      branches.insert(branches.begin(), std::move(*motion.next));
  }
  find_met(problem, before, found);
  if (!found.others.empty()) return found;
  if (found.jump && !family && !branches.empty()) {
    // Orbits some way off, from where they can be followed: right beside a graze Newton's method leads nowhere.
    std::vector<HalfBranch> farther =
        find_branches_beyond(problem, before, change.at, change.test, options.range, options.stop, 1e3 * same_change);
    for (HalfBranch& next : farther.empty() ? branches : farther) found.others.push_back(std::move(next.point.orbit));
    branches.clear();
  }
  if (branches.empty()) {
    explain(problem, before, change, options.range, family, found);
    return found;
  }
  const HalfBranch& next = branches.front();
  found.passage = next.folds                             ? Passage::fold
                  : same_cycle(before, next.point.orbit) ? Passage::same_events
                                                         : Passage::persistence;
  return found;
}

}  // namespace slapstick::orbit
