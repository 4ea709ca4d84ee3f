#include "orbit/follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orbit/beyond.hpp"
#include "orbit/dying.hpp"
#include "orbit/extent.hpp"
#include "orbit/hidden.hpp"
#include "orbit/lies_on.hpp"
#include "orbit/onset.hpp"
#include "orbit/record.hpp"
#include "orbit/special.hpp"
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

}  // namespace

/// The first change. A point that is all but singular leads nowhere: the one before it may.
std::optional<Change> Follower::change_between(const PathPoint& at, const PathPoint& beyond, double length) const {
  std::optional<Change> change = find_change(problem_, at, beyond, length, range_);
  if (change || !before_ || !(before_->point.orbit.shape.legs == at.orbit.shape.legs)) return change;
  change = find_change(problem_, before_->point, beyond, before_->length + length, range_);
  if (change) change->length -= before_->length;
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
  constexpr double exactly = 1e-10;  // of the range
  const double left = at.watched.turn > 0.0 ? options_.to - place : place - options_.from;
  return left <= exactly * range_ + error;
}

/// Between `at` and `beyond` the motion's events change. Notes the point and goes on with new ones. @returns false if the branch ends
bool Follower::change_events(PathPoint& at, const PathPoint& beyond, double length, const std::string& why) {
  std::optional<Change> change = change_between(at, beyond, length);
  if (!change || fades(at.orbit, change->test.leg)) return look_nearer(at, length, why);
  if (at_end(change->special.value, change->special.error, at)) {
    end("range", false);
    return false;
  }
  if (is_all_but_gone(at.orbit) && die_out(at)) return !ended_;
  if (change->length > 0.0) add(beside_change(problem_, at, change->length, range_), branch_.points.size() - 1);
  if (ended_) return false;
  SpecialPoint special = std::move(change->special);
  special.after = branch_.points.size() - 1;
  // At a touch multipliers are infinite, or 0 / 0: those of the point before say more.
  special.solution.multipliers = branch_.points.back().multipliers;
  if (!options_.through_changes) return end_at(std::move(special), Beyond::not_followed);
  std::vector<Reshaped> found = reshape(problem_, at.orbit, change->at, change->test, range_, options_.stop);
  const auto of_family = [&](const Reshaped& next) { return one_of_family(problem_, next.point, range_); };
  bool family = std::erase_if(found, of_family) > 0;
  if (found.empty() && !family && end_cascade_with(at, special)) return !ended_;
  std::string left;  // where a stable motion goes when there is no branch
  if (found.empty() && !family && branch_.points.back().stable()) {
    Behind there = behind(problem_, change->at, range_, options_.stop);
    left = there.what;
    family = there.family || (there.next && of_family(*there.next));
    if (there.next && !family) found.push_back(std::move(*there.next));
  }
  if (found.empty() && !left.empty() && !family) return end_at(std::move(special), Beyond::jump, left);
  if (found.empty()) {
    family = family || begins_family(problem_, at.orbit, change->at, change->test);
    if (!family && departs(problem_, change->at, change->test, range_))
      return end_at(std::move(special), Beyond::departure);
    return end_at(std::move(special), family ? Beyond::family : Beyond::unknown);
  }
  const auto repeated = [&](const Reshaped& next) {
    return becomes_shorter(problem_, at.orbit, next.point.orbit, 1e-6);
  };
  if (std::ranges::any_of(found, repeated)) return end_at(std::move(special), Beyond::shorter);
  if (lies_on_first(problem_, branch_.points.size(), branch_, found.front().point.orbit))
    return end_at(std::move(special), Beyond::retraced);
  if (found.front().onset && found.front().folds && turn_round(at))
    return true;  // back to the chatter that it has just left
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
    case Beyond::departure:
      special.outcome = "jump";
      why = "a jump: to either side of it motions differ within a cycle, however near";
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
  if (!options_.through_changes || !branch_.points.back().chatter) return false;
  constexpr double clear = 1e-3;  // nearer to the onset impacts are too many and too short to be followed
  std::vector<Reshaped> found = reshape(problem_, at.orbit, at, std::nullopt, range_, options_.stop, clear);
  std::erase_if(found, [](const Reshaped& next) { return !next.onset || next.folds; });
  if (found.empty() && !chatter_lengthens(branch_)) return false;
  const double reach = shortest_step() * range_;
  Between about{value(at) - reach, value(at) + reach};
  const bool release = !found.empty() && found.front().onset->release;
  if (release) about = *found.front().onset;
  SpecialPoint special = onset(about, branch_.points.back());
  if (!found.empty() && !release)
    special.error = std::max(special.error, std::abs(value(found.front().point) - value(at)));
  add_onset(std::move(special), found.empty() ? "the branch ends" : "persistence");
  if (!found.empty()) {
    restart(at, std::move(found.front().point));
    onset_ = Onset{reversed(at), branch_.points.size(), branch_.special.size(), chatters(at.orbit)};
  } else {
    end("CH at " + shown(value(at)) + ": the complete chatter ends there, and no orbit with impacts was found beyond",
        true);
  }
  return true;
}

/// Behind the onset of a chatter one direction leads on, the other back towards the onset, through ever more impacts. @returns false if it was not that
bool Follower::turn_round(PathPoint& at) {
  constexpr double near = 1e-3;  // of the range
  if (!onset_ || chatters(branch_.points.back().orbit) > onset_->chatters ||
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
  SpecialPoint special = onset({limit->value, limit->value, false}, branch_.points.back());
  special.error = limit->error;
  special.what += " (a cascade, ratio " + shown(std::round(1e4 * limit->ratio) / 1e4) + ")";
  std::optional<Reshaped> next = beyond_cascade(problem_, at, limit->value, range_, options_.stop);
  if (next && lies_on(problem_, branch_, next->point.orbit)) next.reset();
  add_onset(std::move(special), next ? "persistence" : "the branch ends");
  if (next)
    restart(at, std::move(next->point));
  else
    end("CH at " + shown(limit->value) +
            ": a cascade, which gathers there, and no orbit with the chatter was found beyond",
        true);
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

/// Where legs shrink to nothing together and steps lead no further: the place, by extrapolation, and what the motion does beyond.
/// @returns false if none shrinks
bool Follower::die_out(PathPoint& at) {
  if (!options_.through_changes) return false;
  const std::optional<Death> death = dies_out(branch_);
  if (!death) return false;
  if (at_end(death->value, death->error, at)) {
    end("range", false);
    return true;
  }
  const Solution& last = branch_.points.back();
  SpecialPoint special;
  special.type = last.sticking ? SpecialType::SL : SpecialType::CO;
  special.value = death->value;
  special.error = death->error;
  special.solution = last;
  special.after = branch_.points.size() - 1;
  special.what =
      "the motion dies out: leg " + std::to_string(death->leg + 1) + " and others shrink to nothing together";
  const auto& tests = at.watched.tests;
  const auto length = [&](const TestValue& test) { return test.test == Test::duration && test.leg == death->leg; };
  special.test = static_cast<std::size_t>(std::ranges::find_if(tests, length) - tests.begin());
  PathPoint there = at;
  there.orbit.values[0] = death->value;
  Behind beyond;
  if (last.stable()) beyond = behind(problem_, there, range_, options_.stop);
  if (beyond.next && !one_of_family(problem_, beyond.next->point, range_)) {
    special.outcome = "persistence";
    branch_.special.push_back(std::move(special));
    restart(at, std::move(beyond.next->point));
  } else {
    const bool jump = !beyond.family && !beyond.what.empty();
    end_at(std::move(special), beyond.family ? Beyond::family : jump ? Beyond::jump : Beyond::unknown, beyond.what);
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
  return leave_edge(at) || leave_chatter(at) || turn_round(at) || end_cascade(at) || die_out(at);
}

void Follower::add_onset(SpecialPoint special, const std::string& outcome) {
  special.outcome = outcome;
  special.after = branch_.points.size() - 1;
  branch_.special.push_back(std::move(special));
}

/// Goes on from another orbit, if that is not outside the range.
void Follower::restart(PathPoint& at, PathPoint from) {
  if (!inside(value(from))) return end("range", false);
  at = std::move(from);
  branch_.points.push_back(solution_of(at, nullptr));
  step_ = options_.step;
}

/// The branch goes on behind a change, with new events.
void Follower::go_on(PathPoint& at, SpecialPoint special, Reshaped next) {
  special.outcome = next.folds ? "non-smooth fold" : "persistence";
  Solution first = solution_of(next.point, nullptr);
  const bool begins = chatters(next.point.orbit) > chatters(special.solution.orbit);
  if (next.onset && next.onset->release && begins) {
    special.type = SpecialType::CH;
    special.what += ", and a complete chatter begins";
    branch_.special.push_back(std::move(special));
  } else if (next.onset) {
    SpecialPoint here = onset(*next.onset, special.solution);
    const std::string outcome = std::exchange(special.outcome, "one of infinitely many changes");
    if (begins) branch_.special.push_back(special);
    add_onset(std::move(here), outcome);
    if (!begins) branch_.special.push_back(std::move(special));
  } else if (!next.renewed) {
    branch_.special.push_back(std::move(special));
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
