#include "slapstick/flow/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "slapstick/base/error.hpp"
#include "slapstick/base/floating_point.hpp"
#include "slapstick/flow/mode_graph.hpp"

namespace slapstick {

namespace {

/// Steps lose less than a guard's rounding bound in so many windows.
constexpr int windows_per_start = 16;

/// More than an instant and its place in a window of H periods can differ, in windows. Whether an event comes before a cut is decided by
/// the clock, which does not know of the cut.
double clock_rounding(double H) { return 0x1p-46 + 0x1p-51 / H; }

}  // namespace

std::string_view name(EventKind kind) {
  constexpr std::string_view names[event_kinds] = {"impact", "slip+",   "slip-",  "stick",     "release",
                                                   "graze",  "chatter", "engage", "disengage", "separate"};
  return names[static_cast<int>(kind)];
}

Motion::Motion(const System& system, const State& state, Instant start, MotionOptions options)
    : system_(&system),
      options_(options),
      now_(start),
      segment_start_(start),
      origin_(system.frame().size()),
      X_(system.frame().size()),
      X_window_(X_),
      magnitude_(X_),
      X_before_(X_),
      X_segment_(X_),
      X_next_(X_),
      phase_floor_(X_) {
  const IeeeArithmetic ieee;
  validate(system.model(), state);
  const mode::Frame& frame = system.frame();
  const int guards = 1 + stops() + 2 * frictions() + 2 * compliants();
  touching_.reserve(stops());
  pending_.reserve(64 + 4 * guards);
  hits_.reserve(guards);
  strikes_.reserve(64);
  scratch_.assign(4 * X_.span().size(), 0.0);
  sample_out_.resize(X_.span().size() / 8);
  orders_.assign(guards, 0);
  tail_orders_.assign(guards, 0);
  lingers_.assign(guards, false);
  before_.assign(2 * static_cast<std::size_t>(frame.n), 0.0);
  std::fill_n(phase_floor_.data() + 2 * frame.d, 2 * frame.harmonics.size(), 1.0);
  budget_period_ = now_.period;

  frame.enter(state.data(), X_.data());
  frame.set_phase(now_.fraction, X_.data());
  X_segment_ = X_before_ = X_;
  this->start();
  shown_ = -1;
}

/// A start in contact and approaching is an impact, the first event of the motion.
void Motion::start() {
  const int stop = approaching();
  if (stop < 0) return choose_mode();
  mode_ = flow::approaching_mode(*system_, X_.data());
  here_ = &system_->mode(mode_);
  begin_segment();
  const auto& guards = here_->guards();
  for (std::size_t g = 0; g < guards.size(); ++g) {
    if (guards[g].kind != mode::GuardKind::gap || flow::gap(*system_, guards[g].contact, X_.data()) != 0.0) continue;
    if (flow::approach_velocity(*system_, guards[g].contact, X_.data()) <= 0.0) continue;
    hits_.push_back(static_cast<int>(g));
  }
  X_before_ = X_;
  strike_all();
  settle(Cause::impact);
}

State Motion::state() const {
  State out(before_.size());
  state(out);
  return out;
}

void Motion::state(std::span<double> out) const {
  const IeeeArithmetic ieee;
  system_->frame().leave(X_.data(), out.data());
}

std::span<const double> Motion::before() const {
  const IeeeArithmetic ieee;
  system_->frame().leave(X_before_.data(), before_.data());
  return before_;
}

Motion::Segment Motion::segment() const {
  return {segment_start_, segment_mode_, segment_duration_, X_segment_.span()};
}

void Motion::sample(double s, std::span<double> out) const {
  const IeeeArithmetic ieee;
  const mode::Mode& mode = system_->mode(segment_mode_);
  const int m = system_->frame().size();
  double* X = scratch_.data();
  double* at = X + m;
  std::copy_n(X_segment_.data(), m, X);
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
  if (shown_ + 1 < static_cast<int>(pending_.size())) {
    ++shown_;
    return Outcome::event;
  }
  if (end <= now_) return Outcome::reached_end;
  const IeeeArithmetic ieee;
  const double limit = end.since(flight_.start) * system_->period();
  if (!pending_.empty()) last_ = pending_[shown_];
  pending_.clear();
  shown_ = 0;
  if (chatter_stop_ >= 0 && end_chatter(limit)) return Outcome::event;
  begin_segment();
  if (fly(end)) return Outcome::event;
  now_ = end;
  system_->frame().set_phase(now_.fraction, X_.data());
  return Outcome::reached_end;
}

/// From the state now, in the mode just selected; `orders_` and `magnitude_` are those of this state.
void Motion::begin_flight() {
  flight_ = {now_, 0};
  elapsed_ = 0.0;
  clear_lingers();
  X_window_ = X_;
  origin_.begin();
  ++counters_.windows;
}

void Motion::begin_segment() {
  segment_start_ = now_;
  segment_mode_ = mode_;
  segment_begun_ = elapsed_;
  segment_duration_ = 0.0;
  hits_.clear();
  strikes_.clear();
  X_segment_ = X_;
  ++counters_.segments;
}

/// Goes on with the flight, up to `end`. True if an event has ended it.
bool Motion::fly(Instant end) {
  for (;;) {
    const double H = here_->window_in_periods();
    const double to_end = std::max((end.since(flight_.start) - flight_.windows * H) / H, 0.0);  // in windows
    const double x_end = std::min(to_end + clock_rounding(H), 1.0);
    const Found found = first_event_in_window(x_end);
    if (found.kind != event::RootKind::none && instant(found.x) > end) {
      look(std::min(to_end, 1.0));
      return false;
    }
    switch (found.kind) {
      case event::RootKind::none:
        if (x_end < 1.0) {
          look(to_end);
          return false;
        }
        next_window();
        break;
      case event::RootKind::restart:
        restart_window(found.x);
        break;
      case event::RootKind::crossing:
      case event::RootKind::graze:
        look(found.x);
        if (origin_.can_carry() && in_doubt(found)) {
          sharpen_window();
          break;
        }
        stand(found.x);
        handle(found.guard, found.kind == event::RootKind::graze);
        return true;
    }
  }
}

/// The first event before x_end; if there is none, the place where a search that could not decide wants to start anew.
Motion::Found Motion::first_event_in_window(double x_end) {
  const mode::Mode& mode = *here_;
  Found found{event::RootKind::none, 0, x_end};
  double restart = -1.0;
  int falling = -1;  // a gap that falls all over the window: its pair does not come to rest before the impact
  for (int g = 0; g < mode.guard_count(); ++g) {
    if (orders_[g] == flow::negative) return {event::RootKind::crossing, g, 0.0};
    if (found.x == 0.0 || orders_[g] == flow::never || (falling >= 0 && mode.guards()[g].falls_with == falling))
      continue;
    if (mode.excludes(g, orders_[g], X_window_.data(), size_, flown_noise(g))) continue;
    event::GuardWindow window;
    window.hull = enclosed(g);
    if (event::excluded(window.hull)) continue;
    mode.taylor(g, orders_[g], X_window_.data(), window.taylor);
    const event::Root root = event::first_root(window, found.x, counters_.evaluations);
    if (root.kind == event::RootKind::restart)
      restart = restart < 0.0 ? root.x : std::min(restart, root.x);
    else if (root.kind != event::RootKind::none && (found.kind == event::RootKind::none || root.x < found.x))
      found = {root.kind, g, root.x, root.doubtful};
    if (root.falls && orders_[g] == 0) falling = g;
    if (root.lingers) any_lingers_ = lingers_[g] = true;
  }
  if (found.kind == event::RootKind::none && restart >= 0.0) return {event::RootKind::restart, 0, restart};
  return found;
}

/// More than what the rounding of earlier windows adds to a guard's noise.
double Motion::flown_noise(int guard) const {
  return origin_.stale() ? 8.0 * origin_.staleness() * origin_.size() * here_->coarse_noise(guard) : 0.0;
}

/// The hull of a guard in the present window, with what earlier windows' rounding adds to its noise.
event::Hull Motion::enclosed(int guard) const {
  event::Hull hull, flown;
  here_->enclose(guard, orders_[guard], X_window_.data(), magnitude_.data(), hull);
  const double lowest = hull.bounds[event::hull_error] + flown_noise(guard);
  if (!origin_.stale() || event::all_above(hull.bernstein, lowest)) return hull;
  here_->enclose(guard, orders_[guard], X_window_.data(), origin_.largest(), flown);
  event::add_noise(hull, flown.bounds, origin_.staleness());
  return hull;
}

/// No event in this window: every guard is clear of its noise at its end, or lingers in it, or has been zero so far, as a force that
/// just holds. The last two are judged by their derivatives again.
void Motion::next_window() {
  const mode::Mode& mode = *here_;
  mode.step(X_window_.data(), X_next_.lanes().data());
  origin_.pass(mode.window(), X_window_.lanes(), X_next_.lanes());
  std::swap(X_window_, X_next_);
  ++counters_.windows;
  if (++flight_.windows == windows_per_start) move_start(0.0, X_window_);
  note_magnitude(X_window_);
  for (int g = 0; g < mode.guard_count(); ++g) {
    const bool unclear = orders_[g] == flow::never || lingers_[g];
    orders_[g] = unclear ? flow::start_order(mode, g, X_window_.data(), magnitude_.data()) : 0;
  }
  clear_lingers();
}

void Motion::clear_lingers() {
  if (any_lingers_) lingers_.assign(lingers_.size(), false);
  any_lingers_ = false;
}

/// The root search could not decide at the window's end: a new window, from x of this one on, has that place inside.
void Motion::restart_window(double x) {
  const mode::Mode& mode = *here_;
  mode.state_at(x, X_window_.data(), X_next_.data());
  move_start(x, X_next_);
  origin_.pass(x * mode.window(), X_window_.lanes(), X_next_.lanes());
  std::swap(X_window_, X_next_);
  ++counters_.windows;
  note_magnitude(X_window_);
  for (int g = 0; g < mode.guard_count(); ++g)
    orders_[g] = flow::start_order(mode, g, X_window_.data(), magnitude_.data());
}

/// Would a sharper state perhaps decide otherwise what is an event, or which events are one? X_ is the state at the event.
bool Motion::in_doubt(const Found& found) const {
  if (found.doubtful) return true;
  for (int g = 0; g < here_->guard_count(); ++g) {
    if (g != found.guard && within_noise(g, found.x)) return true;
  }
  return false;
}

/// A touch or a tie that the rounding of earlier windows leaves in doubt is looked at again, with the state that the flight's origin gives.
void Motion::sharpen_window() {
  const mode::Mode& mode = *here_;
  origin_.carry(mode, X_window_.data());
  move_start(0.0, X_window_);
  note_magnitude(X_window_);
  for (int g = 0; g < mode.guard_count(); ++g)
    orders_[g] = flow::start_order(mode, g, X_window_.data(), magnitude_.data());
}

/// Counts the flight from x of its present window on, where the state is X. The clock sets the phase, which steps from window to window
/// would lose digit by digit: it counts windows exactly.
void Motion::move_start(double x, Extended& X) {
  const mode::Mode& mode = *here_;
  segment_begun_ -= flight_.elapsed(mode.window()) + x * mode.window();
  flight_ = {instant(x), 0};
  system_->frame().set_phase(flight_.start.fraction, X.data());
  chatter_stop_ = -1;  // its limit was within the first window
}

/// x of the present window on the clock.
Instant Motion::instant(double x) const {
  return flight_.start.plus((flight_.windows + x) * here_->window_in_periods());
}

/// Reads the coordinates at x of the present window.
void Motion::look(double x) {
  const mode::Mode& mode = *here_;
  elapsed_ = flight_.elapsed(mode.window()) + x * mode.window();
  segment_duration_ = elapsed_ - segment_begun_;
  if (x == 0.0)
    X_ = X_window_;
  else
    mode.state_at(x, X_window_.data(), X_.data());
}

/// Moves to x of the present window, the clock as well.
void Motion::arrive(double x) {
  look(x);
  stand(x);
}

/// The same where the coordinates have been read.
void Motion::stand(double x) {
  arrived_x_ = x;
  const Instant at = instant(x);
  if (now_ < at) {
    now_ = at;
    at_one_instant_ = 0;
    struck_now_ = 0;
    fastest_now_ = 0.0;
  }
  system_->frame().set_phase(now_.fraction, X_.data());
}

/// |X|, what rounding is measured by. The phase is known to the clock's rounding only, also where a sine vanishes: those count as one.
void Motion::note_magnitude(Extended& X) {
  event::Lane8 total{};
  for (std::size_t b = 0; b < X.lanes().size(); ++b)
    total += magnitude_.lanes()[b] = event::larger(event::magnitude(X.lanes()[b]), phase_floor_.lanes()[b]);
  size_ = event::sum(total);
}

}  // namespace slapstick
