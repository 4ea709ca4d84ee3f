/// Products and elimination in balls.
#include "linear.hpp"

#include <cmath>
#include <utility>

namespace verify {

Matrix zero_matrix(std::size_t rows, std::size_t columns) { return Matrix(rows, Balls(columns)); }

void add(Balls& y, const Ball& a, const Balls& x) {
  for (std::size_t j = 0; j < y.size(); ++j)
    if (!x[j].is_zero()) y[j].add_product(a, x[j]);
}

Matrix product(const Matrix& A, const Matrix& B) {
  Matrix C;
  for (const Balls& row : A) {
    C.emplace_back(B.empty() ? 0 : B.front().size());
    for (std::size_t k = 0; k < row.size(); ++k)
      if (!row[k].is_zero()) add(C.back(), row[k], B[k]);
  }
  return C;
}

Matrix transposed(const Matrix& A) {
  Matrix B = zero_matrix(A.empty() ? 0 : A.front().size(), A.size());
  for (std::size_t i = 0; i < A.size(); ++i)
    for (std::size_t j = 0; j < A[i].size(); ++j) B[j][i] = A[i][j];
  return B;
}

namespace {

bool is_regular(const Ball& pivot) { return pivot > Ball(0.0) || pivot < Ball(0.0); }

/// Gauss and Jordan; `choose(A, k)` is the row whose entry k is the next pivot.
template <class Choose, class Accept>
std::optional<Matrix> eliminate(Matrix A, Matrix B, Choose choose, Accept accept) {
  const std::size_t n = A.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t row = choose(A, k);
    std::swap(A[k], A[row]);
    std::swap(B[k], B[row]);
    if (!accept(A[k][k])) return std::nullopt;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || A[i][k].is_zero()) continue;
      const Ball factor = -(A[i][k] / A[k][k]);
      add(A[i], factor, A[k]);
      add(B[i], factor, B[k]);
    }
  }
  for (std::size_t k = 0; k < n; ++k)
    for (Ball& x : B[k]) x = x / A[k][k];
  return B;
}

}  // namespace

std::optional<Matrix> solve(Matrix A, Matrix B) {
  const auto largest = [](const Matrix& rows, std::size_t k) {
    std::size_t best = k;
    for (std::size_t i = k; i < rows.size(); ++i)
      if (std::abs(rows[i][k].near()) > std::abs(rows[best][k].near())) best = i;
    return best;
  };
  return eliminate(std::move(A), std::move(B), largest, is_regular);
}

/// All pivots of a symmetric matrix are positive if and only if it is positive definite.
std::optional<Matrix> inverse_definite(const Matrix& A) {
  Matrix one = zero_matrix(A.size(), A.size());
  for (std::size_t i = 0; i < A.size(); ++i) one[i][i] = Ball(1.0);
  return eliminate(
      A, std::move(one), [](const Matrix&, std::size_t k) { return k; },
      [](const Ball& pivot) { return pivot > Ball(0.0); });
}

}  // namespace verify
