#pragma once
/// Linear algebra in balls: products, and systems of equations by elimination.
#include <optional>

#include "ball.hpp"

namespace verify {

using Matrix = std::vector<Balls>;  ///< by rows

[[nodiscard]] Matrix zero_matrix(std::size_t rows, std::size_t columns);
[[nodiscard]] Matrix product(const Matrix& A, const Matrix& B);
[[nodiscard]] Matrix transposed(const Matrix& A);
/// y += a x.
void add(Balls& y, const Ball& a, const Balls& x);
/// X with A X = B, or nothing where no pivot is certainly different from zero.
[[nodiscard]] std::optional<Matrix> solve(Matrix A, Matrix B);
/// The inverse of a symmetric positive definite matrix, or nothing where it is not certainly so.
[[nodiscard]] std::optional<Matrix> inverse_definite(const Matrix& A);

}  // namespace verify
