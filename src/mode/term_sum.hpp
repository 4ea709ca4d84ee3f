#pragma once
/// exp(A s) X for a large mode, from the terms of its series: t_0 = X, t_{n+1} = s / (n + 1) A t_n, n < 24.
///
/// Of A = [0 1; a_p a_u] (displacements p, velocities u) with its forcing only the accelerations a are stored. The
/// displacements are put in an order in which those that act on each other are near (Cuthill and McKee 1969). In this
/// order a is kept by diagonals in blocks of eight rows, each with the diagonals that are not zero there. A chain costs
/// three vector operations per eight coordinates and term so, a full matrix O(n^2).
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "event/kernels.hpp"

namespace slapstick::mode {

class TermSum {
 public:
  TermSum() = default;
  /// @param system A on X = (p, u, cos, sin, .., 1)  @param d number of displacements
  TermSum(const Eigen::MatrixXd& system, int d);

  /// p and u after a time s within a window, into out[0 .. 2 d). Does not allocate up to 80 displacements.
  void state(double s, const double* X, double* out) const;

 private:
  void store_block(const Eigen::MatrixXd& system, int block);
  void accelerate(double factor, const double* term, event::Lane8* out) const;
  void turn(double factor, const double* phase, double* out) const;

  [[nodiscard]] int p() const { return 8; }  ///< places in a term: p and u, eight zeros around each, then the forcing
  [[nodiscard]] int u() const { return 8 * blocks_ + 16; }
  [[nodiscard]] int phase() const { return 16 * blocks_ + 24; }

  const event::Kernels* kernels_ = &event::kernels();
  int d_ = 0, blocks_ = 0, phases_ = 0;
  std::vector<int> order_;  ///< the displacement at each place
  std::vector<double> drift_;
  std::vector<std::pair<double, double>> turns_;  ///< of the pairs of the forcing: entries of A beside the diagonal
  std::vector<int> diagonals_end_, columns_end_;  ///< of each block of rows; the next one's diagonals follow
  event::PlacedRows diagonals_;                   ///< times the eight numbers of a term from `place` on
  event::PlacedRows columns_;                     ///< times the number of the forcing at `place`
};

}  // namespace slapstick::mode
