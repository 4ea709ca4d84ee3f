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
  return ranges::any_of(model.forces, [&](const Force& force) {
    if (force.amplitude == 0.0 || !model.repeats_with_forcing(force)) return false;
    if (force.signal < 0) return true;
    const auto& knots = model.signals[static_cast<std::size_t>(force.signal)].knots;
    return ranges::any_of(
        knots, [&](const Signal::Knot& knot) { return knot.value != knots.front().value || knot.pulse != 0.0; });
  });
}

Settling::Settling(const System& system, const State& state, const SettlingOptions& options)
    : system_(system),
      options_(options),
      map_(std::make_unique<Stroboscopic>(system)),
      motion_(system, state),
      start_cell_(translations().take_out(motion_)),
      record_(2 * system.compiled().frame().n),
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
  for (bool more = true; more && !grows_;) {
    VectorXd x = flow::contact_state(motion_);
    translations().take_out(x);
    record_.note_size(x, omega_);
    more = next_change(motion_, options_.stop).has_value();
    periods_ += more;
    grows_ = beyond_bounds(motion_);
  }
}

VectorXd Settling::scale_with(const VectorXd& sizes) const {
  PointRecord record(sizes.size());
  record.note_size(record_.scale(), omega_);
  record.note_size(sizes, omega_);
  return record.scale();
}

bool Settling::out_of_time() const { return options_.until && std::chrono::steady_clock::now() >= *options_.until; }
bool Settling::cancelled() const { return stopped(options_.stop) || out_of_time(); }

void Settling::discard(long periods) {
  if (ended_ || periods == 0) return;
  for (long k = 0; k < periods && !cancelled() && !grows_; ++k) {
    if (!run_period()) break;
    report();
  }
  if (!grows_) choose_section();
}

/// To the next return. A free motion may have none, as one that comes to rest, or to other flights: it is run on.
std::optional<PeriodEvents> Settling::run_period() {
  const Instant begin = motion_.time();
  const std::optional<Instant> end = map_->next(motion_, options_.stop);
  if (!end) {
    for (int k = 0; free_ && k < most_others && next_change(motion_, options_.stop); ++k)
      translations().take_out(motion_);
    return std::nullopt;
  }
  const PeriodEvents events = run_counting(motion_, *end, options_.stop);
  translations().take_out(motion_);
  grows_ = grows_ || beyond_bounds(motion_);
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
  constexpr double at_rest_within = 1e-7;  // of the motion's size; fixed points are known to 1e-11 of it
  Motion motion(system_, flow::user_state(system_, cycle.x));
  run_to(motion, Instant{}.plus(0.25 * cycle.duration / cycle.n), options_.stop, [] {});
  VectorXd x = flow::contact_state(motion);
  translations().take_out(x);
  return distance(translations(), x, cycle.x, record_.scale()) <= at_rest_within;
}

void Settling::note_approach(int k, int periods) {
  if (k == periods / 2) {
    earlier_.clear();
    for (int n = 1; n <= options_.most_n; ++n) earlier_.push_back(record_.widest_return(n));
  }
  if (k + 1 != periods || earlier_.empty()) return;
  int nearest = 1;
  for (int n = 2; n <= options_.most_n; ++n) {
    if (record_.widest_return(n) < record_.widest_return(nearest)) nearest = n;
  }
  approaching_ = record_.widest_return(nearest) < 0.5 * earlier_[static_cast<std::size_t>(nearest) - 1];
}

bool Settling::note_period() {
  const std::optional<PeriodEvents> events = run_period();
  if (!events) return false;
  record_.add(flow::contact_state(motion_), *events, omega_);
  report();
  const long reach = 6L * options_.most_n + returns_compared;  // of what comparisons can ask for
  if (record_.size() > reach) record_.keep_last(reach - 2L * options_.most_n);
  return true;
}

/// Of the numbers of the motion, within a return.
VectorXd Settling::sizes_between() const {
  constexpr int looks = 16;
  Motion trial = motion_;
  VectorXd sizes = VectorXd::Zero(2 * system_.compiled().frame().n);
  const Instant begin = motion_.time();
  const double period = map_->next(motion_, options_.stop).value_or(begin.plus(1.0)).since(begin);
  for (int k = 1; k < looks; ++k) {
    const Instant next = begin.plus(period * static_cast<double>(k) / looks);
    if (!run_to(trial, next, options_.stop, [] {})) break;
    sizes = sizes.cwiseMax(flow::contact_state(trial).cwiseAbs());
  }
  return sizes;
}

/// With translations a displacement is zero at every return by definition; and all numbers of all points may be zero by
/// chance. What the motion is like in between says how large it is.
void Settling::look_between(bool by_chance) {
  constexpr double zero_by_chance = 1e-6;  // of the motion's size: less at every point is chance
  if (by_chance != (translations().count() == 0)) return;
  const VectorXd sizes = sizes_between();
  if (!by_chance || record_.scale().maxCoeff() < zero_by_chance * sizes.maxCoeff()) record_.note_size(sizes, omega_);
}

std::vector<double> Settling::drift(const VectorXd& advance) const {
  std::vector<double> by_coordinate = translations().by_coordinate(advance);
  for (double& length : by_coordinate) {
    if (std::abs(length) <= options_.tolerance * record_.scale()[0]) length = 0.0;
  }
  return by_coordinate;
}

/// The motion has no more flights of the section's kind: it begins anew with others, or has ended.
void Settling::lose_section() {
  if (cancelled()) return;
  choose_section();
  record_.clear();
  earlier_.clear();
}

std::optional<Cycle> Settling::run(int periods) {
  constexpr long first_turn = 8;
  look_between(false);
  long next_newton = first_turn, next_return = 0;
  for (int k = 0; k < periods && !cancelled(); ++k) {
    if (!note_period()) {
      lose_section();
      break;
    }
    if (grows_) return std::nullopt;
    if (cancelled()) break;
    if (k == first_turn) look_between(true);
    const auto later = k + first_turn + k / 4;  // what failed is tried again so seldom that the motion costs more
    const bool newton_turn = k >= next_newton;
    if (newton_turn) next_newton = later;
    if (newton_turn || k >= next_return) {
      const ReturnWish wish{options_.most_n, options_.tolerance, options_.newton_start};
      const Confirmation::Look look = confirmation().first_of(record_.candidates(wish, k >= next_return, newton_turn));
      if (look.cycle) return look.cycle;
      if (look.refused_return) next_return = later;
    }
    note_approach(k, periods);
  }
  return cancelled() ? std::nullopt : confirmation().look_around();
}

Confirmation Settling::confirmation() const {
  ConfirmationOptions options;
  options.most_n = options_.most_n;
  options.tolerance = options_.tolerance;
  options.free = free_;
  options.stop = options_.stop;
  return {*map_, record_, motion_, options};
}

}  // namespace slapstick::section
