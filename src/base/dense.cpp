/// The only source that instantiates Eigen's decompositions.
#include "base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace slapstick::dense {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

VectorXcd eigenvalues(const MatrixXd& A) { return A.eigenvalues(); }

Eigenpairs eigenpairs(const MatrixXd& A) {
  const Eigen::EigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd solve(const MatrixXd& A, const VectorXd& b) { return A.partialPivLu().solve(b); }
VectorXcd solve_complex(const MatrixXcd& A, const VectorXcd& b) { return A.partialPivLu().solve(b); }
double determinant(const MatrixXd& A) { return A.partialPivLu().determinant(); }
MatrixXd inverse(const MatrixXd& A) { return A.inverse(); }
double reciprocal_condition(const MatrixXd& A) { return A.partialPivLu().rcond(); }

VectorXd solve_definite(const MatrixXd& A, const VectorXd& b) { return A.llt().solve(b); }
MatrixXd inverse_definite(const MatrixXd& A) { return A.llt().solve(MatrixXd::Identity(A.rows(), A.cols())); }

Index rank(const MatrixXd& A) { return Eigen::FullPivLU<MatrixXd>(A).rank(); }

std::optional<MatrixXd> inverse_if_regular(const MatrixXd& A) {
  const Eigen::FullPivLU<MatrixXd> lu(A);
  if (!lu.isInvertible()) return std::nullopt;
  return lu.inverse();
}

Kernel kernel(const MatrixXd& A, double threshold) {
  Eigen::FullPivLU<MatrixXd> lu;
  lu.setThreshold(threshold);
  lu.compute(A);
  Kernel found{MatrixXd(A.cols(), 0), {}};
  const auto& order = lu.permutationQ().indices();
  for (Index i = lu.rank(); i < A.cols(); ++i) found.free.push_back(order[i]);
  if (!found.free.empty()) found.basis = lu.kernel();  // the identity in its last pivots' rows
  return found;
}

struct LeastNorm::Decomposition : Eigen::CompleteOrthogonalDecomposition<MatrixXd> {
  using Eigen::CompleteOrthogonalDecomposition<MatrixXd>::CompleteOrthogonalDecomposition;
};

LeastNorm::LeastNorm(const MatrixXd& A) : decomposition_(std::make_unique<const Decomposition>(A)) {}
LeastNorm::~LeastNorm() = default;
VectorXd LeastNorm::solve(const VectorXd& b) const { return decomposition_->solve(b); }
MatrixXd LeastNorm::solve(const MatrixXd& B) const { return decomposition_->solve(B); }
MatrixXd LeastNorm::pseudo_inverse() const { return decomposition_->pseudoInverse(); }

MatrixXd right_singular_vectors(const MatrixXd& A) {
  return Eigen::JacobiSVD<MatrixXd>(A, Eigen::ComputeFullV).matrixV();
}

SingularVectors singular_vectors(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}

}  // namespace slapstick::dense
