/// Runs motions that start on an orbit, and says where they settle.
#include "change/jump.hpp"

#include <cmath>

#include "flow/contact_state.hpp"
#include "orbit/extent.hpp"
#include "orbit/record.hpp"
#include "orbit/same_motion.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::orbit {

using Eigen::VectorXd;

std::optional<Motion> motion_from(const System& system, const ModeSet& set, const Orbit& orbit, std::size_t leg,
                                  double part) {
  const VectorXd X = state_within(set, orbit, leg, part * orbit.duration(leg));
  for (const mode::Guard& guard : set.mode(orbit.shape.legs[leg].states).outline.guards)
    if (guard.row.dot(X) <= 0.0) return std::nullopt;
  return from_inside(system, set, orbit, leg, part);
}

namespace {

constexpr long transient = 500;  ///< cycles that a motion is given to settle

/// A motion from the orbit at a change, run at the parameter + `move`: the orbit that it settles on, and
/// whether it has left the place where it was.
struct Course {
  std::optional<Solution> settled;
  bool left = false;
};

/// By parts of the orbit's extent, and of the least sizes by which its branch is measured: one that dies out leaves
/// itself over hardly any distance.
bool has_left(const Problem& problem, const Orbit& orbit, VectorXd from, VectorXd to) {
  constexpr double distance_left = 0.01;
  if (!(Extent(problem, orbit).distance(from, to) > distance_left)) return false;
  problem.translations().take_out(from);
  problem.translations().take_out(to);
  const VectorXd moved = problem.translations().numbers(to) - problem.translations().numbers(from);
  return (moved.array().abs() > distance_left * problem.least_sizes().array()).any();
}

Course course_behind(const Problem& problem, const PathPoint& change, double move, const std::atomic<bool>* stop) {
  Course course;
  try {
    std::vector<double> values = change.orbit.values;
    values[0] += move;
    const auto there = pose(problem.family(), values);
    const System system(problem.family().model(values));
    const ModeSet set(constant_family(system.model()), {});
    for (std::size_t leg = 0; leg < change.orbit.legs(); ++leg) {
      std::optional<Motion> motion = motion_from(system, set, change.orbit, leg, 0.5);
      if (!motion) continue;
      const double cycle = change.orbit.t.back() - change.orbit.t.front();
      const auto while_it_settles = static_cast<long>(std::ceil(static_cast<double>(transient) * cycle));
      course.settled = orbit_near(*there, *motion, while_it_settles, 0, stop);
      const VectorXd start = flow::contact_state(*motion);
      const Instant end = motion->time().plus(static_cast<double>(while_it_settles));
      const bool ran = run_to(*motion, end, stop, [] {});
      course.left = ran && has_left(problem, change.orbit, start, flow::contact_state(*motion));
      return course;
    }
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
  return course;
}

constexpr double shrinks = 0.3;  ///< a hundred times nearer, what grows like a root of the distance is a tenth

/// Has an orbit hardly moved from a change just beyond it: the same long legs, in either?
bool goes_on(const Problem& problem, const PathPoint& change, const Orbit& orbit) {
  constexpr double hardly_moved = 1e-3;  // of a leg's state
  return resembles(problem, orbit, change.orbit, hardly_moved) || resembles(problem, change.orbit, orbit, hardly_moved);
}

/// Does a motion settle elsewhere, however near to the change?
bool settles_elsewhere(const Problem& problem, const PathPoint& change, const Course& course, double nearer,
                       const std::atomic<bool>* stop) {
  constexpr double noticed = 1e-3;
  const auto off = [&](const Course& found) {
    if (!found.settled || goes_on(problem, change, found.settled->orbit)) return 0.0;
    return std::min(1.0, apart(problem, change.orbit, found.settled->orbit));
  };
  const double first = off(course);
  return first > noticed && off(course_behind(problem, change, nearer, stop)) > shrinks * first;
}

}  // namespace

MotionBeyond run_beyond(const Problem& problem, const PathPoint& change, double range, const std::atomic<bool>* stop) {
  const double sense = std::copysign(1.0, change.watched.turn);
  MotionBeyond result;
  for (const double distance : {1e-6, 1e-5, 1e-4}) {
    Course course = course_behind(problem, change, sense * distance * range, stop);
    result.family = course.settled && course.settled->family > static_cast<int>(change.watched.kept.size());
    if (course.settled) {
      const Orbit& orbit = course.settled->orbit;
      const bool like = goes_on(problem, change, orbit);
      if (like && orbit.shape.n != change.orbit.shape.n) {  // beside it, but not its successor
        result.jump = Jump{Jump::Kind::settles, course.settled->label, 0};
        return result;
      }
      if (like) {
        result.next = HalfBranch{point_of(problem, orbit, range, {}), false, false, {}, 0.0, 0.0, 0.0};
        if (result.next->point.watched.turn * sense < 0.0) result.next->point = reversed(std::move(result.next->point));
        return result;
      }
    }
    const double nearer = sense * 0.01 * distance * range;
    if (!course.left && !settles_elsewhere(problem, change, course, nearer, stop)) continue;
    const bool stays = course.settled && (course.settled->stable() || result.family);
    result.jump =
        stays ? Jump{Jump::Kind::settles, course.settled->label, 0} : Jump{Jump::Kind::wanders, {}, transient};
    return result;
  }
  return result;
}

namespace {

/// The states in the middles of the later legs of a motion that begins before the change. Empty if it cannot start.
std::vector<VectorXd> later(const Problem& problem, Orbit orbit, const TestValue& test) {
  const System system(problem.family().model(orbit.values));
  const ModeSet set(constant_family(system.model()), {});
  const bool at_start = test.test == Test::guard && !(test.at > 0.0);
  rotate(orbit, at_start ? (test.leg + orbit.legs() - 1) % orbit.legs() : test.leg);
  const bool within = test.test == Test::guard && !at_start;
  std::optional<Motion> motion = motion_from(system, set, orbit, 0, within ? 0.5 * test.at / orbit.duration(0) : 0.5);
  std::vector<VectorXd> states;
  for (std::size_t i = 1; motion && i < orbit.legs(); ++i) {
    while (motion->advance(Instant{}.plus(orbit.t[i] + 0.5 * orbit.duration(i))) == Outcome::event) {
    }
    states.push_back(flow::contact_state(*motion));
  }
  return states;
}

/// An orbit of the events before the change, so far from it along the branch. Where that is singular, or turns back as
/// two zeros of a guard become one, the change's own with another value of the parameter.
Orbit displaced(const Problem& problem, const PathPoint& change, const TestValue& test, double length, double range) {
  if (test.test != Test::speed)
    if (auto point = step_to(problem, change, length, range)) return std::move(point->orbit);
  Orbit orbit = change.orbit;
  orbit.parameter() += length * range;
  return orbit;
}

/// How far motions a little to either side of the change come from one another, against the orbit's extent.
double departure(const Problem& problem, const PathPoint& change, const TestValue& test, double length, double range) {
  const std::vector<VectorXd> here = later(problem, displaced(problem, change, test, -length, range), test),
                              there = later(problem, displaced(problem, change, test, length, range), test);
  const Extent extent(problem, change.orbit);
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i)
    most = std::max(most, extent.distance(here[i], there[i]));
  return most;
}

}  // namespace

bool departs(const Problem& problem, const PathPoint& change, const TestValue& test, double range) {
  constexpr double offset = 1e-7, least_departure = 1e-5;
  if (change.orbit.legs() < 2 || test.test == Test::duration) return false;
  try {
    const double first = departure(problem, change, test, offset, range);
    return first > least_departure && departure(problem, change, test, 0.01 * offset, range) > shrinks * first;
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
  return false;
}

}  // namespace slapstick::orbit
