#pragma once
/// Decompositions of dense matrices. Eigen's templates for them take a compiler ten seconds or more: they are compiled
/// here once.
///
/// Every function does what the Eigen call beside its name does, in the same operations.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace slapstick::dense {

/// A.eigenvalues(), and EigenSolver with its vectors as columns.
[[nodiscard]] Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);
struct Eigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
[[nodiscard]] Eigenpairs eigenpairs(const Eigen::MatrixXd& A);

/// x of A x = b and det A by PartialPivLU, for a regular square A.
[[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
[[nodiscard]] Eigen::VectorXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);
[[nodiscard]] double determinant(const Eigen::MatrixXd& A);
[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);

/// The same for a symmetric positive definite A, by LLT.
[[nodiscard]] Eigen::VectorXd solve_definite(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
[[nodiscard]] Eigen::MatrixXd inverse_definite(const Eigen::MatrixXd& A);

/// By FullPivLU: the rank, and the inverse if A has full rank.
[[nodiscard]] Eigen::Index rank(const Eigen::MatrixXd& A);
[[nodiscard]] std::optional<Eigen::MatrixXd> inverse_if_regular(const Eigen::MatrixXd& A);
/// By FullPivLU with pivots below `threshold` of the largest taken for zero: a basis of the kernel of A, the identity
/// in the rows `free`.
struct Kernel {
  Eigen::MatrixXd basis;
  std::vector<Eigen::Index> free;
};
[[nodiscard]] Kernel kernel(const Eigen::MatrixXd& A, double threshold);

/// The solutions of least norm of A X = B in the sense of least squares, by CompleteOrthogonalDecomposition.
class LeastNorm {
 public:
  explicit LeastNorm(const Eigen::MatrixXd& A);
  ~LeastNorm();
  LeastNorm(const LeastNorm&) = delete;
  LeastNorm& operator=(const LeastNorm&) = delete;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  [[nodiscard]] Eigen::MatrixXd pseudo_inverse() const;

 private:
  struct Decomposition;
  std::unique_ptr<const Decomposition> decomposition_;
};

/// An estimate of 1 / (|A| |A^-1|) in the norm of columns, by PartialPivLU: not above rounding for a singular A, and 0
/// for a pivot that is 0.
[[nodiscard]] double reciprocal_condition(const Eigen::MatrixXd& A);

/// JacobiSVD with full V, or with full U and V; singular values descending.
[[nodiscard]] Eigen::MatrixXd right_singular_vectors(const Eigen::MatrixXd& A);
struct SingularVectors {
  Eigen::MatrixXd left, right;
  Eigen::VectorXd values;
};
[[nodiscard]] SingularVectors singular_vectors(const Eigen::MatrixXd& A);

}  // namespace slapstick::dense
