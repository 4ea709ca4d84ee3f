/// Flights window by window: steps, searches of the guards' zeros, and the clock.
#include "flow/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/floating_point.hpp"
#include "base/text.hpp"
#include "flow/mode_graph.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::flow {

namespace {

/// Steps lose less than a guard's rounding bound in this many windows.
constexpr int windows_per_start = 16;

/// Products of larger numbers with those of a model may overflow, and then no bound of a guard says anything.
/// @param size  sum of |X|
void demand_ordinary(double size, Instant now, double period) {
  constexpr double largest = 1e150;
  if (size <= largest) return;
  throw NumericalError("the motion grows beyond " + shown(largest) + " at t = " + shown(now.seconds(period)) +
                       ": a coordinate or velocity is too large; give less time, or a model that does not grow");
}

/// More than an instant and its place in a window of H periods can differ, in windows. Whether an event comes before a
/// cut is decided by the clock, which does not know of the cut.
double clock_rounding(double H) { return 0x1p-46 + 0x1p-51 / H; }

}  // namespace

Flight::Flight(const CompiledSystem& system, Instant start)
    : system_(&system),
      now_(start),
      segment_start_(start),
      X_(system.frame().size()),
      X_window_(X_),
      magnitude_(X_),
      X_next_(X_),
      origin_(system.frame().size()),
      X_segment_(X_),
      clock_sizes_(X_) {
  const auto guards = static_cast<std::size_t>(system.most_guards());
  orders_.assign(guards, 0);
  lingers_.assign(guards, false);
  sample_.assign(2 * X_.span().size(), 0.0);
  sample_out_.resize(X_.span().size() / 8);
}

void Flight::note_clock_sizes() { system_->frame().set_clock_sizes(X_.data(), clock_sizes_.data()); }

void Flight::state(std::span<double> out) const {
  const IeeeArithmetic ieee;
  system_->frame().leave(X_.data(), out.data());
}

void Flight::sample(double s, std::span<double> out) const {
  const IeeeArithmetic ieee;
  system_->frame().leave(stepped_to(s), out.data());
}

std::span<const double> Flight::extended_within(double s) const {
  const IeeeArithmetic ieee;
  const mode::Frame& frame = system_->frame();
  double* X = stepped_to(s);
  set_clock_in_segment(s / system_->period(), X);
  return {X, static_cast<std::size_t>(frame.size())};
}

/// Writes what moves by the clock into X.
/// @param periods  from the start of the last segment
void Flight::set_clock_in_segment(double periods, double* X) const {
  const mode::Frame& frame = system_->frame();
  std::copy(X_segment_.data() + 2 * frame.d, X_segment_.data() + frame.size(), X + 2 * frame.d);  // the slopes
  frame.set_clock_within(segment_start_.plus(periods), X);
}

/// p and u, by steps from the start of the last segment; what moves by the clock is left as it was.
double* Flight::stepped_to(double s) const {
  const mode::Mode& mode = system_->mode(segment_mode_);
  const int m = system_->frame().size();
  double* X = sample_.data();
  double* at = X + m;
  const double H = mode.window_in_periods(), gone = s / system_->period() / H;  // in windows
  const auto windows = static_cast<std::int64_t>(gone);
  if (sample_at_ < 0 || sample_at_ > windows) {
    std::copy_n(X_segment_.data(), m, X);
    sample_at_ = 0;
  }
  for (; sample_at_ < windows; ++sample_at_, ++sampled_windows_) {
    mode.step(X, sample_out_.data());
    std::copy_n(reinterpret_cast<const double*>(sample_out_.data()), m, X);
    const std::int64_t passed = sample_at_ + 1;
    if (passed % windows_per_start == 0) set_clock_in_segment(static_cast<double>(passed) * H, X);
  }
  mode.state_at(gone - static_cast<double>(windows), X, at);
  return at;
}

/// From the state now, in the mode just selected; `orders_` and `magnitude_` are those of this state.
void Flight::begin_flight() {
  demand_ordinary(size_, now_, system_->period());
  place_ = {.start = now_};
  elapsed_ = 0.0;
  clear_lingers();
  X_window_ = X_;
  origin_.begin();
  ++counters_.windows;
}

void Flight::keep_segment_start() {
  X_segment_ = X_;
  sample_at_ = -1;
}

void Flight::begin_segment() {
  segment_start_ = now_;
  segment_mode_ = mode_;
  segment_begun_ = elapsed_;
  segment_duration_ = 0.0;
  keep_segment_start();
  ++counters_.segments;
}

std::optional<Flight::Found> Flight::fly(Instant end) {
  for (;;) {
    const double H = here_->window_in_periods();
    const double to_end = std::max((end.since(place_.start) - place_.windows * H) / H, 0.0);  // in windows
    const double x_end = std::min(to_end + clock_rounding(H), 1.0);
    const Found found = first_event_in_window(x_end);
    if (found.kind != event::RootKind::none && instant(found.x) > end) {
      look(std::min(to_end, 1.0));
      return {};
    }
    switch (found.kind) {
      case event::RootKind::none:
        if (x_end < 1.0) {
          look(to_end);
          return {};
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
        return found;
    }
  }
}

/// The first event before x_end; without one the place where a search that could not decide wants to start anew.
Flight::Found Flight::first_event_in_window(double x_end) {
  const mode::Mode& mode = *here_;
  Found found{event::RootKind::none, 0, x_end};
  double restart = -1.0;
  int falling = -1;  // a gap that falls all over the window: its pair does not come to rest before the impact
  for (int g = 0; g < mode.guard_count(); ++g) {
    if (orders_[g] == negative) return {event::RootKind::crossing, g, 0.0};
    if (found.x == 0.0 || orders_[g] == never || (falling >= 0 && mode.guards()[g].falls_with == falling)) continue;
    if (mode.excludes(g, orders_[g], X_window_.data(), size_, flown_noise(g))) continue;
    event::GuardWindow window;
    if (enclose(g, window.hull)) continue;
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
double Flight::flown_noise(int guard) const {
  return origin_.stale() ? 8.0 * origin_.staleness() * origin_.size() * here_->coarse_noise(guard) : 0.0;
}

/// The hull of a guard in the present window, with what earlier windows' rounding adds to its noise, and whether it
/// excludes a zero. Into a named place: gcc 12 aligns the unnamed result of a call less than kernels' vectors ask for.
bool Flight::enclose(int guard, event::Hull& out) const {
  if (here_->enclose(guard, orders_[guard], X_window_.data(), magnitude_.data(), out, flown_noise(guard))) return true;
  if (!origin_.stale()) return false;
  event::Lane8 flown;
  here_->bounds(guard, orders_[guard], X_window_.data(), origin_.largest(), flown);
  event::add_noise(out, flown, origin_.staleness());
  return event::excluded(out);
}

/// No event in this window: every guard is clear of its noise at its end, or lingers in it, or has been zero so far, as
/// a force that just holds. The last two are judged by their derivatives again.
void Flight::next_window() {
  const mode::Mode& mode = *here_;
  const bool fresh = origin_.leave(X_window_.lanes());
  std::array<double, 2> sizes{};
  mode.pass(X_window_.lanes().data(), clock_sizes_.lanes().data(), fresh, X_next_.lanes().data(),
            magnitude_.lanes().data(), origin_.largest_lanes().data(), sizes.data());
  size_ = sizes[0];
  demand_ordinary(size_, now_, system_->period());
  origin_.arrive(sizes[1]);
  std::swap(X_window_, X_next_);
  ++counters_.windows;
  if (++place_.windows == windows_per_start) {
    move_start(0.0, X_window_);
    note_magnitude(X_window_);
  }
  for (int g = 0; g < mode.guard_count(); ++g) {
    const bool unclear = orders_[g] == never || lingers_[g];
    orders_[g] = unclear ? start_order(mode, g, X_window_.data(), magnitude_.data()) : 0;
  }
  clear_lingers();
}

void Flight::clear_lingers() {
  if (any_lingers_) lingers_.assign(lingers_.size(), false);
  any_lingers_ = false;
}

/// The root search could not decide at the window's end: a new window, from x of this one on, has that place inside.
void Flight::restart_window(double x) {
  const mode::Mode& mode = *here_;
  mode.state_at(x, X_window_.data(), X_next_.data());
  move_start(x, X_next_);
  origin_.pass(x * mode.window(), X_window_.lanes(), X_next_.lanes());
  std::swap(X_window_, X_next_);
  ++counters_.windows;
  note_magnitude(X_window_);
  for (int g = 0; g < mode.guard_count(); ++g) orders_[g] = start_order(mode, g, X_window_.data(), magnitude_.data());
}

/// Is a gap, a velocity or a slider's way to its limit, at x of the window and in the state there, within its rounding
/// bound of zero? False for forces.
bool Flight::within_noise(int guard, double x) const {
  const mode::Guard& h = here_->guards()[guard];
  const int order = orders_[guard];
  const bool slider = system_->frame().slider(h.kind, h.contact) != nullptr;
  const bool force = h.kind != mode::GuardKind::gap && h.kind != mode::GuardKind::slip &&
                     h.kind != mode::GuardKind::engage && h.kind != mode::GuardKind::leave && !slider;
  if (force || order < 0 || order == never) return false;
  const double value = h.kind == mode::GuardKind::gap    ? gap(*system_, h.contact, X_.data())
                       : h.kind == mode::GuardKind::slip ? sliding_velocity(*system_, h.contact, X_.data())
                       : slider                          ? h.at(X_.data())
                                                         : depth(*system_, h.contact, X_.data());
  if (std::abs(value) > 0x1p-30 * size_) return false;
  // Neither the event's place in the flight nor the clock is sharper than some roundings.
  const double instant = 0x1p-50 * (elapsed_ + system_->period());
  return std::abs(value) <= noise_of(guard, x) + instant * std::abs(rate(h));
}

/// A bound of a guard's rounding at x of the window.
double Flight::noise_of(int guard, double x) const {
  event::Hull hull;
  (void)enclose(guard, hull);
  const double noise =
      hull.bounds[event::noise_0] + x * (hull.bounds[event::noise_1] + x * hull.bounds[event::noise_2]);
  double lift = 1.0;  // x^order
  for (int p = 0; p < orders_[guard]; ++p) lift *= x;
  return lift * noise;
}

/// The rate of a guard in the state now.
double Flight::rate(const mode::Guard& guard) const {
  double all = 0.0;
  for (const mode::Guard::Entry& entry : guard.entries) {
    double sum = 0.0;
    for (int j = 0; j < here_->size(); ++j) sum += here_->system()(entry.column, j) * X_.data()[j];
    all += entry.value * sum;
  }
  return all;
}

/// Would a sharper state perhaps decide otherwise what is an event, or which events are one? X_ is the state at the
/// event.
bool Flight::in_doubt(const Found& found) const {
  if (found.doubtful) return true;
  for (int g = 0; g < here_->guard_count(); ++g) {
    if (g != found.guard && within_noise(g, found.x)) return true;
  }
  return false;
}

/// A touch or a tie that the rounding of earlier windows leaves in doubt is looked at again, with the state that the
/// flight's origin gives.
void Flight::sharpen_window() {
  const mode::Mode& mode = *here_;
  origin_.carry(mode, X_window_.data());
  move_start(0.0, X_window_);
  note_magnitude(X_window_);
  for (int g = 0; g < mode.guard_count(); ++g) orders_[g] = start_order(mode, g, X_window_.data(), magnitude_.data());
}

/// Counts the flight from x of its present window on, where the state is X. The clock sets the phase, which steps from
/// window to window would lose digit by digit: it counts windows exactly. So would the segment's length.
void Flight::move_start(double x, Extended& X) {
  place_ = {.start = instant(x), .moved = true};
  segment_begun_ = segment_start_.since(place_.start) * system_->period();
  system_->frame().set_clock(place_.start, X.data());
}

/// x of the present window on the clock.
Instant Flight::instant(double x) const { return place_.start.plus((place_.windows + x) * here_->window_in_periods()); }

/// Reads the coordinates at x of the present window.
void Flight::look(double x) {
  const mode::Mode& mode = *here_;
  elapsed_ = place_.elapsed(mode.window()) + x * mode.window();
  segment_duration_ = elapsed_ - segment_begun_;
  if (x == 0.0)
    X_ = X_window_;
  else
    mode.state_at(x, X_window_.data(), X_.data());
}

/// Moves to x of the present window, the clock as well.
void Flight::arrive(double x) {
  look(x);
  stand(x);
}

/// The same where the coordinates have been read.
void Flight::stand(double x) {
  arrived_x_ = x;
  const Instant at = instant(x);
  if (now_ < at) {
    now_ = at;
    at_instant_.forget();
  }
  system_->frame().set_clock(now_, X_.data());
}

/// |X|, what rounding is measured by. The phase is known to the clock's rounding only, also where a sine vanishes:
/// those count as one.
void Flight::note_magnitude(Extended& X) {
  size_ = event::kernels().magnitudes(X.lanes().data(), clock_sizes_.lanes().data(), static_cast<int>(X.lanes().size()),
                                      magnitude_.lanes().data());
}

}  // namespace slapstick::flow
