#include "slapstick/attractor/classify.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "attractor/exponent.hpp"
#include "attractor/return_map.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

std::string_view name(Attractor attractor) {
  constexpr std::string_view names[] = {"periodic", "quasi-periodic", "chaotic", "undecided"};
  return names[static_cast<int>(attractor)];
}

std::string_view name(Chatter chatter) {
  constexpr std::string_view names[] = {"none", "incomplete", "complete"};
  return names[static_cast<int>(chatter)];
}

namespace {

using attractor::PeriodEvents;
using Eigen::VectorXd;

constexpr long returns_compared = 100;
constexpr double repelling = 1e-6;  ///< a multiplier beyond 1 by more than its own error

/// The search for a return of the stroboscopic state.
class ReturnSearch {
 public:
  ReturnSearch(const System& system, const State& state, const ClassifyOptions& options)
      : system_(system), options_(options), translations_(system), motion_(system, state) {
    home_ = translations_.take_out(motion_);
    scale_ = VectorXd::Constant(2 * system.frame().n, 1e-300);
  }

  /// Runs up to `periods` more; true once a cycle is found, which `result` then holds.
  bool run(int periods, Classification& result);
  [[nodiscard]] State state() const { return motion_.state(); }
  [[nodiscard]] const attractor::Translations& translations() const { return translations_; }
  /// A state moved back along the translations to where the start was.
  [[nodiscard]] State at_home(const State& state) const { return translations_.moved(state, home_); }
  /// By coordinate; zero if it cannot be told from none.
  [[nodiscard]] std::vector<double> drift(const VectorXd& advance) const;
  [[nodiscard]] long periods() const { return motion_.time().period; }
  /// True if the last run was still closing in on a cycle: the nearest of its returns kept shrinking. An invariant curve, too, returns
  /// close to its start, but no closer as time goes on.
  [[nodiscard]] bool still_approaching() const { return approaching_; }
  void discard(int periods) {
    for (int k = 0; k < periods && !cancelled(); ++k) {
      run_one_period(motion_);
      report();
    }
  }
  [[nodiscard]] bool cancelled() const { return stopped(options_.cancel); }

 private:
  [[nodiscard]] const VectorXd& back(long n) const { return states_[states_.size() - 1 - static_cast<std::size_t>(n)]; }
  [[nodiscard]] double returned(long n, long cycles_ago = 0) const {
    return attractor::distance(back(cycles_ago * n), back((cycles_ago + 1) * n), scale_);
  }
  [[nodiscard]] double widest_return(int n) const;
  PeriodEvents run_one_period(Motion& motion) const {
    const PeriodEvents events = attractor::run_one_period(motion, options_.cancel);
    translations_.take_out(motion);
    return events;
  }
  void note_approach(int k, int periods);
  void note_period();
  void note_size(const VectorXd& x);
  void look_between();
  void report() const {
    if (options_.progress) options_.progress(periods());
  }
  bool same_events(long n) const;
  [[nodiscard]] int shortest_cycle(const VectorXd& x, int n) const;
  bool accept(const VectorXd& x, int cycle, double returned, Classification& result);
  bool try_newton(int n, Classification& result);

  const System& system_;
  const ClassifyOptions& options_;
  attractor::Translations translations_;
  Motion motion_;
  VectorXd home_;   ///< the start along each translation
  VectorXd scale_;  ///< size of the motion: positions share one number, velocities another
  std::vector<VectorXd> states_;
  std::vector<PeriodEvents> events_;
  long next_newton_ = 8;
  std::vector<double> earlier_;  ///< widest_return of every n, half a run ago
  bool approaching_ = false;
};

/// The largest of the last returns after n periods.
double ReturnSearch::widest_return(int n) const {
  double widest = 0.0;
  const auto last = static_cast<long>(states_.size()) - 1;
  for (long j = 0; j < returns_compared && j + n <= last; ++j)
    widest = std::max(widest, attractor::distance(states_[last - j], states_[last - j - n], scale_));
  return widest;
}

void ReturnSearch::note_approach(int k, int periods) {
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

void ReturnSearch::note_period() {
  events_.push_back(run_one_period(motion_));
  report();
  states_.push_back(attractor::contact_state(motion_));
  note_size(states_.back());
  const long surplus = static_cast<long>(states_.size()) - (6L * options_.most_n + returns_compared);
  if (surplus > 0) {  // keep what comparisons can reach
    const long removed = surplus + 2L * options_.most_n;
    states_.erase(states_.begin(), states_.begin() + removed);
    events_.erase(events_.begin(), events_.begin() + removed);
  }
}

void ReturnSearch::note_size(const VectorXd& x) {
  const auto n = system_.frame().n;
  const double position = x.head(n).cwiseAbs().maxCoeff(), speed = x.tail(n).cwiseAbs().maxCoeff();
  scale_.head(n) = scale_.head(n).cwiseMax(position);
  scale_.tail(n) = scale_.tail(n).cwiseMax(speed);
  // A velocity (or a displacement) that happens to vanish at phase 0 says nothing about the size of the motion.
  const double omega = 2.0 * std::numbers::pi / system_.period(), least = 1e-3;
  scale_.head(n) = scale_.head(n).cwiseMax(least * scale_.tail(n) / omega);
  scale_.tail(n) = scale_.tail(n).cwiseMax(least * scale_.head(n) * omega);
}

/// With translations a displacement is zero at every return by definition: what the motion is like in between says how large it is.
void ReturnSearch::look_between() {
  if (translations_.count() == 0) return;
  constexpr int looks = 16;
  Motion trial = motion_;
  for (int k = 1; k < looks; ++k) {
    const Instant next{motion_.time().period, static_cast<double>(k) / looks};
    if (!run_to(trial, next, options_.cancel, [] {})) return;
    note_size(attractor::contact_state(trial));
  }
}

bool ReturnSearch::same_events(long n) const {
  const auto size = static_cast<long>(events_.size());
  for (long i = 1; i <= n; ++i) {
    if (!(events_[size - i] == events_[size - i - n])) return false;
  }
  return true;
}

std::vector<double> ReturnSearch::drift(const VectorXd& advance) const {
  std::vector<double> by_coordinate = translations_.by_coordinate(advance);
  for (double& length : by_coordinate) {
    if (std::abs(length) <= options_.tolerance * scale_[0]) length = 0.0;
  }
  return by_coordinate;
}

bool ReturnSearch::run(int periods, Classification& result) {
  look_between();
  for (int k = 0; k < periods && !cancelled(); ++k) {
    note_period();
    if (cancelled()) break;
    const auto kept = static_cast<long>(states_.size());
    const bool newton_turn = k >= next_newton_;
    for (int n = 1; n <= options_.most_n && 2 * n < kept; ++n) {
      const double d = returned(n);
      const bool returns = d <= options_.tolerance && same_events(n) && returned(n, 1) <= 2.0 * options_.tolerance;
      if (returns && accept(back(0), n, d, result)) return true;
      const bool approaching = 3 * n < kept && d < options_.newton_start && d < returned(n, 1);
      if (newton_turn && approaching && try_newton(n, result)) return true;
    }
    if (newton_turn) next_newton_ = k + 8 + k / 4;
    note_approach(k, periods);
  }
  next_newton_ = 8;
  return false;
}

/// Newton's method on the n-period map also finds cycles whose length divides n.
int ReturnSearch::shortest_cycle(const VectorXd& x, int n) const {
  for (int d = 1; d < n; ++d) {
    if (n % d == 0 &&
        attractor::distance(attractor::return_map(translations_, x, d, options_.cancel).image, x, scale_) < 1e-8)
      return d;
  }
  return n;
}

/// False if the cycle at x repels: a motion that began on it, or passes it closely, is not drawn to it.
bool ReturnSearch::accept(const VectorXd& x, int cycle, double d, Classification& result) {
  const int n = shortest_cycle(x, cycle);
  const attractor::MapValue map = attractor::return_map(translations_, x, n, options_.cancel);
  const auto multipliers = attractor::multipliers_of(map.jacobian);
  if (!multipliers.empty() && std::abs(multipliers.front()) > 1.0 + repelling) return false;
  result.attractor = Attractor::periodic;
  result.approach = d;
  attractor::record_cycle(system_, at_home(attractor::user_state(system_, x)), n, options_.stops, options_.cancel,
                          result);
  result.return_distance = attractor::distance(map.image, x, scale_);
  result.multipliers = multipliers;
  result.drift = drift(map.advance);
  return true;
}

/// A stable fixed point of the n-period map close by that the motion is drawn to.
bool ReturnSearch::try_newton(int n, Classification& result) {
  const auto found = attractor::fixed_point(translations_, back(0), n, scale_, options_.cancel);
  if (!found || !found->stable()) return false;
  const double before = attractor::distance(back(0), found->x, scale_);
  if (before > 10.0 * options_.newton_start) return false;
  // Long enough for the slowest multiplier to halve the distance.
  const double slowest = found->multipliers.empty() ? 0.0 : std::abs(found->multipliers.front());
  const double cycles = slowest > 0.5 ? std::ceil(std::log(0.5) / std::log(slowest)) : 1.0;
  if (cycles * n > options_.most_periods) return false;
  Motion trial = motion_;
  for (long k = 0; k < static_cast<long>(cycles) * n && !cancelled(); ++k) run_one_period(trial);
  const double after = attractor::distance(attractor::contact_state(trial), found->x, scale_);
  if (after > 0.8 * before + options_.tolerance) return false;
  return accept(found->x, n, after, result);
}

void decide_aperiodic(const attractor::RunFigures& run, const ClassifyOptions& options, Classification& result) {
  result.exponent = run.exponent;
  result.exponent_error = run.exponent_error;
  result.digits = run.digits;
  result.sticking = run.events.sticks > 0 || run.events.chatters > 0;
  result.chatter = run.events.chatters > 0 ? Chatter::complete : run.burst ? Chatter::incomplete : Chatter::none;
  const bool positive = run.exponent > 3.0 * run.exponent_error && run.exponent > 0.005;
  if (positive && run.digits < options.curve_digits)
    result.attractor = Attractor::chaotic;
  else if (!positive && run.exponent > -0.005 && run.digits >= options.curve_digits)
    result.attractor = Attractor::quasi_periodic;
  else
    result.attractor = Attractor::undecided;
  result.label = name(result.attractor);
}

}  // namespace

Classification classify(const System& system, const State& state, const ClassifyOptions& options) {
  if (!system.model().forced())
    throw InputError("model '" + system.model().name +
                     "' has no periodic forcing: n-p classes count forcing periods; "
                     "`poincare --section event` shows its returns");
  Classification result;
  ReturnSearch search(system, state, options);
  search.discard(options.transient_periods);
  // Rounds of growing length: a clearly chaotic motion is recognised early, a slow approach gets its time.
  for (int round = std::max(500, 4 * options.most_n), done = 0; done < options.most_periods; round *= 4) {
    const int periods = std::min(round, options.most_periods - done);
    if (search.run(periods, result) || search.cancelled()) break;
    done += periods;
    const bool last = done >= options.most_periods;
    const auto run = attractor::run_figures(search.translations(), search.state(),
                                            last ? options.exponent_periods : options.exponent_periods / 4,
                                            options.stops, options.cancel);
    if (search.cancelled()) break;
    decide_aperiodic(run, options, result);
    if (result.attractor == Attractor::quasi_periodic && search.still_approaching()) {
      result.attractor = Attractor::undecided;
      result.label = name(result.attractor);
    }
    result.state = search.at_home(run.state);
    result.drift = search.drift(run.advance);
    const bool clear =
        result.attractor == Attractor::chaotic && run.exponent > 10.0 * run.exponent_error && run.exponent > 0.02;
    if (clear || last) break;
    result = {};
  }
  if (result.attractor == Attractor::periodic && !result.multipliers.empty())
    result.exponent = std::log(std::abs(result.multipliers.front())) / result.n;
  result.periods_used = search.periods();
  result.interrupted = search.cancelled();
  return result;
}

}  // namespace slapstick
