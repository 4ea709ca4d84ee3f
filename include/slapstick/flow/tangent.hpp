#pragma once
/// Linearised flow through events: how small changes of the state are carried along a motion.
///
/// Along a segment a tangent vector obeys delta' = A delta (no forcing, no constants); at an event it passes the
/// saltation matrix: one guard h, reset R, flows f- and f+ give
///     dt = -(h . delta-) / (dh/dt-),     delta+ = R (delta- + f- dt) - f+ dt.
/// Entering stick annihilates the slip direction exactly; a chatter limit annihilates gap and relative velocity. A
/// graze is passed unchanged: the derivative is unbounded there.
///
/// Shapes: vectors are in *contact coordinates*, the first n of p and of u, 2 n long, at fixed time (phase). p = W
/// q - shift, u = p' - drift: the displacements of the stops and friction contacts, completed by original coordinates
/// (docs/developers/architecture.md, section 2). Threads: as Motion. Errors: as Motion.
/// Source: docs/reference/notation.md; Leine and Nijmeijer (2004), chapter 7.
#include <Eigen/Core>
#include <memory>

#include "slapstick/flow/motion.hpp"

namespace slapstick {

/// A copy goes on by itself. What was moved from may only be assigned to or destroyed.
class TangentMotion {
 public:
  /// Carries the columns of `tangents` (2n x k) along with a motion from `state`. Sets up its buffers here.
  /// @throws InputError as Motion
  TangentMotion(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start = {},
                MotionOptions options = {});
  TangentMotion(const TangentMotion& other);
  TangentMotion(TangentMotion&& other) noexcept;
  TangentMotion& operator=(const TangentMotion& other);
  TangentMotion& operator=(TangentMotion&& other) noexcept;
  ~TangentMotion();

  /// As Motion::advance; the tangents follow. Cost: one propagation per column and segment.
  Outcome advance(Instant end);

  [[nodiscard]] const Motion& motion() const;
  [[nodiscard]] Eigen::MatrixXd tangents() const;
  /// Replaces the tangents (to normalise or orthogonalise them), 2n x k with any k.
  void set_tangents(const Eigen::MatrixXd& tangents);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slapstick
