/// What happens at an event: impact law, rest, next mode, complete chatter. See flow/motion.hpp for the order of things.
#include <algorithm>
#include <cmath>

#include "slapstick/flow/chatter.hpp"
#include "slapstick/flow/mode_graph.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick {

using mode::FrictionState;
using mode::GuardKind;
using mode::StopState;

namespace {

constexpr long most_events_at_one_instant = 16;

}  // namespace

void Motion::handle(int guard, bool graze) {
  const mode::Guard& hit = system_->mode(mode_).guards()[guard];
  hit_guard_ = &hit;
  X_before_ = X_;
  switch (hit.kind) {
    case GuardKind::gap:
      return touch(hit.contact, graze);
    case GuardKind::slip:
      if (const int stop = stop_touched_at_rest(hit.contact); stop >= 0) return touch(stop, true);
      rest(system_->frame().frictions[hit.contact], system_->model().frictions[hit.contact].belt_speed);
      return settle(Cause::reversal);
    case GuardKind::stick_above:
    case GuardKind::stick_below:
      return force_limit(guard, stops() + hit.contact, graze);
    case GuardKind::press:
      return force_limit(guard, hit.contact, graze);
  }
}

/// A holding force has reached its limit: release. A force that only touches its limit holds on (|f0| <= f_s is stick): the guard has a double
/// zero here, and the mode goes on unless its next derivative says otherwise.
void Motion::force_limit(int guard, int contact, bool graze) {
  report(graze ? EventKind::graze : EventKind::release, contact, 0.0);
  note_magnitude(X_);
  const mode::Mode& mode = system_->mode(mode_);
  const int touched = graze ? flow::start_order(mode, guard, X_.data(), magnitude_.data(), 2) : flow::negative;
  if (touched == flow::negative) return settle(Cause::force);
  for (int g = 0; g < mode.guard_count(); ++g) orders_[g] = flow::start_order(mode, g, X_.data(), magnitude_.data());
  orders_[guard] = touched;
  chatter_stop_ = -1;
  begin_flight();
}

/// The stop of a pair that comes to rest just where its gap vanishes, within the gap's rounding bound, or -1. The gap's minimum and the zero of
/// its rate are one instant, whichever of the two searches ends an ulp earlier.
int Motion::stop_touched_at_rest(int friction) const {
  const mode::Mode& mode = system_->mode(mode_);
  for (int g = 0; g < mode.guard_count(); ++g) {
    const mode::Guard& guard = mode.guards()[g];
    if (guard.kind != GuardKind::gap || !system_->coupling(guard.contact, friction).same_pair) continue;
    const int order = orders_[g];
    if (order < 0 || order == flow::never) continue;
    event::Hull hull;
    mode.enclose(g, order, X_window_.data(), magnitude_.data(), hull);
    const double x = arrived_x_, noise = hull.bounds[event::noise_0] +
                                         x * (hull.bounds[event::noise_1] + x * hull.bounds[event::noise_2]);
    if (flow::gap(*system_, guard.contact, X_.data()) <= std::pow(x, order) * noise) return guard.contact;
  }
  return -1;
}

/// Sets the velocity of a pair relative to `speed` to exactly zero in the stored state.
void Motion::rest(const mode::ContactRow& contact, double speed) {
  const mode::Frame& frame = system_->frame();
  if (contact.own >= 0) {
    X_.data()[frame.u(contact.own)] = speed == frame.drift[contact.own] ? 0.0 : speed - frame.drift[contact.own];
    return;
  }
  for (int i = 0; i < frame.n; ++i) {  // a row that is +- one contact coordinate
    if (std::abs(contact.row[i]) == 1.0) {
      X_.data()[frame.u(i)] = contact.row[i] * speed - frame.drift[i];
      return;
    }
  }
}

/// The gap has reached zero: an impact, or a graze without impulse.
void Motion::touch(int stop, bool graze) {
  const mode::ContactRow& contact = system_->frame().stops[stop];
  if (contact.own >= 0) X_.data()[contact.own] = 0.0;
  if (graze || flow::approach_velocity(*system_, stop, X_.data()) <= 0.0) {
    rest(contact, 0.0);
    report(EventKind::graze, stop, 0.0);
    return settle(Cause::graze);
  }
  impact(stop);
  settle(Cause::impact);
}

/// Newton's law: u+ = u- - (1 + r) w M^{-1} g^T / (g M^{-1} g^T). The pair's own velocity is set, not computed: exactly -r w.
void Motion::impact(int stop) {
  const mode::Frame& frame = system_->frame();
  const double w = flow::approach_velocity(*system_, stop, X_.data());
  const double r = system_->model().stops[stop].restitution;
  for (int i = 0; i < frame.n; ++i) X_.data()[frame.u(i)] -= (1.0 + r) * w * system_->impulse(stop)[i];
  const int own = frame.stops[stop].own;
  if (own >= 0) X_.data()[frame.u(own)] = -r * w - frame.drift[own];
  ++counters_.impacts;
  report(EventKind::impact, stop, w);
  chatter_stop_ = r > 0.0 && r < 1.0 ? stop : -1;
}

/// The mode that may start now, from which a new flight begins.
void Motion::choose_mode() {
  note_magnitude(X_);
  const int next = flow::select_mode(*system_, X_.data(), magnitude_.data(), orders_);
  if (next < 0) fail("no contact mode fits the state (a contact force is inconsistent)");
  mode_ = next;
  begin_flight();
}

/// Decides the next mode after an event and reports what follows from it at once.
void Motion::settle(Cause cause) {
  const int old = mode_;
  choose_mode();
  if (cause != Cause::impact) chatter_stop_ = -1;
  if (cause != Cause::force) report_settled(cause, old);
}

/// What the new mode says about the event: reversal or stick of a friction contact, a stop that has closed at rest.
void Motion::report_settled(Cause cause, int old_mode) {
  const mode::ContactStates& now = system_->mode(mode_).states();
  const mode::ContactStates& old = system_->mode(old_mode).states();
  bool stuck = false;
  for (std::size_t i = 0; i < now.frictions.size(); ++i) {
    const int contact = stops() + static_cast<int>(i);
    const bool sticks = now.frictions[i] == FrictionState::stick;
    if (sticks && old.frictions[i] != FrictionState::stick) {
      report(EventKind::stick, contact, 0.0);
      stuck = true;
    } else if (!sticks && cause == Cause::reversal) {
      report(now.frictions[i] == FrictionState::slip_plus ? EventKind::slip_plus : EventKind::slip_minus, contact, 0.0);
    }
  }
  for (std::size_t i = 0; i < now.stops.size() && !stuck; ++i) {
    if (now.stops[i] == StopState::closed && old.stops[i] == StopState::open)
      report(EventKind::stick, static_cast<int>(i), 0.0);
  }
}

/// Replaces a proven complete chatter, from the impact at which the flight began, by its limit if that is known sharply enough and comes
/// within `limit` of the impact. A cut before the limit leaves the question to the next call.
bool Motion::end_chatter(double limit) {
  const int stop = chatter_stop_;
  const flow::ChatterLimit chatter =
      flow::prove_chatter(*system_, stop, X_window_.data(), options_.chatter_tolerance * system_->period(), scratch_);
  if (!chatter.proven || flight_.windows > 0 || chatter.duration > 0.5 * system_->mode(mode_).window()) {
    chatter_stop_ = -1;
    return false;
  }
  if (chatter.duration > limit) return false;

  // The pair's momentum does not see the impacts: flow the closed stop from the velocity after a fully plastic impact.
  const double begun = elapsed_;
  const Instant impact = flight_.start;
  const mode::Frame& frame = system_->frame();
  X_ = X_window_;
  const double w = flow::approach_velocity(*system_, stop, X_.data());
  for (int i = 0; i < frame.n; ++i) X_.data()[frame.u(i)] -= w * system_->impulse(stop)[i];
  rest(frame.stops[stop], 0.0);
  choose_mode();
  flight_.start = impact;
  const double H = system_->mode(mode_).window();
  look(begun / H);
  frame.set_phase(now_.fraction, X_.data());
  begin_segment();
  arrive(chatter.duration / H);
  X_before_ = X_;
  report(EventKind::chatter, stop, 0.0);
  pending_[pending_count_ - 1].error = chatter.error;
  settle(Cause::force);
  return true;
}

void Motion::fail_pile_up() const {
  for (const double x : X_.span()) {
    if (!std::isfinite(x)) fail("the numbers overflow: a coordinate or velocity is not finite; scale the model");
  }
  fail("more than 16 events at one instant");
}

void Motion::report(EventKind kind, int contact, double w) {
  pending_[pending_count_++] = Event{kind, contact, now_, w, 0.0};
  ++counters_.events;
  counters_.grazes += kind == EventKind::graze;
  if (++at_one_instant_ > most_events_at_one_instant) fail_pile_up();
  if (now_.period != budget_period_) {
    budget_period_ = now_.period;
    budget_events_ = 0;
  }
  if (++budget_events_ > options_.most_events_per_period)
    fail("event budget: more than " + std::to_string(options_.most_events_per_period) +
         " events in one period; raise the budget or change the restitution");
}

}  // namespace slapstick
