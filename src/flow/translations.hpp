#pragma once
/// The rigid translations that a model does not notice, and the states modulo them.
///
/// A direction t of the coordinates is a translation if q -> q + s t leaves the equations of motion as they are: no
/// spring, no row of the stiffness matrix and no stop or compliant stop sees it. Dampers and friction contacts see
/// velocities only. A drill that advances or a shaft that rotates is periodic in the quotient of the states by these
/// directions.
///
/// Contact states (p, u) of the quotient are represented by the one whose `k` free displacements are zero, one for each
/// translation. Springs and stops without ratios give rows of 0 and +-1, whose rank is exact; others, and those of a
/// stiffness matrix, scaled to a largest entry of 1, count as dependent below 1e-12.
///
/// The rates of inner coordinates (mode::InnerRow) follow from the displacements, and are no numbers of a class either:
/// i of them leave 2n - k - i.
#include <Eigen/Core>
#include <vector>

#include "mode/frame.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick::flow {

/// How many a model has. Cost: a microsecond or two.
[[nodiscard]] int translation_count(const Model& model, const mode::Frame& frame);

class Translations {
 public:
  explicit Translations(const System& system);

  [[nodiscard]] const System& system() const { return system_; }
  [[nodiscard]] int count() const { return static_cast<int>(free_.size()); }
  /// How many numbers a class has, and how many of them are velocities: the last ones.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(kept_.size()); }
  [[nodiscard]] Eigen::Index velocities() const;

  /// Makes x, a contact state or a tangent, the representative of its class. @returns how far it was along each
  /// translation
  Eigen::VectorXd take_out(Eigen::VectorXd& x) const;
  /// Does the same to a motion, by a new start at its instant, so that no displacement grows without bounds. Without
  /// translations nothing is touched.
  Eigen::VectorXd take_out(Motion& motion) const;
  Eigen::VectorXd take_out(TangentMotion& motion) const;

  /// The user's state moved by so much along each translation, and the move by coordinate.
  [[nodiscard]] State moved(State state, const Eigen::VectorXd& amounts) const;
  [[nodiscard]] std::vector<double> by_coordinate(const Eigen::VectorXd& amounts) const;

  /// Jacobian of the map of the classes, `size` square, from that of a map of contact states: without the multiplier of
  /// each translation, which is 1.
  [[nodiscard]] Eigen::MatrixXd quotient(const Eigen::MatrixXd& jacobian) const;
  /// The numbers of a representative that are not zero by definition, and the representative from them; of changes,
  /// too. The rates of inner coordinates are those of a change.
  [[nodiscard]] Eigen::VectorXd numbers(const Eigen::VectorXd& x) const { return x(kept_); }
  [[nodiscard]] Eigen::VectorXd representative(const Eigen::VectorXd& numbers) const;
  /// The first number of a contact state that is not a free displacement.
  [[nodiscard]] Eigen::Index observed() const { return kept_.front(); }

 private:
  System system_;
  Eigen::MatrixXd directions_;      ///< n x k over p: the identity in the rows free_
  std::vector<Eigen::Index> free_;  ///< the displacements that are zero in a representative
  std::vector<Eigen::Index> kept_;  ///< all other numbers of (p, u)
};

}  // namespace slapstick::flow
