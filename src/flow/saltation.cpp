/// Takes tangent vectors through the events of one instant.
#include "flow/saltation.hpp"

#include <algorithm>
#include <vector>

#include "base/ranges.hpp"
#include "flow/collision.hpp"
#include "flow/engine.hpp"
#include "flow/instant_parts.hpp"

namespace slapstick::flow {
namespace {

class Passage {
 public:
  Passage(const Engine& engine, bool backward);
  void carry(Eigen::MatrixXd& tangents);
  void carry_at_once(Eigen::MatrixXd& tangents) const;
  /// What the rounding of rates can have made of the tangents: a slow event makes much of that.
  [[nodiscard]] const Eigen::MatrixXd& rounding() const { return rounding_; }

 private:
  void apply(const Motion::Strike& strike, bool rates, Eigen::Ref<Eigen::MatrixXd> velocities) const;
  [[nodiscard]] Eigen::MatrixXd flow_of(const mode::ContactStates& states) const;

  const Engine& engine_;
  const CompiledSystem& system_;
  const mode::Frame& frame_;
  const mode::Mode& before_;
  bool backward_;
  Eigen::VectorXd X_;
  Eigen::MatrixXd rounding_;
};

Passage::Passage(const Engine& engine, bool backward)
    : engine_(engine),
      system_(engine.system()),
      frame_(system_.frame()),
      before_(system_.mode(engine.segment().mode)),
      backward_(backward),
      X_(Eigen::Map<const Eigen::VectorXd>(engine.extended_before().data(), before_.size())) {
  for (std::size_t k = 0; k < frame_.signals.size() && engine.hits().empty(); ++k)
    frame_.kick(k, frame_.signals[k].pulse(engine.time()), X_.data());
}

/// Of the state now, or of small changes of it.
// NOLINTNEXTLINE(performance-unnecessary-value-param): a view, through which is written
void Passage::apply(const Motion::Strike& strike, bool rates, Eigen::Ref<Eigen::MatrixXd> velocities) const {
  const Collision hit(system_.model(), frame_, strike, X_);
  push_along(frame_, hit.rows, rates ? hit.slope : hit.factor, velocities);
}

/// A of a mode, which may exist between two guards only.
Eigen::MatrixXd Passage::flow_of(const mode::ContactStates& states) const {
  const ModeId id = system_.mode_id(states);
  const mode::Mode* known = system_.known_mode(id);
  if (known != nullptr) return known->system();
  return system_.outline(id)->system;
}

void Passage::carry(Eigen::MatrixXd& tangents) {
  const std::vector<InstantPart> parts = parts_of_instant(engine_, backward_);
  const int d = frame_.d;
  mode::ContactStates states = before_.states();
  rounding_ = Eigen::MatrixXd::Zero(tangents.rows(), tangents.cols());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const mode::Guard& guard = before_.guards()[parts[k].guard];
    const bool last = k + 1 == parts.size();
    if (!passes_smoothly(system_.model(), guard)) {  // else nothing happens to a tangent
      const Eigen::MatrixXd minus = flow_of(states), plus = flow_of(parts[k].after);
      const Eigen::VectorXd f_minus = minus * X_;
      const double slope = guard.row.dot(f_minus);
      Eigen::RowVectorXd dt = Eigen::RowVectorXd::Zero(tangents.cols());
      if (slope != 0.0) dt = -(guard.row.head(2 * d) * tangents) / slope;
      Eigen::VectorXd terms = minus.cwiseAbs() * X_.cwiseAbs();
      tangents += f_minus.head(2 * d) * dt;
      for (const Motion::Strike& strike : parts[k].strikes) {
        apply(strike, true, tangents.bottomRows(d));
        apply(strike, false, X_.segment(d, d));
      }
      if (last) X_ = Eigen::Map<const Eigen::VectorXd>(engine_.extended().data(), before_.size());
      const Eigen::VectorXd f_plus = plus * X_;
      terms += plus.cwiseAbs() * X_.cwiseAbs();
      tangents -= f_plus.head(2 * d) * dt;
      rounding_ += 0x1p-50 * terms.head(2 * d) * dt.cwiseAbs();
    }
    states = parts[k].after;
  }
}

/// Impacts without a time of their own, after a chatter limit, and the end of a pile-up: gaps and their rates are lost,
/// the momentum is kept.
void Passage::carry_at_once(Eigen::MatrixXd& tangents) const {
  for (const Motion::Strike& strike : separated_strikes(frame_, engine_.strikes())) {
    apply(strike, true, tangents.bottomRows(frame_.d));
    if (strike.to_rest) apply(strike, true, tangents.topRows(frame_.d));
  }
}

/// Do all events of the instant have a time of their own?
bool timed(const Engine& engine) {
  return !engine.hits().empty() && ranges::none_of(engine.strikes(), &Motion::Strike::to_rest);
}

/// Are two derivatives the same up to rounding? Their four blocks, displacements and velocities by displacements and
/// velocities, have a unit each. The state at the instant has no size to go by: all may be at rest there.
/// @param rounding  of each entry, beside that of the blocks
/// @param time  in which a state of the motion changes
bool alike(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& rounding, double time) {
  constexpr double order_rounding = 1e-9;  // of a block's entries; an order that matters shows in the leading digits
  Eigen::Matrix2d units;
  units << 1.0, time, 1.0 / time, 1.0;
  const Eigen::Index d = a.rows() / 2, n = a.cols() / 2;
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j) {
      const Eigen::MatrixXd x = a.block(i * d, j * n, d, n), y = b.block(i * d, j * n, d, n);
      const double size = std::max(units(i, j), x.cwiseAbs().cwiseMax(y.cwiseAbs()).maxCoeff());
      const Eigen::MatrixXd apart = (x - y).cwiseAbs() - rounding.block(i * d, j * n, d, n);
      if (apart.maxCoeff() > order_rounding * size) return false;
    }
  return true;
}

}  // namespace

void pass_event(const Engine& engine, Eigen::MatrixXd& tangents) {
  if (engine.hits().empty() && engine.strikes().empty()) return;
  Passage passage(engine, false);
  timed(engine) ? passage.carry(tangents) : passage.carry_at_once(tangents);
}

void hold_still(const Engine& engine, Eigen::MatrixXd& tangents) {
  const mode::Frame& frame = engine.system().frame();
  const mode::Mode& mode = engine.system().mode(engine.mode_id());
  for (int i = 0; i < frame.d; ++i)
    if (mode.steady(i)) tangents.row(frame.u(i)).setZero();
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (mode.states().stops[i] == mode::StopState::closed) tangents.row(frame.stops[i].own).setZero();
  move_sliders(engine, tangents);
}

void move_sliders(const Engine& engine, Eigen::MatrixXd& tangents) {
  const mode::Frame& frame = engine.system().frame();
  const mode::Mode& mode = engine.system().mode(engine.mode_id());
  for (const mode::SliderRow& row : frame.sliders) {
    const bool rests = row.rests(mode.states().pieces);
    tangents.row(frame.u(row.own)) = (rests ? 0.0 : row.pair.sign) * tangents.row(frame.u(row.pair.own));
    if (!rests) tangents.row(row.own) = row.displacement.head(frame.d) * tangents.topRows(frame.d);
  }
}

bool differentiable(const Engine& engine) {
  if (!timed(engine) || (engine.hits().size() < 2 && parts_of_instant(engine).size() < 2)) return true;
  const mode::Frame& frame = engine.system().frame();
  Eigen::MatrixXd forward = Eigen::MatrixXd::Zero(2 * frame.d, 2 * frame.n);
  forward.topLeftCorner(frame.d, frame.n) = frame.dependence;
  forward.bottomRightCorner(frame.d, frame.n) = frame.dependence;
  Eigen::MatrixXd backward = forward;
  Passage first(engine, false), second(engine, true);
  first.carry(forward);
  second.carry(backward);
  hold_still(engine, forward);
  hold_still(engine, backward);
  const Eigen::MatrixXd rounding = first.rounding() + second.rounding();
  return alike(forward, backward, rounding, engine.system().mode(engine.mode_id()).window());
}

}  // namespace slapstick::flow
