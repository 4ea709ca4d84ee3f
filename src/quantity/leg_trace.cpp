/// Hands the legs of a cycle to a tracer.
#include "quantity/leg_trace.hpp"

#include <algorithm>
#include <cmath>

#include "base/set_bits.hpp"

namespace slapstick::quantity {
namespace {

/// The stops whose flights count from the end of a leg, the limit of a chatter.
std::vector<int> flights_after_chatter(const orbit::Leg& leg) {
  return leg.ending == orbit::Ending::chatter ? set_bits(leg.chattering) : std::vector<int>{};
}

bool slips(const orbit::Leg& leg) {
  const auto& states = leg.states.frictions;
  return std::any_of(states.begin(), states.end(), [](auto state) { return state != mode::FrictionState::stick; });
}

}  // namespace

Cycle::Cycle(const orbit::Problem& problem, const orbit::Orbit& orbit)
    : orbit_(orbit),
      set_(std::make_shared<orbit::ModeSet>(constant_family(problem.family().model(orbit.values)),
                                            std::vector<double>{})) {}

Cycle::Cycle(std::shared_ptr<const orbit::ModeSet> set, const orbit::Orbit& orbit, const orbit::OrbitRate& rate,
             std::size_t parameter)
    : orbit_(orbit), set_(std::move(set)), rate_(&rate), parameter_(parameter) {}

/// The one after an impact, or after the end of a chatter.
std::size_t Cycle::first_leg() const {
  for (std::size_t i = 0; i < orbit_.legs(); ++i)
    if (const orbit::Leg& leg = orbit_.shape.legs[i]; !leg.strikes.empty() || leg.ending == orbit::Ending::chatter)
      return (i + 1) % orbit_.legs();
  return 0;
}

/// X at the start of a leg. Its derivative: x, the instant and the model's numbers move together.
Moving Cycle::start(std::size_t i) const {
  const orbit::Jet X = orbit::leg_start(*set_, leg(i), orbit_.x[i], orbit_.t[i]);
  if (rate_ == nullptr) return {X.value(), {}};
  return {X.value(), X.by_state() * rate_->x[i] + X.by_begin() * rate_->t[i] +
                         X.by_parameter().col(static_cast<Eigen::Index>(parameter_))};
}

/// Time at which leg i begins, in a trace that begins with leg `first`: from phase 0 on, without forcing from event 0.
Number Cycle::begin(std::size_t i, std::size_t first) const {
  const Number zero = orbit_.shape.n > 0 ? Number{std::ceil(orbit_.t.front()), 0.0} : instant(0);
  return (instant(i) - zero + (i < first ? instant(orbit_.legs()) - instant(0) : Number{})) * period();
}

void Cycle::piece(std::size_t i, Number begin, Tracer& tracer) const {
  const orbit::ModeRates& mode = set_->mode(leg(i).states);
  const Number duration = lasts(i);
  static_cast<void>(mode.steps(duration.value));  // throws where they are too many
  // the set keeps it
  const std::shared_ptr<const mode::Outline> outline(std::shared_ptr<const void>(), &mode.outline);
  const Moving from = start(i);
  // where all sticks nothing has a rate
  const double longest = std::min(0.5 * mode.longest_step, this->duration().value);
  if (rate_ == nullptr) return tracer.piece(outline, longest, from.X.data(), begin.value, duration.value);
  const PieceRates rates{mode.rates[parameter_], from.by.data(), begin.rate, duration.rate};
  tracer.piece(outline, longest, from.X.data(), begin.value, duration.value, &rates);
}

void Cycle::trace(Tracer& tracer) const {
  const std::size_t first = first_leg(), legs = orbit_.legs();
  begin_flights(first, tracer);
  for (std::size_t k = 0; k < legs; ++k) {
    const std::size_t i = (first + k) % legs;
    const Number begin = this->begin(i, first);
    if (leg(i).chattering != 0) tracer.chatter(leg(i).chattering);
    piece(i, begin, tracer);
    for (const Motion::Strike& strike : leg(i).strikes) tracer.strike(strike.stops);
    for (const orbit::Pulse& pulse : orbit::pulses(*set_, leg(i)))
      tracer.pulse(pulse.signal,
                   {pulse.area[0], rate_ != nullptr ? pulse.area[1 + static_cast<Eigen::Index>(parameter_)] : 0.0});
    for (const auto& [contact, w] : met(i))
      if (contact < static_cast<int>(model().stops.size())) tracer.impact(contact, w);
    for (const int stop : flights_after_chatter(leg(i))) tracer.begin_flight(stop, begin + lasts(i));
  }
  const Moving again = start(first);
  tracer.finish(again.X.data(), set_->mode(leg(first).states).outline, rate_ != nullptr ? again.by.data() : nullptr);
}

/// The stops that are hit at the end of a leg and the compliant ones that are met, with their velocities.
std::vector<std::pair<int, double>> Cycle::met(std::size_t i) const {
  std::vector<std::pair<int, double>> all;
  const orbit::Leg &before = leg(i), &after = leg((i + 1) % orbit_.legs());
  if (before.strikes.empty() && before.states.compliant == after.states.compliant) return all;
  const Vector X = orbit::behind_pulses(*set_, before, orbit::state_within(*set_, orbit_, i, orbit_.duration(i)));
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
    Number time, slid;
  };
  std::vector<Mark> marks;
  Number slid;
  for (std::size_t k = 0; k < orbit_.legs(); ++k) {
    const std::size_t i = (first + k) % orbit_.legs();
    const Number end = begin(i, first) + lasts(i);
    if (slips(leg(i))) slid += lasts(i);
    for (const auto& [contact, w] : met(i)) marks.push_back({contact, end, slid});
    for (const int stop : flights_after_chatter(leg(i))) marks.push_back({stop, end, slid});
  }
  for (const Mark& mark : marks) tracer.begin_flight(mark.contact, mark.time - duration(), slid - mark.slid);
}

}  // namespace slapstick::quantity
