/// Eigenvalues and eigenvectors: the only source that instantiates Eigen/Eigenvalues.
#include "base/dense.hpp"

#include <Eigen/Eigenvalues>

namespace slapstick::dense {

using Eigen::MatrixXd;
using Eigen::VectorXcd;

VectorXcd eigenvalues(const MatrixXd& A) { return A.eigenvalues(); }

Eigenpairs eigenpairs(const MatrixXd& A) {
  const Eigen::EigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace slapstick::dense
