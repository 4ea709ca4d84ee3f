/// Contact states from motions and back, their linear motion in a mode, and sorted multipliers.
#include "flow/contact_state.hpp"

#include <algorithm>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "flow/engine.hpp"

namespace slapstick::flow {

Eigen::VectorXd contact_state(const Motion& motion) {
  const mode::Frame& frame = motion.system().compiled().frame();
  Eigen::VectorXd state(2 * frame.n);
  std::copy_n(motion.engine().extended().data(), frame.n, state.data());
  std::copy_n(motion.engine().extended().data() + frame.d, frame.n, state.data() + frame.n);
  return state;
}

Eigen::VectorXd contact_state(const mode::Frame& frame, const Eigen::VectorXd& X) {
  Eigen::VectorXd state(2 * frame.n);
  state << X.head(frame.n), X.segment(frame.d, frame.n);
  return state;
}

State user_state(const System& system, const Eigen::VectorXd& contact) {
  State state(static_cast<std::size_t>(contact.size()));
  system.compiled().frame().leave(contact.data(), contact.data() + system.compiled().frame().n, state.data());
  return state;
}

Extension extension_of(const mode::Frame& frame) {
  const Eigen::Index n = frame.n, d = frame.d;
  Extension all{Eigen::MatrixXd::Zero(2 * d, 2 * n), Eigen::VectorXd(2 * d)};
  all.by.topLeftCorner(d, n) = all.by.bottomRightCorner(d, n) = frame.dependence;
  all.constant << frame.shift_slack, frame.drift_slack;
  for (const mode::InnerRow& row : frame.inner) {
    all.by.row(frame.u(row.own)) << row.rate.head(n), Eigen::RowVectorXd::Zero(n);
    all.constant[frame.u(row.own)] = row.rate[frame.one()];
  }
  return all;
}

ContactFlow contact_flow(const mode::Frame& frame, const mode::Matrix& A, const Extension& all) {
  const Eigen::Index n = frame.n, d = frame.d;
  const Eigen::MatrixXd by = A.topLeftCorner(2 * d, 2 * d) * all.by;
  const Eigen::VectorXd constant = A.topLeftCorner(2 * d, 2 * d) * all.constant + A.col(frame.one()).head(2 * d);
  ContactFlow flow{Eigen::MatrixXd(2 * n, 2 * n), Eigen::VectorXd(2 * n)};
  flow.by << by.topRows(n), by.middleRows(d, n);
  flow.constant << constant.head(n), constant.segment(d, n);
  return flow;
}

std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& jacobian) {
  const Eigen::VectorXcd values = dense::eigenvalues(jacobian);
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  ranges::sort(sorted, [](auto a, auto b) {
    return std::norm(a) != std::norm(b) ? std::norm(a) > std::norm(b) : a.imag() > b.imag();
  });
  return sorted;
}

}  // namespace slapstick::flow
