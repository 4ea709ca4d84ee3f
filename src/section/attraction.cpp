/// Follows a motion beside a cycle, and looks for cycles beside a cycle.
#include "section/attraction.hpp"

#include <algorithm>

#include "base/dense.hpp"
#include "section/approach.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::section {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A motion beside a cycle, from stage to stage.
class Trial {
 public:
  Trial(const ReturnMap& map, const Followed& followed, const FixedPoint& cycle, int n, const VectorXd& scale,
        Stop stop)
      : map_(map),
        record_(followed.record),
        motion_(followed.motion),
        there_(followed.there),
        stop_(stop),
        approach_(map.translations(), cycle, n, scale) {
    go_back(n);
    seen_ = look();
  }

  [[nodiscard]] double distance() const { return seen_.distance; }
  [[nodiscard]] long periods() const { return approach_.stage(); }

  /// Follows the motion for one stage. Has it lost what a motion loses that is drawn to the cycle?
  bool loses() {
    const Approach::Look before = seen_;
    if (!go_on()) return false;
    seen_ = look();
    return approach_.loses(before, seen_, there_);
  }

 private:
  /// To the first point of the record from which on the motion stays beside the cycle.
  void go_back(int n) {
    constexpr double beside_cycle = 1e-3;  // of the motion's size, as where Newton's method begins
    if (record_ == nullptr) return;
    const auto is_near = [&](long place) { return approach_.distance(record_->back(place)) <= beside_cycle; };
    for (long place = 0; place < record_->size() && place <= static_cast<long>(longest_trial) && is_near(place);
         place += n)
      ago_ = place;
  }

  /// One stage: through the record, and then with the motion.
  [[nodiscard]] bool go_on() {
    const long in_record = std::min(ago_, periods());
    ago_ -= in_record;
    return in_record == periods() || map_.run(motion_, periods() - in_record, stop_);
  }

  [[nodiscard]] Approach::Look look() const {
    VectorXd x = ago_ > 0 ? VectorXd(record_->back(ago_)) : flow::contact_state(motion_);
    map_.translations().take_out(x);
    return approach_.at(x);
  }

  const ReturnMap& map_;
  const PointRecord* record_;
  long ago_ = 0;  ///< points of the record that are left
  Motion motion_;
  double there_;
  Stop stop_;
  Approach approach_;
  Approach::Look seen_;
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
      : map_(map), n_(n), stop_(stop), sizes_(map.translations().numbers(scale)), x_(x) {
    constexpr double null = 1e-6;  // a double multiplier 1, as of a conservative model, is known to half the digits
    const MatrixXd jacobian = map.value(x, n, stop).jacobian;
    by_ = dense::singular_vectors(sizes_.cwiseInverse().asDiagonal() *
                                  (jacobian - MatrixXd::Identity(sizes_.size(), sizes_.size())) * sizes_.asDiagonal());
    nulls_ = (by_.values.array() < null).count();
  }

  [[nodiscard]] Index size() const { return sizes_.size(); }
  [[nodiscard]] Index nulls() const { return nulls_; }
  [[nodiscard]] VectorXd direction(Index k) const { return by_.right.rightCols(nulls_).col(k); }
  /// The part of a point that is in the null directions.
  [[nodiscard]] VectorXd part(const VectorXd& y) const { return by_.right.rightCols(nulls_).transpose() * y; }
  [[nodiscard]] VectorXd state(const VectorXd& y) const { return x_ + map_.translations().representative(move(y)); }

  /// By how much the point at y misses its return.
  [[nodiscard]] VectorXd residual(const VectorXd& y) const {
    const VectorXd image = map_.value(state(y), n_, stop_).image;
    return (map_.translations().numbers(image - x_) - move(y)).cwiseQuotient(sizes_);
  }

  /// The part of a residual that moves of no null direction can mend is left; the rest is mended in the least move.
  [[nodiscard]] VectorXd least_move(const VectorXd& residual) const {
    const Index regular = by_.values.size() - nulls_;
    return by_.right.leftCols(regular) *
           (by_.left.leftCols(regular).transpose() * residual).cwiseQuotient(by_.values.head(regular));
  }

  /// By how much the map itself moves a point in the null directions, as a slider that is drawn to its limit.
  /// Not at all where the multiplier 1 has fewer eigenvectors than its multiplicity.
  [[nodiscard]] VectorXd drawn(const VectorXd& residual) const {
    const auto right = by_.right.rightCols(nulls_), left = by_.left.rightCols(nulls_);
    constexpr double defective = 1e-6;  // as `null`
    const MatrixXd across = left.transpose() * right;
    if (dense::reciprocal_condition(across) < defective) return VectorXd::Zero(residual.size());
    return right * dense::solve(across, left.transpose() * residual);
  }

 private:
  /// From x to y. What is rounding moves none: a coordinate that rests at a stop is not put behind it.
  [[nodiscard]] VectorXd move(const VectorXd& y) const {
    constexpr double component_rounding = 0x1p-40;  // of singular vectors; far below what a fold leaves
    return (y.array().abs() > component_rounding).select(y, 0.0).cwiseProduct(sizes_);
  }

  const ReturnMap& map_;
  int n_;
  Stop stop_;
  VectorXd sizes_, x_;
  dense::SingularVectors by_;
  Index nulls_ = 0;
};

}  // namespace

/// At the end of a family, as where several sliders just touch their limits, the members beside x are a cone: motions
/// beside x are drawn to members that span it.
int family(const ReturnMap& map, const VectorXd& x, int n, const VectorXd& scale, Stop stop) {
  constexpr double aside = 1e-3;        // of the motion's size
  constexpr double closed = 1e-9;       // a fold leaves a residual of the order of aside^2
  constexpr double elsewhere = 0.01;    // of the way aside: of what is drawn nearer to x the linear part says nothing
  constexpr double independent = 0.01;  // singular values of directions; a narrower cone has fewer dimensions
  constexpr int most_steps = 40;        // of a linear part that is another one at the end of a family; two where not
  const Beside beside(map, x, n, scale, stop);
  const auto member = [&](VectorXd y) -> VectorXd {
    try {
      for (int step = 0; step <= most_steps && !stopped(stop); ++step) {
        const VectorXd residual = beside.residual(y);
        if (residual.cwiseAbs().maxCoeff() < closed) return beside.part(y);
        y += beside.drawn(residual) - beside.least_move(residual);
      }
    } catch (const InputError&) {  // behind a stop
    } catch (const NumericalError&) {
    }
    return VectorXd::Zero(beside.nulls());
  };
  MatrixXd directions(beside.nulls(), 0);
  Index dimensions = 0;
  for (const double way : {aside, -aside}) {
    for (Index k = 0; k < beside.nulls() && dimensions < beside.nulls(); ++k) {
      const VectorXd found = member(way * beside.direction(k));
      if (found.norm() < elsewhere * aside || member(0.5 * way * beside.direction(k)).norm() < 0.5 * elsewhere * aside)
        continue;
      directions.conservativeResize(Eigen::NoChange, directions.cols() + 1);
      directions.rightCols(1) = found.normalized();
      dimensions = (dense::singular_vectors(directions).values.array() > independent).count();
    }
  }
  return stopped(stop) ? 0 : static_cast<int>(dimensions);
}

VectorXd nearest_fixed_point(const ReturnMap& map, const VectorXd& x, int n, const VectorXd& scale, Stop stop) {
  const Beside beside(map, x, n, scale, stop);
  return beside.state(-beside.least_move(beside.residual(VectorXd::Zero(beside.size()))));
}

}  // namespace slapstick::section
