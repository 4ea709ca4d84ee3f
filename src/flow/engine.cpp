/// A Motion's start, its advance from event to event, and how it gives up.
#include "flow/engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/floating_point.hpp"
#include "flow/impact_law.hpp"
#include "flow/mode_graph.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::flow {

Engine::Engine(const CompiledSystem& system, const State& state, Instant start, MotionOptions options)
    : Flight(system, start), options_(options), X_before_(X_) {
  const IeeeArithmetic ieee;
  validate(system.model(), state);
  reserve();
  const mode::Frame& frame = system.frame();
  frame.enter(state.data(), X_.data());
  frame.set_clock(now_, X_.data());
  look_ahead();
  X_before_ = X_;
  keep_segment_start();
  this->start();
  shown_ = -1;
}

Engine::Engine(const CompiledSystem& system, std::span<const double> coordinates, Instant start, MotionOptions options)
    : Flight(system, start), options_(options), X_before_(X_) {
  reserve();
  restart(coordinates, start);
}

void Engine::reserve() {
  const int guards = system_->most_guards();
  touching_.reserve(stops());
  bouncing_.reserve(stops());
  pending_.reserve(64 + 4 * guards);
  later_before_.reserve(16 * X_.span().size());
  hits_.reserve(guards);
  strikes_.reserve(64);
  scratch_.assign(4 * X_.span().size(), 0.0);
  tail_orders_.assign(guards, 0);
  before_.assign(2 * static_cast<std::size_t>(system_->frame().n), 0.0);
  budget_period_ = now_.period;
}

void Engine::restart(std::span<const double> coordinates, Instant start) {
  const IeeeArithmetic ieee;
  now_ = start;
  at_instant_.forget();
  hits_.clear();
  strikes_.clear();
  pending_.clear();
  later_before_.clear();
  bouncing_.clear();
  budget_period_ = now_.period;
  budget_events_ = 0;
  std::copy(coordinates.begin(), coordinates.end(), X_.data());
  system_->frame().set_inner_rates(X_.data());
  system_->frame().set_clock(now_, X_.data());
  look_ahead();
  X_before_ = X_;
  keep_segment_start();
  this->start();
  shown_ = -1;
}

/// A start in contact and approaching is an impact, the first event of the motion.
void Engine::start() {
  const int stop = approaching();
  if (stop < 0) {
    here_ = nullptr;
    start_mode();
    if (!leave_limits_at_start()) return;
    here_ = nullptr;  // nothing slips yet
    return start_mode();
  }
  mode_ = approaching_mode(*system_, X_.data());
  here_ = &system_->mode(mode_);
  begin_segment();
  const auto& guards = here_->guards();
  for (std::size_t g = 0; g < guards.size(); ++g) {
    if (guards[g].kind != mode::GuardKind::gap || gap(*system_, guards[g].contact, X_.data()) != 0.0) continue;
    if (approach_velocity(*system_, guards[g].contact, X_.data()) <= 0.0) continue;
    hits_.push_back(static_cast<int>(g));
  }
  X_before_ = X_;
  strike_all();
  choose_next_mode(Cause::start);
}

void Engine::begin_segment() {
  Flight::begin_segment();
  hits_.clear();
  strikes_.clear();
  chattered_ = 0;
}

std::span<const double> Engine::extended_of_event() const {
  const std::size_t size = X_.span().size();
  if (shown_ == 0 || pending_.empty()) return X_before_.span();
  return {later_before_.data() + static_cast<std::size_t>(shown_ - 1) * size, size};
}

std::span<const double> Engine::before() const {
  const IeeeArithmetic ieee;
  system_->frame().leave(extended_of_event().data(), before_.data());
  return before_;
}

void Engine::fail(const std::string& what) const {
  std::string message = what + " at t = " + std::to_string(now_.seconds(system_->period())) + " (period " +
                        std::to_string(now_.period) + "), mode " + system_->mode_name(mode_) + ", state";
  State here(before_.size());
  state(here);
  const auto names = state_names(system_->model());
  char text[64];
  for (std::size_t i = 0; i < here.size(); ++i) {
    std::snprintf(text, sizeof text, " %s=%.17g", names[i].c_str(), here[i]);
    message += text;
  }
  std::snprintf(text, sizeof text, " phase=%.17g", now_.fraction);
  throw NumericalError(message + text);
}

/// A chatter's limit lies within the first window of the flight after its impact: where the flight's start has moved,
/// no limit is due.
Outcome Engine::advance(Instant end) {
  if (shown_ + 1 < static_cast<int>(pending_.size())) {
    ++shown_;
    return Outcome::event;
  }
  if (end <= now_) return Outcome::reached_end;
  const IeeeArithmetic ieee;
  const Instant stage = std::min(end, knot_);
  const double limit = stage.since(place_.start) * system_->period();
  if (!pending_.empty()) last_ = pending_[shown_];
  pending_.clear();
  later_before_.clear();
  shown_ = 0;
  if (!bouncing_.empty() && !place_.moved && end_chatter(limit)) return Outcome::event;
  begin_segment();
  while (const auto found = fly(stage)) {
    handle(found->guard, found->kind == event::RootKind::graze);
    if (!pending_.empty()) return Outcome::event;
  }
  if (stage == knot_) {
    pass_knot();
    return Outcome::event;
  }
  now_ = end;
  system_->frame().set_clock(now_, X_.data());
  return Outcome::reached_end;
}

/// X_ has the slopes of the signals from now on.
void Engine::look_ahead() {
  knot_ = system_->frame().next_knot(now_);
  note_clock_sizes();
}

/// The slope of a signal jumps, its value at a step, and velocities at a pulse. Forces may jump: the next mode is asked
/// for.
void Engine::pass_knot() {
  if (now_ < knot_) at_instant_.forget();
  now_ = knot_;
  const mode::Frame& frame = system_->frame();
  X_before_ = X_;
  frame.set_clock_within(now_, X_before_.data());
  frame.set_clock(now_, X_.data());
  look_ahead();
  const int first = stops() + frictions() + compliants() + static_cast<int>(system_->model().characteristics.size());
  for (std::size_t k = 0; k < frame.signals.size(); ++k)
    if (frame.signals[k].has_knot(now_)) report(EventKind::knot, first + static_cast<int>(k), 0.0);
  take_blow();
  choose_next_mode(Cause::force);
}

/// The pulses of this instant: first those of forces, then the jumps of a wall's speed, by which stops are hit.
void Engine::take_blow() {
  if (kick(false)) bear_blow();
  kick(true);
}

/// Takes the pulses of one kind into the velocities; false if there are none.
bool Engine::kick(bool kinematic) {
  const mode::Frame& frame = system_->frame();
  bool any = false;
  for (std::size_t k = 0; k < frame.signals.size(); ++k) {
    if (system_->model().signals[k].kinematic != kinematic) continue;
    const double area = frame.signals[k].pulse(now_);
    if (area == 0.0) continue;
    frame.kick(k, area, X_.data());
    any = true;
  }
  return any;
}

/// Closed stops bear what presses them; friction, whose force is bounded, takes nothing of a blow in no time.
/// A velocity that keeps nothing of the blow except rounding is what it was: a contact at rest stays at rest.
void Engine::bear_blow() {
  touching_.clear();
  for (int s = 0; s < stops(); ++s)
    if (here_->states().stops[s] == mode::StopState::closed) touching_.push_back(s);
  if (touching_.empty()) return;
  X_next_ = X_;  // with what the blow gave
  std::array<bool, System::most_contacts> borne{};
  if (!bear(*system_, touching_, X_.data(), std::span(borne).first(touching_.size())))
    fail("the blow of this instant has no solution");
  const double *before = X_before_.data(), *given = X_next_.data();
  for (int i = system_->frame().d; i < 2 * system_->frame().d; ++i) {
    double& u = X_.data()[i];
    if (std::abs(u - before[i]) <= mode::Frame::structural_zero * std::abs(given[i] - before[i])) u = before[i];
  }
  Motion::Strike strike{0, true};
  for (std::size_t i = 0; i < touching_.size(); ++i)
    if (borne[i]) strike.stops |= std::uint32_t{1} << touching_[i];
  if (strike.stops != 0) strikes_.push_back(strike);
}

}  // namespace slapstick::flow
