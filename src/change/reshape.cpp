/// Finds the orbits beyond a change of events.
#include "change/reshape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/ranges.hpp"
#include "change/coincident.hpp"
#include "change/jump.hpp"
#include "change/locate_margin.hpp"
#include "change/nearby_shapes.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"
#include "orbit/record.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/short_legs.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;

constexpr std::size_t most_held = 4;  ///< legs whose length is held in turn

/// Newton's method from a guess: at its own parameter, and with the parameter free and the length of one of the
/// shortest legs held.
std::optional<Orbit> solved(const Problem& problem, const Orbit& guess) {
  if (auto orbit = refine(problem, guess); orbit && is_motion(problem, *orbit)) return orbit;
  std::vector<std::size_t> events(guess.legs());
  std::iota(events.begin(), events.end(), std::size_t{1});
  ranges::sort(events, {}, [&](std::size_t event) { return guess.duration(event - 1); });
  if (events.size() > most_held) events.resize(most_held);
  for (const std::size_t event : events) {
    Orbit orbit = guess;
    if (solve(problem, orbit, fixed_length(problem, orbit.legs(), event - 1), 20).converged &&
        is_motion(problem, orbit))
      return orbit;
  }
  return std::nullopt;
}

/// Has Newton's method led to no other orbit than where it began?
bool stayed(const Problem& problem, const Orbit& from, const Orbit& to) {
  constexpr double same_place =
      1e-2;  // of extent and cycle: where legs die out the last orbit is a little before the place
  const Extent extent(problem, from);
  for (std::size_t i = 0; i < from.legs(); ++i)
    if (extent.distance(from.x[i], to.x[i]) > same_place ||
        std::abs(to.t[i] - from.t[i]) > same_place * (from.t.back() - from.t.front()))
      return false;
  return true;
}

constexpr double flat = 1e-3;  ///< a tangent's component in the parameter that says nothing of its sense

/// Does a branch go from its start at a change, by a later point, in the sense of the parameter from which the old one
/// came? The later point may lie beyond a fold. The tangent at the change may be rounding: it is used if a neighbouring
/// tangent agrees.
bool goes_back(const Problem& problem, const PathPoint& start, const PathPoint& later, double sense_before,
               double range) {
  constexpr double step_beside = 1e-7, change_of_turn = 0.1;
  const double turn = start.watched.turn;
  const auto beside = std::abs(turn) > flat ? step_to(problem, start, step_beside, range) : std::nullopt;
  if (beside && std::abs(beside->watched.turn - turn) < change_of_turn * std::abs(turn))
    return turn * sense_before < 0.0;
  return (later.orbit.parameter() - start.orbit.parameter()) * sense_before < 0.0;
}

/// Where the parameter is a square of the arclength, a point from which its sense is seen (special.cpp, look_back).
std::optional<PathPoint> some_way_off(const Problem& problem, const PathPoint& start, double range) {
  constexpr double way = 1e-4;
  return std::abs(start.watched.turn) < flat ? step_to(problem, start, way, range) : std::nullopt;
}

/// Does a leg end at a guard's second zero, at which it rises? Just beyond a graze both are one instant to the
/// simulator.
bool rises_at_an_end(const PathPoint& start, const PathPoint& next) {
  for (std::size_t i = 0; i < next.watched.tests.size(); ++i) {
    const double rounding = 2.0 * std::abs(start.watched.tests[i].value);
    if (next.watched.tests[i].test == Test::speed && next.watched.tests[i].value < -rounding) return true;
  }
  return false;
}

/// The branch of a shape that the orbit at the change has already, by arclength to either side of it: as near as the
/// simulator can tell what it does.
std::optional<HalfBranch> branch_at(const Problem& problem, double sense_before, const Orbit& shape, double range) {
  Orbit orbit = shape;
  const NewtonResult result = solve(problem, orbit, fixed_parameters(problem, orbit.legs()), 12);
  if (!result.refusal.empty()) return std::nullopt;  // pieces that make no cycle
  if (!result.converged) orbit = shape;              // singular at the change itself: it is the solution
  if (!stayed(problem, shape, orbit)) return std::nullopt;
  const PathPoint up = point_of(problem, orbit, range, {});
  for (const PathPoint& start : {up, reversed(up)}) {
    for (const double length : {1e-6, 1e-5, 1e-4, 1e-3, 5e-3}) {
      std::optional<PathPoint> next = step_to(problem, start, length, range);
      if (!next || rises_at_an_end(start, *next) || !is_motion(problem, next->orbit)) continue;
      const std::optional<PathPoint> farther = some_way_off(problem, start, range);
      const bool folds = goes_back(problem, start, farther ? *farther : *next, sense_before, range);
      return HalfBranch{std::move(*next), folds, false, {}, length, 0.0, 0.0};
    }
  }
  return std::nullopt;
}

/// Where the events of a new orbit's branch begin, and by which margin, as it is there.
struct Beginning {
  Located located;
  TestValue test;
};

/// Followed back towards the change; empty if that is not there.
/// @param same  how far off it may be, of the range
std::optional<Beginning> beginning(const Problem& problem, const PathPoint& next, double critical, double same,
                                   double range) {
  const PathPoint back = reversed(next);
  const std::vector<TestValue>& tests = back.watched.tests;
  const double turn = std::abs(next.watched.turn);
  const double near = turn > 0.0 ? std::abs(next.orbit.parameter() - critical) / (turn * range) : 0.0;
  for (double length : {1.5 * near, 4.0 * near, 20.0 * near}) {
    if (!(length > 0.0) || length > 0.05) break;
    const std::optional<PathPoint> beyond = step_to(problem, back, length, range);
    if (!beyond) continue;
    const auto first = [&](const auto& locate_test) -> std::optional<Beginning> {
      for (std::size_t i = 0; i < tests.size(); ++i) {
        if (!(tests[i].value > 0.0) || !(beyond->watched.tests[i].value < 0.0)) continue;
        auto located = locate_test(i);
        if (!located || std::abs(located->point.orbit.parameter() - critical) >= same * range) continue;
        const TestValue there = located->point.watched.tests[i];
        return Beginning{std::move(*located), there};
      }
      return std::nullopt;
    };
    const auto directly = [&](std::size_t i) {
      const auto value = [i](const Watched& watched) { return watched.tests[i].value; };
      return locate(problem, back, length, range, value, value(beyond->watched));
    };
    const auto by_interpolation = [&](std::size_t i) {
      return locate_margin(problem, back, *beyond, length, range, i);
    };
    if (auto found = first(directly)) return found;
    if (chatters(next.orbit) > 0) continue;  // hundreds of margins
    if (auto found = first(by_interpolation)) return found;
  }
  return std::nullopt;
}

bool releases(const TestValue& test) { return test.test == Test::guard && test.kind == mode::GuardKind::press; }

/// The onset of a chatter, of the orbit at a change or of the one beyond it.
/// Where a chatter's limit meets a point of a signal the onset is the change itself.
/// Elsewhere it is known by the other orbit, without chatter, which is followed to where that lets a contact go.
OnsetInterval onset_between(const PathPoint& change, const std::optional<TestValue>& test, const Orbit& orbit,
                            const std::optional<Beginning>& begins) {
  const double critical = change.orbit.parameter();
  const bool meets_knot = test && test->test == Test::duration && rests_to_knot(change.orbit.shape, test->leg);
  if (meets_knot && chatters(orbit) < chatters(change.orbit)) return {critical, critical, false, true};
  if (chatters(orbit) > chatters(change.orbit) && test && releases(*test)) return {critical, critical, true};
  if (!begins) return {critical, orbit.parameter(), false};
  const double there = begins->located.point.orbit.parameter();
  const double error = begins->test.value == 0.0 ? 0.0 : begins->located.error;
  if (chatters(change.orbit) > chatters(orbit) && releases(begins->test)) return {there - error, there + error, true};
  return {critical, there, false};
}

/// The point of a new orbit, led away from the change; empty if it does not come from there. Between orbits with a
/// complete chatter and without lie infinitely many changes, which gather where the one with the chatter begins: there
/// the nearest of them stands for all.
std::optional<HalfBranch> born(const Problem& problem, const PathPoint& change, const std::optional<TestValue>& test,
                               double sense_before, const Orbit& orbit, double length, double range) {
  constexpr double nearer = 0.5;  // than the orbit itself
  constexpr double gathering = 30.0, much_the_same = 0.01, alike = 0.1;
  const double critical = change.orbit.parameter(), away = orbit.parameter() - critical;
  if (away == 0.0 || std::abs(away) > 10.0 * length * range) return std::nullopt;
  HalfBranch next{point_of(problem, orbit, range, {}), away * sense_before < 0.0, false, {}, 0.0, 0.0, 0.0};
  if (next.point.watched.turn * away < 0.0) next.point = reversed(std::move(next.point));
  const bool chatter = chatters(orbit) + chatters(change.orbit) > 0,
             gathers = chatters(orbit) != chatters(change.orbit);
  const double within = gathers ? gathering * length : std::max(same_change, nearer * std::abs(away) / range);
  const auto off = [&](const Beginning& place) { return std::abs(place.located.point.orbit.parameter() - critical); };
  auto begins = beginning(problem, next.point, critical, within, range);
  if ((!begins || off(*begins) > place_tolerance * range) && !gathers) {  // beyond a fold near the change
    PathPoint other = reversed(next.point);
    auto behind = beginning(problem, other, critical, nearer * std::abs(away) / range, range);
    if (behind && (!begins || off(*behind) < off(*begins))) {
      begins = std::move(behind);
      next.point = std::move(other);
    }
  }
  if (!begins && !(chatter && resembles(problem, orbit, change.orbit, much_the_same))) return std::nullopt;
  if (begins && gathers && !resembles(problem, orbit, change.orbit, alike)) return std::nullopt;
  next.renewed = chatter && !gathers && !begins;
  if (begins) {
    if (!gathers) next.folds = goes_back(problem, reversed(begins->located.point), next.point, sense_before, range);
    next.length = begins->located.length;
    next.distance_from_change = off(*begins);
    next.error = begins->located.error;
  }
  if (gathers) next.onset = onset_between(change, test, orbit, begins);
  return next;
}

/// Does its branch begin at the change, as far as that can be told from it?
bool begins_there(const HalfBranch& next, double range) {
  return next.onset || next.renewed || next.distance_from_change <= same_change * range;
}

/// Each cycle once: the first that begins at the change, or else the one that begins nearest to it.
void add(std::vector<HalfBranch>& all, std::optional<HalfBranch> next, double range) {
  if (!next) return;
  const auto same = [&](const HalfBranch& other) {
    return other.folds == next->folds && same_cycle(other.point.orbit, next->point.orbit);
  };
  const auto known = ranges::find_if(all, same);
  if (known == all.end())
    all.push_back(std::move(*next));
  else if (!begins_there(*known, range) && next->distance_from_change < known->distance_from_change)
    *known = std::move(*next);
}

}  // namespace

bool rests_to_knot(const Itinerary& shape, std::size_t leg) {
  const Leg &rest = shape.legs[leg], &before = shape.legs[(leg + shape.legs.size() - 1) % shape.legs.size()];
  return rest.ending == Ending::knot && before.ending == Ending::chatter;
}

std::vector<HalfBranch> branches_at(const Problem& problem, const PathPoint& change, const std::vector<Orbit>& shapes,
                                    double range) {
  std::vector<HalfBranch> all;
  const double sense = std::copysign(1.0, change.watched.turn);
  try {
    for (const Orbit& shape : shapes) add(all, branch_at(problem, sense, shape, range), range);
  } catch (const NumericalError&) {  // a shape whose modes have no such guards
  } catch (const InputError&) {
  }
  ranges::stable_sort(all, {},
                      &HalfBranch::length);  // what is a motion farther off only has changed once more on the way
  return all;
}

std::vector<HalfBranch> branches_at(const Problem& problem, const Orbit& before, const PathPoint& change,
                                    const TestValue& test, double range) {
  try {
    return branches_at(problem, change, sequences_of_same_orbit(problem, before, change.orbit, test), range);
  } catch (const NumericalError&) {
  } catch (const InputError&) {
  }
  return {};
}

std::vector<HalfBranch> find_branches_beyond(const Problem& problem, const Orbit& before, const PathPoint& change,
                                             const std::optional<TestValue>& test, double range,
                                             const std::atomic<bool>* stop, double nearest) {
  const double critical = change.orbit.parameter();
  const double sense = std::copysign(1.0, change.watched.turn);  // a secant may span a fold
  std::vector<HalfBranch> all;
  if (test) all = branches_at(problem, before, change, *test, range);
  const double longest =
      chatters(change.orbit) > 0 ? 1e-2 : 1e-3;  // near its onset a chatter's equations are hardly solvable
  // Just beyond a release the hops of a chatter are rounding.
  const bool release = test && releases(*test) && chatters(change.orbit) == 0;
  const std::vector<double> lengths =
      release ? std::vector{1e-4, 1e-3, 1e-5, 1e-6} : std::vector{1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2};
  for (const double length : lengths) {
    if (length < nearest) continue;
    const auto here = [&](const HalfBranch& next) { return begins_there(next, range); };
    if (ranges::any_of(all, here) || length > longest) break;
    Orbit beyond = change.orbit;  // as it is, where its own equations lead no further
    beyond.parameter() += sense * length * range;
    const auto point = test ? step_to(problem, change, length, range) : std::nullopt;
    if (point) beyond = point->orbit;
    const std::vector<Orbit> guesses = guess_sequences(problem, beyond, test ? test->leg : 0);
    for (double side : {1.0, -1.0}) {  // where the old branch would have gone on, then where it came from
      for (Orbit guess : guesses) {
        if (stopped(stop)) return all;
        guess.parameter() = critical + side * (beyond.parameter() - critical);
        if (const auto orbit = solved(problem, guess))
          add(all, born(problem, change, test, sense, *orbit, length, range), range);
      }
    }
  }
  return all;
}

namespace {

/// Do the same numbers rest in an orbit, but elsewhere? A slider at its limit is drawn along as the parameter goes on:
/// where a motion leaves it says nothing of where others do.
bool rests_elsewhere(const Problem& problem, const PathPoint& from, const PathPoint& point) {
  constexpr double rounding = 1e-11;  // of the orbit's size: of what rests only its conversion from a user's state
  if (point.watched.kept != from.watched.kept) return false;
  const VectorXd moved = problem.translations().numbers(point.orbit.x[0] - from.orbit.x[0]);
  return ranges::any_of(point.watched.kept,
                        [&](Eigen::Index i) { return std::abs(moved[i]) > rounding * from.units[i]; });
}

}  // namespace

/// Just beyond a singular change a multiplier may be very near 1. A family's own equations are singular: they lead
/// nowhere.
bool one_of_family(const Problem& problem, const PathPoint& from, const PathPoint& point, double range) {
  if (rests_elsewhere(problem, from, point)) return true;
  if (isolated(point.watched.multipliers)) return false;
  const auto leads_out = [&](double length) {
    const std::optional<PathPoint> next = step_to(problem, point, length, range);
    return next && isolated(next->watched.multipliers);
  };
  return !leads_out(1e-3) && !leads_out(1e-4);
}

bool rests_more(const PathPoint& before, const PathPoint& next) {
  return next.watched.kept.size() > before.watched.kept.size();
}

bool begins_family(const Problem& problem, const Orbit& before, const PathPoint& change, const TestValue& test) {
  try {
    const auto kept = static_cast<int>(change.watched.kept.size());
    const auto of_family = [&](const Orbit& shape) { return describe(problem, shape, nullptr).family > kept; };
    return ranges::any_of(sequences_of_same_orbit(problem, before, change.orbit, test), of_family);
  } catch (const NumericalError&) {  // a shape whose modes have no such guards
    return false;
  }
}

std::optional<HalfBranch> beyond_cascade(const Problem& problem, const PathPoint& last, double limit, double range,
                                         const std::atomic<bool>* stop) {
  constexpr long settling_periods = 5;  // a complete chatter forgets what was before it
  for (const double length : {1e-6, 1e-5, 1e-4, 1e-3}) {
    for (const double side : {1.0, -1.0}) {
      try {
        std::vector<double> values = last.orbit.values;
        const double ahead = side * length * range, left = values[0] - limit;
        if (ahead * left > 0.0 && std::abs(ahead) < std::abs(left)) continue;  // before the last orbit
        values[0] = limit + ahead;
        const auto there = pose(problem.family(), values);
        const ModeSet set(constant_family(there->base().model()), {});
        const std::optional<Motion> motion =
            motion_from(there->base(), set, last.orbit, freest_leg(set, last.orbit), 0.5);
        if (!motion) continue;
        const auto settled = orbit_near(*there, *motion, settling_periods, last.orbit.shape.n, stop);
        if (!settled || !settled->chatter || !resembles(problem, settled->orbit, last.orbit, 0.1)) continue;
        HalfBranch next{point_of(problem, settled->orbit, range, {}),
                        false,
                        false,
                        OnsetInterval{limit, values[0], false},
                        0.0,
                        0.0,
                        0.0};
        if (next.point.watched.turn * side < 0.0) next.point = reversed(std::move(next.point));
        return next;
      } catch (const InputError&) {
      } catch (const NumericalError&) {
      }
    }
  }
  return std::nullopt;
}

}  // namespace slapstick::orbit
