#include "slapstick/flow/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "slapstick/base/error.hpp"
#include "slapstick/flow/chatter.hpp"
#include "slapstick/flow/mode_graph.hpp"

namespace slapstick {

using mode::FrictionState;
using mode::GuardKind;
using mode::StopState;

namespace {

constexpr long most_events_at_one_instant = 16;

}  // namespace

std::string_view name(EventKind kind) {
  constexpr std::string_view names[] = {"impact", "slip+", "slip-", "stick", "release", "graze", "chatter"};
  return names[static_cast<int>(kind)];
}

Motion::Motion(const System& system, const State& initial, Instant start, MotionOptions options)
    : system_(&system), options_(options), now_(start), segment_start_(start) {
  validate(system.model(), initial);
  const int m = system.frame().size();
  const auto padded = static_cast<std::size_t>((m + 7) / 8 * 8);
  int blocks = 0, guards = 1;
  for (int id = 0; id < system.mode_count(); ++id) {
    blocks = std::max(blocks, system.mode(id).state_blocks() + 3 * system.mode(id).guard_count());
    guards = std::max(guards, system.mode(id).guard_count());
  }
  for (auto* buffer : {&X_, &magnitude_, &X_before_, &X_segment_, &X_next_}) buffer->assign(padded, 0.0);
  scratch_.assign(4 * padded, 0.0);
  out_.resize(blocks);
  sample_out_.resize(padded / 8);
  noise_.resize((guards + 7) / 8);
  orders_.assign(guards, 0);
  before_.assign(2 * static_cast<std::size_t>(system.frame().n), 0.0);
  budget_period_ = now_.period;

  system.frame().enter(initial.data(), X_.data());
  system.frame().set_phase(now_.fraction, X_.data());
  X_segment_ = X_before_ = X_;
  settle(Cause::start);
}

State Motion::state() const {
  State out(before_.size());
  state(out);
  return out;
}

void Motion::state(std::span<double> out) const { system_->frame().leave(X_.data(), out.data()); }

std::span<const double> Motion::before() const {
  system_->frame().leave(X_before_.data(), before_.data());
  return before_;
}

Motion::Segment Motion::segment() const { return {segment_start_, segment_mode_, elapsed_, X_segment_}; }

void Motion::sample(double s, std::span<double> out) const {
  const mode::Mode& mode = system_->mode(segment_mode_);
  const int m = system_->frame().size();
  double* X = scratch_.data();
  double* at = X + m;
  std::copy_n(X_segment_.begin(), m, X);
  for (; s > mode.window(); s -= mode.window()) {
    mode.step(X, sample_out_.data());
    std::copy_n(reinterpret_cast<const double*>(sample_out_.data()), m, X);
  }
  mode.state_at(s / mode.window(), X, at);
  system_->frame().leave(at, out.data());
}

void Motion::fail(const std::string& what) const {
  std::string message = what + " at t = " + std::to_string(now_.seconds(system_->period())) + " (period " +
                        std::to_string(now_.period) + "), mode " + system_->mode_name(mode_) + ", state";
  const State here = state();
  const auto names = state_names(system_->model());
  char text[64];
  for (std::size_t i = 0; i < here.size(); ++i) {
    std::snprintf(text, sizeof text, " %s=%.17g", names[i].c_str(), here[i]);
    message += text;
  }
  std::snprintf(text, sizeof text, " phase=%.17g", now_.fraction);
  throw NumericalError(message + text);
}

Outcome Motion::advance(Instant end) {
  if (pending_count_ > 0) return next_pending();
  for (;;) {
    const double limit = end.since(now_) * system_->period();
    if (limit < 0.0 || (limit == 0.0 && !resume_)) return Outcome::reached_end;
    if (chatter_stop_ >= 0 && end_chatter(limit)) return next_pending();
    begin_segment();
    if (pending_count_ > 0) return next_pending();
    switch (fly(limit)) {
      case Flight::event:
        return next_pending();
      case Flight::end:
        now_ = end;
        system_->frame().set_phase(now_.fraction, X_.data());
        resume_ = true;
        return Outcome::reached_end;
      case Flight::restart:
        resume_ = true;
        break;
    }
  }
}

Outcome Motion::next_pending() {
  event_ = pending_[0];
  std::move(pending_.begin() + 1, pending_.begin() + pending_count_, pending_.begin());
  --pending_count_;
  return Outcome::event;
}

/// A segment that continues the last one (after a cut, or a restart near a window's end) finds its guards' start orders anew;
/// one that follows an event has them from the mode graph.
void Motion::begin_segment() {
  segment_start_ = now_;
  segment_mode_ = mode_;
  elapsed_ = arrived_x_ = 0.0;
  hit_guard_ = nullptr;
  X_segment_ = X_;
  ++counters_.segments;
  if (!resume_) return;
  resume_ = false;
  note_magnitude();
  const mode::Mode& mode = system_->mode(mode_);
  for (int g = 0; g < mode.guard_count(); ++g) {
    orders_[g] = flow::start_order(mode, g, X_.data(), magnitude_.data());
    if (orders_[g] == flow::negative) {  // the cut fell on the event
      handle(g, false);
      return;
    }
  }
}

Motion::Flight Motion::fly(double limit) {
  const mode::Mode& mode = system_->mode(mode_);
  const double H = mode.window();
  const int m = mode.size();
  for (long flown = 0;; ++flown) {
    elapsed_ = static_cast<double>(flown) * H;  // a sum would gather a rounding per window
    ++counters_.windows;
    mode.advance(X_.data(), out_.data());
    const double x_end = std::min(1.0, (limit - elapsed_) / H);
    const Found found = first_event_in_window(flown == 0, x_end);
    if (found.kind != event::RootKind::none) {
      arrive(found.x);
      if (found.kind == event::RootKind::restart) return Flight::restart;
      handle(found.guard, found.kind == event::RootKind::graze);
      return Flight::event;
    }
    if (x_end < 1.0) {
      arrive(x_end);
      return Flight::end;
    }
    std::copy_n(reinterpret_cast<const double*>(out_.data()), m, X_.data());
    at_one_instant_ = 0;
  }
}

Motion::Found Motion::first_event_in_window(bool first, double x_end) {
  const mode::Mode& mode = system_->mode(mode_);
  note_magnitude();
  mode.bernstein_noise(magnitude_.data(), noise_.data());
  Found found{event::RootKind::none, 0, x_end};
  int falling = -1;  // a gap that falls all over the window: its pair does not come to rest before the impact
  for (int g = 0; g < mode.guard_count(); ++g) {
    int order = first ? orders_[g] : 0;
    if (!first &&
        orders_[g] == flow::never) {  // zero so far, as a force that just holds: does it begin to differ from zero?
      orders_[g] = order = flow::start_order(mode, g, X_.data(), magnitude_.data());
      if (order == flow::negative) return {event::RootKind::crossing, g, 0.0};
    }
    if (order == flow::never || (falling >= 0 && mode.guards()[g].falls_with == falling)) continue;
    event::GuardWindow window;
    std::copy_n(out_.begin() + mode.state_blocks() + 3 * g, 3, window.bernstein.data());
    if (event::excluded(window.bernstein, noise_[g / 8][g % 8], order)) continue;
    mode.taylor(g, X_.data(), window.taylor);
    mode.taylor_noise(g, magnitude_.data(), window);
    window.order = order;
    window.taylor[0] = event::with_first(window.taylor[0], order, 0.0);
    if (order > 0) window.noise_0 = 0.0;
    if (order > 1) window.noise_1 = 0.0;
    const event::Root root = event::first_root(window, found.x, counters_.evaluations);
    if (root.kind != event::RootKind::none && (found.kind == event::RootKind::none || root.x < found.x))
      found = {root.kind, g, root.x};
    if (root.falls) falling = g;
  }
  return found;
}

/// Moves the state to x of the present window and the clock with it.
void Motion::arrive(double x) {
  const mode::Mode& mode = system_->mode(mode_);
  mode.state_at(x, X_.data(), X_next_.data());
  X_.swap(X_next_);
  elapsed_ += x * mode.window();
  arrived_x_ = x;
  if (x > 0.0) at_one_instant_ = 0;
  now_ = segment_start_.plus(elapsed_ / system_->period());
  system_->frame().set_phase(now_.fraction, X_.data());
}

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
  note_magnitude();
  const mode::Mode& mode = system_->mode(mode_);
  const int touched = graze ? flow::start_order(mode, guard, X_.data(), magnitude_.data(), 2) : flow::negative;
  if (touched == flow::negative) return settle(Cause::force);
  for (int g = 0; g < mode.guard_count(); ++g) orders_[g] = flow::start_order(mode, g, X_.data(), magnitude_.data());
  orders_[guard] = touched;
  chatter_stop_ = -1;
}

/// The stop of a pair that comes to rest just where its gap vanishes, within the gap's rounding bound, or -1. The gap's minimum and the zero of
/// its rate are one instant, whichever of the two searches ends an ulp earlier.
int Motion::stop_touched_at_rest(int friction) const {
  const mode::Mode& mode = system_->mode(mode_);
  for (int g = 0; g < mode.guard_count(); ++g) {
    const mode::Guard& guard = mode.guards()[g];
    if (guard.kind != GuardKind::gap || !system_->coupling(guard.contact, friction).same_pair) continue;
    event::GuardWindow window;
    mode.taylor_noise(g, magnitude_.data(), window);
    const double x = arrived_x_;
    if (flow::gap(*system_, guard.contact, X_.data()) <= window.noise_0 + x * (window.noise_1 + x * window.noise_2))
      return guard.contact;
  }
  return -1;
}

/// Sets the velocity of a pair relative to `speed` to exactly zero in the stored state.
void Motion::rest(const mode::ContactRow& contact, double speed) {
  const mode::Frame& frame = system_->frame();
  if (contact.own >= 0) {
    X_[frame.u(contact.own)] = speed == frame.drift[contact.own] ? 0.0 : speed - frame.drift[contact.own];
    return;
  }
  for (int i = 0; i < frame.n; ++i) {  // a row that is +- one contact coordinate
    if (std::abs(contact.row[i]) == 1.0) {
      X_[frame.u(i)] = contact.row[i] * speed - frame.drift[i];
      return;
    }
  }
}

/// The gap has reached zero: an impact, or a graze without impulse.
void Motion::touch(int stop, bool graze) {
  const mode::ContactRow& contact = system_->frame().stops[stop];
  if (contact.own >= 0) X_[contact.own] = 0.0;
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
  for (int i = 0; i < frame.n; ++i) X_[frame.u(i)] -= (1.0 + r) * w * system_->impulse(stop)[i];
  const int own = frame.stops[stop].own;
  if (own >= 0) X_[frame.u(own)] = -r * w - frame.drift[own];
  ++counters_.impacts;
  report(EventKind::impact, stop, w);
  chatter_stop_ = r > 0.0 && r < 1.0 ? stop : -1;
}

/// Decides the next mode at the present instant and reports what follows from it at once.
void Motion::settle(Cause cause) {
  for (int s = 0; cause == Cause::start && s < stops(); ++s) {
    if (flow::gap(*system_, s, X_.data()) == 0.0 && flow::approach_velocity(*system_, s, X_.data()) > 0.0) impact(s);
  }
  note_magnitude();
  const int old = mode_;
  mode_ = flow::select_mode(*system_, X_.data(), magnitude_.data(), orders_);
  if (mode_ < 0) {
    mode_ = old;
    fail("no contact mode fits the state (a contact force is inconsistent)");
  }
  if (cause != Cause::impact && cause != Cause::start) chatter_stop_ = -1;
  if (cause != Cause::start && cause != Cause::force) report_settled(cause, old);
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

/// Replaces a proven complete chatter by its limit if that is known sharply enough and comes within `limit`.
bool Motion::end_chatter(double limit) {
  const int stop = chatter_stop_;
  chatter_stop_ = -1;
  const double H = system_->mode(mode_).window();
  const flow::ChatterLimit chatter =
      flow::prove_chatter(*system_, stop, X_.data(), options_.chatter_tolerance * system_->period(), scratch_);
  if (!chatter.proven || chatter.duration > std::min(limit, 0.5 * H)) return false;

  // The pair's momentum does not see the impacts: flow the closed stop from the velocity after a fully plastic impact.
  const mode::Frame& frame = system_->frame();
  const double w = flow::approach_velocity(*system_, stop, X_.data());
  for (int i = 0; i < frame.n; ++i) X_[frame.u(i)] -= w * system_->impulse(stop)[i];
  rest(frame.stops[stop], 0.0);
  note_magnitude();
  const int closed = flow::select_mode(*system_, X_.data(), magnitude_.data(), orders_);
  if (closed < 0) fail("no contact mode fits the limit of a chatter");
  mode_ = closed;
  begin_segment();
  arrive(chatter.duration / system_->mode(closed).window());
  X_before_ = X_;
  report(EventKind::chatter, stop, 0.0);
  pending_[pending_count_ - 1].error = chatter.error;
  settle(Cause::force);
  return true;
}

void Motion::report(EventKind kind, int contact, double w) {
  pending_[pending_count_++] = Event{kind, contact, now_, w, 0.0};
  ++counters_.events;
  counters_.grazes += kind == EventKind::graze;
  if (++at_one_instant_ > most_events_at_one_instant) fail("more than 16 events at one instant");
  if (now_.period != budget_period_) {
    budget_period_ = now_.period;
    budget_events_ = 0;
  }
  if (++budget_events_ > options_.most_events_per_period)
    fail("event budget: more than " + std::to_string(options_.most_events_per_period) +
         " events in one period; raise the budget or change the restitution");
}

/// |X|, what rounding is measured by. The phase is known to the clock's rounding only, also where a sine vanishes: those count as one.
void Motion::note_magnitude() {
  for (std::size_t i = 0; i < X_.size(); ++i) magnitude_[i] = std::abs(X_[i]);
  const mode::Frame& frame = system_->frame();
  std::fill_n(magnitude_.begin() + 2 * frame.n, 2 * frame.harmonics.size(), 1.0);
}

}  // namespace slapstick
