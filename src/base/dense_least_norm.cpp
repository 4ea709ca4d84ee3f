/// Least norm and least squares: the only source that instantiates CompleteOrthogonalDecomposition.
#include "base/dense.hpp"

#include <Eigen/QR>

namespace slapstick::dense {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct LeastNorm::Decomposition : Eigen::CompleteOrthogonalDecomposition<MatrixXd> {
  using Eigen::CompleteOrthogonalDecomposition<MatrixXd>::CompleteOrthogonalDecomposition;
};

LeastNorm::LeastNorm(const MatrixXd& A) : decomposition_(std::make_unique<const Decomposition>(A)) {}
LeastNorm::~LeastNorm() = default;
VectorXd LeastNorm::solve(const VectorXd& b) const { return decomposition_->solve(b); }
MatrixXd LeastNorm::solve(const MatrixXd& B) const { return decomposition_->solve(B); }
MatrixXd LeastNorm::pseudo_inverse() const { return decomposition_->pseudoInverse(); }

}  // namespace slapstick::dense
