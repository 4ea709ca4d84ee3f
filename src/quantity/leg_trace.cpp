/// Hands the legs of a cycle to a tracer.
#include "quantity/leg_trace.hpp"

#include <algorithm>
#include <cmath>

#include "slapstick/base/error.hpp"

namespace slapstick::quantity {
namespace {

constexpr double most_steps = 1e4;  // as in orbit::flow: a mass may be next to nothing

bool sums_impacts(const orbit::Leg& leg) {
  return leg.ending == orbit::Ending::chatter || leg.ending == orbit::Ending::onset;
}

bool slips(const orbit::Leg& leg) {
  const auto& states = leg.states.frictions;
  return std::any_of(states.begin(), states.end(), [](auto state) { return state != mode::FrictionState::stick; });
}

}  // namespace

Cycle::Cycle(const orbit::Problem& problem, const orbit::Orbit& orbit)
    : orbit_(orbit), set_(constant_family(problem.family().model(orbit.values)), {}) {}

/// The one after an impact, or after the end of a chatter.
std::size_t Cycle::first_leg() const {
  for (std::size_t i = 0; i < orbit_.legs(); ++i)
    if (const orbit::Leg& leg = orbit_.shape.legs[i]; !leg.strikes.empty() || leg.ending == orbit::Ending::chatter)
      return (i + 1) % orbit_.legs();
  return 0;
}

Vector Cycle::start(std::size_t leg, double t) const {
  return orbit::leg_start(set_, orbit_.shape.legs[leg], orbit_.x[leg], t).value();
}

/// Time at which leg i begins, in a trace that begins with leg `first`.
double Cycle::begin(std::size_t i, std::size_t first) const {
  const double whole = orbit_.t.back() - orbit_.t.front(), zero = std::ceil(orbit_.t.front());
  return (orbit_.t[i] - zero + (i < first ? whole : 0.0)) * period();
}

void Cycle::trace(Tracer& tracer) const {
  const std::size_t first = first_leg(), legs = orbit_.legs();
  begin_flights(first, tracer);
  for (std::size_t k = 0; k < legs; ++k) {
    const std::size_t i = (first + k) % legs;
    const orbit::Leg& leg = this->leg(i);
    const orbit::ModeRates& mode = set_.mode(leg.states);
    const double begin = this->begin(i, first), duration = orbit_.duration(i) * period();
    if (!(duration <= most_steps * mode.longest_step)) throw NumericalError("orbit: a leg is too long for the rates of its mode");
    if (sums_impacts(leg)) tracer.strike(std::uint32_t{1} << static_cast<unsigned>(leg.contact));
    // the set keeps it
    const std::shared_ptr<const mode::Outline> outline(std::shared_ptr<const void>(), &mode.outline);
    tracer.piece(outline, 0.5 * mode.longest_step, start(i, orbit_.t[i]).data(), begin, duration);
    for (const Motion::Strike& strike : leg.strikes) tracer.strike(strike.stops);
    for (const auto& [contact, w] : met(i))
      if (contact < static_cast<int>(model().stops.size())) tracer.impact(contact, w);
    if (leg.ending == orbit::Ending::chatter) tracer.begin_flight(leg.contact, begin + duration);
  }
  tracer.finish(start(first, orbit_.t[first]).data(), set_.mode(leg(first).states).outline);
}

/// The stops that are hit at the end of a leg and the compliant ones that are met, with their velocities.
std::vector<std::pair<int, double>> Cycle::met(std::size_t i) const {
  std::vector<std::pair<int, double>> all;
  const orbit::Leg &before = leg(i), &after = leg((i + 1) % orbit_.legs());
  if (before.strikes.empty() && before.states.compliant == after.states.compliant) return all;
  const Vector X = orbit::state_within(set_, orbit_, i, orbit_.duration(i));
  const auto add = [&](std::size_t contact, const mode::ContactRow& row) {
    if (const double w = frame().velocity_row(row).dot(X); w > 0.0) all.emplace_back(static_cast<int>(contact), w);
  };
  for (const Motion::Strike& strike : before.strikes)
    for (std::size_t stop = 0; stop < model().stops.size(); ++stop)
      if (!strike.to_rest && (strike.stops >> stop & 1U) != 0) add(stop, frame().stops[stop]);
  constexpr auto off = mode::CompliantState::off;
  for (std::size_t k = 0; k < model().compliant_stops.size(); ++k)
    if (before.states.compliant[k] == off && after.states.compliant[k] != off)
      add(model().stops.size() + model().frictions.size() + k, frame().compliant[k]);
  return all;
}

/// The flights of the cycle's first impacts began in the cycle before.
void Cycle::begin_flights(std::size_t first, Tracer& tracer) const {
  struct Mark {
    int contact;
    double time, slid;
  };
  std::vector<Mark> marks;
  double slid = 0.0;
  for (std::size_t k = 0; k < orbit_.legs(); ++k) {
    const std::size_t i = (first + k) % orbit_.legs();
    const double duration = orbit_.duration(i) * period(), end = begin(i, first) + duration;
    if (slips(leg(i))) slid += duration;
    for (const auto& [contact, w] : met(i)) marks.push_back({contact, end, slid});
    if (leg(i).ending == orbit::Ending::chatter) marks.push_back({leg(i).contact, end, slid});
  }
  for (const Mark& mark : marks) tracer.begin_flight(mark.contact, mark.time - duration(), slid - mark.slid);
}

}  // namespace slapstick::quantity
