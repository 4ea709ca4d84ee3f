/// Tangent vectors along an engine's motion: through segments by the modes' operators, through events by saltation.hpp.
#include "flow/carried_tangents.hpp"

#include <algorithm>

#include "base/ranges.hpp"
#include "base/set_bits.hpp"
#include "flow/collision.hpp"
#include "flow/engine.hpp"
#include "flow/saltation.hpp"

namespace slapstick::flow {

CarriedTangents::CarriedTangents(const CompiledSystem& system) : system_(&system) {
  const auto padded = static_cast<std::size_t>((system.frame().size() + 7) / 8 * 8);
  delta_.assign(padded, 0.0);
  next_.assign(padded, 0.0);
  out_.resize(padded / 8);
}

void CarriedTangents::begin(const Engine& engine) {
  if (engine.hits().empty()) come_to_rest(engine);
}

void CarriedTangents::follow(const Engine& engine, Outcome outcome) {
  if (engine.counters().segments == segments_seen_) return;  // a further event at the same instant
  segments_seen_ = engine.counters().segments;
  if (engine.chattered() != 0) {  // from the last impacts to the limit: momentum is kept, gaps and their rates are lost
    const mode::Frame& frame = system_->frame();
    std::vector<int> own;
    for (const int stop : set_bits(engine.chattered())) own.push_back(frame.stops[stop].own);
    hold(own, frame.d);
    hold(own, 0);
  }
  flow(engine.segment());
  if (outcome == Outcome::event) {
    if (engine.event().kind != EventKind::graze) pass_event(engine, columns_);
    flow::hold_still(engine, columns_);
  }
}

/// delta(s) = exp(A s) delta(0): whole windows, then the rest.
void CarriedTangents::flow(const Motion::Segment& segment) {
  const mode::Mode& mode = system_->mode(segment.mode);
  const int d = system_->frame().d, m = mode.size();
  for (Eigen::Index column = 0; column < columns_.cols(); ++column) {
    ranges::fill(delta_, 0.0);
    std::copy_n(columns_.col(column).data(), 2 * d, delta_.data());
    double s = segment.duration;
    for (; s > mode.window(); s -= mode.window()) {
      mode.step(delta_.data(), out_.data());
      std::copy_n(reinterpret_cast<const double*>(out_.data()), m, delta_.data());
    }
    mode.state_at(s / mode.window(), delta_.data(), next_.data());
    std::copy_n(next_.data(), 2 * d, columns_.col(column).data());
  }
}

/// At a start in stick or on a closed stop. A small velocity of slip there is gone after a time of its own size, a
/// small gap after an impact: contact forces bring the pair to rest, and the momentum stays.
void CarriedTangents::come_to_rest(const Engine& engine) {
  const mode::Frame& frame = system_->frame();
  const mode::Mode& mode = system_->mode(engine.mode_id());
  std::vector<int> held, closed;
  for (int i = 0; i < frame.d; ++i)
    if (mode.steady(i)) held.push_back(i);
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (mode.states().stops[i] == mode::StopState::closed) closed.push_back(frame.stops[i].own);
  hold(held, frame.d);
  hold(closed, 0);
  flow::hold_still(engine, columns_);
}

/// Takes the rates of these displacements, or the displacements themselves (first row `offset`), out of the tangents;
/// the momentum stays.
void CarriedTangents::hold(const std::vector<int>& rows, Eigen::Index offset) {
  const mode::Frame& frame = system_->frame();
  push_along(frame, rows, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows.size())),
             columns_.middleRows(offset, frame.d));
}

void CarriedTangents::set(const Eigen::MatrixXd& tangents, const Engine& engine) {
  const mode::Frame& frame = system_->frame();
  columns_.resize(2 * frame.d, tangents.cols());
  columns_.topRows(frame.d) = frame.dependence * tangents.topRows(frame.n);
  columns_.bottomRows(frame.d) = frame.dependence * tangents.bottomRows(frame.n);
  for (const mode::InnerRow& row : frame.inner)
    columns_.row(frame.u(row.own)) = row.rate.head(frame.n) * columns_.topRows(frame.n);
  move_sliders(engine, columns_);
}

Eigen::MatrixXd CarriedTangents::get() const {
  const mode::Frame& frame = system_->frame();
  Eigen::MatrixXd all(2 * frame.n, columns_.cols());
  all << columns_.topRows(frame.n), columns_.middleRows(frame.d, frame.n);
  return all;
}

}  // namespace slapstick::flow
