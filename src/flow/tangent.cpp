#include "slapstick/flow/tangent.hpp"

#include <algorithm>

#include "slapstick/flow/saltation.hpp"

namespace slapstick {

TangentMotion::TangentMotion(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start,
                             MotionOptions options)
    : motion_(system, state, start, options) {
  set_tangents(tangents);
  if (motion_.hits().empty()) come_to_rest();
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
    const mode::Frame& frame = motion_.system().frame();
    const std::vector<int> own = {frame.stops[motion_.event().contact].own};
    hold(own, frame.d);
    hold(own, 0);
  }
  flow(motion_.segment());
  if (outcome == Outcome::event) {
    if (motion_.event().kind != EventKind::graze) flow::pass_event(motion_, tangents_);
    hold_still();
  }
  return outcome;
}

/// delta(s) = exp(A s) delta(0): whole windows, then the rest.
void TangentMotion::flow(const Motion::Segment& segment) {
  const System& system = motion_.system();
  const mode::Mode& mode = system.mode(segment.mode);
  const int d = system.frame().d, m = mode.size();
  for (Eigen::Index column = 0; column < tangents_.cols(); ++column) {
    std::ranges::fill(delta_, 0.0);
    std::copy_n(tangents_.col(column).data(), 2 * d, delta_.data());
    double s = segment.duration;
    for (; s > mode.window(); s -= mode.window()) {
      mode.step(delta_.data(), out_.data());
      std::copy_n(reinterpret_cast<const double*>(out_.data()), m, delta_.data());
    }
    mode.state_at(s / mode.window(), delta_.data(), next_.data());
    std::copy_n(next_.data(), 2 * d, tangents_.col(column).data());
  }
}

/// At a start in stick or on a closed stop. A small velocity of slip there is gone after a time of its own size, a small gap after an impact:
/// contact forces bring the pair to rest, and the momentum stays.
void TangentMotion::come_to_rest() {
  const mode::Frame& frame = motion_.system().frame();
  const mode::Mode& mode = motion_.system().mode(motion_.mode_id());
  std::vector<int> held, closed;
  for (int i = 0; i < frame.d; ++i)
    if (mode.steady(i)) held.push_back(i);
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (mode.states().stops[i] == mode::StopState::closed) closed.push_back(frame.stops[i].own);
  hold(held, frame.d);
  hold(closed, 0);
  hold_still();
}

/// Takes the rates of these displacements, or the displacements themselves (first row `offset`), out of the tangents; the momentum stays.
void TangentMotion::hold(const std::vector<int>& rows, Eigen::Index offset) {
  const mode::Frame& frame = motion_.system().frame();
  flow::push_along(frame, rows, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows.size())),
                   tangents_.middleRows(offset, frame.d));
}

/// What the new mode holds still is exactly zero: the rank loss of stick.
void TangentMotion::hold_still() {
  const System& system = motion_.system();
  const mode::Frame& frame = system.frame();
  const mode::Mode& mode = system.mode(motion_.mode_id());
  for (int i = 0; i < frame.d; ++i) {
    if (mode.steady(i)) tangents_.row(frame.u(i)).setZero();
  }
  for (std::size_t i = 0; i < frame.stops.size(); ++i) {
    if (mode.states().stops[i] == mode::StopState::closed) tangents_.row(frame.stops[i].own).setZero();
  }
}

void TangentMotion::set_tangents(const Eigen::MatrixXd& tangents) {
  const mode::Frame& frame = motion_.system().frame();
  tangents_.resize(2 * frame.d, tangents.cols());
  tangents_.topRows(frame.d) = frame.dependence * tangents.topRows(frame.n);
  tangents_.bottomRows(frame.d) = frame.dependence * tangents.bottomRows(frame.n);
}

Eigen::MatrixXd TangentMotion::tangents() const {
  const mode::Frame& frame = motion_.system().frame();
  Eigen::MatrixXd out(2 * frame.n, tangents_.cols());
  out << tangents_.topRows(frame.n), tangents_.middleRows(frame.d, frame.n);
  return out;
}

}  // namespace slapstick
