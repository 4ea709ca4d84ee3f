/// Follows a motion beside a cycle, and looks for cycles beside a cycle.
#include "section/attraction.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// |w . (x - x*)| for the left eigenvector of the leading multiplier, of norm 1 over |x_i| <= scale_i.
class Amplitude {
 public:
  Amplitude(const flow::Translations& translations, const FixedPoint& cycle, const VectorXd& scale)
      : translations_(translations), at_(translations.numbers(cycle.x)) {
    const dense::Eigenpairs left = dense::eigenpairs(cycle.value.jacobian.transpose());
    Index leading = 0;
    if (left.values.size() > 0) left.values.cwiseAbs().maxCoeff(&leading);
    w_ = left.vectors.col(leading);
    w_ /= w_.cwiseAbs().dot(translations.numbers(scale));
  }
  [[nodiscard]] double operator()(const VectorXd& x) const {
    const VectorXd away = translations_.numbers(x) - at_;
    return std::abs((w_.transpose() * away.cast<std::complex<double>>())(0));
  }

 private:
  const flow::Translations& translations_;
  VectorXd at_;
  VectorXcd w_;
};

constexpr double longest_trial = 256.0;  ///< points of the section

/// As many as the slowest multiplier needs to halve an amplitude, but no more than a trial may last. An even number: a
/// motion that alternates beside the cycle is farther away on one side than on the other.
long cycles_of_stage(double slowest, int n) {
  const double halving = slowest > 0.5 ? std::ceil(std::log(0.5) / std::log(slowest)) : 1.0;
  return 2 * static_cast<long>(std::max(1.0, std::min(std::ceil(halving / 2.0), std::floor(longest_trial / n / 2.0))));
}

/// A motion beside a cycle, from stage to stage.
class Trial {
 public:
  Trial(const ReturnMap& map, const Followed& followed, const FixedPoint& cycle, int n, const VectorXd& scale,
        Stop stop)
      : map_(map),
        record_(followed.record),
        motion_(followed.motion),
        cycle_(cycle),
        scale_(scale),
        there_(followed.there),
        stop_(stop),
        amplitude_(map.translations(), cycle, scale),
        slowest_(std::abs(cycle.multipliers.front())),
        cycles_(cycles_of_stage(slowest_, n)),
        periods_(cycles_ * n) {
    go_back(n);
    look();
  }

  [[nodiscard]] double distance() const { return distance_; }
  [[nodiscard]] long periods() const { return periods_; }

  /// Follows the motion for one stage. Has it lost what a motion loses that is drawn to the cycle?
  bool loses() {
    constexpr double share = 0.5;             // of the linear loss, see attraction.hpp
    constexpr double linear = 1e-2;           // farther away the loss must be near the linear one, from both sides
    constexpr double above_rounding = 1e-13;  // a loss below is that of some hundred roundings
    const double away = distance_, first = size_;
    if (!go_on()) return false;
    look();
    // what is left is of faster directions, which fall by themselves
    if (first <= there_) return distance_ <= 0.8 * away;
    const double lost = first - size_;
    const double expected = first * (1.0 - std::pow(slowest_, static_cast<double>(cycles_)));
    const bool turns = cycle_.multipliers.front().imag() != 0.0;
    return lost >= share * expected && lost > above_rounding && (!turns || away <= linear || lost * share <= expected);
  }

 private:
  /// To the first point of the record from which on the motion stays beside the cycle.
  void go_back(int n) {
    constexpr double near = 1e-3;  // of the motion's size, as where Newton's method begins
    if (record_ == nullptr) return;
    const auto is_near = [&](long place) { return section::distance(record_->back(place), cycle_.x, scale_) <= near; };
    for (long place = 0; place < record_->size() && place <= static_cast<long>(longest_trial) && is_near(place);
         place += n)
      ago_ = place;
  }

  /// One stage: through the record, and then with the motion.
  [[nodiscard]] bool go_on() {
    const long in_record = std::min(ago_, periods_);
    ago_ -= in_record;
    return in_record == periods_ || map_.run(motion_, periods_ - in_record, stop_);
  }

  void look() {
    VectorXd x = ago_ > 0 ? VectorXd(record_->back(ago_)) : flow::contact_state(motion_);
    map_.translations().take_out(x);
    distance_ = section::distance(x, cycle_.x, scale_);
    size_ = amplitude_(x);
  }

  const ReturnMap& map_;
  const PointRecord* record_;
  long ago_ = 0;  ///< points of the record that are left
  Motion motion_;
  const FixedPoint& cycle_;
  const VectorXd& scale_;
  double there_;
  Stop stop_;
  Amplitude amplitude_;
  double slowest_;
  long cycles_, periods_;
  double distance_ = 0.0, size_ = 0.0;  ///< from the cycle; along the slowest direction
};

}  // namespace

Attraction attraction(const ReturnMap& map, const Followed& followed, const FixedPoint& cycle, int n,
                      const VectorXd& scale, Stop stop) {
  constexpr double beside = 0.05;  // of the motion's size: a motion farther away may do anything yet
  if (cycle.multipliers.empty()) return {true, 0.0};
  Trial trial(map, followed, cycle, n, scale, stop);
  for (double left = longest_trial; left > 0.0; left -= static_cast<double>(trial.periods())) {
    const bool loses = trial.loses();
    if (trial.distance() <= followed.there) return {true, trial.distance()};
    if (!loses) return {false, trial.distance()};
  }
  return {trial.distance() <= beside, trial.distance()};
}

namespace {

/// Fixed points of the map of n points near x, in numbers relative to the motion's size: the linear part of the map
/// there, and its null directions, along which there may be others.
class Beside {
 public:
  Beside(const ReturnMap& map, const VectorXd& x, int n, const VectorXd& scale, Stop stop)
      : map_(map), n_(n), stop_(stop), sizes_(map.translations().numbers(scale)), here_(map.translations().numbers(x)) {
    constexpr double null = 1e-6;  // a double multiplier 1, as of a conservative model, is known to half the digits
    const MatrixXd jacobian = map.value(x, n, stop).jacobian;
    by_ = dense::singular_vectors(sizes_.cwiseInverse().asDiagonal() *
                                  (jacobian - MatrixXd::Identity(here_.size(), here_.size())) * sizes_.asDiagonal());
    nulls_ = (by_.values.array() < null).count();
  }

  [[nodiscard]] Index size() const { return here_.size(); }
  [[nodiscard]] Index nulls() const { return nulls_; }
  [[nodiscard]] VectorXd direction(Index k) const { return by_.right.col(k); }
  [[nodiscard]] VectorXd state(const VectorXd& y) const { return map_.translations().representative(at(y)); }

  /// By how much the point at y misses its return.
  [[nodiscard]] VectorXd residual(const VectorXd& y) const {
    const VectorXd image = map_.value(state(y), n_, stop_).image;
    return (map_.translations().numbers(image) - at(y)).cwiseQuotient(sizes_);
  }

  /// The part of a residual that moves of no null direction can mend is left; the rest is mended in the least move.
  [[nodiscard]] VectorXd least_move(const VectorXd& residual) const {
    const Index regular = by_.values.size() - nulls_;
    return by_.right.leftCols(regular) *
           (by_.left.leftCols(regular).transpose() * residual).cwiseQuotient(by_.values.head(regular));
  }

 private:
  /// The numbers at y. What is rounding moves none: a coordinate that rests at a stop is not put behind it.
  [[nodiscard]] VectorXd at(const VectorXd& y) const {
    constexpr double rounding = 0x1p-40;  // of singular vectors; far below what a fold leaves
    return here_ + (y.array().abs() > rounding).select(y, 0.0).cwiseProduct(sizes_);
  }

  const ReturnMap& map_;
  int n_;
  Stop stop_;
  VectorXd sizes_, here_;
  dense::SingularVectors by_;
  Index nulls_ = 0;
};

}  // namespace

int family(const ReturnMap& map, const VectorXd& x, int n, const VectorXd& scale, Stop stop) {
  constexpr double aside = 1e-3;   // of the motion's size
  constexpr double closed = 1e-9;  // a fold leaves a residual of the order of aside^2
  const Beside beside(map, x, n, scale, stop);
  int dimensions = 0;
  for (Index k = beside.size() - beside.nulls(); k < beside.size(); ++k) {
    const auto has_member = [&](double move) {
      VectorXd y = move * beside.direction(k);
      try {
        for (int step = 0; step < 2; ++step) y -= beside.least_move(beside.residual(y));
        return beside.residual(y).cwiseAbs().maxCoeff() < closed;
      } catch (const InputError&) {  // behind a stop
      } catch (const NumericalError&) {
      }
      return false;
    };
    if (has_member(aside) && has_member(-aside)) ++dimensions;
  }
  return stopped(stop) ? 0 : dimensions;
}

VectorXd nearest_fixed_point(const ReturnMap& map, const VectorXd& x, int n, const VectorXd& scale, Stop stop) {
  const Beside beside(map, x, n, scale, stop);
  return beside.state(-beside.least_move(beside.residual(VectorXd::Zero(beside.size()))));
}

}  // namespace slapstick::section
