/// Tangent vectors along a motion: through segments by the modes' operators, through events by flow/saltation.hpp.
#include "slapstick/flow/tangent.hpp"

#include <algorithm>
#include <vector>

#include "base/ranges.hpp"
#include "flow/engine.hpp"
#include "flow/saltation.hpp"

namespace slapstick {

struct TangentMotion::Parts {
  Parts(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start, MotionOptions options);

  Outcome advance(Instant end);
  void flow(const Motion::Segment& segment);
  void come_to_rest();
  void hold(const std::vector<int>& rows, Eigen::Index offset);
  void hold_still();
  void set(const Eigen::MatrixXd& tangents);
  [[nodiscard]] Eigen::MatrixXd get() const;
  [[nodiscard]] const flow::CompiledSystem& system() const { return motion.system().compiled(); }

  Motion motion;
  Eigen::MatrixXd columns;  ///< of all d displacements and velocities
  std::vector<double> delta, next;
  event::Lanes out;
  long segments_seen = 0;
};

TangentMotion::Parts::Parts(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start,
                            MotionOptions options)
    : motion(system, state, start, options) {
  set(tangents);
  if (motion.engine().hits().empty()) come_to_rest();
  const auto padded = static_cast<std::size_t>((system.compiled().frame().size() + 7) / 8 * 8);
  delta.assign(padded, 0.0);
  next.assign(padded, 0.0);
  out.resize(padded / 8);
}

Outcome TangentMotion::Parts::advance(Instant end) {
  const Outcome outcome = motion.advance(end);
  if (motion.counters().segments == segments_seen) return outcome;  // a further event at the same instant
  segments_seen = motion.counters().segments;
  const bool chatter = outcome == Outcome::event && motion.event().kind == EventKind::chatter;
  if (chatter) {  // from the last impact to the limit: momentum is kept, the gap and its rate are lost
    const mode::Frame& frame = system().frame();
    const std::vector<int> own = {frame.stops[motion.event().contact].own};
    hold(own, frame.d);
    hold(own, 0);
  }
  flow(motion.segment());
  if (outcome == Outcome::event) {
    if (motion.event().kind != EventKind::graze) flow::pass_event(motion, columns);
    hold_still();
  }
  return outcome;
}

/// delta(s) = exp(A s) delta(0): whole windows, then the rest.
void TangentMotion::Parts::flow(const Motion::Segment& segment) {
  const mode::Mode& mode = system().mode(segment.mode);
  const int d = system().frame().d, m = mode.size();
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    ranges::fill(delta, 0.0);
    std::copy_n(columns.col(column).data(), 2 * d, delta.data());
    double s = segment.duration;
    for (; s > mode.window(); s -= mode.window()) {
      mode.step(delta.data(), out.data());
      std::copy_n(reinterpret_cast<const double*>(out.data()), m, delta.data());
    }
    mode.state_at(s / mode.window(), delta.data(), next.data());
    std::copy_n(next.data(), 2 * d, columns.col(column).data());
  }
}

/// At a start in stick or on a closed stop. A small velocity of slip there is gone after a time of its own size, a
/// small gap after an impact: contact forces bring the pair to rest, and the momentum stays.
void TangentMotion::Parts::come_to_rest() {
  const mode::Frame& frame = system().frame();
  const mode::Mode& mode = system().mode(motion.mode_id());
  std::vector<int> held, closed;
  for (int i = 0; i < frame.d; ++i)
    if (mode.steady(i)) held.push_back(i);
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (mode.states().stops[i] == mode::StopState::closed) closed.push_back(frame.stops[i].own);
  hold(held, frame.d);
  hold(closed, 0);
  hold_still();
}

/// Takes the rates of these displacements, or the displacements themselves (first row `offset`), out of the tangents;
/// the momentum stays.
void TangentMotion::Parts::hold(const std::vector<int>& rows, Eigen::Index offset) {
  const mode::Frame& frame = system().frame();
  flow::push_along(frame, rows, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows.size())),
                   columns.middleRows(offset, frame.d));
}

/// What the new mode holds still is exactly zero: the rank loss of stick.
void TangentMotion::Parts::hold_still() {
  const mode::Frame& frame = system().frame();
  const mode::Mode& mode = system().mode(motion.mode_id());
  for (int i = 0; i < frame.d; ++i) {
    if (mode.steady(i)) columns.row(frame.u(i)).setZero();
  }
  for (std::size_t i = 0; i < frame.stops.size(); ++i) {
    if (mode.states().stops[i] == mode::StopState::closed) columns.row(frame.stops[i].own).setZero();
  }
}

void TangentMotion::Parts::set(const Eigen::MatrixXd& tangents) {
  const mode::Frame& frame = system().frame();
  columns.resize(2 * frame.d, tangents.cols());
  columns.topRows(frame.d) = frame.dependence * tangents.topRows(frame.n);
  columns.bottomRows(frame.d) = frame.dependence * tangents.bottomRows(frame.n);
}

Eigen::MatrixXd TangentMotion::Parts::get() const {
  const mode::Frame& frame = system().frame();
  Eigen::MatrixXd all(2 * frame.n, columns.cols());
  all << columns.topRows(frame.n), columns.middleRows(frame.d, frame.n);
  return all;
}

TangentMotion::TangentMotion(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start,
                             MotionOptions options)
    : parts_(std::make_unique<Parts>(system, state, tangents, start, options)) {}

TangentMotion::TangentMotion(const TangentMotion& other) : parts_(std::make_unique<Parts>(*other.parts_)) {}
TangentMotion::TangentMotion(TangentMotion&& other) noexcept = default;
TangentMotion& TangentMotion::operator=(TangentMotion&& other) noexcept = default;
TangentMotion::~TangentMotion() = default;
TangentMotion& TangentMotion::operator=(const TangentMotion& other) {
  if (this != &other) *this = TangentMotion(other);
  return *this;
}

Outcome TangentMotion::advance(Instant end) { return parts_->advance(end); }
const Motion& TangentMotion::motion() const { return parts_->motion; }
Eigen::MatrixXd TangentMotion::tangents() const { return parts_->get(); }
void TangentMotion::set_tangents(const Eigen::MatrixXd& tangents) { parts_->set(tangents); }

}  // namespace slapstick
