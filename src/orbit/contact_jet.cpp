/// Sets what a mode holds still.
#include "orbit/contact_jet.hpp"

#include "base/dense.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Displacements or velocities, the first n of which are x, that a mode holds still.
struct Held {
  std::vector<Index> open, dependent;  ///< of the first n those that it does not hold; of the others those it does
};

/// Changes the open numbers the least way that makes good what the dependent ones miss.
/// @param missed  a row for each dependent number
void make_good(const Held& held, const MatrixXd& dependence, const MatrixXd& missed, Eigen::Ref<MatrixXd> x) {
  const MatrixXd rows = dependence(held.dependent, held.open);
  std::vector<Index> own;
  for (Index k = 0; k < rows.rows(); ++k) {  // not those that follow from others that are held
    const double size = dependence.row(held.dependent[static_cast<std::size_t>(k)]).norm();
    if (rows.row(k).norm() > mode::Frame::structural_zero * size) own.push_back(k);
  }
  if (own.empty()) return;
  x(held.open, Eigen::all) -=
      dense::LeastNorm(MatrixXd(rows(own, Eigen::all))).solve(MatrixXd(missed(own, Eigen::all)));
}

/// Velocities and their derivatives by the parameters.
void hold_velocities(const ModeSet& set, const Leg& next, const Jet& X, Jet& x) {
  const mode::Frame& frame = set.frame();
  const mode::Outline& outline = set.mode(next.states).outline;
  MatrixXd speeds = MatrixXd::Zero(frame.d, X.all.cols());
  speeds.col(0) = outline.held_speeds(frame.drift);
  for (Index p = 0; p < X.parameters; ++p)
    speeds.col(X.all.cols() - X.parameters + p) =
        outline.held_speeds(set.frame_rate(static_cast<std::size_t>(p)).drift);
  Held held;
  for (int i = 0; i < frame.n; ++i) {
    if (!outline.steady[i]) held.open.push_back(i);
    if (outline.steady[i]) x.all.row(frame.n + i) = speeds.row(i);
  }
  for (int i = frame.n; i < frame.d; ++i)
    if (outline.steady[i]) held.dependent.push_back(i);
  auto own = x.all.bottomRows(frame.n);
  const MatrixXd all =
      X.all.middleRows(frame.d, frame.d) + frame.dependence * (own - X.all.middleRows(frame.d, frame.n));
  make_good(held, frame.dependence, (all - speeds)(held.dependent, Eigen::all), own);
}

void hold_gaps(const ModeSet& set, const Leg& next, const Jet& X, Jet& x) {
  const mode::Frame& frame = set.frame();
  std::vector<bool> closed(static_cast<std::size_t>(frame.d), false);
  for (std::size_t i = 0; i < frame.stops.size(); ++i)
    if (next.states.stops[i] == mode::StopState::closed) closed[static_cast<std::size_t>(frame.stops[i].own)] = true;
  Held held;
  for (int i = 0; i < frame.d; ++i) {
    if (i >= frame.n && closed[static_cast<std::size_t>(i)]) held.dependent.push_back(i);
    if (i < frame.n && closed[static_cast<std::size_t>(i)]) x.all.row(i).setZero();
    if (i < frame.n && !closed[static_cast<std::size_t>(i)]) held.open.push_back(i);
  }
  auto own = x.all.topRows(frame.n);
  const MatrixXd all = X.all.topRows(frame.d) + frame.dependence * (own - X.all.topRows(frame.n));
  make_good(held, frame.dependence, all(held.dependent, Eigen::all), own);
}

}  // namespace

Jet contact_jet(const ModeSet& set, const Leg& next, const Jet& X) {
  const mode::Frame& frame = set.frame();
  Jet x(2 * frame.n, X.states, X.parameters);
  x.all << X.all.topRows(frame.n), X.all.middleRows(frame.d, frame.n);
  if (next.chattering != 0) return x;  // begins with plastic impacts
  hold_velocities(set, next, X, x);
  hold_gaps(set, next, X, x);
  return x;
}

}  // namespace slapstick::orbit
