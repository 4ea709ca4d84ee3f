#pragma once
/// A second way to move a machine with many contacts: Moreau's time-stepping with a small step.
#include <Eigen/Core>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick::test {

/// Moreau and Jean's scheme with midpoints: stops that are touched at the middle of a step, and all friction contacts,
/// act on its velocities through impulses found by projected Gauss-Seidel. Of first order; it has no events. For rigid
/// stops, f_s = f_k and no belts.
class TimeStepping {
 public:
  explicit TimeStepping(const Model& model);
  /// Positions after `steps` steps of h from a state.
  Eigen::VectorXd positions(const State& start, double h, long steps) const;

 private:
  struct Row {
    Eigen::VectorXd g, M_inverse_g;  ///< displacement row over the coordinates
    double mobility;                 ///< g M^{-1} g^T
    double clearance = 0.0, restitution = 0.0, friction = 0.0;
  };
  Row row(int a, int b) const;
  void contact_impulses(const Eigen::VectorXd& middle, const Eigen::VectorXd& before, double h,
                        Eigen::VectorXd& v) const;

  Model model_;
  Eigen::VectorXd inverse_mass_;
  Eigen::MatrixXd C_, K_;
  std::vector<Row> stops_, frictions_;
};

}  // namespace slapstick::test
