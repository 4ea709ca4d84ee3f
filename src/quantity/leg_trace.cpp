/// Hands the legs of a cycle to a tracer.
#include "quantity/leg_trace.hpp"

#include <cmath>

#include "slapstick/base/error.hpp"

namespace slapstick::quantity {
namespace {

constexpr double most_steps = 1e4;  // as in orbit::flow: a mass may be next to nothing

bool sums_impacts(const orbit::Leg& leg) {
  return leg.ending == orbit::Ending::chatter || leg.ending == orbit::Ending::onset;
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

void Cycle::trace(Tracer& tracer) const {
  const std::size_t first = first_leg(), legs = orbit_.legs();
  const double whole = orbit_.t.back() - orbit_.t.front(), zero = std::ceil(orbit_.t.front());
  for (std::size_t k = 0; k < legs; ++k) {
    const std::size_t i = (first + k) % legs;
    const orbit::Leg& leg = orbit_.shape.legs[i];
    const orbit::ModeRates& mode = set_.mode(leg.states);
    const double begin = (orbit_.t[i] - zero + (i < first ? whole : 0.0)) * period(), duration = orbit_.duration(i) * period();
    if (!(duration <= most_steps * mode.longest_step)) throw NumericalError("orbit: a leg is too long for the rates of its mode");
    if (sums_impacts(leg)) tracer.strike(std::uint32_t{1} << static_cast<unsigned>(leg.contact));
    // the set keeps it
    const std::shared_ptr<const mode::Outline> outline(std::shared_ptr<const void>(), &mode.outline);
    if (k == 0) tracer.begin_flight(begin);
    tracer.piece(outline, 0.5 * mode.longest_step, start(i, orbit_.t[i]).data(), begin, duration);
    strike(leg, i, tracer);
    if (leg.ending == orbit::Ending::chatter) tracer.begin_flight(begin + duration);
  }
  tracer.finish(start(first, orbit_.t[first]).data());
}

void Cycle::strike(const orbit::Leg& leg, std::size_t i, Tracer& tracer) const {
  if (leg.strikes.empty()) return;
  const Vector X = orbit::state_within(set_, orbit_, i, orbit_.duration(i));
  for (const Motion::Strike& strike : leg.strikes) {
    tracer.strike(strike.stops);
    for (int stop = 0; stop < static_cast<int>(model().stops.size()); ++stop) {
      const double w = frame().velocity_row(frame().stops[static_cast<std::size_t>(stop)]).dot(X);
      if (!strike.to_rest && (strike.stops >> static_cast<unsigned>(stop) & 1U) != 0 && w > 0.0) tracer.impact(stop, w);
    }
  }
}

}  // namespace slapstick::quantity
