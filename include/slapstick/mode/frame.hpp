#pragma once
/// Contact coordinates: the coordinates in which the flow works.
///
///     p = W q - shift,   u = p' - drift
///
/// The rows of W are the relative displacements x_a - x_b of the stops, then of the friction contacts (each only if independent
/// of the rows before), completed by original coordinates, the last ones first. `shift` is the clearance on a stop's own row
/// (so that the gap is -p) and `drift` the belt speed on a friction contact's own row, else 0. A gap and a relative velocity
/// are then each one stored number, with a relative error of its own: exactly zero at contact, constant in stick.
///
/// Extended state X in R^m, m = 2 n + 2 h + 1, h = number of distinct harmonics of the forcing:
///     X = (p_1..p_n, u_1..u_n, cos j_1 theta, sin j_1 theta, .., 1),   theta = omega t.
/// In every mode X' = A X.
#include <Eigen/Dense>
#include <vector>

#include "slapstick/model/model.hpp"

namespace slapstick::mode {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using RowVector = Eigen::RowVectorXd;

/// A stop or friction contact seen in contact coordinates.
struct ContactRow {
  RowVector row;  ///< x_a - x_b = row . (p + shift)
  int own =
      -1;  ///< index of the coordinate p_own that is exactly this displacement, or -1 if it depends on earlier rows
};

struct Frame {
  explicit Frame(const Model& model);

  int n = 0;                   ///< coordinates
  std::vector<int> harmonics;  ///< distinct harmonics j > 0, ascending
  Matrix W, W_inverse;
  Vector shift, drift;
  std::vector<ContactRow> stops, frictions;
  Matrix mass_inverse;  ///< M^{-1} in contact coordinates
  Matrix free;          ///< n x m: u' = free . X with no contact force

  [[nodiscard]] int size() const { return 2 * n + 2 * static_cast<int>(harmonics.size()) + 1; }
  [[nodiscard]] int u(int i) const { return n + i; }
  [[nodiscard]] int one() const { return size() - 1; }

  /// Row over X of the displacement rate row . p' minus `speed`: the velocity of a pair relative to a belt.
  [[nodiscard]] RowVector velocity_row(const ContactRow& contact, double speed) const;
  /// Row over X of the gap clearance - (x_a - x_b).
  [[nodiscard]] RowVector gap_row(const ContactRow& contact, double clearance) const;
  /// The rows p' = u + drift and the forcing oscillators of A; the rows u' are left zero.
  [[nodiscard]] Matrix kinematics(double omega) const;

  /// Writes p and u of a user's state (x_1, v_1, x_2, v_2, ..) into X. A gap of at most four roundings of its coordinates is zero.
  void enter(const double* state, double* X) const;
  /// Writes cos, sin of the harmonics at phase `fraction` (periods) and the constant 1 into X. One libm call per harmonic.
  void set_phase(double fraction, double* X) const;
  /// Writes the user's state (x_1, v_1, ..) of X.
  void leave(const double* X, double* state) const;
};

}  // namespace slapstick::mode
