#pragma once
/// Linearised flow through events: how small changes of the state are carried along a motion.
///
/// Along a segment a tangent vector obeys delta' = A delta (no forcing, no constants); at an event it passes the saltation matrix
/// (flow/saltation.hpp). Entering stick annihilates the slip direction exactly; a chatter limit annihilates gap and relative velocity. A graze is
/// passed unchanged: the derivative is unbounded there.
///
/// Vectors are in contact coordinates, the first n of p and of u (Frame), 2 n long, at fixed time (phase).
/// Source: system page, section 3; Leine and Nijmeijer (2004), chapter 7.
#include <Eigen/Dense>

#include "slapstick/flow/motion.hpp"

namespace slapstick {

class TangentMotion {
 public:
  /// Carries the columns of `tangents` (2n x k) along with a motion from `state`. Sets up its buffers here.
  TangentMotion(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start = {},
                MotionOptions options = {});

  /// As Motion::advance; the tangents follow. Cost: one propagation per column and segment.
  Outcome advance(Instant end);

  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] Eigen::MatrixXd tangents() const;
  /// Replaces the tangents (to normalise or orthogonalise them).
  void set_tangents(const Eigen::MatrixXd& tangents);

 private:
  void flow(const Motion::Segment& segment);
  void come_to_rest();
  void hold(const std::vector<int>& rows, Eigen::Index offset);
  void hold_still();

  Motion motion_;
  Eigen::MatrixXd tangents_;  ///< of all d displacements and velocities
  std::vector<double> delta_, next_;
  event::Lanes out_;
  long segments_seen_ = 0;
};

}  // namespace slapstick
