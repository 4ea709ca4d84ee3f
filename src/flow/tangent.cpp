#include "slapstick/flow/tangent.hpp"

#include <algorithm>

namespace slapstick {
namespace {

/// A X at an extended state, rows (p, u) only.
Eigen::VectorXd velocity(const mode::Mode& mode, std::span<const double> X, int rows) {
  const Eigen::Map<const Eigen::VectorXd> state(X.data(), mode.size());
  return mode.system().topRows(rows) * state;
}

}  // namespace

TangentMotion::TangentMotion(const System& system, const State& state, Eigen::MatrixXd tangents, Instant start,
                             MotionOptions options)
    : motion_(system, state, start, options), tangents_(std::move(tangents)) {
  const auto padded = static_cast<std::size_t>((system.frame().size() + 7) / 8 * 8);
  delta_.assign(padded, 0.0);
  next_.assign(padded, 0.0);
  out_.resize(padded / 8);
}

Outcome TangentMotion::advance(Instant end) {
  const Outcome outcome = motion_.advance(end);
  if (motion_.counters().segments == segments_seen_) return outcome;  // a further event at the same instant
  segments_seen_ = motion_.counters().segments;
  const bool chatter = outcome == Outcome::event && motion_.event().kind == EventKind::chatter;
  if (chatter) {  // from the last impact to the limit: momentum is kept, the gap and its rate are lost
    const System& system = motion_.system();
    const int stop = motion_.event().contact, n = system.frame().n;
    const mode::RowVector& g = system.frame().stops[stop].row;
    const Eigen::RowVectorXd rate = g * tangents_.bottomRows(n), depth = g * tangents_.topRows(n);
    tangents_.bottomRows(n) -= system.impulse(stop) * rate;
    tangents_.topRows(n) -= system.impulse(stop) * depth;
  }
  flow(motion_.segment());
  if (outcome == Outcome::event && !chatter) jump(motion_.event());
  return outcome;
}

/// delta(s) = exp(A s) delta(0): whole windows, then the rest.
void TangentMotion::flow(const Motion::Segment& segment) {
  const System& system = motion_.system();
  const mode::Mode& mode = system.mode(segment.mode);
  const int n = system.frame().n, m = mode.size();
  for (Eigen::Index column = 0; column < tangents_.cols(); ++column) {
    std::ranges::fill(delta_, 0.0);
    std::copy_n(tangents_.col(column).data(), 2 * n, delta_.data());
    double s = segment.duration;
    for (; s > mode.window(); s -= mode.window()) {
      mode.step(delta_.data(), out_.data());
      std::copy_n(reinterpret_cast<const double*>(out_.data()), m, delta_.data());
    }
    mode.state_at(s / mode.window(), delta_.data(), next_.data());
    for (int i = 0; i < n; ++i) next_[n + i] += system.frame().drift[i];  // state_at is affine in p', tangents are not
    std::copy_n(next_.data(), 2 * n, tangents_.col(column).data());
  }
}

void TangentMotion::jump(const Event& event) {
  if (event.kind == EventKind::graze) return hold_still();
  if (!motion_.hit_guard()) return;
  const System& system = motion_.system();
  const int n = system.frame().n;
  const mode::Mode& before = system.mode(motion_.segment().mode);
  const mode::RowVector& h = motion_.hit_guard()->row;
  const Eigen::Map<const Eigen::VectorXd> X(motion_.extended_before().data(), before.size());
  const double slope = h.dot(before.system() * X);
  if (slope == 0.0) return;
  const Eigen::VectorXd f_minus = velocity(before, motion_.extended_before(), 2 * n);
  const Eigen::VectorXd f_plus = velocity(system.mode(motion_.mode_id()), motion_.extended(), 2 * n);
  const Eigen::RowVectorXd dt = -(h.head(2 * n) * tangents_) / slope;
  tangents_ += f_minus * dt;
  if (event.kind == EventKind::impact) {
    const double r = system.model().stops[event.contact].restitution;
    const Eigen::RowVectorXd rate = system.frame().stops[event.contact].row * tangents_.bottomRows(n);
    tangents_.bottomRows(n) -= (1.0 + r) * system.impulse(event.contact) * rate;
  }
  tangents_ -= f_plus * dt;
  hold_still();
}

/// What the new mode holds still is exactly zero: the rank loss of stick.
void TangentMotion::hold_still() {
  const System& system = motion_.system();
  const int n = system.frame().n;
  const mode::ContactStates& states = system.mode(motion_.mode_id()).states();
  const auto hold = [&](const mode::ContactRow& contact) {
    if (contact.own >= 0) tangents_.row(n + contact.own).setZero();
  };
  for (std::size_t i = 0; i < states.stops.size(); ++i) {
    const mode::ContactRow& stop = system.frame().stops[i];
    if (states.stops[i] != mode::StopState::closed) continue;
    hold(stop);
    if (stop.own >= 0) tangents_.row(stop.own).setZero();
  }
  for (std::size_t i = 0; i < states.frictions.size(); ++i) {
    if (states.frictions[i] == mode::FrictionState::stick) hold(system.frame().frictions[i]);
    // A friction contact that shares a stop's coordinate holds that coordinate.
    for (const mode::ContactRow& stop : system.frame().stops) {
      const bool same = stop.row == system.frame().frictions[i].row || stop.row == -system.frame().frictions[i].row;
      if (same && states.frictions[i] == mode::FrictionState::stick) hold(stop);
    }
  }
}

}  // namespace slapstick
