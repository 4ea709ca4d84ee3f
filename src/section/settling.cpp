/// The search for a return of the stroboscopic state: what a motion settles on.
#include "section/settling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flow/compiled_system.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick::section {
namespace {

using Eigen::VectorXd;

constexpr long returns_compared = 100;
constexpr double repelling = 1e-6;  ///< a multiplier beyond 1 by more than its own error
constexpr int shortest_round = 500;

}  // namespace

PeriodEvents run_one_period(Motion& motion, Stop stop) {
  PeriodEvents count;
  const Instant end{motion.time().period + 1, 0.0};
  run_to(motion, end, stop, [&] {
    const EventKind kind = motion.event().kind;
    count.impacts += StopChoice().is_point(motion.event());
    count.sticks += kind == EventKind::stick;
    count.chatters += kind == EventKind::chatter;
  });
  return count;
}

Settling::Settling(const System& system, const State& state, const SettlingOptions& options)
    : system_(system),
      options_(options),
      translations_(system),
      motion_(system, state),
      home_(translations_.take_out(motion_)),
      scale_(VectorXd::Constant(2 * system.compiled().frame().n, 1e-300)),
      round_(std::max(shortest_round, 4 * options.most_n)) {}

bool Settling::out_of_time() const { return options_.until && std::chrono::steady_clock::now() >= *options_.until; }
bool Settling::cancelled() const { return stopped(options_.stop) || out_of_time(); }

void Settling::discard(long periods) {
  for (long k = 0; k < periods && !cancelled(); ++k) {
    run_period(motion_);
    report();
  }
}

PeriodEvents Settling::run_period(Motion& motion) const {
  const PeriodEvents events = run_one_period(motion, options_.stop);
  translations_.take_out(motion);
  return events;
}

std::optional<Cycle> Settling::next_round() {
  const int periods = std::min(round_, options_.most_periods - done_);
  auto cycle = run(periods);
  if (cancelled()) return std::nullopt;
  if (!cycle) done_ += periods;
  round_ *= 4;
  return cycle;
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

void Settling::note_period() {
  events_.push_back(run_period(motion_));
  report();
  states_.push_back(flow::contact_state(motion_));
  note_size(states_.back());
  const long surplus = static_cast<long>(states_.size()) - (6L * options_.most_n + returns_compared);
  if (surplus > 0) {  // keep what comparisons can reach
    const long removed = surplus + 2L * options_.most_n;
    states_.erase(states_.begin(), states_.begin() + removed);
    events_.erase(events_.begin(), events_.begin() + removed);
  }
}

void Settling::note_size(const VectorXd& x) {
  const auto n = system_.compiled().frame().n;
  const double position = x.head(n).cwiseAbs().maxCoeff(), speed = x.tail(n).cwiseAbs().maxCoeff();
  scale_.head(n) = scale_.head(n).cwiseMax(position);
  scale_.tail(n) = scale_.tail(n).cwiseMax(speed);
  // A velocity (or a displacement) that happens to vanish at phase 0 says nothing about the size of the motion.
  const double omega = 2.0 * std::numbers::pi / system_.period(), least = 1e-3;
  scale_.head(n) = scale_.head(n).cwiseMax(least * scale_.tail(n) / omega);
  scale_.tail(n) = scale_.tail(n).cwiseMax(least * scale_.head(n) * omega);
}

/// With translations a displacement is zero at every return by definition: what the motion is like in between says how
/// large it is.
void Settling::look_between() {
  if (translations_.count() == 0) return;
  constexpr int looks = 16;
  Motion trial = motion_;
  for (int k = 1; k < looks; ++k) {
    const Instant next{motion_.time().period, static_cast<double>(k) / looks};
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
  std::vector<double> by_coordinate = translations_.by_coordinate(advance);
  for (double& length : by_coordinate) {
    if (std::abs(length) <= options_.tolerance * scale_[0]) length = 0.0;
  }
  return by_coordinate;
}

std::optional<Cycle> Settling::run(int periods) {
  look_between();
  long next_newton = 8;
  for (int k = 0; k < periods && !cancelled(); ++k) {
    note_period();
    if (cancelled()) break;
    const bool newton_turn = k >= next_newton;
    if (auto cycle = look_for_return(newton_turn)) return cycle;
    if (newton_turn) next_newton = k + 8 + k / 4;
    note_approach(k, periods);
  }
  return std::nullopt;
}

std::optional<Cycle> Settling::look_for_return(bool newton_turn) {
  const auto kept = static_cast<long>(states_.size());
  for (int n = 1; n <= options_.most_n && 2 * n < kept; ++n) {
    const double d = returned(n);
    const bool returns = d <= options_.tolerance && same_events(n) && returned(n, 1) <= 2.0 * options_.tolerance;
    if (returns)
      if (auto cycle = accept(back(0), n, d)) return cycle;
    const bool approaching = 3 * n < kept && d < options_.newton_start && d < returned(n, 1);
    if (newton_turn && approaching)
      if (auto cycle = try_newton(n)) return cycle;
  }
  return std::nullopt;
}

/// Newton's method on the n-period map also finds cycles whose length divides n.
int Settling::shortest_cycle(const VectorXd& x, int n) const {
  for (int d = 1; d < n; ++d) {
    if (n % d == 0 && distance(return_map(translations_, x, d, options_.stop).image, x, scale_) < 1e-8) return d;
  }
  return n;
}

/// Empty if the cycle at x repels: a motion that began on it, or passes it closely, is not drawn to it.
std::optional<Cycle> Settling::accept(const VectorXd& x, int cycle, double d) const {
  const int n = shortest_cycle(x, cycle);
  const MapValue map = return_map(translations_, x, n, options_.stop);
  auto multipliers = flow::multipliers_of(map.jacobian);
  if (!multipliers.empty() && std::abs(multipliers.front()) > 1.0 + repelling) return std::nullopt;
  return Cycle{x, n, std::move(multipliers), map.advance, distance(map.image, x, scale_), d};
}

/// A stable fixed point of the n-period map close by that the motion is drawn to.
std::optional<Cycle> Settling::try_newton(int n) const {
  const auto found = fixed_point(translations_, back(0), n, scale_, options_.stop);
  if (!found || !found->stable()) return std::nullopt;
  const double before = distance(back(0), found->x, scale_);
  if (before > 10.0 * options_.newton_start) return std::nullopt;
  // Long enough for the slowest multiplier to halve the distance.
  const double slowest = found->multipliers.empty() ? 0.0 : std::abs(found->multipliers.front());
  const double cycles = slowest > 0.5 ? std::ceil(std::log(0.5) / std::log(slowest)) : 1.0;
  if (cycles * n > options_.most_periods) return std::nullopt;
  Motion trial = motion_;
  for (long k = 0; k < static_cast<long>(cycles) * n && !cancelled(); ++k) run_period(trial);
  const double after = distance(flow::contact_state(trial), found->x, scale_);
  if (after > 0.8 * before + options_.tolerance) return std::nullopt;
  return accept(found->x, n, after);
}

}  // namespace slapstick::section
