#include "slapstick/orbit/branch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "orbit/hidden.hpp"
#include "orbit/lies_on.hpp"
#include "orbit/normal_form.hpp"
#include "orbit/onset.hpp"
#include "orbit/path.hpp"
#include "orbit/record.hpp"
#include "orbit/reshape.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/special.hpp"
#include "orbit/two_ways.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

constexpr double shortest_for_pairs = 1e-4;  ///< arclength that may hold two special points of one type
constexpr double straight = 0.95;            ///< least cosine between the tangents of neighbouring points

/// Follows one direction from a point.
class Follower {
 public:
  Follower(const Problem& problem, const ContinuationOptions& options, Branch& branch)
      : problem_(problem), options_(options), range_(options.to - options.from), branch_(branch) {}

  void run(PathPoint at);

 private:
  [[nodiscard]] double value(const PathPoint& point) const { return point.orbit.values[0]; }
  /// The onset of a chatter is not come nearer to than its equations, of ever more impacts, are solvable.
  [[nodiscard]] double shortest_step() const {
    return branch_.points.back().chatter ? std::max(1e-6, options_.shortest_step) : options_.shortest_step;
  }
  [[nodiscard]] bool inside(double v) const { return v >= options_.from && v <= options_.to; }
  [[nodiscard]] Solution solution_of(const PathPoint& point, Verification* seen) const;
  bool accept(PathPoint& at, PathPoint next, double length);
  bool change_events(PathPoint& at, const PathPoint& beyond, double length, const std::string& why);
  void end_at(SpecialPoint special, const std::string& left, bool shorter, bool retraces);
  void go_on(PathPoint& at, SpecialPoint special, Reshaped next);
  bool leave_chatter(PathPoint& at);
  bool end_cascade(PathPoint& at);
  bool turn_round(PathPoint& at);
  void add_onset(SpecialPoint special, const std::string& outcome);
  void restart(PathPoint& at, PathPoint from);
  void look_for_pairs(const PathPoint& at, const PathPoint& next, double length);
  void add(std::vector<SpecialPoint> smooth, std::size_t after);
  bool end_at_boundary(PathPoint& at);
  bool runs_over_itself();
  void end(std::string why, bool failed);

  const Problem& problem_;
  const ContinuationOptions& options_;
  double range_;
  Branch& branch_;
  struct Before {
    PathPoint point;
    double length;  ///< from there to the next one
  };
  std::optional<Before> before_;
  /// The first point behind the onset of a chatter, in the other direction, and what the branch had then.
  struct Onset {
    PathPoint other_way;
    std::size_t points, special;
  };
  std::optional<Onset> onset_;
  double step_ = 0.0;
  int old_points_ = 0;  ///< latest points that lie on the branch as it was followed before
  bool ended_ = false;
};

void Follower::end(std::string why, bool failed) {
  branch_.ended = std::move(why);
  branch_.failed = failed;
  ended_ = true;
}

/// Runs the simulator over the cycle. Where only the number of impacts before a chatter's sum has changed, `seen` has the orbit as it is now.
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
  if (!before_ || !(before_->point.orbit.shape.legs == next.orbit.shape.legs)) return;
  Pair pair = pair_within(problem_, {before_->point, at, next, before_->length, length}, range_);
  add(std::move(pair.points), branch_.points.size() - (pair.earlier ? 2 : 1));
}

/// Notes special points that leave the events as they are. A branch ends where its orbit becomes a shorter one run through twice, or the symmetric
/// one behind which it has the mirror images of its orbits.
void Follower::add(std::vector<SpecialPoint> smooth, std::size_t after) {
  constexpr double merged = 1e-3;  // at a fold or crossing that is known to 1e-10 in the parameter, states are to 1e-5
  for (SpecialPoint& special : smooth) {
    const bool doubling =
        (special.type == SpecialType::LP || special.type == SpecialType::BP) && repeats(special.solution.orbit, merged);
    special.after = after;
    if (doubling) {
      special.type = SpecialType::PD;
      special.birth = true;
      special.born.clear();
      special.what = "the branch leaves a shorter orbit, which doubles";
      end("meets the orbit of which it is the double at " + shown(special.value), false);
    } else if (special.type != SpecialType::BP)
      special.normal_form = normal_form(problem_, special);
    if (special.type == SpecialType::BP && images_begin(problem_, branch_.points.back().orbit, special.solution.orbit))
      end("behind the symmetric orbit at " + shown(special.value) + " are the mirror images of this branch's", false);
    branch_.special.push_back(std::move(special));
    if (ended_) return;
  }
}

/// The last point of a branch is on the boundary of the range, if the tangent leads there. @returns false if the branch goes on
bool Follower::end_at_boundary(PathPoint& at) {
  const double wall = at.watched.turn > 0.0 ? options_.to : options_.from;
  const double length = (wall - value(at)) / (at.watched.turn * range_);
  if (length < 1e-12) {
    end("range", false);
    return true;
  }
  Orbit last = at.orbit;
  const ModeSet set(problem_.family(), last.values);
  move(problem_, linearise(problem_, set, last), length * at.tangent.cwiseProduct(at.units), 0.0, last);
  last.values[0] = wall;
  const std::optional<Orbit> orbit = refine(problem_, last);
  if (!orbit) return false;
  PathPoint next = point_of(problem_, *orbit, range_, at.tangent);
  if (at.tangent.dot(next.tangent) < straight) return false;
  if (!accept(at, std::move(next), length)) return true;
  if (value(at) != wall) return false;  // the events have changed on the way
  end("range", false);
  return true;
}

/// After a crossing a branch may come upon itself. It ends there, without the points that it has twice.
bool Follower::runs_over_itself() {
  constexpr std::size_t neighbours = 10;
  constexpr int certain = 5;  // one or two may be near: where branches cross, at folds
  const std::size_t count = branch_.points.size();
  const bool old = count > neighbours && lies_on_first(count - neighbours, branch_, branch_.points.back().orbit);
  old_points_ = old ? old_points_ + 1 : 0;
  if (old_points_ < certain) return false;
  branch_.points.resize(count - certain);
  std::erase_if(branch_.special, [&](const SpecialPoint& special) { return special.after >= branch_.points.size(); });
  end("runs over itself from " + shown(branch_.points.back().orbit.values[0]) + " on", false);
  return true;
}

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
  std::vector<Reshaped> found;
  if (options_.through_changes) found = reshape(problem_, at.orbit, change->at, change->test, range_, options_.stop);
  std::string left;  // where a stable motion goes when there is no branch
  if (found.empty() && options_.through_changes && branch_.points.back().stable()) {
    Behind there = behind(problem_, at.orbit, change->at, range_, options_.stop);
    left = there.what;
    if (there.next) found.push_back(std::move(*there.next));
  }
  const bool shorter = std::ranges::any_of(found, [](const Reshaped& next) { return repeats(next.point.orbit, 1e-6); });
  const bool retraces = !found.empty() && lies_on_first(branch_.points.size(), branch_, found.front().point.orbit);
  if (found.empty() || shorter || retraces) {
    end_at(std::move(special), left, shorter, retraces);
    return false;
  }
  for (std::size_t i = 1; i < found.size(); ++i) special.born.push_back(found[i].point.orbit);
  go_on(at, std::move(special), std::move(found.front()));
  return true;
}

/// The branch ends where its events change. @param left  what the motion goes over to, if that is known
void Follower::end_at(SpecialPoint special, const std::string& left, bool shorter, bool retraces) {
  std::string why = "the events change";
  bool failed = false;
  if (shorter) {
    special.outcome = why = "from there on it is a shorter orbit, run through more than once";
  } else if (retraces) {
    special.outcome = "the branch as it came";
    why = "from there on the branch runs back over itself";
  } else if (!options_.through_changes) {
    special.outcome = "not followed";
    failed = true;
  } else if (!left.empty()) {
    special.outcome = "jump to " + left;
    why = "a jump: the motion goes over to " + left;
  } else {
    special.outcome = "none found";
    why = "no orbit was found beyond, a jump or a failure of the search";
    failed = true;
  }
  end(std::string(name(special.type)) + " at " + shown(special.value) + ": " + why, failed);
  branch_.special.push_back(std::move(special));
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
  if (next && lies_on(branch_, next->point.orbit)) next.reset();
  add_onset(std::move(special), next ? "persistence" : "the branch ends");
  if (next)
    restart(at, std::move(next->point));
  else
    end("CH at " + shown(limit->value) + ": a cascade, which gathers there", false);
  return true;
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

/// .. or goes on with new ones.
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

/// Takes a step, or makes it shorter. @returns false if the branch ends
bool Follower::accept(PathPoint& at, PathPoint next, double length) {
  Verification seen;
  Solution solution;
  try {
    solution = solution_of(next, &seen);
  } catch (const std::runtime_error& error) {
    end(error.what(), true);
    return false;
  }
  if (!solution.is_motion) return change_events(at, next, length, solution.why);
  std::vector<SpecialPoint> smooth = smooth_special_points(problem_, at, next, length, range_);
  if (length > shortest_for_pairs && !explained(at.watched, next.watched, smooth)) {
    step_ = 0.5 * length;
    return true;
  }
  if (smooth.empty()) look_for_pairs(at, next, length);
  add(std::move(smooth), branch_.points.size() - 1);
  if (ended_) return false;
  before_ = Before{at, length};
  branch_.points.push_back(std::move(solution));
  if (runs_over_itself()) return false;
  if (!seen.same_chatter && !seen.seen.shape.legs.empty()) {
    Orbit renewed = seen.seen;
    renewed.values = next.orbit.values;
    if (auto orbit = refine(problem_, renewed)) {
      const bool grows = next.watched.turn > 0.0;
      next = point_of(problem_, *orbit, range_, {});
      if ((next.watched.turn > 0.0) != grows) next = point_of(problem_, *orbit, range_, VectorXd(-next.tangent));
    }
  }
  at = std::move(next);
  return true;
}

void Follower::run(PathPoint at) {
  step_ = options_.step;
  const Orbit first = at.orbit;
  for (int count = 0; !ended_ && count < options_.most_points; ++count) {
    if (stopped(options_.stop)) return end("stopped", true);
    if (!inside(value(at) + step_ * at.watched.turn * range_)) {
      if (end_at_boundary(at)) return;
      step_ *= 0.5;
      if (step_ < shortest_step()) return end("range", false);
      continue;
    }
    int newton = 0;
    std::string why = "Newton's method does not converge";
    std::optional<PathPoint> next = step_to(problem_, at, step_, range_, &newton, &why);
    const double bend = next ? at.tangent.dot(next->tangent) : -1.0;
    if (!next || !inside(value(*next)) || (bend < straight && step_ > 1e-4)) {
      step_ *= 0.5;
      if (step_ < shortest_step() && (leave_chatter(at) || turn_round(at) || end_cascade(at))) continue;
      if (step_ < shortest_step()) {
        if (branch_.points.back().chatter)
          why += "; the onset of the chatter may be near, and no orbit was found beyond";
        return end("behind " + problem_.family().names[0] + " = " + shown(value(at)) + ": " + why, true);
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
    const std::size_t last = branch_.points.size() - 1;
    if (last > 3 && between(branch_.points[last - 1].orbit, branch_.points[last].orbit, first))
      return end("closed", false);
  }
  if (!ended_) end(std::to_string(options_.most_points) + " points each way, the most allowed", true);
}

}  // namespace

Branch follow(const Problem& problem, const Orbit& start, const ContinuationOptions& options) {
  const double value = start.values.at(0);
  if (!(value >= options.from && value <= options.to))
    throw InputError(problem.family().names[0] + " = " + shown(value) + " is outside the range " + shown(options.from) +
                     ":" + shown(options.to));
  const double range = options.to - options.from;
  const System system(problem.family().model(start.values));
  const Solution solution = describe(problem, start, &system);
  if (!solution.isolated())
    throw NumericalError("the orbit is one of a family (a multiplier is 1): orbits lie beside it at the same " +
                         problem.family().names[0] + ", and there is no branch to follow");
  const PathPoint first = point_of(problem, start, range, {});
  Branch down, up;
  up.points.push_back(solution);
  down.points.push_back(up.points.front());
  Follower(problem, options, up).run(first);
  if (up.ended == "closed") return up;
  Follower(problem, options, down).run(reversed(first));
  return joined(std::move(down), std::move(up), &Branch::special);
}

}  // namespace slapstick::orbit
