/// Carries an orthonormal frame of tangent vectors along a motion, and sums what its QR decompositions say.
#include "slapstick/attractor/lyapunov.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "attractor/batches.hpp"
#include "base/dense.hpp"
#include "base/double_double.hpp"
#include "base/ranges.hpp"
#include "flow/compiled_system.hpp"
#include "flow/contact_state.hpp"
#include "flow/saltation.hpp"
#include "flow/translations.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double unit_roundoff = 0x1p-53;

/// What the trace along segments and the determinants at events say of the contraction of volumes.
class Contraction {
 public:
  /// @param mode  at the start: what it holds still is forgotten there
  Contraction(const System& system, ModeId mode) : system_(system), frame_(system.compiled().frame()) {
    for (Index i = 0; i < 2 * frame_.n; ++i)
      if (i < frame_.n || !frame_.rate_follows(static_cast<int>(i) - frame_.n)) numbers_.push_back(i);
    for (int i = 0; i < frame_.d; ++i) forgets_ = forgets_ || system_.compiled().mode(mode).steady(i);
  }

  /// After each advance of the motion. @param event  whether one has ended the segment
  void note(const Motion& motion, bool event) {
    windows_ = 0.0;
    if (motion.counters().segments == segments_seen_) return;
    segments_seen_ = motion.counters().segments;
    const Motion::Segment& segment = motion.segment();
    const mode::Matrix& A = system_.compiled().mode(segment.mode).system();
    // Dependent velocities follow from the first n: u = dependence u_n, apart from a constant.
    double rate = A.block(frame_.d, frame_.d, frame_.n, frame_.d).cwiseProduct(frame_.dependence.transpose()).sum();
    for (const mode::InnerRow& row : frame_.inner)  // of s, in place of s': it follows
      rate += row.rate[row.own] - A(frame_.u(row.own), frame_.u(row.own));
    const mode::Mode& mode = system_.compiled().mode(segment.mode);
    windows_ = std::ceil(segment.duration / mode.window());
    sum_ = sum_ + rate * segment.duration;
    rounding_ += unit_roundoff * std::abs(rate) * segment.duration;
    if (event && motion.event().kind != EventKind::graze) pass(motion);
  }
  /// After a new start of the motion, which counts its segments anew.
  void begin_at(const Motion& motion) { segments_seen_ = motion.counters().segments; }
  [[nodiscard]] bool forgets() const { return forgets_; }                 ///< a direction: the volume is zero
  [[nodiscard]] bool differentiable() const { return differentiable_; }   ///< all events so far
  [[nodiscard]] double sum() const { return static_cast<double>(sum_); }  ///< unless it forgets
  [[nodiscard]] double windows() const { return windows_; }               ///< of the last segment
  [[nodiscard]] double rounding() const { return rounding_; }

 private:
  void pass(const Motion& motion) {
    const Index n = frame_.n, d = frame_.d;
    MatrixXd columns = MatrixXd::Zero(2 * d, 2 * n);
    columns.topLeftCorner(d, n) = frame_.dependence;
    columns.bottomRightCorner(d, n) = frame_.dependence;
    flow::pass_event(motion.engine(), columns);
    differentiable_ = differentiable_ && flow::differentiable(motion.engine());
    MatrixXd whole(2 * n, 2 * n);
    whole << columns.topRows(n), columns.middleRows(d, n);
    const MatrixXd saltation = whole(numbers_, numbers_);
    const double determinant = std::abs(dense::determinant(saltation));
    forgets_ = forgets_ || determinant == 0.0 || motion.event().kind == EventKind::chatter || holds_more(motion);
    if (forgets_) return;
    sum_ = sum_ + std::log(determinant);
    // Both sides apply the same S, the one to a frame, the other to the identity.
    rounding_ += 8.0 * static_cast<double>(n * n) * unit_roundoff / dense::reciprocal_condition(saltation);
  }

  /// Does the mode after the event hold a number still that the one before let go?
  [[nodiscard]] bool holds_more(const Motion& motion) const {
    const mode::Mode& after = system_.compiled().mode(motion.mode_id());
    const mode::Mode& before = system_.compiled().mode(motion.segment().mode);
    for (int i = 0; i < frame_.d; ++i)
      if (after.steady(i) && !before.steady(i)) return true;
    return ranges::any_of(frame_.sliders, [&](const mode::SliderRow& row) {  // one that slips forgets where it was
      return !row.rests(after.states().pieces) && row.rests(before.states().pieces);
    });
  }

  const System& system_;
  const mode::Frame& frame_;
  std::vector<Index> numbers_;  ///< of a contact state, without the rates that follow from others
  long segments_seen_ = 0;
  bool forgets_ = false, differentiable_ = true;
  DoubleDouble sum_ = 0.0;  // a running sum of doubles would lose a rounding of the whole at each event
  double rounding_ = 0.0, windows_ = 0.0;
};

/// The frame: orthonormal columns in the numbers of the classes modulo translations.
class TangentFrame {
 public:
  TangentFrame(const flow::Translations& translations, const State& state)
      : TangentFrame(translations, state, {}, identity(translations)) {}
  /// @param columns  that span the tangents of all classes
  TangentFrame(const flow::Translations& translations, const State& state, Instant start, const MatrixXd& columns)
      : translations_(translations),
        size_(numbers(translations)),
        growth_(static_cast<std::size_t>(size_), 0.0),
        motion_(translations.system(), state, columns, start),
        contraction_(translations.system(), motion_.motion().mode_id()) {
    orthonormalise();
    growth_.assign(growth_.size(), 0.0);
    rounding_ = 0.0;
  }

  /// The same motion and frame, begun anew: with the vectors that were lost on the way.
  [[nodiscard]] TangentFrame renewed() const {
    const MatrixXd present = motion_.tangents(), all = identity(translations_);
    MatrixXd columns(all.rows(), present.cols() + all.cols());
    columns << present, all;
    return {translations_, motion_.motion().state(), motion_.motion().time(), columns};
  }

  /// One forcing period on. @returns false if it was stopped
  bool run_period(const std::atomic<bool>* stop) {
    const Instant begin = motion_.motion().time();
    const int parts = parts_of_period();
    for (int k = 1; k <= parts; ++k) {
      const Instant end =
          k < parts ? Instant{begin.period, static_cast<double>(k) / parts} : Instant{begin.period + 1, 0.0};
      while (motion_.advance(end) == Outcome::event) {
        contraction_.note(motion_.motion(), true);
        orthonormalise();
      }
      contraction_.note(motion_.motion(), false);
      orthonormalise();
      if (stopped(stop)) return false;
    }
    static_cast<void>(translations_.take_out(motion_));
    contraction_.begin_at(motion_.motion());
    return true;
  }

  /// ln R_ii since the last call, and its sum over all places since the beginning; -infinity where a direction is lost.
  std::vector<double> take_growth() {
    std::vector<double> taken(static_cast<std::size_t>(size_), 0.0);
    std::swap(taken, growth_);
    for (Index i = rank_; i < size_; ++i) taken[static_cast<std::size_t>(i)] = -INFINITY;
    return taken;
  }
  [[nodiscard]] const Contraction& contraction() const { return contraction_; }
  /// What rounding may have put between the two sides of the sum rule.
  [[nodiscard]] double rounding() const { return rounding_ + contraction_.rounding(); }
  [[nodiscard]] Index size() const { return size_; }

 private:
  static Index numbers(const flow::Translations& translations) { return translations.size(); }
  static MatrixXd identity(const flow::Translations& translations) {
    const Index size = numbers(translations);
    MatrixXd columns(2 * translations.system().compiled().frame().n, size);
    for (Index i = 0; i < size; ++i) columns.col(i) = translations.representative(VectorXd::Unit(size, i));
    return columns;
  }

  /// A frame turns by some four windows, eight radians of the fastest motion, at most: what shrinks more than that is
  /// lost.
  [[nodiscard]] int parts_of_period() const {
    constexpr double windows_each = 4.0, most_parts = 4096.0;
    const double windows = translations_.system().windows_per_period();
    return static_cast<int>(std::clamp(std::ceil(windows / windows_each), 1.0, most_parts));
  }

  /// Gram and Schmidt twice: the second time removes what rounding has left of the first.
  /// Backward errors E of this and of the flow before change ln |det A| by tr(A^-1 E), and |A^-1| is about 1 / min R.
  void orthonormalise() {
    // of a unit vector: between two QR a motion shrinks it by e^-8 and an impact's r, not more
    constexpr double lost = 1e-12;
    const MatrixXd tangents = motion_.tangents();
    MatrixXd Q(size_, 0);
    double shortest = INFINITY;
    for (Index i = 0; i < tangents.cols(); ++i) {
      VectorXd column = tangents.col(i);
      translations_.take_out(column);
      VectorXd q = translations_.numbers(column);
      for (int twice = 0; twice < 2; ++twice) q -= Q * (Q.transpose() * q);
      const double length = q.norm();
      if (!(length > lost)) continue;
      growth_[static_cast<std::size_t>(Q.cols())] += std::log(length);
      shortest = std::min(shortest, length);
      Q.conservativeResize(Eigen::NoChange, Q.cols() + 1);
      Q.rightCols(1) = q / length;
    }
    rank_ = Q.cols();
    const double numbers = translations_.system().compiled().frame().size();
    const double terms = static_cast<double>(size_) + contraction_.windows() * numbers;
    rounding_ += unit_roundoff * static_cast<double>(size_) * terms * tangents.norm() / shortest;
    MatrixXd next(tangents.rows(), rank_);
    for (Index i = 0; i < rank_; ++i) next.col(i) = translations_.representative(Q.col(i));
    motion_.set_tangents(next);
  }

  const flow::Translations& translations_;
  Index size_, rank_ = 0;
  std::vector<double> growth_;
  double rounding_ = 0.0;
  TangentMotion motion_;
  Contraction contraction_;
};

/// The running sum of all ln R_ii.
class Total {
 public:
  void add(const std::vector<double>& growth) {
    for (const double of_place : growth) {
      if (std::isfinite(of_place))
        sum_ = sum_ + of_place;
      else
        lost_ = true;
    }
  }
  [[nodiscard]] double value() const { return lost_ ? -INFINITY : static_cast<double>(sum_); }

 private:
  DoubleDouble sum_ = 0.0;  // a running sum of doubles would lose a rounding of the whole in each period
  bool lost_ = false;       // a direction: the sum is minus infinity
};

/// Means, errors and order of the exponents, from ln R_ii period by period.
void summarise(const std::vector<std::vector<double>>& growth, LyapunovExponents& found) {
  std::vector<attractor::Mean> means;
  for (const std::vector<double>& of_place : growth)
    means.push_back(std::isfinite(of_place.back()) ? attractor::batch_mean(of_place) : attractor::Mean{-INFINITY, 0.0});
  ranges::stable_sort(means, std::greater<>(), &attractor::Mean::value);
  found.per_period.clear(), found.errors.clear();
  for (const attractor::Mean& mean : means) {
    found.per_period.push_back(mean.value);
    found.errors.push_back(mean.error);
  }
}

/// The exponents, 0 for those that their errors do not tell from 0: of a cycle without forcing and of a torus they are.
std::vector<double> told_from_zero(const LyapunovExponents& found) {
  constexpr double certain = 3.0;  // standard errors; with less a torus would have now one dimension, now none
  std::vector<double> exponents = found.per_period;
  for (std::size_t i = 0; i < exponents.size(); ++i)
    if (std::abs(exponents[i]) <= certain * found.errors[i] + found.rounding) exponents[i] = 0.0;
  return exponents;
}

bool known_well_enough(const LyapunovExponents& found, double error) {
  return ranges::all_of(found.errors, [error](double known) { return known <= error; });
}

}  // namespace

bool LyapunovExponents::sum_rule_holds() const {
  if (!std::isfinite(sum) || !std::isfinite(contraction)) return sum == contraction;
  return std::abs(sum - contraction) <= rounding;
}

double kaplan_yorke_dimension(const std::vector<double>& exponents) {
  double sum = 0.0;
  for (std::size_t j = 0; j < exponents.size(); ++j) {
    if (sum + exponents[j] < 0.0)
      return static_cast<double>(j) + (std::isfinite(exponents[j]) ? sum / -exponents[j] : 0.0);
    sum += exponents[j];
  }
  return static_cast<double>(exponents.size());
}

LyapunovExponents lyapunov(const System& system, const State& state, const LyapunovOptions& options) {
  const flow::Translations translations(system);
  std::optional<TangentFrame> frame(std::in_place, translations, state);
  LyapunovExponents found;
  found.period = system.period();
  const auto give_up = [&] {
    found.interrupted = true;
    return found;
  };
  const auto report = [&](long periods) {
    if (options.progress) options.progress(periods);
  };
  for (long k = 0; k < options.transient_periods; ++k) {
    if (!frame->run_period(options.cancel)) return give_up();
    report(k + 1);
  }
  if (options.transient_periods > 0) frame.emplace(frame->renewed());
  std::vector<std::vector<double>> growth(static_cast<std::size_t>(frame->size()));
  Total total;
  long next_look = 100 * attractor::batches;
  for (long k = 0; k < options.most_periods; ++k) {
    if (!frame->run_period(options.cancel)) return give_up();
    if (!frame->contraction().differentiable())
      throw NumericalError(
          "the motion has no exponents: contacts that act on each other meet their events at one instant, "
          "and what comes first decides; change a parameter or the start a little");
    report(options.transient_periods + k + 1);
    const std::vector<double> taken = frame->take_growth();
    for (std::size_t i = 0; i < growth.size(); ++i) growth[i].push_back(taken[i]);
    total.add(taken);
    found.periods = k + 1;
    const bool last = k + 1 == options.most_periods;
    if (!last && (options.error <= 0.0 || k + 1 < next_look)) continue;
    summarise(growth, found);
    found.reached = options.error <= 0.0 || known_well_enough(found, options.error);
    if (options.error > 0.0 && found.reached) break;
    next_look = 5 * next_look / 4;
  }
  const auto periods = static_cast<double>(found.periods);
  found.sum = total.value() / periods;
  found.contraction = frame->contraction().forgets() ? -INFINITY : frame->contraction().sum() / periods;
  found.rounding = frame->rounding() / periods;
  found.dimension = kaplan_yorke_dimension(told_from_zero(found));
  return found;
}

}  // namespace slapstick
