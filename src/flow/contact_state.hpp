#pragma once
/// States of motions in contact coordinates (mode/frame.hpp), as vectors, how they move in a mode, and the eigenvalues
/// of maps of them.
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "mode/frame.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::flow {

/// The first n of p and the first n of u of a motion's extended state.
[[nodiscard]] Eigen::VectorXd contact_state(const Motion& motion);
/// .. and of any extended state.
[[nodiscard]] Eigen::VectorXd contact_state(const mode::Frame& frame, const Eigen::VectorXd& X);
/// The user's state of a contact state.
[[nodiscard]] State user_state(const System& system, const Eigen::VectorXd& contact);

/// X = by x + constant of a contact state x, for the first 2 d numbers of X.
struct Extension {
  Eigen::MatrixXd by;
  Eigen::VectorXd constant;
};

/// What depends on the first n follows them: p = dependence (p + shift) - shift, u likewise with the drift.
[[nodiscard]] Extension extension_of(const mode::Frame& frame);

/// x' = by x + constant of a contact state x where X' = A X. The drives come on top.
struct ContactFlow {
  Eigen::MatrixXd by;
  Eigen::VectorXd constant;
};
[[nodiscard]] ContactFlow contact_flow(const mode::Frame& frame, const mode::Matrix& A, const Extension& all);

/// Eigenvalues of a Jacobian of contact states, largest modulus first.
[[nodiscard]] std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& jacobian);

}  // namespace slapstick::flow
