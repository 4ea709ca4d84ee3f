#include "orbit/follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orbit/beyond.hpp"
#include "orbit/change_kind.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"
#include "orbit/hidden.hpp"
#include "orbit/lies_on.hpp"
#include "orbit/onset.hpp"
#include "orbit/record.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/special.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"

namespace slapstick::orbit {
namespace {

/// Has it a leg so short that what happens there is rounding? Those of a chatter's burst are always there.
bool is_all_but_gone(const Orbit& orbit) {
  constexpr double nothing = 1e-7;
  for (std::size_t leg = 0; leg < orbit.legs(); ++leg)
    if (!in_burst(orbit, leg) && orbit.duration(leg) < nothing * (orbit.t.back() - orbit.t.front())) return true;
  return false;
}

/// Does the parameter turn back there?
bool turns(const SpecialPoint& special) {
  return special.type == SpecialType::LP || special.outcome == "non-smooth fold";
}

/// Is there a model at a value of the parameter?
bool is_model(const Problem& problem, std::vector<double> values, double value) {
  values[0] = value;
  try {
    static_cast<void>(problem.family().model(values));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// A chatter with other last impacts, those that are all but rounding, is the one from which the branch comes.
bool is_chatter_as_it_came(const Problem& problem, const Orbit& before, const Reshaped& next) {
  constexpr double same = 1e-6;  // of a leg's state
  if (!next.folds || chatters(before) == 0 || chatters(next.point.orbit) == 0) return false;
  Orbit own = before;
  own.values = next.point.orbit.values;
  const std::optional<Orbit> there = refine(problem, own);
  return there && resembles(problem, *there, next.point.orbit, same);
}

}  // namespace

/// The first change. A point that is all but singular leads nowhere: the one before it may.
std::optional<Change> Follower::change_between(const PathPoint& at, const PathPoint& beyond, double length) const {
  std::optional<Change> change = find_change(problem_, at, beyond, length, range_);
  if (change || !has_before(at)) return change;
  const double both = arclength(problem_, before_->point, beyond.orbit);
  change = find_change(problem_, before_->point, beyond, both, range_);
  if (change) change->length = arclength(problem_, at, change->at.orbit);
  return change;
}

/// No change is found where there must be one: by a shorter step, or another way on. @returns false if the branch ends
bool Follower::look_nearer(PathPoint& at, double length, const std::string& why) {
  if (length > shortest_step()) {
    step_ = 0.25 * length;
    return true;
  }
  if (leave(at)) return !ended_;
  if (at_end(value(at), structure * range_, at)) {
    end("range", false);
    return false;
  }
  end("the motion has other events than the orbit behind " + problem_.family().names[0] + " = " + shown(value(at)) +
          " (" + why + ")",
      true);
  return false;
}

/// Is a place at the end of the range that the branch goes to, as far as it is known? What is beyond is not asked for, and may not exist, as a
/// negative damper.
bool Follower::at_end(double place, double error, const PathPoint& at) const {
  const double left = at.watched.turn > 0.0 ? options_.to - place : place - options_.from;
  return left <= exactly * range_ + error;
}

/// Between `at` and `beyond` the motion's events change. Notes the point and goes on with new ones. @returns false if the branch ends
bool Follower::change_events(PathPoint& at, const PathPoint& beyond, double length, const std::string& why) {
  std::optional<Change> change = change_between(at, beyond, length);
  if (!change || fades(at.orbit, change->test.leg)) return look_nearer(at, length, why);
  sharpen_death(problem_, branch_, has_before(at) ? before_->point : at, range_, *change);
  SpecialPoint& special = change->special;
  if (at_end(special.value, special.error, at)) {
    end("range", false);
    return false;
  }
  const bool arrived = back_to_ && !back_to_->onset && std::abs(special.value - back_to_->value) <= back_to_->error;
  if (!arrived && is_all_but_gone(at.orbit) && die_out(at, dies_out(branch_))) return !ended_;
  if (change->length > 0.0) add(beside_change(problem_, at, change->length, range_), branch_.points.size() - 1);
  if (ended_) return false;
  special.after = branch_.points.size() - 1;
  if (arrived) {
    arrive(std::move(special));
    return false;
  }
  // At a touch multipliers are infinite, or 0 / 0: those of the point before say more.
  special.solution.multipliers = branch_.points.back().multipliers;
  if (!options_.through_changes) return end_at(at, std::move(special), Beyond::not_followed);
  return pass(at, std::move(*change));
}

/// The orbits behind a change, and where a stable motion goes when there is none.
Follower::Found Follower::look_beyond(const PathPoint& at, const Change& change) const {
  Found found;
  found.next = reshape(problem_, at.orbit, change.at, change.test, range_, options_.stop);
  const auto of_family = [&](const Reshaped& next) { return one_of_family(problem_, next.point, range_); };
  found.family = std::erase_if(found.next, of_family) > 0;
  std::erase_if(found.next, [&](const Reshaped& next) { return is_chatter_as_it_came(problem_, at.orbit, next); });
  find_ways(change, found);
  return found;
}

/// Where the events of an orbit behind a change begin elsewhere, others lie between: it is followed back to the change. What does not come there, and does not
/// begin near it, is not born there.
void Follower::find_ways(const Change& change, Found& found) const {
  const auto place = [&](const Reshaped& next) {
    return Place{change.special.value, change.special.error + next.error + exactly * range_, false};
  };
  const auto apart = [&](const Reshaped& next) {
    return !next.onset && !next.renewed && next.apart > place(next).error;
  };
  std::stable_partition(found.next.begin(), found.next.end(), [&](const Reshaped& next) { return !apart(next); });
  if (!found.next.empty() && !back_to_ && apart(found.next.front()))
    for (std::size_t i = 0; i < found.next.size() && !found.way; ++i) {
      std::optional<Way> way = way_back(reversed(found.next[i].point), place(found.next[i]));
      if (!way) continue;
      found.way = std::move(way->branch);
      const bool turned = std::ranges::count_if(found.way->special, turns) % 2 != 0;
      const double away = found.next[i].point.watched.turn;
      found.next[i].folds = (turned ? -away : away) * change.at.watched.turn < 0.0;
      std::swap(found.next[0], found.next[i]);
    }
  const auto far = [&](const Reshaped& next) { return apart(next) && next.apart > same_change * range_; };
  found.next.erase(std::remove_if(found.next.begin() + (found.way ? 1 : 0), found.next.end(), far), found.next.end());
}

void Follower::run_beyond(const Change& change, Found& found) const {
  Behind there = behind(problem_, change.at, range_, options_.stop);
  found.left = there.what;
  found.family = there.family || (there.next && one_of_family(problem_, there.next->point, range_));
  if (there.next && !found.family) found.next.push_back(std::move(*there.next));
}

/// Does a change lead to where the branch has been? Near its end a cascade, whose folds and grazes are all but one, seems to: it turns back into itself or
/// goes on with an earlier orbit.
bool Follower::leads_back(const Found& found) const {
  return !found.none() && cascade_limit(branch_) && lies_on(problem_, branch_, found.next.front().point.orbit);
}

/// Goes on behind a change. @returns false if the branch ends
bool Follower::pass(PathPoint& at, Change change) {
  SpecialPoint special = std::move(change.special);
  Found found = look_beyond(at, change);
  if (leads_back(found) && end_cascade(at)) return !ended_;
  if (found.none() && !found.family && end_cascade_with(at, special)) return !ended_;
  if (found.none() && !found.family && branch_.points.back().stable()) run_beyond(change, found);
  if (found.none()) {
    if (!found.left.empty() && !found.family) return end_at(at, std::move(special), Beyond::jump, found.left);
    const bool family = found.family || begins_family(problem_, at.orbit, change.at, change.test);
    if (family && change.nearby) {
      change.nearby->multipliers = special.solution.multipliers;
      special.solution = std::move(*change.nearby);
      special.beside = true;
    }
    const bool departure = !family && departs(problem_, change.at, change.test, range_);
    return end_at(at, std::move(special), family ? Beyond::family : departure ? Beyond::departure : Beyond::unknown);
  }
  const auto repeated = [&](const Reshaped& next) {
    return becomes_shorter(problem_, at.orbit, next.point.orbit, 1e-6);
  };
  const bool shorter = std::erase_if(found.next, repeated) > 0;
  for (std::size_t i = shorter ? 0 : 1; i < found.next.size(); ++i) special.born.push_back(found.next[i].point.orbit);
  if (shorter) return end_at(at, std::move(special), Beyond::shorter);
  Reshaped& next = found.next.front();
  if (same_cycle(at.orbit, next.point.orbit) && !next.folds) {  // the motion beyond says that nothing changes
    restart(at, std::move(next.point));
    return !ended_;
  }
  if (lies_on_first(problem_, branch_.points.size(), branch_, next.point.orbit))
    return end_at(at, std::move(special), Beyond::retraced);
  if (next.onset && next.folds && turn_round(at)) return true;  // back to the chatter that it has just left
  if (!next.renewed && !next.onset && special.type != SpecialType::GR) {
    const Orbit& behind = found.way ? found.way->points.back().orbit : next.point.orbit;
    const ChangeOfEvents seen = orbit::change_between(special.solution.orbit, behind);
    special.type = seen.type;
    special.what = describe(change.test, at.orbit.shape, problem_.base());
    if (seen.type == SpecialType::SL)
      special.what += seen.sliding.empty() ? kind_of_sliding(change.test, at.orbit.shape) : seen.sliding;
  }
  go_on(at, std::move(special), std::move(next), std::move(found.way));
  return true;
}

/// The branch ends where its events change. @param left  what the motion goes over to in a jump. @returns false
bool Follower::end_at(const PathPoint& at, SpecialPoint special, Beyond beyond, const std::string& left) {
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
    case Beyond::departure:
      special.outcome = "jump";
      why = "a jump: to either side of it motions differ within a cycle, however near";
      break;
    case Beyond::not_followed:
      special.outcome = "not followed";
      why = "the events change";
      break;
    case Beyond::unknown:
      if (at_end(special.value, structure * range_, at)) {
        end("range", false);
        return false;
      }
      special.outcome = "none found";
      why = "no orbit was found beyond, a jump or a failure of the search";
  }
  end(std::string(name(special.type)) + " at " + shown(special.value) + ": " + why,
      beyond == Beyond::not_followed || beyond == Beyond::unknown);
  branch_.special.push_back(std::move(special));
  return false;
}

/// Where legs shrink to nothing together and steps lead no further: the place, by extrapolation, and what the motion does beyond.
/// @returns false if none shrinks
bool Follower::die_out(PathPoint& at, const std::optional<Death>& death) {
  if (!options_.through_changes) return false;
  if (!death || !is_model(problem_, at.orbit.values, death->value)) return false;
  if (at_end(death->value, death->error, at)) {
    end("range", false);
    return true;
  }
  SpecialPoint special;
  special.solution = branch_.points.back();
  special.beside = true;
  special.type = special.solution.sticking ? SpecialType::SL : SpecialType::CO;
  special.value = death->value;
  special.error = death->error;
  special.after = branch_.points.size() - 1;
  special.what =
      "the motion dies out: leg " + std::to_string(death->leg + 1) + " and others shrink to nothing together";
  const auto& tests = at.watched.tests;
  const auto length = [&](const TestValue& test) { return test.test == Test::duration && test.leg == death->leg; };
  special.test = static_cast<std::size_t>(std::ranges::find_if(tests, length) - tests.begin());
  PathPoint there = at;
  there.orbit.values[0] = death->value;
  std::vector<Reshaped> left = leavings(problem_, death->longest, there, tests[special.test], range_);
  std::erase_if(left, [&](const Reshaped& next) { return one_of_family(problem_, next.point, range_); });
  if (!left.empty()) {
    const ChangeOfEvents seen = orbit::change_between(special.solution.orbit, left.front().point.orbit);
    special.type = seen.type;
    go_on(at, std::move(special), std::move(left.front()), std::nullopt);
    return true;
  }
  Behind beyond;
  if (special.solution.stable()) beyond = behind(problem_, there, range_, options_.stop);
  if (beyond.next && !one_of_family(problem_, beyond.next->point, range_)) {
    special.outcome = "persistence";
    branch_.special.push_back(std::move(special));
    restart(at, std::move(beyond.next->point));
  } else {
    const bool jump = !beyond.family && !beyond.what.empty();
    end_at(at, std::move(special), beyond.family ? Beyond::family : jump ? Beyond::jump : Beyond::unknown, beyond.what);
  }
  return true;
}

/// From a first point at which the model itself has another structure than beside it, as with a damper of exactly zero: the orbit beside it.
bool Follower::leave_edge(PathPoint& at) {
  if (branch_.points.size() > 1 || !branch_.points.front().stable()) return false;
  Behind beyond = behind(problem_, at, range_, options_.stop);
  if (!beyond.next || one_of_family(problem_, beyond.next->point, range_)) return false;
  restart(at, std::move(beyond.next->point));
  return true;
}

/// Where no step leads on and no change is found: an end that is known, or a way on. @returns false if there is none
bool Follower::leave(PathPoint& at) {
  return leave_edge(at) || leave_chatter(at) || turn_round(at) || clear_onset(at) || end_cascade(at) ||
         die_out(at, dies_out(problem_, branch_, at, range_));
}

/// Goes on from an orbit that the branch has.
void Follower::set_out(PathPoint& at, PathPoint from) {
  at = std::move(from);
  before_.reset();
  step_ = std::min(step_, options_.step);
}

/// Goes on from another orbit, if that is not outside the range.
void Follower::restart(PathPoint& at, PathPoint from) {
  if (!inside(value(from))) return end("range", false);
  at = std::move(from);
  branch_.points.push_back(solution_of(at, nullptr));
  step_ = options_.step;
}

/// The branch goes on behind a change, with new events.
/// @param between  followed back from there to the change, if other changes lie between
void Follower::go_on(PathPoint& at, SpecialPoint special, Reshaped next, std::optional<Branch> between) {
  special.outcome = next.folds ? "non-smooth fold" : "persistence";
  Solution first = solution_of(next.point, nullptr);
  const bool begins = chatters(next.point.orbit) > chatters(special.solution.orbit);
  if (next.onset && next.onset->release && begins) {
    special.type = SpecialType::CH;
    special.what += ", and a complete chatter begins";
    branch_.special.push_back(std::move(special));
  } else if (next.onset) {
    SpecialPoint here = onset(*next.onset, special.solution);
    here.outcome = std::exchange(special.outcome, "one of infinitely many changes");
    if (begins) branch_.special.push_back(special);
    if (begins && back_to_ && back_to_->onset) return arrive(std::move(here));
    if (!begins && !next.onset->release && enter_cascade(at, here, next.point)) return;
    add_here(std::move(here));
    if (!begins) branch_.special.push_back(std::move(special));
  } else if (!next.renewed) {
    branch_.special.push_back(std::move(special));
    if (between) {
      add_between(std::move(*between));
      return set_out(at, std::move(next.point));
    }
    if (next.length > 0.0)
      add(beside_change(problem_, reversed(next.point), next.length, range_), branch_.points.size() - 1);
    if (ended_) return;
  }
  if (!inside(value(next.point))) return end("range", false);
  at = std::move(next.point);
  branch_.points.push_back(std::move(first));
  step_ = std::min(step_, options_.step);
}

}  // namespace slapstick::orbit
