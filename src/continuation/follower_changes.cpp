/// Changes of events on a branch: where they are, what is beyond them, and how the branch goes on or ends there.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ranges.hpp"
#include "change/change_kind.hpp"
#include "change/jump.hpp"
#include "change/onset.hpp"
#include "change/past_knot.hpp"
#include "continuation/follower.hpp"
#include "continuation/hidden.hpp"
#include "continuation/lies_on.hpp"
#include "continuation/special.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/short_legs.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

/// The type of a change and how sliding changes, by the events on both sides.
void name_change(const Orbit& behind, SpecialPoint& special) {
  const ChangeOfEvents seen = compare_events(special.solution.orbit, behind);
  special.type = seen.type;
  special.sliding = seen.sliding;
}

/// Of what was before: what a place that is known to 1e-9 of a step leaves of a speed or a length that is zero there.
constexpr double as_good_as_none = 1e-4;

/// Has the orbit at a change multipliers of its own? Where a guard comes to zero within a leg the orbit is as it was.
/// Where an impact loses its speed, or a leg its length, they are infinite, or 0 / 0.
bool has_multipliers(const PathPoint& before, const Change& change) {
  if (change.special.margin.kind != UsedMargin::Kind::least || change.special.death) return false;
  const std::vector<TestValue>&was = before.watched.tests, &is = change.at.watched.tests;
  for (std::size_t i = 0; i < std::min(was.size(), is.size()); ++i) {
    const bool ends_leg = is[i].test == Test::speed || is[i].test == Test::duration;
    if (ends_leg && !(is[i].value > as_good_as_none * was[i].value)) return false;
  }
  const auto finite = [](const std::complex<double>& one) { return std::isfinite(std::abs(one)); };
  return ranges::all_of(change.special.solution.multipliers, finite);
}

/// Does the parameter turn back there?
bool turns(const SpecialPoint& special) { return special.type == SpecialType::LP || special.passage == Passage::fold; }

}  // namespace

/// The first change. A point that is nearly singular leads nowhere: the one before it may.
std::optional<Change> Follower::first_change(const PathPoint& at, const PathPoint& beyond, double length) const {
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
  if (try_ways_on(at)) return !ended_;
  if (at_end(value(at), structure * range_, at)) {
    end(BranchEnd::Kind::range);
    return false;
  }
  fail({.kind = BranchEnd::Kind::no_change, .value = value(at), .detail = why});
  return false;
}

/// Is a place at the end of the range that the branch goes to, as far as it is known? What is beyond is not asked for,
/// and may not exist, as a negative damper.
bool Follower::at_end(double place, double error, const PathPoint& at) const {
  const double left = at.watched.turn > 0.0 ? options_.to - place : place - options_.from;
  return left <= place_tolerance * range_ + error;
}

/// Between `at` and `beyond` the motion's events change. Notes the point and goes on with new ones. @returns false if
/// the branch ends
bool Follower::change_events(PathPoint& at, const PathPoint& beyond, double length, const std::string& why) {
  std::optional<Change> change = first_change(at, beyond, length);
  if ((!change || in_gathering(at, *change)) && meet_onset(at)) return !ended_;
  if (!change || is_rounding_leg(at.orbit, change->test.leg)) return look_nearer(at, length, why);
  SpecialPoint& special = change->special;
  if (at_end(special.value, special.error, at)) {
    end(BranchEnd::Kind::range);
    return false;
  }
  const bool arrived = back_to_ && !back_to_->onset && std::abs(special.value - back_to_->value) <= back_to_->error;
  constexpr double hardly_a_leg = 1e-7;  // of the cycle: what happens in it is rounding
  if (!arrived && has_leg_below(at.orbit, hardly_a_leg) && die_out(at)) return !ended_;
  std::optional<PathPoint> behind_others;  // where a fold, say, lies before the change
  if (change->length > 0.0) {
    std::vector<SpecialPoint> smooth = beside_change(problem_, at, change->length, range_);
    if (!smooth.empty()) {
      const double last = arclength(problem_, at, smooth.back().solution.orbit);
      behind_others = step_to(problem_, at, 0.5 * (last + change->length), range_);
    }
    add(std::move(smooth), branch_.points.size() - 1);
  }
  if (ended_) return false;
  special.after = branch_.points.size() - 1;
  if (arrived) {
    arrive(std::move(special));
    return false;
  }
  if (!has_multipliers(at, *change))  // those of the point before say more
    special.solution.multipliers =
        behind_others ? behind_others->watched.multipliers : branch_.points.back().multipliers;
  if (!options_.through_changes) {
    special.passage = Passage::not_followed;
    return end_at(at, std::move(special));
  }
  return pass(at, std::move(*change));
}

/// What lies beyond a change.
Unfolding Follower::look_beyond(const PathPoint& at, const Change& change, std::optional<Branch>& way) const {
  UnfoldOptions how{.range = range_, .stop = options_.stop};
  how.simulate = branch_.points.back().stable() && !cascade_ends(at);
  if (!back_to_)
    how.lead_back = [&](const HalfBranch& found, double error) { return lead_back(change, found, error, way); };
  return unfold(problem_, at.orbit, change, how);
}

/// Where the events of an orbit beyond a change begin elsewhere, others lie between: it is followed back to the change.
/// @returns whether its branch begins in the sense of the parameter from which the old one came; empty if it does not
/// come to the change
std::optional<bool> Follower::lead_back(const Change& change, const HalfBranch& found, double error,
                                        std::optional<Branch>& way) const {
  std::optional<ReturnPath> back = follow_back(reversed(found.point), {change.special.value, error, false});
  if (!back) return std::nullopt;
  way = std::move(back->branch);
  const bool turned = ranges::count_if(way->special, turns) % 2 != 0;
  const double away = found.point.watched.turn;
  return (turned ? -away : away) * change.at.watched.turn < 0.0;
}

/// Does a change lead to where the branch has been? Near its end a cascade, whose folds and grazes are nearly one,
/// seems to: it turns back into itself or goes on with an earlier orbit.
bool Follower::leads_back(const Unfolding& beyond) const {
  return !beyond.branches.empty() && cascade() && lies_on(problem_, branch_, beyond.branches.front().point.orbit);
}

/// .. where those do not tell how sliding changes, by the margin that is used up.
void Follower::name_by_both_sides(const PathPoint& at, const Change& change, const Orbit& behind,
                                  SpecialPoint& special) const {
  name_change(behind, special);
  if (special.type == SpecialType::SL && special.sliding == Sliding::unchanged)
    special.sliding = kind_of_sliding(change.test, at.orbit.shape);
}

/// The branch ends where others are. @returns false
bool Follower::end_at_others(const PathPoint& at, SpecialPoint special, Unfolding beyond) {
  special.passage = beyond.passage;
  special.born = std::move(beyond.others);
  for (const HalfBranch& other : beyond.branches) special.born.push_back(other.point.orbit);
  return end_at(at, std::move(special));
}

/// Goes on beyond a change. @returns false if the branch ends
bool Follower::pass(PathPoint& at, Change change) {
  SpecialPoint& special = change.special;
  std::optional<Branch> way;
  Unfolding beyond = look_beyond(at, change, way);
  special.passage = beyond.passage;
  special.jump = std::move(beyond.jump);
  if (leads_back(beyond) && end_cascade(at)) return !ended_;
  if (!beyond.others.empty()) return end_at_others(at, std::move(special), std::move(beyond));
  if (beyond.branches.empty()) {
    const bool family = beyond.passage == Passage::family;
    if (!family && end_cascade_with(at, special)) return !ended_;
    // A graze that is not the cascade's next: impacts are hardly more than rounding, and the limit is known without it.
    if (!family && in_gathering(at, change) && end_cascade(at)) return !ended_;
    return end_at(at, std::move(special));
  }
  for (std::size_t i = 1; i < beyond.branches.size(); ++i) special.born.push_back(beyond.branches[i].point.orbit);
  HalfBranch& next = beyond.branches.front();
  if (beyond.passage == Passage::same_events) {  // the motion beyond says that nothing changes
    restart(at, std::move(next.point));
    return !ended_;
  }
  if (lies_on_first(problem_, branch_.points.size(), branch_, next.point.orbit)) {
    special.passage = Passage::retraced;
    return end_at(at, std::move(special));
  }
  if (next.onset && next.folds && turn_round(at)) return true;  // back to the chatter that it has just left
  const bool chatter = chatters(at.orbit) + chatters(next.point.orbit) > 0;
  if (!next.renewed && !next.onset && !(chatter && special.type == SpecialType::GR))
    name_by_both_sides(at, change, way ? way->points.back().orbit : next.point.orbit, special);
  go_on(at, std::move(special), std::move(next), std::move(way));
  return true;
}

/// Has a cycle without forcing shrunk to a point? Beside a corner the laws are linear on either side: a cycle about a
/// state of rest there has a size in proportion to the distance of the two, and ends as they meet.
bool Follower::shrinks_to_equilibrium(const SpecialPoint& special) const {
  if (special.solution.orbit.shape.n > 0 || branch_.points.empty()) return false;
  return Extent(problem_, special.solution.orbit).velocity() <=
         as_good_as_none * Extent(problem_, branch_.points.back().orbit).velocity();
}

/// Does a cycle without forcing stay in one mode, apart from legs that are nearly gone? A closed curve of a linear
/// system is one of a family: all that lie about the state of rest like it, nearer or farther.
bool Follower::stays_in_one_mode(const Orbit& orbit) const {
  if (orbit.shape.n > 0) return false;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < orbit.legs(); ++i)
    if (orbit.duration(i) > orbit.duration(longest)) longest = i;
  double elsewhere = 0.0;
  for (std::size_t i = 0; i < orbit.legs(); ++i)
    if (orbit.shape.legs[i].states != orbit.shape.legs[longest].states) elsewhere += orbit.duration(i);
  return elsewhere <= as_good_as_none * (orbit.t.back() - orbit.t.front());
}

/// The branch ends where its events change: its passage says why. @returns false
bool Follower::end_at(const PathPoint& at, SpecialPoint special) {
  if (special.passage == Passage::unknown && at_end(special.value, structure * range_, at)) {
    end(BranchEnd::Kind::range);
    return false;
  }
  if (special.passage == Passage::unknown && shrinks_to_equilibrium(special)) special.passage = Passage::equilibrium;
  if (special.passage == Passage::unknown && stays_in_one_mode(special.solution.orbit))
    special.passage = Passage::family;
  branch_.up.failed = special.passage == Passage::unknown;
  branch_.special.push_back(std::move(special));
  end(BranchEnd::Kind::special);
  return false;
}

namespace {

/// .. also of one in which what has died out rests.
bool is_of_family(const Problem& problem, const PathPoint& at, const PathPoint& next, double range) {
  return rests_more(at, next) || one_of_family(problem, at, next, range);
}

}  // namespace

/// Where legs shrink to nothing together and steps lead no further: what the motion does beyond.
/// @returns false if none shrinks
bool Follower::die_out(PathPoint& at) {
  if (!options_.through_changes) return false;
  std::optional<LocatedDeath> ahead = death_ahead(problem_, at);
  if (!ahead) return false;
  SpecialPoint special;
  special.value = ahead->death.orbit.parameter();
  special.error = ahead->error;
  if (at_end(special.value, special.error, at)) {
    end(BranchEnd::Kind::range);
    return true;
  }
  special.solution = branch_.points.back();
  special.type = special.solution.sticking ? SpecialType::SL : SpecialType::CO;
  special.after = branch_.points.size() - 1;
  special.death = std::move(ahead->death);
  special.occurrence = Occurrence::death;
  special.margin = {.kind = UsedMargin::Kind::duration, .leg = ahead->leg};
  const auto& tests = at.watched.tests;
  const auto length = [&](const TestValue& test) { return test.test == Test::duration && test.leg == ahead->leg; };
  special.test = static_cast<std::size_t>(ranges::find_if(tests, length) - tests.begin());
  PathPoint there = at;
  there.orbit.parameter() = special.value;
  Unfolding found;
  std::vector<HalfBranch>& left = found.branches;
  left = branches_at(problem_, there, {special.death->orbit}, range_);
  std::erase_if(left, [&](const HalfBranch& next) { return is_of_family(problem_, at, next.point, range_); });
  find_met(problem_, at.orbit, found);
  if (!found.others.empty()) {
    name_change(found.others.front(), special);
    end_at_others(at, std::move(special), std::move(found));
    return true;
  }
  if (!left.empty()) {
    name_change(left.front().point.orbit, special);
    go_on(at, std::move(special), std::move(left.front()), std::nullopt);
    return true;
  }
  MotionBeyond beyond;
  if (special.solution.stable()) beyond = run_beyond(problem_, there, range_, options_.stop);
  if (beyond.next && !is_of_family(problem_, at, beyond.next->point, range_)) {
    special.passage = Passage::persistence;
    branch_.special.push_back(std::move(special));
    restart(at, std::move(beyond.next->point));
  } else {
    special.passage = beyond.family ? Passage::family : beyond.jump ? Passage::jump : Passage::unknown;
    if (special.passage == Passage::jump) special.jump = std::move(beyond.jump);
    end_at(at, std::move(special));
  }
  return true;
}

/// From a first point at which the model itself has another structure than beside it, as with a damper of exactly zero:
/// the orbit beside it.
bool Follower::leave_edge(PathPoint& at) {
  if (branch_.points.size() > 1 || !branch_.points.front().stable()) return false;
  MotionBeyond beyond = run_beyond(problem_, at, range_, options_.stop);
  if (!beyond.next || one_of_family(problem_, at, beyond.next->point, range_)) return false;
  restart(at, std::move(beyond.next->point));
  return true;
}

/// Called when no step converges and no change is found: an end that is known, or a way on.
/// @returns false if there is neither
bool Follower::try_ways_on(PathPoint& at) {
  return leave_edge(at) || leave_chatter(at) || turn_round(at) || clear_onset(at) || end_cascade(at) || die_out(at);
}

/// Goes on from an orbit that the branch has.
void Follower::set_out(PathPoint& at, PathPoint from) {
  ahead_.reset();
  at = std::move(from);
  before_.reset();
  step_ = std::min(step_, options_.step);
}

/// Goes on from another orbit, if that is not outside the range.
void Follower::restart(PathPoint& at, PathPoint from) {
  if (!inside(value(from))) return end(BranchEnd::Kind::range);
  ahead_.reset();
  at = std::move(from);
  branch_.points.push_back(solution_of(at, nullptr));
  step_ = options_.step;
}

/// Do one event and points of signals change places, at which nothing happens?
bool Follower::passes_nothing(const SpecialPoint& special) const {
  if (special.margin.kind != UsedMargin::Kind::duration) return false;
  const Orbit& orbit = special.solution.orbit;
  const Model model = problem_.family().model(orbit.values);
  const auto events = events_at(special);
  const auto idle = std::count_if(events.begin(), events.end(),
                                  [&](std::size_t leg) { return is_idle_knot(model, orbit.shape, leg); });
  return idle > 0 && static_cast<std::size_t>(idle) + 1 >= events.size();
}

/// The branch goes on beyond a change, with new events.
/// @param between  followed back from there to the change, if other changes lie between
void Follower::go_on(PathPoint& at, SpecialPoint special, HalfBranch next, std::optional<Branch> between) {
  special.passage = next.folds ? Passage::fold : rests_more(at, next.point) ? Passage::family : Passage::persistence;
  if (branch_.points.back().chatter || special.type != SpecialType::GR) {  // no change of a cascade
    ahead_.reset();
    looked_from_ = 0;
  }
  Solution first = solution_of(next.point, nullptr);
  const bool begins = chatters(next.point.orbit) > chatters(special.solution.orbit);
  if (next.onset && next.onset->release && begins) {
    special.type = SpecialType::CH;
    special.chatter_begins = true;
    branch_.special.push_back(std::move(special));
  } else if (next.onset) {
    SpecialPoint here = onset(*next.onset, special.solution);
    here.error = std::max(here.error, special.error);
    if (begins) place_at_knot(here, next.point.orbit, here.error);
    here.passage = std::exchange(special.passage, Passage::cascade);
    if (begins) branch_.special.push_back(special);
    if (begins && back_to_ && back_to_->onset) return arrive(std::move(here));
    if (!begins && next.onset->knot && leave_knot(at, here)) return;
    if (!begins && !next.onset->release && (enter_cascade(at, here, next.point) || leave_clear_of_onset(at))) return;
    add_here(std::move(here));
    if (!begins) branch_.special.push_back(std::move(special));
  } else if (!next.renewed) {
    if (next.folds || !passes_nothing(special)) branch_.special.push_back(std::move(special));
    if (between) {
      add_between(std::move(*between));
      return set_out(at, std::move(next.point));
    }
    if (next.length > 0.0)
      add(beside_change(problem_, reversed(next.point), next.length, range_), branch_.points.size() - 1);
    if (ended_) return;
  }
  if (!inside(value(next.point))) return end(BranchEnd::Kind::range);
  at = std::move(next.point);
  branch_.points.push_back(std::move(first));
  step_ = std::min(step_, options_.step);
}

}  // namespace slapstick::orbit
