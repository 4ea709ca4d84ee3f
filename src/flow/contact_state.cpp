/// Contact states from motions and back, and sorted multipliers.
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

std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& jacobian) {
  const Eigen::VectorXcd values = dense::eigenvalues(jacobian);
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  ranges::sort(sorted, [](auto a, auto b) {
    return std::norm(a) != std::norm(b) ? std::norm(a) > std::norm(b) : a.imag() > b.imag();
  });
  return sorted;
}

}  // namespace slapstick::flow
