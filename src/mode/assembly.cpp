/// Assembles the matrices of a model in its own coordinates.
#include "mode/assembly.hpp"

#include <vector>

#include "base/dense.hpp"

namespace slapstick::mode {
namespace {

/// Adds coefficient * row^T row to a matrix: the stiffness or damping of one element.
template <class Link>
void add_element(Matrix& matrix, const Link& link, double coefficient) {
  const RowVector row = pair_row(static_cast<int>(matrix.rows()), link);
  matrix += coefficient * row.transpose() * row;
}

Matrix symmetric(const SymmetricMatrix& entries, int n) {
  if (entries.empty()) return Matrix::Zero(n, n);
  return Eigen::Map<const Matrix>(entries.data(), n, n);
}

}  // namespace

Matrix mass_matrix(const Model& model) {
  Matrix M = symmetric(model.mass, model.size());
  for (int i = 0; i < model.size(); ++i) M(i, i) += model.coordinates[i].mass;
  return M;
}

Matrix damping_matrix(const Model& model) {
  Matrix C = symmetric(model.damping, model.size());
  for (const Damper& damper : model.dampers) add_element(C, damper, damper.coefficient);
  return C;
}

Matrix stiffness_matrix(const Model& model) {
  Matrix K = symmetric(model.stiffness, model.size());
  for (const Spring& spring : model.springs) add_element(K, spring, spring.stiffness);
  return K;
}

Matrix inverse_mass(const Model& model) {
  const Matrix M = mass_matrix(model);
  std::vector<int> massive;
  for (int i = 0; i < model.size(); ++i)
    if (!model.is_inner(i)) massive.push_back(i);
  Matrix inverse = Matrix::Zero(M.rows(), M.cols());
  if (M.isDiagonal(0.0))
    for (const int i : massive) inverse(i, i) = 1.0 / M(i, i);
  else
    inverse(massive, massive) = dense::inverse_definite(M(massive, massive));
  return inverse;
}

}  // namespace slapstick::mode
