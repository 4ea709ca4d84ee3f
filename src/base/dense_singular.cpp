/// Singular vectors: the only source that instantiates Eigen/SVD.
#include "base/dense.hpp"

#include <Eigen/SVD>

namespace slapstick::dense {

using Eigen::MatrixXd;

MatrixXd right_singular_vectors(const MatrixXd& A) {
  return Eigen::JacobiSVD<MatrixXd>(A, Eigen::ComputeFullV).matrixV();
}

SingularVectors singular_vectors(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}

}  // namespace slapstick::dense
