/// Follows a branch of orbits step by step, both ways from its start.
#include "slapstick/continuation/branch.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "change/onset.hpp"
#include "continuation/follower.hpp"
#include "continuation/hidden.hpp"
#include "continuation/lies_on.hpp"
#include "continuation/normal_form.hpp"
#include "continuation/special.hpp"
#include "continuation/two_ways.hpp"
#include "orbit/extent.hpp"
#include "orbit/kept.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/short_legs.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

constexpr double shortest_for_pairs = 1e-4;  ///< arclength that may hold two special points of one type
constexpr std::size_t most_events =
    1000;  ///< of a cycle: the cost of a step grows like their cube, and a chatter's number has no bound
constexpr double small_size = 0.2;  ///< of the first orbit's: what is smaller is followed in steps of this size's
constexpr double straight = 0.95;   ///< least cosine between the tangents of neighbouring points

}  // namespace

void Follower::end(BranchEnd::Kind why) {
  branch_.up.kind = why;
  ended_ = true;
}

void Follower::fail(BranchEnd end) {
  branch_.up = std::move(end);
  branch_.up.failed = true;
  ended_ = true;
}

/// Runs the simulator over the cycle. Where only the number of impacts before a chatter's sum has changed, `seen` has
/// the orbit as it is now.
Solution Follower::solution_of(const PathPoint& point, Verification* seen) const {
  const System system(problem_.family().model(point.orbit.values));
  Solution solution = describe(problem_, point.orbit, nullptr);
  Verification verification = verify(system, point.orbit);
  solution.is_motion = verification.is_motion;
  solution.why = verification.why;
  if (seen != nullptr) *seen = std::move(verification);
  return solution;
}

void Follower::look_for_pairs(const PathPoint& at, const PathPoint& next, double length) {
  Pair pair;
  if (has_before(next))
    pair = pair_within(problem_, {before_->point, at, next, before_->length, length}, range_);
  else
    pair.points = within_halves(problem_, at, next, length, range_);
  const std::size_t after = branch_.points.size() - (pair.earlier ? 2 : 1);
  std::erase_if(pair.points, [&](const SpecialPoint& point) {  // a step is looked at from both of its ends
    return ranges::any_of(branch_.special, [&](const SpecialPoint& known) {
      const double alike = 1e-9 * range_ + point.error + known.error;
      return known.type == point.type && known.after == after && std::abs(known.value - point.value) < alike;
    });
  });
  add(std::move(pair.points), after);
}

/// Notes special points that leave the events as they are. A branch ends where its orbit becomes a shorter one run
/// through twice, or the symmetric one beyond which it has the images of its orbits.
void Follower::add(std::vector<SpecialPoint> smooth, std::size_t after) {
  constexpr double merged = 1e-3;  // at a fold or crossing that is known to 1e-10 in the parameter, states are to 1e-5
  for (SpecialPoint& special : smooth) {
    if (std::min(special.value - options_.from, options_.to - special.value) <= place_tolerance * range_) continue;
    const bool doubling = (special.type == SpecialType::LP || special.type == SpecialType::BP) &&
                          becomes_shorter(problem_, branch_.points.back().orbit, special.solution.orbit, merged);
    special.after = after;
    if (doubling) {
      special.type = SpecialType::PD;
      special.occurrence = Occurrence::end_of_doubled;
      special.passage = Passage::merges;
      special.born.clear();
    } else if (special.type != SpecialType::BP)
      special.normal_form = normal_form(problem_, special);
    if (special.type == SpecialType::BP &&
        breaks_symmetry(problem_, branch_.points.back().orbit, special.solution.orbit))
      special.passage = Passage::symmetric;
    branch_.special.push_back(std::move(special));
    if (branch_.special.back().passage != Passage::same_events) return end(BranchEnd::Kind::special);
  }
}

/// The last point of a branch is on the boundary of the range, if the tangent leads there. @returns false if the branch
/// goes on
bool Follower::end_at_boundary(PathPoint& at) {
  const double wall = at.watched.turn > 0.0 ? options_.to : options_.from;
  const double length = (wall - value(at)) / (at.watched.turn * range_);
  if (length < 1e-12) {
    end(BranchEnd::Kind::range);
    return true;
  }
  Orbit last = at.orbit;
  const ModeSet set(problem_.family(), last.values);
  move(problem_, linearise(problem_, set, last), length * at.tangent.cwiseProduct(at.units), 0.0, last);
  last.parameter() = wall;
  const std::optional<Orbit> orbit = refine(problem_, last);
  if (!orbit) return false;
  PathPoint next = point_of(problem_, *orbit, range_, at.tangent);
  if (at.tangent.dot(next.tangent) < straight) return false;
  if (!accept(at, std::move(next), length)) return true;
  if (value(at) != wall) return false;  // the events have changed on the way
  end(BranchEnd::Kind::range);
  return true;
}

/// After a crossing a branch may come upon itself. The branch ends there, without the points that it has twice. If it
/// runs the other way it has been led back by its last change of events, which is not what it seems.
bool Follower::runs_over_itself() {
  constexpr std::size_t neighbours = 10;
  constexpr int certain = 5;  // one or two may be near: where branches cross, at folds
  std::vector<Solution>& points = branch_.points;
  std::vector<SpecialPoint>& special = branch_.special;
  const std::size_t count = points.size();
  const auto old =
      count > neighbours ? lies_on_first(problem_, count - neighbours, branch_, points.back().orbit) : std::nullopt;
  old_points_ = old ? old_points_ + 1 : 0;
  if (old_points_ < certain) return false;
  const auto on = [&](std::size_t i) { return points[i + 1].orbit.parameter() - points[i].orbit.parameter(); };
  const bool back = on(*old) * on(count - 2) < 0.0;
  const auto last = std::find_if(special.rbegin(), special.rend(),
                                 [&](const SpecialPoint& point) { return changes_events(point.type); });
  if (back && last != special.rend()) {
    const double place = last->value;
    points.resize(last->after + 1);
    special.erase(std::prev(last.base()), special.end());
    fail({.kind = BranchEnd::Kind::led_back, .value = place});
    return true;
  }
  points.resize(count - certain);
  std::erase_if(special, [&](const SpecialPoint& point) { return point.after >= points.size(); });
  branch_.up.value = points.back().orbit.parameter();
  end(BranchEnd::Kind::over_itself);
  return true;
}

/// An orbit that has grown beyond measure while the parameter hardly moves. @returns false if the branch goes on
bool Follower::grows_without_bound(const PathPoint& at) {
  constexpr double beyond = 1e6;  // a resonance of less damping than this counts as unbounded
  const Eigen::Index numbers = problem_.numbers();
  const VectorXd grown = at.units.head(numbers).cwiseQuotient(problem_.least_sizes());
  if (grown.maxCoeff() * small_size < beyond || std::abs(at.watched.turn) > 1.0 / beyond) return false;
  branch_.up.value = value(at);
  end(BranchEnd::Kind::unbounded);
  return true;
}

/// Ends the branch if the model ends within twice the shortest step: a static friction falls to the kinetic one.
bool Follower::end_of_model(const PathPoint& at) {
  std::vector<double> values = at.orbit.values;
  values[0] += std::copysign(2.0 * shortest_step() * range_, at.watched.turn);
  try {
    const System beyond(problem_.family().model(values));
  } catch (const InputError& error) {
    branch_.up = {.kind = BranchEnd::Kind::no_model, .value = value(at), .detail = error.what()};
    return ended_ = true;
  }
  return false;
}

/// Takes a step, or makes it shorter. @returns false if the branch ends
bool Follower::accept(PathPoint& at, PathPoint next, double length) {
  Verification seen;
  Solution solution;
  try {
    solution = solution_of(next, &seen);
  } catch (const InputError& error) {  // no model there
    step_ = 0.5 * length;
    if (step_ >= shortest_step()) return true;
    if (!end_of_model(at)) fail({.kind = BranchEnd::Kind::refused, .value = value(at), .detail = error.what()});
    return false;
  } catch (const std::runtime_error& error) {
    fail({.kind = BranchEnd::Kind::refused, .value = value(at), .detail = error.what()});
    return false;
  }
  if (!solution.is_motion) return change_events(at, next, length, solution.why);
  constexpr double half = 0.5;  // of legs that shrink together: where they do to nothing, what is left says how
  if (length > shortest_for_pairs && shrunk_legs(at.orbit, next.orbit, half) > 1) {
    step_ = half * length;
    return true;
  }
  std::vector<SpecialPoint> smooth = smooth_special_points(problem_, at, next, range_);
  if (length > shortest_for_pairs && !explained(at.watched, next.watched, smooth)) {
    step_ = 0.5 * length;
    return true;
  }
  if (smooth.empty()) look_for_pairs(at, next, length);
  add(std::move(smooth), branch_.points.size() - 1);
  if (ended_) return false;
  before_ = Before{at, length};
  branch_.points.push_back(std::move(solution));
  if (runs_over_itself() || grows_without_bound(next)) return false;
  if (!seen.same_chatter && !seen.seen.shape.legs.empty()) {
    Orbit renewed = seen.seen;
    renewed.values = next.orbit.values;
    if (auto orbit = refine(problem_, renewed)) {
      const VectorXd parameter =
          VectorXd::Unit(problem_.unknowns(orbit->legs()), problem_.parameter_column(orbit->legs(), 0));
      next = point_of(problem_, *orbit, range_, next.watched.turn > 0.0 ? parameter : VectorXd(-parameter));
    }
  }
  at = std::move(next);
  return true;
}

/// Is the first orbit between the last two points? Where the branch passes the orbit once more, it goes the way that it
/// went there first; on the other side of a fold it goes back.
bool Follower::has_come_round(const Extent& extent, const Orbit& first) const {
  const std::vector<Solution>& points = branch_.points;
  const std::size_t last = points.size() - 1;
  if (last <= 3) return false;  // still beside the first: it would be found at once
  const Orbit &a = points[last - 1].orbit, &b = points[last].orbit;
  if (lies_between(extent, a, b, first)) return true;
  const auto rises = [](const Orbit& from, const Orbit& to) { return to.parameter() > from.parameter(); };
  return rises(a, b) == rises(points[0].orbit, points[1].orbit) && meets_between(problem_, a, b, first);
}

/// The last point has gone past the first one: the first one it is, and what lies beyond is known from there.
void Follower::close() {
  std::vector<Solution>& points = branch_.points;
  const std::size_t before = points.size() - 2;
  const double first = points.front().orbit.parameter(), from = points[before].orbit.parameter();
  std::erase_if(branch_.special, [&](const SpecialPoint& point) {
    return point.after >= before && (point.value - first) * (first - from) > 0.0;
  });
  points.back() = points.front();
  end(BranchEnd::Kind::closed);
}

void Follower::run(PathPoint at) {
  step_ = options_.step;
  const Orbit first = at.orbit;
  const Extent extent(problem_, first);
  for (int count = 0; !ended_ && count < options_.most_points; ++count) {
    if (stopped(options_.stop)) return fail({.kind = BranchEnd::Kind::stopped, .value = value(at)});
    if (at.orbit.legs() > most_events)
      return fail({.kind = BranchEnd::Kind::too_many_events, .value = value(at), .limit = most_events});
    if (!inside(value(at) + step_ * at.watched.turn * range_)) {
      if (end_at_boundary(at)) return;
      step_ *= 0.5;
      if (step_ < shortest_step()) return end(BranchEnd::Kind::range);
      continue;
    }
    int newton = 0;
    std::string why = "Newton's method does not converge";
    std::optional<PathPoint> next = step_to(problem_, at, step_, range_, &newton, &why);
    const double bend = next ? at.tangent.dot(next->tangent) : -1.0;
    if (!next || !inside(value(*next)) || (bend < straight && step_ > 1e-4)) {
      step_ *= 0.5;
      if (step_ < shortest_step() && end_of_model(at)) return;
      if (step_ < shortest_step() && try_ways_on(at)) continue;
      if (step_ < shortest_step()) {
        if (at_end(value(at), structure * range_, at)) return end(BranchEnd::Kind::range);
        if (branch_.points.back().chatter)
          why += "; the onset of the chatter may be near, and no orbit was found beyond";
        return fail({.kind = BranchEnd::Kind::no_step, .value = value(at), .detail = why});
      }
      continue;
    }
    const double taken = step_;
    if (!accept(at, std::move(*next), taken)) return;
    if (step_ == taken)
      step_ = std::min(options_.longest_step, newton <= 4 && bend > 0.995 ? 1.5 * step_
                                              : newton > 6                ? 0.7 * step_
                                                                          : step_);
    if (options_.progress) options_.progress(value(at), static_cast<long>(branch_.points.size()));
    if (has_come_round(extent, first)) return close();
  }
  if (!ended_) fail({.kind = BranchEnd::Kind::most_points, .limit = options_.most_points});
}

Branch follow(const Problem& posed, const Orbit& start, const ContinuationOptions& options) {
  Problem problem = posed;
  problem.set_least(small_size * sizes(problem, start).head(problem.numbers()), options.to - options.from);
  const double value = start.values.at(0);
  if (!(value >= options.from && value <= options.to))
    throw InputError(problem.family().names[0] + " = " + shown(value) + " is outside the range " + shown(options.from) +
                     ":" + shown(options.to));
  const double range = options.to - options.from;
  const System system(problem.family().model(start.values));
  const Solution solution = describe(problem, start, &system);
  if (solution.family > kept_numbers(problem, start))
    throw NumericalError("the orbit is one of a family (a multiplier is 1): orbits lie beside it at the same " +
                         problem.family().names[0] + ", and there is no branch to follow");
  const PathPoint first = point_of(problem, start, range, {});
  Branch down, up;
  up.parameter = problem.family().names[0];
  up.points.push_back(solution);
  down.points.push_back(up.points.front());
  const auto run = [&](Branch& branch, const PathPoint& from) {
    try {
      Follower(problem, options, branch).run(from);
    } catch (const NumericalError& error) {  // what there is stays
      branch.up = {.kind = BranchEnd::Kind::refused,
                   .failed = true,
                   .value = branch.points.back().orbit.parameter(),
                   .detail = error.what()};
    }
    if (branch.up.kind == BranchEnd::Kind::special) branch.up.special = branch.special.size() - 1;
    sharpen_onsets(problem, branch.points, branch.special);
  };
  run(up, first);
  if (up.up.kind == BranchEnd::Kind::closed) {
    up.down = up.up;
    return up;
  }
  run(down, reversed(first));
  if (down.up.kind == BranchEnd::Kind::closed) {  // this way is the whole branch, and the other the same once more
    up.points.resize(1);
    up.special.clear();
    up.up = down.up;
  }
  const std::size_t below = down.special.size();
  if (up.up.special) *up.up.special += below;
  if (down.up.special) *down.up.special = below - 1 - *down.up.special;
  return joined(std::move(down), std::move(up), &Branch::special);
}

}  // namespace slapstick::orbit
