/// What lies beyond a change of events, from the orbits that are found there and the motions that are run there.
#include "change/unfold.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "change/jump.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"
#include "orbit/kept.hpp"
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

/// What rests all along and comes to a limit: its displacement in a contact state, and the way between its limits in
/// the units of the margin. The displacement is -1 where nothing does.
struct AtLimit {
  Eigen::Index displacement = -1;
  double between = 0.0;
  bool slider = false;
};

AtLimit at_limit(const Problem& problem, const TestValue& test) {
  if (test.test != Test::guard) return {};
  const mode::Frame& frame = problem.base().compiled().frame();
  const auto contact = static_cast<std::size_t>(test.contact);
  if (mode::of_corner(test.kind))
    if (const mode::SliderRow* slider = frame.slider(test.contact))
      return {slider->own, slider->high - slider->low, true};
  if (test.kind != mode::GuardKind::stick_above && test.kind != mode::GuardKind::stick_below) return {};
  const FrictionContact& friction = problem.base().model().frictions[contact];
  if (!may_be_drawn_along(friction)) return {};
  return {frame.frictions[contact].own, 2.0 * friction.static_friction, false};
}

/// Does a slider or a body that rests all along come to one of its limits? Beyond, it is drawn along: the orbits there
/// are of a family, and in each it rests elsewhere. At both limits it begins to slip.
bool is_drawn_along(const Problem& problem, const Change& change, bool slider) {
  // Of the way between the limits: far above what locating a change leaves. More would take a slider that is drawn
  // along for one that slips.
  constexpr double off_limit = 1e-6;
  const TestValue& at = change.test;
  const AtLimit limit = at_limit(problem, at);
  if (limit.displacement < 0 || limit.slider != slider) return false;
  if (!keeps(problem, change.at.watched.kept, limit.displacement)) return false;
  return ranges::none_of(change.at.watched.tests, [&](const TestValue& test) {
    const bool other = test.contact == at.contact && test.kind != at.kind &&
                       at_limit(problem, test).displacement == limit.displacement;
    return other && test.value <= off_limit * limit.between;
  });
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
  } else if (is_drawn_along(problem, change, false)) {
    found.passage = Passage::family;
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
  if (change.special.death) branches = branches_at(problem, change.at, {change.special.death->orbit}, options.range);
  if (branches.empty())
    branches = find_branches_beyond(problem, before, change.at, change.test, options.range, options.stop);
  const auto of_family = [&](const HalfBranch& next) {
    return one_of_family(problem, change.at, next.point, options.range);
  };
  bool family = std::erase_if(branches, of_family) > 0;
  std::erase_if(branches, [&](const HalfBranch& next) { return is_chatter_as_it_came(problem, before, next); });
  keep_born(change, options, branches);
  // A symmetric branch goes on with symmetric orbits; others are born there.
  const auto breaks = [&](const HalfBranch& next) { return breaks_symmetry(problem, next.point.orbit, before); };
  std::stable_partition(branches.begin(), branches.end(), [&](const HalfBranch& next) { return !breaks(next); });
  const bool own = !branches.empty() && !breaks(branches.front());
  if (!own && is_drawn_along(problem, change, true)) {
    found.passage = Passage::family;
    return found;
  }
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
                  : rests_more(change.at, next.point)    ? Passage::family
                  : same_cycle(before, next.point.orbit) ? Passage::same_events
                                                         : Passage::persistence;
  return found;
}

}  // namespace slapstick::orbit
