#pragma once
/// What stops that are struck together do to the velocities, and to small changes of them.
///
///     u -> u - M^{-1} G^T P,   P = D^+ F G u,   D = G M^{-1} G^T
///
/// G: the rows of the stops. F: 1 + r, for a small change of the speed v 1 + d(r v)/dv, and 1 where all comes to rest.
#include <Eigen/Core>
#include <vector>

#include "mode/frame.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::flow {

struct Collision {
  /// @param X  the extended state before
  Collision(const Model& model, const mode::Frame& frame, const Motion::Strike& strike, const Eigen::VectorXd& X);

  std::vector<int> stops, rows;   ///< and their displacements
  Eigen::VectorXd speed;          ///< v, towards each stop
  Eigen::VectorXd factor, slope;  ///< F of the state, and of its small changes
};

/// P of what is loaded so: one row for each displacement, any columns. If the displacements depend on each other, any
/// solution gives the same velocities; this is the least.
[[nodiscard]] Eigen::MatrixXd impulses(const mode::Frame& frame, const std::vector<int>& rows,
                                       const Eigen::MatrixXd& load);

/// The rates of some displacements are changed by impulses along them; momentum is kept.
/// @param rows    the displacements
/// @param factor  F, one for each
/// @param block   d rows, of velocities, or of displacements that follow them
void push_along(const mode::Frame& frame, const std::vector<int>& rows, const Eigen::VectorXd& factor,
                Eigen::Ref<Eigen::MatrixXd> block);

}  // namespace slapstick::flow
