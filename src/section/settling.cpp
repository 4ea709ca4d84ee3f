/// The search for a return of the state to its section: what a motion settles on.
#include "section/settling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ranges.hpp"
#include "flow/compiled_system.hpp"
#include "section/attraction.hpp"
#include "section/flight_section.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick::section {
namespace {

using Eigen::VectorXd;

constexpr long returns_compared = 100;
constexpr double known_to = 1e-9;   ///< a multiplier of a return within 1e-10
constexpr double repelling = 1e-6;  ///< a multiplier of one of a family beyond 1 by more than its own error
constexpr int shortest_round = 500;

}  // namespace

PeriodEvents run_counting(Motion& motion, Instant end, Stop stop) {
  PeriodEvents count;
  run_to(motion, end, stop, [&] {
    const EventKind kind = motion.event().kind;
    count.impacts += StopChoice().is_point(motion.event());
    count.sticks += kind == EventKind::stick;
    count.chatters += kind == EventKind::chatter;
  });
  return count;
}

bool driven(const Model& model) {
  return ranges::any_of(model.forces, [](const Force& force) { return force.harmonic > 0 && force.amplitude != 0.0; });
}

Settling::Settling(const System& system, const State& state, const SettlingOptions& options)
    : system_(system),
      options_(options),
      map_(std::make_unique<Stroboscopic>(system)),
      motion_(system, state),
      home_(translations().take_out(motion_)),
      scale_(VectorXd::Constant(2 * system.compiled().frame().n, 1e-300)),
      omega_(2.0 * std::numbers::pi / system.period()),
      round_(std::max(shortest_round, 4 * options.most_n)),
      free_(!options.by_clock && !driven(system)) {
  choose_section();
}

/// Of a free motion: that of the flights that it keeps having. With few events left it is run to the last of them.
void Settling::choose_section() {
  if (!free_) return;
  const auto kind = choose_flights(motion_, options_.stop);
  if (cancelled()) return;
  if (kind) {
    map_ = std::make_unique<FlightSection>(system_, *kind);
    return;
  }
  ended_ = true;
  while (next_change(motion_, options_.stop)) ++periods_;
}

bool Settling::out_of_time() const { return options_.until && std::chrono::steady_clock::now() >= *options_.until; }
bool Settling::cancelled() const { return stopped(options_.stop) || out_of_time(); }

void Settling::discard(long periods) {
  if (ended_ || periods == 0) return;
  for (long k = 0; k < periods && !cancelled(); ++k) {
    if (!run_period()) break;
    report();
  }
  choose_section();
}

/// To the next return; a free motion may have none, as one that comes to rest or to other flights.
std::optional<PeriodEvents> Settling::run_period() {
  const Instant begin = motion_.time();
  const std::optional<Instant> end = map_->next(motion_, options_.stop);
  if (!end) return std::nullopt;
  const PeriodEvents events = run_counting(motion_, *end, options_.stop);
  translations().take_out(motion_);
  ++periods_;
  if (free_) omega_ = 2.0 * std::numbers::pi / (system_.period() * end->since(begin));
  return events;
}

std::optional<Cycle> Settling::next_round() {
  const int periods = std::min(round_, options_.most_periods - done_);
  auto cycle = run(periods);
  if (cancelled()) return std::nullopt;
  if (cycle && free_ && is_a_point(*cycle)) {
    shrinks_to_ = cycle->x;
    ended_ = true;
    return std::nullopt;
  }
  if (!cycle) done_ += periods;
  round_ *= 4;
  return cycle;
}

/// A fixed point of the map of a free motion may be a state of rest.
bool Settling::is_a_point(const Cycle& cycle) const {
  constexpr double nothing = 1e-7;  // of the motion's size; fixed points are known to 1e-11 of it
  Motion motion(system_, flow::user_state(system_, cycle.x));
  run_to(motion, Instant{}.plus(0.25 * cycle.duration / cycle.n), options_.stop, [] {});
  VectorXd x = flow::contact_state(motion);
  translations().take_out(x);
  return distance(x, cycle.x, scale_) <= nothing;
}

/// The largest of the last returns after n periods.
double Settling::widest_return(int n) const {
  double widest = 0.0;
  const auto last = static_cast<long>(states_.size()) - 1;
  for (long j = 0; j < returns_compared && j + n <= last; ++j)
    widest = std::max(widest, distance(states_[last - j], states_[last - j - n], scale_));
  return widest;
}

void Settling::note_approach(int k, int periods) {
  if (k == periods / 2) {
    earlier_.clear();
    for (int n = 1; n <= options_.most_n; ++n) earlier_.push_back(widest_return(n));
  }
  if (k + 1 != periods || earlier_.empty()) return;
  int nearest = 1;
  for (int n = 2; n <= options_.most_n; ++n) {
    if (widest_return(n) < widest_return(nearest)) nearest = n;
  }
  approaching_ = widest_return(nearest) < 0.5 * earlier_[static_cast<std::size_t>(nearest) - 1];
}

bool Settling::note_period() {
  const std::optional<PeriodEvents> events = run_period();
  if (!events) return false;
  events_.push_back(*events);
  report();
  states_.push_back(flow::contact_state(motion_));
  note_size(states_.back());
  const long surplus = static_cast<long>(states_.size()) - (6L * options_.most_n + returns_compared);
  if (surplus > 0) {  // keep what comparisons can reach
    const long removed = surplus + 2L * options_.most_n;
    states_.erase(states_.begin(), states_.begin() + removed);
    events_.erase(events_.begin(), events_.begin() + removed);
  }
  return true;
}

void Settling::note_size(const VectorXd& x) {
  const auto n = system_.compiled().frame().n;
  const double position = x.head(n).cwiseAbs().maxCoeff(), speed = x.tail(n).cwiseAbs().maxCoeff();
  scale_.head(n) = scale_.head(n).cwiseMax(position);
  scale_.tail(n) = scale_.tail(n).cwiseMax(speed);
  // A velocity (or a displacement) that happens to vanish at phase 0 says nothing about the size of the motion.
  const double least = 1e-3;
  scale_.head(n) = scale_.head(n).cwiseMax(least * scale_.tail(n) / omega_);
  scale_.tail(n) = scale_.tail(n).cwiseMax(least * scale_.head(n) * omega_);
}

/// With translations a displacement is zero at every return by definition: what the motion is like in between says how
/// large it is.
void Settling::look_between() {
  if (translations().count() == 0) return;
  constexpr int looks = 16;
  Motion trial = motion_;
  const Instant begin = motion_.time();
  const double period = map_->next(motion_, options_.stop).value_or(begin.plus(1.0)).since(begin);
  for (int k = 1; k < looks; ++k) {
    const Instant next = begin.plus(period * static_cast<double>(k) / looks);
    if (!run_to(trial, next, options_.stop, [] {})) return;
    note_size(flow::contact_state(trial));
  }
}

bool Settling::same_events(long n) const {
  const auto size = static_cast<long>(events_.size());
  for (long i = 1; i <= n; ++i) {
    if (!(events_[size - i] == events_[size - i - n])) return false;
  }
  return true;
}

std::vector<double> Settling::drift(const VectorXd& advance) const {
  std::vector<double> by_coordinate = translations().by_coordinate(advance);
  for (double& length : by_coordinate) {
    if (std::abs(length) <= options_.tolerance * scale_[0]) length = 0.0;
  }
  return by_coordinate;
}

/// The motion has no more flights of the section's kind: it begins anew with others, or has ended.
void Settling::lose_section() {
  if (cancelled()) return;
  choose_section();
  states_.clear();
  events_.clear();
  earlier_.clear();
}

std::optional<Cycle> Settling::run(int periods) {
  look_between();
  constexpr long first_turn = 8;
  long next_newton = first_turn, next_return = 0;
  for (int k = 0; k < periods && !cancelled(); ++k) {
    if (!note_period()) {
      lose_section();
      break;
    }
    if (cancelled()) break;
    const auto later = k + first_turn + k / 4;  // what failed is tried again so seldom that the motion costs more
    const bool newton_turn = k >= next_newton;
    if (newton_turn) next_newton = later;
    if (newton_turn || k >= next_return) {
      const Look look = look_for_return(newton_turn, k >= next_return);
      if (look.cycle) return look.cycle;
      if (look.refused_return) next_return = later;
    }
    note_approach(k, periods);
  }
  return cancelled() ? std::nullopt : look_around();
}

Settling::Look Settling::look_for_return(bool newton_turn, bool return_turn) const {
  const auto kept = static_cast<long>(states_.size());
  Look look;
  double nearest = INFINITY;  // of the returns after fewer periods
  for (int n = 1; n <= options_.most_n && 2 * n < kept; ++n) {
    const double d = returned(n);
    const bool returns =
        return_turn && d <= options_.tolerance && same_events(n) && returned(n, 1) <= 2.0 * options_.tolerance;
    const bool approaching = newton_turn && 3 * n < kept && d < options_.newton_start && d < returned(n, 1);
    const bool nearer = d < 0.5 * nearest;  // else it is a multiple of an n that was tried
    nearest = std::min(nearest, d);
    const bool multiple = look.refused_return != 0 && n % look.refused_return == 0;
    const bool worthwhile = (returns && !multiple) || (approaching && nearer);
    if (!worthwhile) continue;
    if ((look.cycle = confirm(n))) return look;
    if (returns) {
      if ((look.cycle = member(n))) return look;
      if (look.refused_return == 0) look.refused_return = n;
    }
  }
  return look;
}

/// Of the last returns after n periods.
VectorXd Settling::mean(int n, long count) const {
  VectorXd sum = VectorXd::Zero(scale_.size());
  for (long j = 0; j < count; ++j) sum += back(j * n);
  return sum / static_cast<double>(count);
}

/// The cycle beside a motion that returns after n periods, the shortest first: a motion that alternates beside it,
/// slowly nearer, returns after twice its length. Its mean over the alternations is where Newton's method begins.
std::optional<Cycle> Settling::confirm(int n) const {
  constexpr double beside = 0.1;  // of the motion's size: what alternates more widely is not beside a shorter cycle
  for (int length = 1; length <= n && !cancelled(); ++length) {
    if (n % length != 0 || (length < n && returned(length) > beside)) continue;
    if (auto cycle = drawn_to(length, mean(length, n / length))) return cycle;
  }
  return std::nullopt;
}

/// A shorter cycle that a stable one of n periods goes round several times; n becomes its length. Beside a multiplier
/// -1 the cycle solves the equations of twice its length also at points beside it: 1 - lambda^2 is almost zero.
FixedPoint Settling::once_round(FixedPoint found, int& n) const {
  constexpr double same = 1e-5;  // of the motion's size: rounding over 1 - |lambda| where the cycle is barely stable
  for (int length = 1; length < n; ++length) {
    if (n % length != 0) continue;
    auto shorter = fixed_point(*map_, found.x, length, scale_, options_.stop);
    if (!shorter || !shorter->stable() || distance(shorter->x, found.x, scale_) > same) continue;
    n = length;
    return std::move(*shorter);
  }
  return found;
}

/// A stable fixed point of the n-period map that the motion is drawn to.
std::optional<Cycle> Settling::drawn_to(int n, const VectorXd& start) const {
  auto found = fixed_point(*map_, start, n, scale_, options_.stop);
  if (!found || !found->stable()) return std::nullopt;
  // On a free family the one multiplier that is left is 1 but for rounding, on either side: `member` judges.
  if (free_ && !found->multipliers.empty() && std::abs(found->multipliers.front()) >= 1.0 - known_to)
    return std::nullopt;
  const Attraction seen = attraction(*map_, motion_, *found, n, scale_, options_.stop);
  if (!seen.drawn) return std::nullopt;
  found = once_round(std::move(*found), n);
  const MapValue map = map_->value(found->x, n, options_.stop);
  const double missed = distance(map.image, found->x, scale_);
  return Cycle{found->x, n, map.duration, found->multipliers, map.advance, missed, seen.distance};
}

/// The cycle that the motion is on, if that is one of a family, where Newton's method has no single point to go to, or
/// if nothing draws motions beside it nor repels them.
std::optional<Cycle> Settling::member(int n) const {
  for (int length = 1; length <= n; ++length) {
    if (n % length != 0 || returned(length) > options_.tolerance) continue;
    const int dimensions = family(*map_, back(0), length, scale_, options_.stop);
    const MapValue map = map_->value(back(0), length, options_.stop);
    auto multipliers = map_->multipliers(map.jacobian);
    const double largest = multipliers.empty() ? 0.0 : std::abs(multipliers.front());
    const bool neutral = largest >= 1.0 - known_to;
    if ((dimensions == 0 && !neutral) || largest > 1.0 + repelling) continue;
    const double missed = distance(map.image, back(0), scale_);
    return Cycle{back(0),     length, map.duration,     std::move(multipliers),
                 map.advance, missed, returned(length), dimensions,
                 true};
  }
  return std::nullopt;
}

/// A short cycle that the motion winds round: it returns to none of its states, but their mean is near the cycle.
std::optional<Cycle> Settling::look_around() const {
  constexpr int longest = 8;
  for (int n = 1; n <= std::min(longest, options_.most_n) && !cancelled(); ++n) {
    const long count = std::min(returns_compared, static_cast<long>(states_.size()) / n);
    if (count < 2) break;
    if (auto cycle = drawn_to(n, mean(n, count))) return cycle;
  }
  return std::nullopt;
}

}  // namespace slapstick::section
