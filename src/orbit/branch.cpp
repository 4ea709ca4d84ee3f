#include "slapstick/orbit/branch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "orbit/lies_on.hpp"
#include "orbit/normal_form.hpp"
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

int outside(const Watched& watched) {
  constexpr double clear = 1e-7;  // of the circle: what lies on it all along is nothing that passes
  return static_cast<int>(
      std::ranges::count_if(watched.multipliers, [](const auto& mu) { return std::abs(mu) > 1.0 + clear; }));
}

/// Do the special points between two points of a branch account for the multipliers that have passed the unit circle? Where a pair of special
/// points of one type lies between them, their test functions show nothing.
bool explained(const Watched& from, const Watched& to, const std::vector<SpecialPoint>& between) {
  int most = 0;
  for (const SpecialPoint& special : between) most += special.type == SpecialType::NS ? 2 : 1;
  return std::abs(outside(to) - outside(from)) <= most;
}

/// Is a leg's length less than this part of what it was?
bool shrinks(const Orbit& from, const Orbit& to, double part) {
  for (std::size_t i = 0; i < from.legs(); ++i)
    if (to.duration(i) < part * from.duration(i)) return true;
  return false;
}

/// Follows one direction from a point.
class Follower {
 public:
  Follower(const Problem& problem, const ContinuationOptions& options, Branch& branch)
      : problem_(problem), options_(options), range_(options.to - options.from), branch_(branch) {}

  void run(PathPoint at);

 private:
  [[nodiscard]] double value(const PathPoint& point) const { return point.orbit.values[0]; }
  [[nodiscard]] bool inside(double v) const { return v >= options_.from && v <= options_.to; }
  [[nodiscard]] Solution solution_of(const PathPoint& point, Verification* seen) const;
  bool accept(PathPoint& at, PathPoint next, double length);
  bool change_events(PathPoint& at, const PathPoint& beyond, double length, const std::string& why);
  void end_at(SpecialPoint special, const std::string& left, bool shorter, bool retraces);
  void go_on(PathPoint& at, SpecialPoint special, Reshaped next);
  [[nodiscard]] SpecialPoint onset(const Reshaped& next, const Solution& nearest) const;
  bool leave_chatter(PathPoint& at);
  void look_beside_change(const PathPoint& from, double length);
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

/// A test function that comes near zero and turns back may have passed it twice. Looks at the vertex of the parabola through three neighbouring points.
void Follower::look_for_pairs(const PathPoint& at, const PathPoint& next, double length) {
  constexpr std::array<double Watched::*, 3> functions = {&Watched::flip, &Watched::torus, &Watched::turn};
  if (!before_ || !(before_->point.orbit.shape.legs == next.orbit.shape.legs)) return;
  const double back = before_->length;
  for (const auto f : functions) {
    const double a = before_->point.watched.*f, b = at.watched.*f, c = next.watched.*f;
    if (!(a * b > 0.0 && b * c > 0.0 && std::abs(b) <= std::abs(a) && std::abs(b) <= std::abs(c))) continue;
    const double left = (b - a) / back, right = (c - b) / length, bend = 2.0 * (right - left) / (back + length);
    const double slope = (left * length + right * back) / (back + length), vertex = -slope / bend;
    if (!(std::abs(vertex) > 0.0)) continue;
    const bool earlier = vertex < 0.0;
    const PathPoint& from = earlier ? before_->point : at;
    const PathPoint& to = earlier ? at : next;
    const double whole = earlier ? back : length, part = earlier ? back + vertex : vertex;
    const std::optional<PathPoint> middle = step_to(problem_, from, part, range_);
    if (!middle || !(middle->watched.*f * b < 0.0)) continue;
    const std::size_t after = branch_.points.size() - (earlier ? 2 : 1);
    add(smooth_special_points(problem_, from, *middle, part, range_), after);
    add(smooth_special_points(problem_, *middle, to, whole - part, range_), after);
    return;
  }
}

/// Special points between a point of the branch and a change of events at `length` from there. An impact that loses its speed lets a multiplier grow
/// without bound: one that doubles lies close by. Where a leg shrinks to nothing the equations are singular: not so close.
void Follower::look_beside_change(const PathPoint& from, double length) {
  constexpr double nothing = 1e-3;
  for (const double part : {1.0 - 1e-6, 1.0 - 1e-2}) {
    const std::optional<PathPoint> last = step_to(problem_, from, part * length, range_);
    if (!last || shrinks(from.orbit, last->orbit, nothing)) continue;
    return add(smooth_special_points(problem_, from, *last, part * length, range_), branch_.points.size() - 1);
  }
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
  if (!change) {
    if (length > options_.shortest_step) {
      step_ = 0.25 * length;
      return true;
    }
    end("the motion has other events than the orbit behind " + problem_.family().names[0] + " = " + shown(value(at)) +
            " (" + why + ")",
        true);
    return false;
  }
  look_beside_change(at, change->length);
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

/// A complete chatter begins or ends: where infinitely many changes gather.
SpecialPoint Follower::onset(const Reshaped& next, const Solution& nearest) const {
  SpecialPoint special;
  special.type = SpecialType::CH;
  special.value = 0.5 * (next.gathering->first + next.gathering->second);
  special.error = next.gathering->second - next.gathering->first;
  special.solution = nearest;
  special.what = "infinitely many changes gather at the onset of a complete chatter";
  special.outcome = next.folds ? "non-smooth fold" : "persistence";
  special.after = branch_.points.size() - 1;
  return special;
}

/// Near its onset a chatter's equations are hardly solvable. Looks for the orbits behind the onset. @returns false if there are none
bool Follower::leave_chatter(PathPoint& at) {
  const std::size_t count = branch_.points.size();
  if (!options_.through_changes || count < 2 || !branch_.points.back().chatter) return false;
  const Orbit& before = branch_.points[count - 2].orbit;
  std::vector<Reshaped> found = reshape(problem_, before, at, TestValue{}, range_, options_.stop);
  std::erase_if(found, [](const Reshaped& next) { return !next.gathering || next.folds; });
  if (found.empty()) return false;
  branch_.special.push_back(onset(found.front(), branch_.points.back()));
  at = std::move(found.front().point);
  branch_.points.push_back(solution_of(at, nullptr));
  step_ = options_.step;
  return true;
}

/// .. or goes on with new ones.
void Follower::go_on(PathPoint& at, SpecialPoint special, Reshaped next) {
  special.outcome = next.folds ? "non-smooth fold" : "persistence";
  Solution first = solution_of(next.point, nullptr);
  if (next.gathering) {
    SpecialPoint here = onset(next, special.solution);
    special.outcome = "one of infinitely many changes";
    if (first.chatter) branch_.special.push_back(special);
    branch_.special.push_back(std::move(here));
    if (!first.chatter) branch_.special.push_back(std::move(special));
  } else if (!next.renewed) {
    branch_.special.push_back(std::move(special));
    if (next.length > 0.0) look_beside_change(reversed(next.point), next.length);
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
      if (step_ < options_.shortest_step) return end("range", false);
      continue;
    }
    int newton = 0;
    std::string why = "Newton's method does not converge";
    std::optional<PathPoint> next = step_to(problem_, at, step_, range_, &newton, &why);
    const double bend = next ? at.tangent.dot(next->tangent) : -1.0;
    if (!next || !inside(value(*next)) || (bend < straight && step_ > 1e-4)) {
      step_ *= 0.5;
      if (step_ < options_.shortest_step && leave_chatter(at)) continue;
      if (step_ < options_.shortest_step)
        return end("behind " + problem_.family().names[0] + " = " + shown(value(at)) + ": " + why, true);
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

std::string_view name(SpecialType type) {
  constexpr std::array<std::string_view, 8> names = {"LP", "PD", "NS", "BP", "GR", "SL", "CH", "CO"};
  return names[static_cast<std::size_t>(type)];
}

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
