#pragma once
/// The motions a = phi exp(lambda t) of a linear machine a'' = K a + C a' without forces.
#include <Eigen/Core>
#include <complex>
#include <vector>

namespace slapstick::flow {

/// Powers of two D that make rows and columns of D^-1 Q D alike in size (Osborne), Q made so. Lengths and speeds, and
/// fast and slow parts of a machine, are columns of very different size: an error would be that of the largest.
Eigen::VectorXd balance(Eigen::MatrixXd& Q);

struct LinearMotion {
  std::complex<double> lambda;
  double error = 0.0;  ///< of lambda, from the rounding of K and C; where eigenvalues meet, half of the digits
  Eigen::VectorXcd shape;
};

/// All 2k of them, both of a pair of conjugates. Directions that K does not see have lambda = 0 exactly, twice where C
/// does not see them either.
///
/// Such directions are taken out first. The others come from the balanced eigenvalue problem of first order. Each is
/// then improved by Newton's method on (lambda^2 - lambda C - K) phi = 0, whose rows are scaled: then it is as exact as
/// the numbers of K and C say, however fast other parts of the machine are. Where Newton's method finds nothing near,
/// as where eigenvalues meet, the first guess stays.
/// Cost: 2k eigenvalue problem, and 2k times two linear systems of k + 1 rows.
/// Source: Tisseur, Meerbergen, The quadratic eigenvalue problem, SIAM Review 43 (2001), sections 3 and 5.
[[nodiscard]] std::vector<LinearMotion> linear_motions(const Eigen::MatrixXd& K, const Eigen::MatrixXd& C);

}  // namespace slapstick::flow
