/// What happens at an event: rest, next mode, complete chatter; ties are in engine_ties.cpp, impacts in
/// engine_impacts.cpp. See flow/motion.hpp for the order of things.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/ranges.hpp"
#include "flow/changes.hpp"
#include "flow/chatter.hpp"
#include "flow/engine.hpp"
#include "flow/impact_law.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::flow {

using mode::GuardKind;

namespace {

constexpr long most_events_at_one_instant = 20'000;

/// True for the guards of the force that a contact at rest needs.
bool of_holding(GuardKind kind) {
  return kind == GuardKind::stick_above || kind == GuardKind::stick_below || kind == GuardKind::press;
}

}  // namespace

void Engine::handle(int guard, bool graze) {
  guard = of_pair(guard);
  hits_.push_back(guard);
  make_exact(here_->guards()[guard]);
  X_before_ = X_;
  gather_ties(guard);
  leave_touched_limits();
  if (hits_.empty()) return go_on();
  graze = graze && guard == hits_.front();
  guard = hits_.front();
  const mode::Guard& hit = here_->guards()[guard];
  switch (hit.kind) {
    case GuardKind::gap:
      return touch(hit.contact, graze);
    case GuardKind::slip:
      if (const int stop = stop_touched_at_rest(hit.contact); stop >= 0) return touch(stop, true);
      set_velocity_zero(system_->frame().frictions[hit.contact]);
      return choose_next_mode(Cause::reversal);
    case GuardKind::stick_above:
    case GuardKind::stick_below:
      return force_limit(guard, stops() + hit.contact, graze);
    case GuardKind::press:
      return force_limit(guard, hit.contact, graze);
    case GuardKind::engage:
    case GuardKind::leave:
    case GuardKind::let_go:
    case GuardKind::push:
      return compliant_limit(hit.contact, hit.kind);
    case GuardKind::corner_above:
    case GuardKind::corner_below:
    case GuardKind::load:
    case GuardKind::unloaded:
    case GuardKind::bound:
    case GuardKind::beyond:
      return cross(guard, graze);
  }
}

/// The guard's zero, in the state just before, which can be started from.
void Engine::make_exact(const mode::Guard& hit) {
  if (hit.kind == GuardKind::gap) set_gap_zero(system_->frame().stops[hit.contact]);
  if (of_crossing(hit.kind)) set_crossing_guard(hit, 0.0);
  if (of_holding(hit.kind)) set_holding_guard_zero(hit);
}

/// A holding force has reached its limit: release. A force that only touches its limit holds on (|f0| <= f_s is stick):
/// the guard has a double zero here, and the mode goes on unless its next derivative says otherwise.
void Engine::force_limit(int guard, int contact, bool graze) {
  if (!graze) return choose_next_mode(Cause::force, reported_event(EventKind::release, contact));
  report(EventKind::graze, contact, 0.0);
  note_magnitude(X_);
  const mode::Mode& mode = *here_;
  const int touched = start_order(mode, guard, X_.data(), magnitude_.data(), 2);
  if (touched == negative) return choose_next_mode(Cause::force);
  for (int g = 0; g < mode.guard_count(); ++g) orders_[g] = start_order(mode, g, X_.data(), magnitude_.data());
  orders_[guard] = touched;
  bouncing_.clear();
  begin_flight();
}

/// The gap has reached zero: an impact, or a graze without impulse.
void Engine::touch(int stop, bool graze) {
  const mode::ContactRow& contact = system_->frame().stops[stop];
  set_gap_zero(contact);  // not yet, if a reversal has found it
  if (graze || approach_velocity(*system_, stop, X_.data()) <= 0.0) {
    set_velocity_zero(contact);
    report(EventKind::graze, stop, 0.0);
    return choose_next_mode(Cause::graze);
  }
  strike_all();
  choose_next_mode(Cause::impact);
}

/// A compliant stop begins or ends to act: at its gap, or beyond it where its force has come to zero.
void Engine::compliant_limit(int compliant, GuardKind kind) {
  const bool at_gap = kind == GuardKind::engage || kind == GuardKind::leave;
  const bool was_on = here_->states().compliant[compliant] != mode::CompliantState::detached;
  at_gap ? set_gap_zero(system_->frame().compliant[compliant]) : set_force_zero(compliant);
  const bool begins = kind == GuardKind::engage || kind == GuardKind::push;
  const EventKind event = begins ? EventKind::engage : was_on ? EventKind::disengage : EventKind::separate;
  choose_next_mode(Cause::compliant, reported_event(event, stops() + frictions() + compliant));
}

/// A characteristic passes a corner, a normal force or the excess of a spring force its zero; or touches it.
void Engine::cross(int guard, bool graze) {
  const mode::Guard& hit = here_->guards()[guard];
  const int contact = contact_index(hit.kind, hit.contact, system_->model());
  if (graze) return force_limit(guard, contact, graze);
  const EventKind event = hit.kind == GuardKind::load       ? EventKind::unload
                          : hit.kind == GuardKind::unloaded ? EventKind::load
                                                            : EventKind::corner;
  choose_next_mode(Cause::compliant, reported_event(event, contact));
}

/// The mode that may start now, from which a new flight begins.
void Engine::start_mode() {
  const mode::Frame& frame = system_->frame();
  if (here_ != nullptr) frame.set_sliders(here_->states().pieces, X_.data());
  note_magnitude(X_);
  const ModeId next = select_mode(*system_, X_.data(), magnitude_.data(), orders_);
  if (next < 0) fail("no contact mode fits the state (a contact force is inconsistent)");
  mode_ = next;
  here_ = &system_->mode(mode_);
  frame.set_slider_rates(here_->states().pieces, X_.data());
  if (!frame.sliders.empty()) note_magnitude(X_);
  begin_flight();
}

/// The numbers of contacts that depend on each other are made to agree again. What that does to a gap by rounding is a
/// contact, and perhaps an impact.
void Engine::reconcile_contacts() {
  if (system_->frame().d == system_->frame().n) return;
  for (int round = 0; round < 8; ++round) {
    system_->frame().refresh(X_.data());
    for (int s = 0; s < stops(); ++s)
      if (gap(*system_, s, X_.data()) < 0.0) set_gap_zero(system_->frame().stops[s]);
    if (approaching() < 0) return;
    strike_all();
  }
}

/// Decides the next mode after an event and reports the event, unless that is done, and what follows from it at once.
void Engine::choose_next_mode(Cause cause, std::optional<ReportedEvent> reported) {
  const mode::ContactStates& old = here_->states();
  if (approaching() >= 0) strike_all();  // a tie
  reconcile_contacts();
  const ModeId ended = mode_;
  const double flown = elapsed_;
  start_mode();
  if (cause != Cause::impact && cause != Cause::start) bouncing_.clear();
  const bool released = reported && reported->kind == EventKind::release;
  if (released && mode_ == ended && pending_.empty() && !at_instant_.held) return postpone_release(flown);
  report_changes(cause, reported, old);
}

/// Rounding has left a force so far above zero that the choice of the mode sees it hold, and changes nothing: the force
/// is released, and told, where the flight finds its zero again. The segment goes on.
void Engine::postpone_release(double flown) {
  at_instant_.held = true;
  hits_.clear();
  spend_budget();
  segment_begun_ -= flown;
}

/// The segment goes on in its mode.
void Engine::go_on() {
  const double flown = elapsed_;
  note_magnitude(X_);
  for (int g = 0; g < here_->guard_count(); ++g) orders_[g] = start_order(*here_, g, X_.data(), magnitude_.data());
  bouncing_.clear();
  begin_flight();
  spend_budget();
  segment_begun_ -= flown;
}

/// What the new mode says about all contacts.
void Engine::report_changes(Cause cause, const std::optional<ReportedEvent>& reported, const mode::ContactStates& old) {
  const mode::Guard* hit = hit_guard();
  Ended ended;
  if (reported) ended.own = reported->kind;
  ended.reversal = cause == Cause::reversal;
  ended.start = cause == Cause::start;
  ended.struck = at_instant_.struck;
  if (hit != nullptr) {
    ended.kind = hit->kind;
    ended.contact = hit->contact;
  }
  for (std::size_t k = 1; k < hits_.size(); ++k) {  // the first has told: a touch at rest is one event, its graze
    const mode::Guard& guard = system_->mode(segment_mode_).guards()[hits_[k]];
    if (guard.kind == GuardKind::slip) ended.rested |= std::uint32_t{1} << guard.contact;
  }
  const auto tell = [&](EventKind kind, int contact) {
    const bool itself = reported && reported->kind == kind && reported->contact == contact;
    report(kind, contact, itself ? reported->w : speed_of(kind, contact));
  };
  Changes(system_->model(), system_->frame(), ended, old, here_->states(), tell).tell();
}

/// w of an event that changes a contact: that of its pair where its kind has one.
double Engine::speed_of(EventKind kind, int contact) const {
  const mode::Frame& frame = system_->frame();
  const int friction = contact - stops(), compliant = friction - frictions(), piece = compliant - compliants();
  if (piece >= 0) return value_of(frame.characteristics[piece].velocity);
  const bool has_speed = compliant >= 0 || kind == EventKind::load || kind == EventKind::unload;
  if (!has_speed) return 0.0;
  const mode::ContactRow& row = compliant >= 0 ? frame.compliant[compliant] : frame.frictions[friction];
  return row.sign * X_.data()[frame.u(row.own)];
}

double Engine::value_of(const mode::RowVector& row) const {
  double value = 0.0;
  for (Eigen::Index j = 0; j < row.size(); ++j) value += row[j] * X_.data()[j];
  return value;
}

/// Replaces proven complete chatters, from the impacts at which the flight began, by their limit if that is known
/// sharply enough and comes within `limit` of the impacts. A cut before the limit leaves the question to the next call.
bool Engine::end_chatter(double limit) {
  const double tolerance = options_.chatter_tolerance * system_->period();
  std::erase_if(bouncing_, [&](int s) { return !slow_enough(*system_, *here_, s, X_window_.data(), tolerance); });
  if (bouncing_.empty()) return false;
  const ChatterLimit chatter = prove_chatter(*system_, *here_, bouncing_, X_window_.data(), tolerance, scratch_);
  if (!chatter.proven || place_.windows > 0 || chatter.duration > 0.5 * here_->window()) {
    bouncing_.clear();
    return false;
  }
  if (chatter.duration > limit) return false;
  if (!tail_is_quiet(chatter.duration)) {
    bouncing_.clear();
    return false;
  }

  // A pair's momentum does not see the impacts: flow the closed stop from the velocity after a fully plastic impact.
  const double begun = elapsed_;
  const Instant impact = place_.start;
  const mode::Frame& frame = system_->frame();
  X_ = X_window_;
  bring_chatter_to_rest(X_);
  start_mode();
  place_.start = impact;
  const double H = here_->window();
  look(begun / H);
  frame.set_clock(now_, X_.data());
  begin_segment();
  for (const int stop : bouncing_) chattered_ |= std::uint32_t{1} << stop;
  arrive(chatter.duration / H);
  X_before_ = X_;
  for (const int stop : bouncing_) {
    report(EventKind::chatter, stop, 0.0);
    pending_.back().error = chatter.error;
  }
  counters_.shaken += chatter.shaken ? 1 : 0;
  choose_next_mode(Cause::force);
  return true;
}

void Engine::bring_chatter_to_rest(Extended& X) const {
  for (const int stop : bouncing_) strike(*system_, stop, 0.0, X.data());
}

bool Engine::may_chatter() const {
  const double tolerance = options_.chatter_tolerance * system_->period();
  return ranges::any_of(bouncing_, [&](int s) { return slow_enough(*system_, *here_, s, X_.data(), tolerance); });
}

/// Is it of friction that the impacts of a chatter shake?
bool Engine::is_shaken(const mode::Guard& guard) const {
  if (!of_friction(guard.kind)) return false;
  return ranges::any_of(bouncing_, [&](int s) { return system_->coupling(s, guard.contact).effect != 0.0; });
}

/// True if no other contact has its event between the last impacts and the limit of a chatter, which is flown with its
/// stops closed. Friction that the impacts shake is not asked: the proof of the chatter allows it any force.
bool Engine::tail_is_quiet(double duration) {
  X_next_ = X_window_;
  bring_chatter_to_rest(X_next_);
  note_magnitude(X_next_);
  std::vector<int>& orders = tail_orders_;
  const ModeId id = select_mode(*system_, X_next_.data(), magnitude_.data(), orders);
  bool quiet = id >= 0;
  const mode::Mode& closed = quiet ? system_->mode(id) : *here_;
  for (int g = 0; quiet && g < closed.guard_count(); ++g) {
    if (orders[g] == never || is_shaken(closed.guards()[g])) continue;
    event::GuardWindow window;
    closed.enclose(g, orders[g], X_next_.data(), magnitude_.data(), window.hull);
    closed.taylor(g, orders[g], X_next_.data(), window.taylor);
    const double x_end = duration / closed.window();
    quiet = x_end < 1.0 && event::first_root(window, x_end, counters_.evaluations).kind == event::RootKind::none;
  }
  note_magnitude(X_window_);
  return quiet;
}

void Engine::fail_pile_up() const {
  for (const double x : X_.span()) {
    if (!std::isfinite(x)) fail("the numbers overflow: a coordinate or velocity is not finite; scale the model");
  }
  fail("more than " + std::to_string(most_events_at_one_instant) + " events at one instant");
}

/// @param before  the state just before; of the first event of an instant X_before_ is it, as the flight has left it
void Engine::report(EventKind kind, int contact, double w, const Extended& before) {
  if (!pending_.empty()) later_before_.insert(later_before_.end(), before.span().begin(), before.span().end());
  pending_.push_back(Event{kind, contact, now_, w, 0.0});
  ++counters_.events;
  counters_.grazes += kind == EventKind::graze;
  if (kind != EventKind::knot) spend_budget();  // the signal says how many knots there are
}

void Engine::spend_budget() {
  if (++at_instant_.events > most_events_at_one_instant) fail_pile_up();
  if (now_.period != budget_period_) {
    budget_period_ = now_.period;
    budget_events_ = 0;
  }
  if (++budget_events_ > options_.most_events_per_period)
    fail("event budget: more than " + std::to_string(options_.most_events_per_period) +
         " events in one period (fewer with a lower restitution, a shorter forcing period or an earlier end)");
}

}  // namespace slapstick::flow
