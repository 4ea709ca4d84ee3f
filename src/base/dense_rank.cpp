/// Rank and kernel by FullPivLU: the only source that instantiates it.
#include "base/dense.hpp"

#include <Eigen/LU>

namespace slapstick::dense {

using Eigen::Index;
using Eigen::MatrixXd;

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

}  // namespace slapstick::dense
