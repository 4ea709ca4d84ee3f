#include "orbit/special.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slapstick::orbit {
namespace {

using Value = std::function<double(const Watched&)>;

constexpr double at_the_circle = 1e-4;  ///< how near the multiplier of a located point must be to what it is taken for

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

std::string stick_of(const System& system, int friction) {
  return system.contact_name(static_cast<int>(system.model().stops.size()) + friction);
}

}  // namespace

std::vector<SpecialPoint> smooth_special_points(const Problem& problem, const PathPoint& from, const PathPoint& to,
                                                double length, double range) {
  struct Kind {
    SpecialType type;
    Value value;
  };
  const std::array<Kind, 4> kinds = {{{SpecialType::LP, [](const Watched& w) { return w.turn; }},
                                      {SpecialType::BP, [](const Watched& w) { return w.cross; }},
                                      {SpecialType::PD, [](const Watched& w) { return w.flip; }},
                                      {SpecialType::NS, [](const Watched& w) { return w.torus; }}}};
  std::vector<std::pair<double, SpecialPoint>> found;
  for (const Kind& kind : kinds) {
    if (!changes_sign(kind.value(from.watched), kind.value(to.watched))) continue;
    const std::optional<Located> located = locate(problem, from, length, range, kind.value, kind.value(to.watched));
    if (!located) continue;
    const Watched& there = located->point.watched;
    SpecialPoint special;
    special.type = kind.type;
    special.rotation = kind.type == SpecialType::NS ? rotation(there) : 0.0;
    if (kind.type == SpecialType::PD && nearest(there, -1.0) > at_the_circle) continue;
    if (kind.type == SpecialType::BP && nearest(there, 1.0) > at_the_circle) continue;
    if (kind.type == SpecialType::NS && special.rotation == 0.0) continue;  // two real multipliers whose product is 1
    special.value = located->point.orbit.values[0];
    special.error = located->error;
    const System system(problem.family().model(located->point.orbit.values));
    special.solution = describe(problem, located->point.orbit, &system);
    special.what = kind.type == SpecialType::LP   ? "fold"
                   : kind.type == SpecialType::BP ? "branches cross"
                   : kind.type == SpecialType::PD ? "period doubling"
                                                  : "torus";
    found.emplace_back(located->length, std::move(special));
  }
  std::ranges::sort(found, {}, [](const auto& entry) { return entry.first; });
  std::vector<SpecialPoint> points;
  for (auto& entry : found) points.push_back(std::move(entry.second));
  return points;
}

SpecialType type_of(const TestValue& test, const Itinerary& shape) {
  const bool stop = test.kind == mode::GuardKind::gap || test.kind == mode::GuardKind::press;
  if (test.test == Test::duration) {
    const auto& states = shape.legs[test.leg].states.frictions;
    const bool sticks = std::ranges::find(states, mode::FrictionState::stick) != states.end();
    return sticks ? SpecialType::SL : SpecialType::CO;
  }
  if (test.test == Test::no_stick || mode::of_friction(test.kind)) return SpecialType::SL;
  return stop ? SpecialType::GR : SpecialType::GR;
}

std::string describe(const TestValue& test, const Itinerary& shape, const System& system) {
  const std::string leg = " in leg " + std::to_string(test.leg + 1);
  const std::string after = " at " + std::string(name(shape.legs[test.leg].event)) + " " +
                            system.contact_name(shape.legs[test.leg].event_contact);
  switch (test.test) {
    case Test::duration:
      return "leg " + std::to_string(test.leg + 1) + " (" +
             system.mode_name(system.mode_id(shape.legs[test.leg].states)) + ") shrinks to nothing";
    case Test::no_stick:
      return "the holding force of " + stick_of(system, test.contact) + " comes to static friction" + after;
    case Test::speed:
      return test.kind == mode::GuardKind::gap ? "the speed of the impact" + after + " goes to zero"
                                               : "the rate of the guard" + after + " goes to zero";
    case Test::guard:
      break;
  }
  switch (test.kind) {
    case mode::GuardKind::gap:
      return "the gap of " + system.contact_name(test.contact) + " touches zero" + leg;
    case mode::GuardKind::slip:
      return "the velocity of " + stick_of(system, test.contact) + " touches zero" + leg;
    case mode::GuardKind::stick_above:
    case mode::GuardKind::stick_below:
      return "the holding force of " + stick_of(system, test.contact) + " touches static friction" + leg;
    case mode::GuardKind::press:
      return "the force of " + system.contact_name(test.contact) + " touches zero" + leg;
    default:
      return "a compliant stop touches" + leg;
  }
}

std::optional<Change> find_change(const Problem& problem, const PathPoint& from, const PathPoint& to, double length,
                                  double range) {
  std::optional<Change> first;
  double nearest_length = INFINITY;
  for (std::size_t i = 0; i < from.watched.tests.size(); ++i) {
    const double before = from.watched.tests[i].value, behind = to.watched.tests[i].value;
    if (!(before > 0.0) || !(behind < 0.0)) continue;
    const auto value = [i](const Watched& watched) { return watched.tests[i].value; };
    std::optional<Located> located = locate(problem, from, length, range, value, behind);
    if (!located || located->length >= nearest_length) continue;
    nearest_length = located->length;
    Change change;
    change.test = from.watched.tests[i];
    change.special.test = i;
    change.special.type = type_of(change.test, from.orbit.shape);
    change.special.value = located->point.orbit.values[0];
    change.special.error = located->error;
    change.special.what = describe(change.test, from.orbit.shape, problem.base());
    change.special.solution = describe(problem, located->point.orbit, nullptr);
    change.at = std::move(located->point);
    first = std::move(change);
  }
  return first;
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
