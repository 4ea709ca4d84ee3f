#include "orbit/follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orbit/hidden.hpp"
#include "orbit/lies_on.hpp"
#include "orbit/onset.hpp"
#include "orbit/special.hpp"
#include "slapstick/base/text.hpp"

namespace slapstick::orbit {

/// Between `at` and `beyond` the motion's events change. Notes the point and goes on with new ones. @returns false if the branch ends
bool Follower::change_events(PathPoint& at, const PathPoint& beyond, double length, const std::string& why) {
  std::optional<Change> change = find_change(problem_, at, beyond, length, range_);
  if (!change || fades(at.orbit, change->test.leg)) {
    if (length > shortest_step()) {
      step_ = 0.25 * length;
      return true;
    }
    if (leave_chatter(at) || turn_round(at) || end_cascade(at)) return !ended_;
    end("the motion has other events than the orbit behind " + problem_.family().names[0] + " = " + shown(value(at)) +
            " (" + why + ")",
        true);
    return false;
  }
  add(beside_change(problem_, at, change->length, range_), branch_.points.size() - 1);
  if (ended_) return false;
  SpecialPoint special = std::move(change->special);
  special.after = branch_.points.size() - 1;
  // At a touch multipliers are infinite, or 0 / 0: those of the point before say more.
  special.solution.multipliers = branch_.points.back().multipliers;
  if (!options_.through_changes) return end_at(std::move(special), Beyond::not_followed);
  std::vector<Reshaped> found = reshape(problem_, at.orbit, change->at, change->test, range_, options_.stop);
  if (found.empty() && end_cascade_with(at, special)) return !ended_;
  std::string left;  // where a stable motion goes when there is no branch
  if (found.empty() && branch_.points.back().stable()) {
    Behind there = behind(problem_, at.orbit, change->at, range_, options_.stop);
    left = there.what;
    if (there.next) found.push_back(std::move(*there.next));
  }
  if (found.empty() && !left.empty()) return end_at(std::move(special), Beyond::jump, left);
  if (found.empty()) {
    const bool family = begins_family(problem_, at.orbit, change->at, change->test);
    return end_at(std::move(special), family ? Beyond::family : Beyond::unknown);
  }
  const auto repeated = [](const Reshaped& next) { return repeats(next.point.orbit, 1e-6).has_value(); };
  if (std::ranges::any_of(found, repeated)) return end_at(std::move(special), Beyond::shorter);
  if (lies_on_first(branch_.points.size(), branch_, found.front().point.orbit))
    return end_at(std::move(special), Beyond::retraced);
  for (std::size_t i = 1; i < found.size(); ++i) special.born.push_back(found[i].point.orbit);
  go_on(at, std::move(special), std::move(found.front()));
  return true;
}

/// The branch ends where its events change. @param left  what the motion goes over to in a jump. @returns false
bool Follower::end_at(SpecialPoint special, Beyond beyond, const std::string& left) {
  std::string why;
  switch (beyond) {
    case Beyond::shorter:
      special.outcome = why = "from there on it is a shorter orbit, run through more than once";
      break;
    case Beyond::retraced:
      special.outcome = "the branch as it came";
      why = "from there on the branch runs back over itself";
      break;
    case Beyond::family:
      special.outcome = why = "from there on it is one of a family";
      break;
    case Beyond::jump:
      special.outcome = "jump to " + left;
      why = "a jump: the motion goes over to " + left;
      break;
    case Beyond::not_followed:
      special.outcome = "not followed";
      why = "the events change";
      break;
    case Beyond::unknown:
      special.outcome = "none found";
      why = "no orbit was found beyond, a jump or a failure of the search";
  }
  end(std::string(name(special.type)) + " at " + shown(special.value) + ": " + why,
      beyond == Beyond::not_followed || beyond == Beyond::unknown);
  branch_.special.push_back(std::move(special));
  return false;
}

/// Near its onset a chatter's equations, of ever more impacts, are hardly solvable. Looks for the orbits behind the onset; where none is found, the
/// branch ends at the onset. @returns false if it is none
bool Follower::leave_chatter(PathPoint& at) {
  const std::size_t count = branch_.points.size();
  if (!options_.through_changes || count < 2 || !branch_.points.back().chatter) return false;
  constexpr double clear = 1e-4;  // nearer to the onset impacts are too many and too short to be followed
  const Orbit& before = branch_.points[count - 2].orbit;
  std::vector<Reshaped> found = reshape(problem_, before, at, TestValue{}, range_, options_.stop, clear);
  std::erase_if(found, [](const Reshaped& next) { return !next.gathering || next.folds; });
  if (found.empty() && !chatter_lengthens(branch_)) return false;
  const double reach = shortest_step() * range_;
  add_onset(onset({value(at) - reach, value(at) + reach}, branch_.points.back()),
            found.empty() ? "the branch ends" : "persistence");
  if (!found.empty()) {
    restart(at, std::move(found.front().point));
    onset_ = Onset{reversed(at), branch_.points.size(), branch_.special.size()};
  } else {
    end("CH at " + shown(value(at)) + ": the complete chatter begins there, from orbits with ever more impacts", false);
  }
  return true;
}

/// Behind the onset of a chatter one direction leads on, the other back towards the onset, through ever more impacts. @returns false if it was not that
bool Follower::turn_round(PathPoint& at) {
  constexpr double near = 1e-3;  // of the range
  if (!onset_ || branch_.points.back().chatter ||
      std::abs(value(at) - onset_->other_way.orbit.values[0]) > near * range_)
    return false;
  at = std::move(onset_->other_way);
  branch_.points.resize(onset_->points);
  branch_.special.resize(onset_->special);
  onset_.reset();
  before_.reset();
  step_ = options_.step;
  return true;
}

/// Where the impacts of a cascade have become too short to be followed: its limit, and the complete chatter beyond.
/// @returns false if this is no cascade
bool Follower::end_cascade(PathPoint& at) {
  constexpr double near = 0.02;  // of the range, from the last point to the limit
  if (!options_.through_changes || branch_.points.back().chatter) return false;
  const std::optional<CascadeLimit> limit = cascade_limit(branch_);
  if (!limit || std::abs(limit->value - value(at)) > near * range_) return false;
  SpecialPoint special = onset({limit->value, limit->value}, branch_.points.back());
  special.error = limit->error;
  special.what += " (a cascade, ratio " + shown(std::round(1e4 * limit->ratio) / 1e4) + ")";
  std::optional<Reshaped> next = beyond_cascade(problem_, at, limit->value, range_, options_.stop);
  if (next && lies_on(problem_, branch_, next->point.orbit)) next.reset();
  add_onset(std::move(special), next ? "persistence" : "the branch ends");
  if (next)
    restart(at, std::move(next->point));
  else
    end("CH at " + shown(limit->value) + ": a cascade, which gathers there", false);
  return true;
}

/// The same where the cascade's next change is known, but not what lies behind it.
bool Follower::end_cascade_with(PathPoint& at, SpecialPoint last) {
  last.outcome = "one of infinitely many changes";
  branch_.special.push_back(std::move(last));
  if (end_cascade(at)) return true;
  branch_.special.pop_back();
  return false;
}

void Follower::add_onset(SpecialPoint special, const std::string& outcome) {
  special.outcome = outcome;
  special.after = branch_.points.size() - 1;
  branch_.special.push_back(std::move(special));
}

void Follower::restart(PathPoint& at, PathPoint from) {
  at = std::move(from);
  branch_.points.push_back(solution_of(at, nullptr));
  step_ = options_.step;
}

/// The branch goes on behind a change, with new events.
void Follower::go_on(PathPoint& at, SpecialPoint special, Reshaped next) {
  special.outcome = next.folds ? "non-smooth fold" : "persistence";
  Solution first = solution_of(next.point, nullptr);
  if (next.gathering) {
    SpecialPoint here = onset(*next.gathering, special.solution);
    const std::string outcome = std::exchange(special.outcome, "one of infinitely many changes");
    if (first.chatter) branch_.special.push_back(special);
    add_onset(std::move(here), outcome);
    if (!first.chatter) branch_.special.push_back(std::move(special));
  } else if (!next.renewed) {
    branch_.special.push_back(std::move(special));
    if (next.length > 0.0)
      add(beside_change(problem_, reversed(next.point), next.length, range_), branch_.points.size() - 1);
    if (ended_) return;
  }
  at = std::move(next.point);
  branch_.points.push_back(std::move(first));
  step_ = std::min(step_, options_.step);
}

}  // namespace slapstick::orbit
