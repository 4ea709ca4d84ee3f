/// Refines the special points between two points of a branch.
#include "continuation/special.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ranges.hpp"
#include "change/change_kind.hpp"
#include "change/death.hpp"
#include "change/locate_margin.hpp"
#include "continuation/crossing.hpp"
#include "continuation/switching.hpp"
#include "orbit/extent.hpp"
#include "orbit/record.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/short_legs.hpp"

namespace slapstick::orbit {
namespace {

using Value = std::function<double(const Watched&)>;

constexpr double at_the_circle = 1e-4;  ///< how near the multiplier of a located point must be to what it is taken for
constexpr double at_a_fold = 0.05;  ///< the same of a fold, whose multiplier is known to the root of its place's error

bool changes_sign(double a, double b) { return (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0); }

double nearest(const Watched& watched, double target) {
  double least = INFINITY;
  for (const auto& multiplier : watched.multipliers) least = std::min(least, std::abs(multiplier - target));
  return least;
}

/// The pair of the unit circle that is no real one: its angle in turns, or 0.
double rotation(const Watched& watched) {
  double best = at_the_circle, angle = 0.0;
  for (const auto& multiplier : watched.multipliers) {
    const double off = std::abs(std::abs(multiplier) - 1.0);
    if (multiplier.imag() <= 1e-6 || off > best) continue;
    best = off;
    angle = std::arg(multiplier) / (2.0 * std::numbers::pi);
  }
  return angle;
}

/// The branch that crosses at a BP. Of two sides that are images of one another, apart from what is of second order in
/// their distance, one is kept.
void add_crossing_branch(const Problem& problem, const PathPoint& at, SpecialPoint& crossing) {
  constexpr double second_order = 0.05;
  std::vector<Orbit>& sides = crossing.born = crossing_branch(problem, at);
  if (sides.size() < 2) return;
  if (apart_from_image(problem, sides[0], sides[1]) > second_order * apart(problem, sides[0], sides[1])) return;
  crossing.occurrence = Occurrence::broken_symmetry;
  sides.pop_back();
}

/// A crossing by interpolation; as it was found only if it is the birth of a doubled orbit, which may be told from that
/// by so much.
std::optional<Located> sharpened(const Problem& problem, const PathPoint& from, std::optional<Located> rough,
                                 double length, double range) {
  constexpr double merged = 1e-3;
  auto sharper = locate_crossing(problem, from, rough ? rough->length : 0.5 * length, range);
  if (sharper) return sharper;
  if (rough && becomes_shorter(problem, from.orbit, rough->point.orbit, merged)) return rough;
  return std::nullopt;
}

/// Special points, each with the arclength to it.
using Along = std::vector<std::pair<double, SpecialPoint>>;

/// The branch that leaves a symmetric one turns back in the parameter where it leaves: no fold of its own.
void drop_folds_of_crossings(Along& found, double range) {
  constexpr double one_place = 1e-3, well_known = 1e-10, one_value = 1e-8;  // arclength; of the range
  std::vector<std::pair<double, double>> crossings;
  for (const auto& [length, special] : found)
    if (special.type == SpecialType::BP) crossings.emplace_back(length, special.value);
  std::erase_if(found, [&](const auto& entry) {
    const auto& [length, special] = entry;
    const auto is_its_fold = [&, length = length, value = special.value, error = special.error](const auto& crossing) {
      return std::abs(crossing.first - length) < one_place &&
             (error > well_known * range || std::abs(crossing.second - value) < one_value * range);
    };
    return special.type == SpecialType::LP && ranges::any_of(crossings, is_its_fold);
  });
}

struct Kind {
  SpecialType type;
  Value value;
};

/// A piece of the branch between two points.
struct Stretch {
  const PathPoint& from;
  const PathPoint& to;
  double begin;  ///< arclength from the first point of all
};

bool is_one(SpecialType type, const Watched& there) {
  switch (type) {
    case SpecialType::LP:
      return nearest(there, 1.0) <= at_a_fold;  // at a graze the branch turns too
    case SpecialType::PD:
      return nearest(there, -1.0) <= at_the_circle;
    case SpecialType::BP:
      return nearest(there, 1.0) <= at_the_circle;
    default:
      return rotation(there) != 0.0;  // not two real multipliers whose product is 1
  }
}

/// Is the product of two multipliers 1 up to rounding, as all along a stretch without damping? A smaller bound takes
/// rounding for tori; with a larger one a torus within so much of both ends of a step is missed.
bool product_is_one(const Watched& there) {
  constexpr double product_rounding = 1e-10;
  return std::abs(there.torus) <= product_rounding;
}

Occurrence occurrence_of(SpecialType type) {
  return type == SpecialType::LP   ? Occurrence::fold
         : type == SpecialType::BP ? Occurrence::crossing
         : type == SpecialType::PD ? Occurrence::doubling
                                   : Occurrence::torus;
}

/// The special point of one kind within a stretch, if its function changes sign there.
void look_within(const Problem& problem, const Kind& kind, const Stretch& stretch, double range, Along& found) {
  const auto& [from, to, begin] = stretch;
  const double length = arclength(problem, from, to.orbit);
  if (!changes_sign(kind.value(from.watched), kind.value(to.watched))) return;
  if (kind.type == SpecialType::NS && product_is_one(from.watched) && product_is_one(to.watched)) return;
  std::optional<Located> located = locate(problem, from, length, range, kind.value, kind.value(to.watched));
  if (kind.type == SpecialType::BP) located = sharpened(problem, from, std::move(located), length, range);
  if (!located || !is_one(kind.type, located->point.watched)) return;
  SpecialPoint special;
  special.type = kind.type;
  special.rotation = kind.type == SpecialType::NS ? rotation(located->point.watched) : 0.0;
  special.value = located->point.orbit.parameter();
  special.error = located->error;
  const System system(problem.family().model(located->point.orbit.values));
  special.solution = describe(problem, located->point.orbit, &system);
  special.occurrence = occurrence_of(kind.type);
  if (kind.type == SpecialType::PD) special.born = doubled(problem, located->point.orbit, range);
  if (kind.type == SpecialType::BP) add_crossing_branch(problem, located->point, special);
  found.emplace_back(begin + located->length, std::move(special));
}

}  // namespace

std::vector<SpecialPoint> smooth_special_points(const Problem& problem, const PathPoint& from, const PathPoint& to,
                                                double range) {
  const Kind crossing = {SpecialType::BP, [](const Watched& w) { return w.cross; }};
  const std::array<Kind, 3> others = {{{SpecialType::LP, [](const Watched& w) { return w.turn; }},
                                       {SpecialType::PD, [](const Watched& w) { return w.flip; }},
                                       {SpecialType::NS, [](const Watched& w) { return w.torus; }}}};
  const Stretch whole{from, to, 0.0};
  Along found;
  look_within(problem, crossing, whole, range, found);
  // A branch that leaves a symmetric or a shorter orbit has the same on both sides of it: signs that change twice.
  std::optional<PathPoint> before, behind;
  double place = 0.0, aside = 0.0;
  if (!found.empty()) {
    place = found.front().first;
    aside = 0.1 * std::min(place, arclength(problem, from, to.orbit) - place);
    before = step_to(problem, from, place - aside, range);
    behind = step_to(problem, from, place + aside, range);
  }
  for (const Kind& kind : others) {
    if (before && behind) {
      look_within(problem, kind, {from, *before, 0.0}, range, found);
      look_within(problem, kind, {*behind, to, place + aside}, range, found);
    } else {
      look_within(problem, kind, whole, range, found);
    }
  }
  drop_folds_of_crossings(found, range);
  ranges::sort(found, {}, [](const auto& entry) { return entry.first; });
  std::vector<SpecialPoint> points;
  points.reserve(found.size());
  for (auto& entry : found) points.push_back(std::move(entry.second));
  return points;
}

namespace {

/// Does the simulator agree that the orbit is a motion before a place of the branch, and none beyond it?
bool changes_there(const Problem& problem, const PathPoint& from, double length, double place, double range) {
  // Near a graze an impact's depth is the square of its speed: closer than this the simulator could not tell.
  const double beside = std::max(1e-3 * length, 1e-6);
  const std::optional<PathPoint> before = step_to(problem, from, std::max(0.5 * place, place - beside), range),
                                 behind = step_to(problem, from, place + beside, range);
  return (!before || is_motion(problem, before->orbit)) && (!behind || !is_motion(problem, behind->orbit));
}

/// Where a graze has no memory, as before a complete chatter, the parameter is a square of the impact's speed: at the
/// graze itself the tangent does not say in which sense the parameter came. The turn is given the sense that it had
/// before.
void look_back(const Problem& problem, const PathPoint& from, double range, Located& located) {
  constexpr double flat = 1e-3;  // a component of the tangent
  double& turn = located.point.watched.turn;
  if (std::abs(turn) > flat) return;
  double before = from.orbit.parameter();
  for (const double beside : {1e-4, 1e-3}) {  // arclength
    const auto point = step_to(problem, from, std::max(0.5 * located.length, located.length - beside), range);
    if (!point) continue;
    before = point->orbit.parameter();
    break;
  }
  turn = std::copysign(turn, located.point.orbit.parameter() - before);
}

using Candidates = std::vector<std::pair<std::size_t, Located>>;

/// As they come. Of margins that are used up together the speed of an impact says most, and of a slip that is no more
/// its length; a gap that closes with the leg after an impact says least. What is not known well comes last.
void in_order(Candidates& candidates, const std::vector<TestValue>& tests, double length, double range) {
  constexpr double together = 1e-3;  // no nearer than the simulator can tell (changes_there)
  constexpr double known_place = 1e-9, at_the_point_itself = 1e-9;
  ranges::stable_sort(candidates, {}, [](const auto& candidate) { return candidate.second.length; });
  const auto says = [&](const auto& candidate) {
    const TestValue& test = tests[candidate.first];
    const bool slip = test.starts_at_end && mode::of_friction(test.kind);
    const bool says_most = test.test == (slip ? Test::duration : Test::speed);
    const bool closes = test.test == Test::guard && test.kind == mode::GuardKind::gap;
    const bool at_the_point = candidate.second.length < at_the_point_itself;  // the point is a motion
    return std::pair(at_the_point || candidate.second.error > known_place * range, says_most ? 0 : closes ? 2 : 1);
  };
  for (auto first = candidates.begin(); first != candidates.end();) {
    const double limit = first->second.length + together * length;
    const auto last = std::find_if(first, candidates.end(), [&](const auto& c) { return c.second.length > limit; });
    std::stable_sort(first, last, [&](const auto& a, const auto& b) { return says(a) < says(b); });
    first = last;
  }
}

}  // namespace

namespace {

/// Margins that are used up together where legs shrink to nothing are singular: how far they agree on the place is how
/// well it is known.
double disagreement(const Candidates& candidates, const std::pair<std::size_t, Located>& chosen, const PathPoint& from,
                    double length) {
  constexpr double together = 1e-2;
  const Orbit& there = chosen.second.point.orbit;
  if (shrunk_legs(from.orbit, there, hardly_left) < 2) return 0.0;
  double most = 0.0;
  for (const auto& [test, located] : candidates)
    if (std::abs(located.length - chosen.second.length) < together * length)
      most = std::max(most, std::abs(located.point.orbit.parameter() - there.parameter()));
  return most;
}

constexpr double known = 1e-7;  ///< of the range: a margin's zero

/// The change where a margin is used up. Where legs die with it, the death is the place.
Change change_at(const Problem& problem, const PathPoint& from, Located located, std::size_t test, double range) {
  Orbit& orbit = located.point.orbit;
  Change change;
  change.test = located.point.watched.tests[test];
  change.special.test = test;
  change.special.error = located.error;
  auto death = death_at(problem, from, orbit, change.test);
  if (death && std::abs(death->death.orbit.parameter() - orbit.parameter()) <= known * range) {
    orbit.parameter() = death->death.orbit.parameter();
    change.special.error = death->error;
    change.special.death = std::move(death->death);
  }
  change.special.type = type_of(change.test, from.orbit.shape);
  change.special.value = orbit.parameter();
  change.special.occurrence = Occurrence::margin;
  change.special.margin = used(change.test);
  change.special.sliding = kind_of_sliding(change.test, from.orbit.shape);
  change.special.solution = describe(problem, orbit, nullptr);
  change.at = std::move(located.point);
  change.length = located.length;
  return change;
}

}  // namespace

std::optional<Change> find_change(const Problem& problem, const PathPoint& from, const PathPoint& to, double length,
                                  double range) {
  Candidates candidates;
  for (std::size_t i = 0; i < from.watched.tests.size(); ++i) {
    const double before = from.watched.tests[i].value, behind = to.watched.tests[i].value;
    if (!(before > 0.0) || !(behind < 0.0)) continue;
    if (auto located = locate_margin(problem, from, to, length, range, i))
      candidates.emplace_back(i, std::move(*located));
  }
  // Where the equations are hardly solvable, as near the onset of a chatter, what looks like a margin's zero may be
  // none.
  std::erase_if(candidates, [&](const auto& candidate) { return candidate.second.error > known * range; });
  in_order(candidates, from.watched.tests, length, range);
  for (auto& candidate : candidates) {
    auto& [test, located] = candidate;
    if (!changes_there(problem, from, length, located.length, range)) continue;
    located.error = std::max(located.error, disagreement(candidates, candidate, from, length));
    look_back(problem, from, range, located);
    return change_at(problem, from, std::move(located), test, range);
  }
  return std::nullopt;
}

double defining(const SpecialPoint& point, const Watched& watched) {
  switch (point.type) {
    case SpecialType::LP:
      return watched.turn;
    case SpecialType::BP:
      return watched.cross;
    case SpecialType::PD:
      return watched.flip;
    case SpecialType::NS:
      return watched.torus;
    default:
      return watched.tests.at(point.test).value;
  }
}

}  // namespace slapstick::orbit
