/// Linear systems by PartialPivLU and LLT: the only source that instantiates them.
#include "base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace slapstick::dense {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

VectorXd solve(const MatrixXd& A, const VectorXd& b) { return A.partialPivLu().solve(b); }
VectorXcd solve_complex(const MatrixXcd& A, const VectorXcd& b) { return A.partialPivLu().solve(b); }
double determinant(const MatrixXd& A) { return A.partialPivLu().determinant(); }
MatrixXd inverse(const MatrixXd& A) { return A.inverse(); }
/// Eigen's estimate divides by the pivots: of one that is zero it may say anything.
double reciprocal_condition(const MatrixXd& A) {
  const Eigen::PartialPivLU<MatrixXd> lu(A);
  return (lu.matrixLU().diagonal().array() == 0.0).any() ? 0.0 : lu.rcond();
}

VectorXd solve_definite(const MatrixXd& A, const VectorXd& b) { return A.llt().solve(b); }
MatrixXd inverse_definite(const MatrixXd& A) { return A.llt().solve(MatrixXd::Identity(A.rows(), A.cols())); }

}  // namespace slapstick::dense
