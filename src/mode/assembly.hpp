#pragma once
/// The matrices of M q'' + C q' + K q in a model's own coordinates. All are linear in the model's numbers: the matrices
/// of a derivative of a model are the derivatives of its matrices.
#include "mode/frame.hpp"

namespace slapstick::mode {

/// Row over q of y = r_a x_a - r_b x_b, of a link between a and b; of a spring with an inner coordinate y - s.
template <class Link>
[[nodiscard]] RowVector pair_row(int n, const Link& link) {
  RowVector row = RowVector::Zero(n);
  if (link.a != ground) row[link.a] += link.ratio.a;
  if (link.b != ground) row[link.b] -= link.ratio.b;
  if constexpr (requires { link.inner; })
    if (link.inner >= 0) row[link.inner] -= 1.0;
  return row;
}

/// The same of y itself.
template <class Link>
[[nodiscard]] RowVector outer_row(int n, Link link) {
  link.inner = -1;
  return pair_row(n, link);
}

[[nodiscard]] Matrix mass_matrix(const Model& model);
[[nodiscard]] Matrix damping_matrix(const Model& model);
[[nodiscard]] Matrix stiffness_matrix(const Model& model);

/// M^{-1}; of a diagonal M every entry has one rounding. Zero in the rows and columns of inner coordinates: no force
/// moves them.
[[nodiscard]] Matrix inverse_mass(const Model& model);

}  // namespace slapstick::mode
