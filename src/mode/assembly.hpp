#pragma once
/// The matrices of M q'' + C q' + K q in a model's own coordinates. They are linear in the model's numbers: those of a derivative of a
/// model are the derivatives of its matrices.
#include "mode/frame.hpp"

namespace slapstick::mode {

/// Row over q of x_a - x_b.
[[nodiscard]] RowVector pair_row(int n, int a, int b);

[[nodiscard]] Matrix mass_matrix(const Model& model);
[[nodiscard]] Matrix damping_matrix(const Model& model);
[[nodiscard]] Matrix stiffness_matrix(const Model& model);

/// M^{-1}; of a diagonal M every entry has one rounding.
[[nodiscard]] Matrix inverse_mass(const Model& model);

}  // namespace slapstick::mode
