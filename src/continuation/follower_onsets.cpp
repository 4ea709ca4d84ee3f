/// Onsets of complete chatter on a branch: the way into a cascade, its end, and the way out of a chatter.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "change/onset.hpp"
#include "continuation/follower.hpp"
#include "continuation/lies_on.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/short_legs.hpp"

namespace slapstick::orbit {

namespace {
constexpr double clear = 1e-3;  ///< of the range: nearer to an onset impacts are too many and too short to be followed
constexpr double gathered =
    1e-2;  ///< of a cascade's length: the changes that are left are as those before, ever nearer to its limit
}  // namespace

void Follower::add_here(SpecialPoint special) {
  special.after = branch_.points.size() - 1;
  branch_.special.push_back(std::move(special));
}

/// Where it was sent to.
void Follower::arrive(SpecialPoint special) {
  add_here(std::move(special));
  back_to_.reset();
  end(BranchEnd::Kind::special);
}

/// From an orbit beyond a place back to it. Empty if the branch does not lead there. Towards an onset of chatter it
/// need not come quite there: from few changes of a cascade its end is not known.
std::optional<Follower::ReturnPath> Follower::follow_back(const PathPoint& from, const Place& place) const {
  constexpr double range_of_return = 30.0, part_left = 0.2;  // of the distance between the place and the orbit
  constexpr int most_points = 300;
  const double distance = std::abs(value(from) - place.value);
  ContinuationOptions between = options_;
  between.from = std::max(options_.from, place.value - range_of_return * distance);
  between.to = std::min(options_.to, place.value + range_of_return * distance);
  between.most_points = most_points;
  ReturnPath way;
  way.branch.points.push_back(solution_of(from, nullptr));
  Follower back(problem_, between, way.branch);
  back.range_ = range_;
  back.back_to_ = place;
  try {
    back.run(from);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  if (!back.back_to_) {
    way.place = std::move(way.branch.special.back());
    way.branch.special.pop_back();
    return way;
  }
  const double left = std::abs(way.branch.points.back().orbit.parameter() - place.value);
  if (!place.onset || !(left < part_left * distance)) return std::nullopt;
  const std::size_t last = way.branch.points.size() - 1;  // what it ended with there says nothing
  std::erase_if(way.branch.special, [&](const SpecialPoint& point) { return point.after >= last; });
  return way;
}

/// Adds the orbits between a place, which the branch has come to, and an orbit beyond it, from which they were followed
/// back.
void Follower::add_between(Branch way) {
  const std::size_t last = branch_.points.size() + way.points.size() - 1;  // the way's first point, when all are there
  ranges::reverse(way.special);
  for (SpecialPoint& point : way.special) {
    point.after = last - point.after - 1;
    branch_.special.push_back(std::move(point));
  }
  std::move(way.points.rbegin(), way.points.rend(), std::back_inserter(branch_.points));
}

/// Goes on beyond the onset of a chatter with the cascade that gathers there, from its end on.
/// The way to the onset comes nearer to its orbit: that tells it where a chatter's limit meets a step, since the
/// cascade passes the onset's parameter between any two changes there.
/// @returns false if that is not to be followed
bool Follower::enter_cascade(PathPoint& at, SpecialPoint special, const PathPoint& from) {
  if (back_to_) return false;
  const auto off = [&](const Orbit& orbit) { return apart(problem_, special.solution.orbit, orbit); };
  for (const PathPoint& start : {reversed(from), from}) {
    std::optional<ReturnPath> way = follow_back(start, {special.value, 0.0, true});
    if (!way || off(way->branch.points.back().orbit) > off(from.orbit)) continue;
    if (way->place && way->place->error < special.error) {
      special.value = way->place->value;
      special.error = way->place->error;
      special.occurrence = way->place->occurrence;
      special.cascade_ratio = way->place->cascade_ratio;
    }
    add_here(std::move(special));
    add_between(std::move(way->branch));
    set_out(at, reversed(start));
    return true;
  }
  return false;
}

/// Orbits of the cascade of an onset, some way from it.
std::vector<HalfBranch> Follower::clear_of_onset(const PathPoint& at) const {
  std::vector<HalfBranch> found =
      find_branches_beyond(problem_, at.orbit, at, std::nullopt, range_, options_.stop, clear);
  std::erase_if(found, [](const HalfBranch& next) { return !next.onset || next.onset->release || next.folds; });
  return found;
}

/// Where a chatter's limit meets a point of a signal the changes of the cascade lie to both sides of the onset, each r
/// times as far from it as the one before: on from an orbit clear of it, in the sense in which orbits differ the more
/// from that of the onset. @returns false if no such orbit is found
bool Follower::leave_knot(PathPoint& at, SpecialPoint special) {
  const auto off = [&](const PathPoint& point) { return apart(problem_, special.solution.orbit, point.orbit); };
  PathPoint there = at;
  there.orbit = special.solution.orbit;
  for (const HalfBranch& next : clear_of_onset(there))
    for (const PathPoint& start : {next.point, reversed(next.point)}) {
      const std::optional<PathPoint> ahead = step_to(problem_, start, shortest_step(), range_);
      if (!ahead || !(off(*ahead) > off(start))) continue;
      add_here(std::move(special));
      restart(at, start);
      return true;
    }
  return false;
}

/// Leaves a chatter by its cascade, from an orbit clear of the onset: just beyond it impacts are too many and too short
/// for four grazes to be found on the way back. @returns false if there is no such orbit, or none that leads back
bool Follower::leave_clear_of_onset(PathPoint& at) {
  const std::vector<HalfBranch> found = clear_of_onset(at);
  if (found.empty()) return false;
  const double reach = shortest_step() * range_;
  SpecialPoint special = onset({value(at) - reach, value(at) + reach, false}, branch_.points.back());
  special.error = std::max(special.error, std::abs(value(found.front().point) - value(at)));
  special.passage = Passage::persistence;
  return enter_cascade(at, std::move(special), found.front().point);
}

/// Near its onset a chatter's equations, of ever more impacts, are hardly solvable. Looks for the orbits beyond the
/// onset; where no orbit is found, the branch ends at the onset. @returns false if it is no onset
bool Follower::leave_chatter(PathPoint& at) {
  if (!options_.through_changes || !branch_.points.back().chatter) return false;
  std::vector<HalfBranch> found =
      find_branches_beyond(problem_, at.orbit, at, std::nullopt, range_, options_.stop, clear);
  std::erase_if(found, [](const HalfBranch& next) { return !next.onset || next.folds; });
  if (found.empty() && !chatter_lengthens(branch_.points)) return false;
  const std::optional<PlaceLimit> ahead = onset_ahead(at);
  if (ahead && !inside(ahead->value) && !back_to_) {
    end(BranchEnd::Kind::range);
    return true;
  }
  const double reach = shortest_step() * range_;
  OnsetInterval about{value(at) - reach, value(at) + reach};
  const bool release = !found.empty() && found.front().onset->release;
  if (release) about = *found.front().onset;
  SpecialPoint special = onset(about, branch_.points.back());
  if (!found.empty() && !release)
    special.error = std::max(special.error, std::abs(value(found.front().point) - value(at)));
  if (ahead && !release && std::abs(ahead->value - value(at)) <= std::max(special.error, clear * range_)) {
    special.value = ahead->value;
    special.error = ahead->error;
  }
  special.passage = found.empty() ? Passage::unknown : Passage::persistence;
  if (!found.empty() && !release && enter_cascade(at, special, found.front().point)) return true;
  add_here(std::move(special));
  if (!found.empty()) {
    restart(at, std::move(found.front().point));
    onset_ = Onset{reversed(at), branch_.points.size(), branch_.special.size(), chatters(at.orbit)};
  } else {
    branch_.up.failed = true;
    end(BranchEnd::Kind::special);
  }
  return true;
}

/// Behind the onset of a chatter one direction leads on, the other back towards the onset, through ever more impacts.
/// @returns false if the branch did not start at an onset
bool Follower::turn_round(PathPoint& at) {
  constexpr double at_onset = 1e-3;  // of the range
  if (!onset_ || chatters(branch_.points.back().orbit) > onset_->chatters ||
      std::abs(value(at) - onset_->other_way.orbit.parameter()) > at_onset * range_)
    return false;
  at = std::move(onset_->other_way);
  branch_.points.resize(onset_->points);
  branch_.special.resize(onset_->special);
  onset_.reset();
  before_.reset();
  step_ = options_.step;
  return true;
}

/// Just beyond the onset of a chatter, from which it is followed or beside which the branch begins, its impacts come as
/// close to rounding as a cascade's: on with the chatter a little farther on. @returns false if it is not so near
bool Follower::clear_onset(PathPoint& at) {
  constexpr double last_changes = 10.0;            // distances of the cascade's last change
  constexpr double nearest = 1e-6, widest = 1e-4;  // of the range
  if (!branch_.points.back().chatter) return false;
  const std::vector<SpecialPoint>& special = branch_.special;
  const bool begins = special.empty();
  if (!begins && special.back().type != SpecialType::CH) return false;
  const double place = begins ? branch_.points.front().orbit.parameter() : special.back().value;
  const double last_change = special.size() > 1 ? last_changes * std::abs(special.end()[-2].value - place) : 0.0;
  if (!(std::abs(value(at) - place) < std::clamp(last_change, nearest * range_, widest * range_))) return false;
  std::optional<HalfBranch> next = beyond_cascade(problem_, at, place, range_, options_.stop);
  if (!next) return false;
  const double on = value(next->point) - value(at);
  if (!(on * at.watched.turn > 0.0) || (begins && std::abs(on) > 0.1 * widest * range_)) return false;
  restart(at, std::move(next->point));
  return true;
}

/// The onset that a branch with a complete chatter runs towards, by the onset's own equations. Looked for again where
/// the chatter has more impacts by far.
std::optional<PlaceLimit> Follower::onset_ahead(const PathPoint& at) {
  if (!branch_.points.back().chatter) return std::nullopt;
  if (!ahead_ && static_cast<double>(at.orbit.legs()) >= longer_burst * static_cast<double>(looked_from_)) {
    looked_from_ = at.orbit.legs();
    ahead_ = chatter_limit(problem_, at.orbit);
  }
  if (ahead_ && (ahead_->value - value(at)) * at.watched.turn < 0.0) return std::nullopt;
  return ahead_;
}

/// Is it a change of the burst that lengthens, or of the cascade, as those before it?
bool Follower::in_gathering(const PathPoint& at, const Change& change) const {
  if (branch_.points.back().chatter) return in_burst(at.orbit, change.test.leg);
  const auto last = std::find_if(branch_.special.rbegin(), branch_.special.rend(),
                                 [](const SpecialPoint& point) { return point.type == SpecialType::GR; });
  return last != branch_.special.rend() && change.special.type == SpecialType::GR &&
         change.special.margin.contact == last->margin.contact;
}

/// Passes an onset of a complete chatter that is known by its own equations. The branch, with the chatter or with the
/// cascade of its changes, must be so near that nothing but ever more impacts lies before the onset.
/// @returns false if there is no such onset so near
bool Follower::meet_onset(PathPoint& at) {
  if (!options_.through_changes) return false;
  if (!branch_.points.back().chatter) {
    const std::optional<CascadeLimit> limit = cascade_ends(at);
    return limit && ahead_ && limit->left < gathered * limit->began && end_cascade(at);
  }
  if (!chatter_lengthens(branch_.points)) return false;
  const std::optional<PlaceLimit> ahead = onset_ahead(at);
  return ahead && std::abs(ahead->value - value(at)) < clear * range_ && leave_chatter(at);
}

std::optional<CascadeLimit> Follower::cascade() const {
  return cascade_limit(problem_, branch_.points, branch_.special, ahead_);
}

/// Have the impacts of a cascade become too short to be followed? Its limit, if the branch is to end or to go on there.
std::optional<CascadeLimit> Follower::cascade_ends(const PathPoint& at) const {
  if (!options_.through_changes || branch_.points.back().chatter || (back_to_ && !back_to_->onset)) return std::nullopt;
  std::optional<CascadeLimit> limit = cascade();
  if (limit && std::abs(limit->value - value(at)) > limit->left) limit.reset();
  return limit;
}

/// Where the limit of a chatter meets a point of a signal the onset is known by the chatter beyond.
void Follower::place_at_knot(SpecialPoint& special, const Orbit& chattering, double within) const {
  const std::optional<PlaceLimit> exact = knot_limit(problem_, chattering);
  if (!exact || exact->error >= special.error || std::abs(exact->value - special.value) > within) return;
  special.value = exact->value;
  special.error = exact->error;
}

/// The end of a cascade: its limit, and the complete chatter beyond. @returns false if there is no such end
bool Follower::end_cascade(PathPoint& at) {
  const std::optional<CascadeLimit> limit = cascade_ends(at);
  if (!limit) return false;
  if (!inside(limit->value) && !back_to_) {
    end(BranchEnd::Kind::range);
    return true;
  }
  SpecialPoint special = onset({limit->value, limit->value, false}, branch_.points.back());
  special.error = limit->error;
  special.cascade_ratio = limit->ratio;
  if (back_to_) {
    arrive(std::move(special));
    return true;
  }
  std::optional<HalfBranch> next = beyond_cascade(problem_, at, limit->value, range_, options_.stop);
  if (next) place_at_knot(special, next->point.orbit, limit->left);
  if (next && lies_on(problem_, branch_, next->point.orbit)) next.reset();
  special.passage = next ? Passage::persistence : Passage::unknown;
  add_here(std::move(special));
  if (next) {
    restart(at, std::move(next->point));
  } else {
    branch_.up.failed = true;
    end(BranchEnd::Kind::special);
  }
  return true;
}

/// The same where the cascade's next change is known, but not what lies beyond it.
bool Follower::end_cascade_with(PathPoint& at, SpecialPoint last) {
  last.passage = Passage::cascade;
  last.jump.reset();
  branch_.special.push_back(std::move(last));
  if (end_cascade(at)) return true;
  branch_.special.pop_back();
  return false;
}

}  // namespace slapstick::orbit
