/// Says what an orbit is: multipliers, class, drift, events.
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/ranges.hpp"
#include "base/set_bits.hpp"
#include "flow/contact_state.hpp"
#include "orbit/continuum.hpp"
#include "orbit/equations.hpp"
#include "orbit/extremes.hpp"
#include "orbit/record.hpp"
#include "orbit/short_legs.hpp"
#include "orbit/ties.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The numbers of a contact state that a mode holds at zero: velocities of held pairs, gaps of closed stops.
std::vector<Index> held_numbers(const mode::Frame& frame, const mode::Outline& outline) {
  std::vector<Index> held;
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (outline.states.stops[i] == mode::StopState::closed && frame.stops[i].own < frame.n)
      held.push_back(frame.stops[i].own);
  for (int i = 0; i < frame.n; ++i)
    if (outline.steady[i]) held.push_back(frame.n + i);
  return held;
}

/// The leg in which most is held still: there the rank that stick takes is seen as rows that are exactly zero.
std::size_t most_held_leg(const ModeSet& set, const Orbit& orbit) {
  std::size_t best = 0, most = 0;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const std::size_t held = held_numbers(set.frame(), set.mode(orbit.shape.legs[i].states).outline).size();
    if (held > most && orbit.shape.legs[i].ending != Ending::chatter) {
      most = held;
      best = i;
    }
  }
  return best;
}

/// Impacts, and compliant stops that begin to act at their gap, at the end of a leg.
long points(const Leg& leg, const Leg& next) {
  if (leg.ending == Ending::cut) return 0;
  long count = 0;
  for (const Motion::Strike& strike : leg.strikes)  // at a knot one to rest is a blow that stops bear
    count += leg.ending == Ending::knot && strike.to_rest ? 0 : std::popcount(strike.stops);
  const auto off = mode::CompliantState::off;
  for (std::size_t i = 0; i < leg.states.compliant.size(); ++i)
    count += leg.states.compliant[i] == off && next.states.compliant[i] != off ? 1 : 0;
  return count;
}

long impacts(const Itinerary& shape) {
  long count = 0;
  for (std::size_t i = 0; i < shape.legs.size(); ++i)
    count += points(shape.legs[i], shape.legs[(i + 1) % shape.legs.size()]);
  return count;
}

bool sticks(const Itinerary& shape) {
  return ranges::any_of(shape.legs, [](const Leg& leg) { return mode::rests(leg.states); });
}

/// What the friction contacts do at each instant that ends legs.
void count_changes(Solution& found, const Orbit& orbit) {
  using mode::FrictionState;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    if (orbit.tied(i)) continue;
    std::size_t behind = (i + 1) % orbit.legs();
    while (orbit.tied(behind)) behind = (behind + 1) % orbit.legs();
    const auto &before = orbit.shape.legs[i].states.frictions, &after = orbit.shape.legs[behind].states.frictions;
    for (std::size_t c = 0; c < before.size(); ++c) {
      if (before[c] == after[c] || before[c] == FrictionState::stick) continue;
      if (before[c] == FrictionState::unloaded || after[c] == FrictionState::unloaded) continue;
      ++(after[c] == FrictionState::stick ? found.sticks : found.reversals);
    }
  }
}

}  // namespace

void drop_kept_direction(std::vector<std::complex<double>>& multipliers) {
  const auto nearest = ranges::min_element(multipliers, {}, [](auto m) { return std::abs(m - 1.0); });
  if (nearest != multipliers.end()) multipliers.erase(nearest);
}

std::vector<std::complex<double>> multipliers(const Problem& problem, const ModeSet& set, const Orbit& orbit,
                                              const std::vector<LegValue>& legs) {
  if (!differentiable(orbit.shape)) return {};
  const std::size_t first = most_held_leg(set, orbit);
  MatrixXd map;
  if (first == 0) {
    map = return_rates(problem, set, orbit, legs).by_state;
  } else {
    Orbit turned = orbit;
    rotate(turned, first);
    std::vector<LegValue> turned_legs = legs;
    std::rotate(turned_legs.begin(), turned_legs.begin() + static_cast<std::ptrdiff_t>(first), turned_legs.end());
    map = return_rates(problem, set, turned, turned_legs).by_state;
  }
  std::vector<Index> free;
  for (Index i = 0; i < map.rows(); ++i)
    if ((map.row(i).array() != 0.0).any()) free.push_back(i);
  std::vector<std::complex<double>> all;
  if (!free.empty()) all = flow::multipliers_of(map(free, free));
  if (orbit.shape.n == 0) drop_kept_direction(all);
  all.resize(all.size() + static_cast<std::size_t>(map.rows()) - free.size(), 0.0);
  return all;
}

namespace {

std::vector<std::complex<double>> across(const Solution& solution) {
  std::vector<std::complex<double>> others = solution.multipliers;
  for (int along = 0; along < solution.family; ++along) drop_kept_direction(others);
  return others;
}

}  // namespace

double Solution::largest_across() const {
  double largest = 0.0;
  for (const auto& mu : across(*this)) largest = std::max(largest, std::abs(mu));
  return largest;
}

/// A multiplier that is no number is not inside the unit circle.
bool Solution::stable() const {
  return differentiable(orbit.shape) && ranges::all_of(across(*this), [](auto mu) { return std::abs(mu) < 1.0; });
}

std::shared_ptr<const Problem> pose(const Family& family, const std::vector<double>& values) {
  return std::make_shared<const Problem>(family, values);
}

std::string class_name(const Orbit& orbit) {
  const std::string n = orbit.shape.n > 0 ? std::to_string(orbit.shape.n) : "free";
  const std::string p = chatters(orbit) > 0 ? "inf" : std::to_string(impacts(orbit.shape));
  return n + "-" + p + (sticks(orbit.shape) ? "-II" : "-I");
}

Solution describe(const Problem& problem, Orbit orbit, const System* system) {
  const ModeSet set(problem.family(), orbit.values);
  Solution found;
  found.multipliers = multipliers(problem, set, orbit, linearise(problem, set, orbit).legs);
  found.impacts = impacts(orbit.shape);
  found.sticking = sticks(orbit.shape);
  found.chatters = chatters(orbit);
  found.chatter = found.chatters > 0;
  count_changes(found, orbit);
  found.family = continuum(problem, orbit, found.multipliers);
  found.label = class_name(orbit);
  found.cycle = (orbit.t.back() - orbit.t.front()) * set.period();
  if (problem.translations().count() > 0) found.drift = problem.translations().by_coordinate(orbit.advance);
  if (system != nullptr) {
    const Verification verification = verify(*system, orbit);
    found.is_motion = verification.is_motion;
    found.why = verification.why;
  }
  found.orbit = std::move(orbit);
  return found;
}

namespace {

/// The event's own condition made exact, as a Motion does, so that the state can be started from.
void land(const mode::Frame& frame, const Leg& leg, Eigen::VectorXd& X) {
  if (leg.ending != Ending::guard) return;
  if (leg.kind == mode::GuardKind::gap) X[frame.stops[leg.contact].own] = 0.0;
  if (leg.kind == mode::GuardKind::slip) X[frame.u(frame.frictions[leg.contact].own)] = 0.0;
}

}  // namespace

std::vector<EventOfOrbit> events(const Problem& problem, const Orbit& orbit) {
  const ModeSet set(problem.family(), orbit.values);
  const mode::Frame& frame = set.frame();
  std::vector<EventOfOrbit> all;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const Leg& leg = orbit.shape.legs[i];
    if (leg.ending == Ending::cut || leg.event == EventKind::knot) continue;  // a point is the signal's own
    const Leg& next = orbit.shape.legs[(i + 1) % orbit.legs()];
    const LegValue value = leg_value(set, leg, next, orbit.x[i], orbit.t[i], orbit.t[i + 1]);
    EventOfOrbit event{leg.event,  leg.event_contact, orbit.t[i + 1], 0.0, State(2 * static_cast<std::size_t>(frame.n)),
                       next.states};
    Eigen::VectorXd X = behind_pulses(set, leg, value.X_end.value());
    land(frame, leg, X);
    frame.leave(X.data(), X.data() + frame.d, event.before.data());
    const auto stops = frame.stops.size(), frictions = frame.frictions.size(),
               at = static_cast<std::size_t>(leg.event_contact);
    if (const auto first = stops + frictions + frame.compliant.size(); at >= first) {
      event.w = frame.characteristics[at - first].velocity.dot(X);
      all.push_back(std::move(event));
      continue;
    }
    const mode::ContactRow& row = at < stops               ? frame.stops[at]
                                  : at < stops + frictions ? frame.frictions[at - stops]
                                                           : frame.compliant[at - stops - frictions];
    event.w = row.sign * X[frame.u(row.own)];
    all.push_back(std::move(event));
    // The limit of several stops is a row of each; the leg is named by the first.
    for (const int stop : set_bits(leg.ending == Ending::chatter ? leg.chattering : 0)) {
      if (stop == leg.event_contact) continue;
      all.push_back(all.back());
      all.back().contact = stop;
    }
  }
  return all;
}

std::vector<Range> ranges(const Problem& problem, const Orbit& orbit) {
  const ModeSet set(constant_family(problem.family().model(orbit.values)), {});
  std::vector<Range> all;
  for (const Extremes& one : extremes(set, orbit, coordinate_functionals(set.frame())))
    all.push_back({one.least.value, one.most.value});
  return all;
}

std::optional<Orbit> refine(const Problem& problem, Orbit guess, const std::vector<Orbit>& besides) {
  const int most_steps = besides.empty() ? 20 : 60;  // a step that is turned round leads into the unknown
  const NewtonResult result = solve(problem, guess, fixed_parameters(problem, guess.legs()), most_steps, besides);
  if (!result.converged) return std::nullopt;
  tie_sliders(problem.base().compiled().frame(), guess, rounding_of_instants(result.last_step));
  return guess;
}

}  // namespace slapstick::orbit
