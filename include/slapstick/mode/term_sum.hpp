#pragma once
/// exp(A s) X for a large mode, from the terms of its series: t_0 = X, t_{n+1} = s / (n + 1) A t_n, n < 24.
///
/// Of A = [0 1; a_p a_u] (displacements p, velocities u) with its forcing only the accelerations a are stored, in blocks of eight rows, each
/// with the columns that are not zero there. A chain of n coordinates costs O(n) so, a full matrix O(n^2).
#include <Eigen/Dense>
#include <vector>

#include "slapstick/event/window.hpp"

namespace slapstick::mode {

class TermSum {
 public:
  TermSum() = default;
  /// @param system A on X = (p, u, cos, sin, .., 1)  @param d number of displacements
  TermSum(const Eigen::MatrixXd& system, int d);

  /// p and u after a time s within a window, into out[0 .. 2 d).
  void state(double s, const double* X, double* out) const;

 private:
  void accelerate(double factor, const event::Lane8* term, event::Lane8* out) const;
  void turn(double factor, const double* phase, double* out) const;

  int d_ = 0, blocks_ = 0, phases_ = 0;
  std::vector<double> drift_, frequencies_;
  std::vector<int> begins_ = {0};  ///< where the columns of each block of rows begin
  std::vector<int> columns_;       ///< places in a term: (p, u), each filled up to whole lanes, then the forcing
  event::Lanes values_;
};

}  // namespace slapstick::mode
