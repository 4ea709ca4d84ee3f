#pragma once
/// Contact coordinates: the coordinates in which the flow works.
///
///     p = W q - shift,   u = p' - drift
///
/// The rows of W are the relative displacements x_a - x_b of the stops, compliant stops and friction contacts,
/// completed by original coordinates, the last ones first. `shift` is the clearance on a stop's own row (so that the
/// gap is -p) and `drift` the belt speed on a friction contact's own row, else 0. A gap and a relative velocity are
/// then each one stored number, with a relative error of its own: exactly zero at contact, constant in stick. Contacts
/// whose numbers are equal or opposite share one.
///
/// W has d >= n rows: a contact whose row depends on others (the far side of a two-sided stop, a loop of contacts) has
/// a number of its own all the same. The first n rows are independent; the others follow from them, up to rounding (see
/// `refresh`). Which contacts are among the first n says mode/numbering.hpp: the nearest of each pair, and none that is
/// far.
///
/// Extended state X in R^m, m = 2 d + 2 h + 1, h = number of distinct harmonics of the forcing, tones and signals:
///     X = (p_1..p_d, u_1..u_d, cos j_1 theta, sin j_1 theta, .., 1),   theta = omega t.
/// Tones and signals (mode/drive.hpp) follow behind the harmonics.
/// In every mode X' = A X.
#include <Eigen/Core>
#include <vector>

#include "mode/drive.hpp"
#include "slapstick/mode/contact_states.hpp"
#include "slapstick/model/model.hpp"

namespace slapstick::mode {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using RowVector = Eigen::RowVectorXd;

/// A stop or friction contact seen in contact coordinates: its displacement is sign * p_own (a stop's: less the
/// clearance), its velocity sign * u_own (a friction contact's: less the belt speed).
struct ContactRow {
  int own = 0;
  double sign = 1.0;
};

/// A pair of bodies without a number of its own in contact coordinates: rows over X, and u' per unit force on a against
/// one on b.
/// The row of a corner is that of what the characteristic is a polyline over, less the corner's place. Where a contact
/// of the pair has its place there, the row is that contact's number, which is exactly zero in contact or at rest.
struct PairRows {
  RowVector displacement, velocity;
  Vector push;
  std::vector<RowVector> corners;
};

/// An inner coordinate s (Coordinate): c s' = -(K q)_s, so that s' is a row over the displacements. Its number is s
/// itself, and stays among the first n.
///
/// Of X' = A X it has s'' = (row . X)' - settling (s' - row . X): a rate that the row does not give, as by rounding,
/// dies out. `settling` is twice k / c, the rate at which s itself settles: of one that is alone k / c is an eigenvalue
/// of A, and a second one beside it would have no eigenvector of its own.
struct InnerRow {
  int coordinate = 0, own = 0;
  RowVector rate;
  double settling = 0.0;
};

/// The slider of a Jenkins element: a characteristic over z = y - s. y' is the rate of a number, as the velocity of a
/// friction contact is. Where the slider rests p_s' = 0, where it slips p_s' = y': p_s needs no u_s, which is for
/// tables.
struct SliderRow {
  int characteristic = 0, own = 0;
  ContactRow pair;               ///< with no drift
  RowVector displacement;        ///< y over X
  double low = 0.0, high = 0.0;  ///< the corners, of z

  [[nodiscard]] bool rests(const std::vector<int>& pieces) const {
    return pieces[static_cast<std::size_t>(characteristic)] == 1;
  }
};

/// One piece of a characteristic: force = slope value + offset; in a zone slope times the velocity.
struct Piece {
  double slope = 0.0, offset = 0.0;
};
[[nodiscard]] Piece piece_of(const Characteristic& characteristic, int piece);
/// Its derivative, `rate` the derivative of the characteristic's numbers.
[[nodiscard]] Piece piece_rate(const Characteristic& characteristic, const Characteristic& rate, int piece);

struct Frame {
  explicit Frame(const Model& model);

  int n = 0;                   ///< coordinates of the model
  int d = 0;                   ///< displacements stored, the first n independent
  std::vector<int> harmonics;  ///< distinct harmonics j > 0, ascending
  std::vector<Tone> tones;     ///< distinct frequencies that are no harmonics
  std::vector<SignalTable> signals;
  double period = 1.0;  ///< of the clock
  Matrix W;             ///< d x n
  Matrix W_inverse;     ///< of its first n rows
  Matrix dependence;    ///< d x n: W = dependence * (first n rows of W)
  Vector shift, drift;
  /// dependence * shift - shift, the constant between a dependent displacement and those it follows from, and the same
  /// of the drifts. Zero where that is rounding: clearances that add up, as 0.1 + 0.2 and 0.3, let all gaps of a loop
  /// close at once.
  Vector shift_slack, drift_slack;
  std::vector<ContactRow> stops, frictions, compliant;
  std::vector<PairRows> characteristics;
  std::vector<InnerRow> inner;
  std::vector<SliderRow> sliders;
  Matrix mass_inverse;  ///< d x d: W M^{-1} W^T
  Matrix free;          ///< d x m: u' = free . X with no contact force
  Matrix free_size;     ///< the sums of the sizes of the terms that each of its entries was made of

  /// A sum below this part of the sizes of its terms is zero by structure, as of two forces that cancel: 64 roundings,
  /// one for each of its products. With less, rounding lets contacts at rest go; with more, small real numbers are
  /// lost.
  static constexpr double structural_zero = 0x1p-47;
  /// Sets entries to exactly zero that are nothing but rounding of terms of the given sizes: a force that the structure
  /// of the model makes zero shall not be taken for one that is certainly negative.
  static void drop_rounding(Matrix& matrix, const Matrix& size);

  [[nodiscard]] int size() const { return signal(signals.size()) + 1; }
  /// Columns of the first number of a tone and of a signal.
  [[nodiscard]] int tone(std::size_t k) const { return 2 * d + 2 * static_cast<int>(harmonics.size() + k); }
  [[nodiscard]] int signal(std::size_t k) const { return tone(tones.size() + k); }
  [[nodiscard]] int u(int i) const { return d + i; }
  [[nodiscard]] int one() const { return size() - 1; }

  /// +1 or -1 if the displacements i and j are those of one pair, else 0.
  [[nodiscard]] int parallel(int i, int j) const;
  /// Are the displacements i and j of one pair, and is no belt between their velocities? Then one is the other's, or
  /// opposite. A stop and a friction contact on a belt are of one pair and not in step: the belt's w is no rate of the
  /// gap.
  [[nodiscard]] bool in_step(int i, int j) const {
    return parallel(i, j) != 0 && drift[i] == parallel(i, j) * drift[j];
  }
  /// Row over X of a contact's velocity, and of a stop's gap.
  [[nodiscard]] RowVector velocity_row(const ContactRow& contact) const;
  [[nodiscard]] RowVector gap_row(const ContactRow& contact) const;
  /// Row over X of the force of a compliant stop, stiffness delta + damping delta'.
  [[nodiscard]] RowVector push_row(const Model& model, int i) const;
  /// What the slope of a piece multiplies.
  [[nodiscard]] const RowVector& slope_row(const Model& model, int i) const {
    const bool displaced = model.characteristics[i].over == Characteristic::Over::displacement;
    return displaced ? characteristics[i].displacement : characteristics[i].velocity;
  }
  /// Row over X of the force of a characteristic in a piece.
  [[nodiscard]] RowVector force_row(const Model& model, int i, int piece) const;
  /// Row over X of a force.
  [[nodiscard]] RowVector drive_row(const Force& force) const;
  /// The rows p' = u + drift, the forcing oscillators and the signals of A; the rows u' are left zero.
  [[nodiscard]] Matrix kinematics(double omega) const;

  /// Writes p and u of a user's state (x_1, v_1, x_2, v_2, ..) into X. A gap below `reading_error` is zero. The rates
  /// of inner coordinates are not read, but follow from the displacements.
  void enter(const double* state, double* X) const;
  /// Sets the rates of the inner coordinates by the displacements.
  void set_inner_rates(double* X) const;
  /// The slider that a characteristic is over, or null.
  [[nodiscard]] const SliderRow* slider(int characteristic) const;
  /// The slider whose limit a guard is, or null.
  [[nodiscard]] const SliderRow* slider(GuardKind kind, int contact) const {
    return of_corner(kind) ? slider(contact) : nullptr;
  }
  /// Is u_i no number of its own, but follows from others?
  [[nodiscard]] bool rate_follows(int i) const;
  /// Sets the rates of sliders in a mode of these pieces.
  void set_slider_rates(const std::vector<int>& pieces, double* X) const;
  /// Sets the sliders that slip in a mode of these pieces to their corner, from which rounding would lead them away.
  void set_sliders(const std::vector<int>& pieces, double* X) const;
  /// A slider that is drawn beyond a corner has slipped to it, at once.
  void draw_sliders(double* X) const;
  /// Sets the velocities (displacements) of all numbers of the pair of displacement i by that of i.
  void match_velocities(int i, double* X) const;
  void match_displacements(int i, double* X) const;
  /// Makes the dependent numbers and the first n agree again, where rounding would let them drift apart in the long
  /// run. A dependent number that is exactly zero (contact, rest) stays, and the largest of those it follows from gives
  /// way; one that is summed without cancellation is set; one near zero keeps its own value, which is the more
  /// accurate.
  void refresh(double* X) const;
  /// Writes all of X that moves by the clock, harmonics, tones and signals, and the constant 1. Fixed operations
  /// (base/phase.hpp). At a knot the slope is that behind the knot.
  void set_clock(Instant t, double* X) const { set_clock(t, X, true); }
  /// The same of a piece of the motion that may end at t: the slopes are those that X has, at a knot those before it,
  /// and the value at a step is that before the step.
  void set_clock_within(Instant t, double* X) const { set_clock(t, X, false); }
  /// What the pulse of a signal of this area does to the velocities: M dv = (the forces that follow it) area.
  void kick(std::size_t of_signal, double area, double* X) const;
  /// Bounds, by columns from 2 d on, of what is known no better than the clock: 1 of a phase, of a signal's value the
  /// slope that X has.
  void set_clock_sizes(const double* X, double* sizes) const;
  /// The lines of the signals that hold from t on. @pre all signals are in periods
  [[nodiscard]] std::vector<int> lines_at(Instant t) const;
  /// The first instant after t at which the slope of a signal jumps, or SignalTable::never.
  [[nodiscard]] Instant next_knot(Instant t) const;
  /// Writes the user's state (x_1, v_1, ..) of X; from the first n displacements and velocities. A velocity that is the
  /// rounding of a sum is zero: a body at rest whose number is not among the first n is read back at rest.
  void leave(const double* X, double* state) const { leave(X, X + d, state); }
  void leave(const double* p, const double* velocity, double* state) const;

 private:
  friend class PeriodicDrive;
  void set_phase(double turns, double* X) const;
  void set_clock(Instant t, double* X, bool behind) const;
  void choose_displacements(const Model& model);
  void set_dynamics(const Model& model);
  void set_characteristics(const Model& model);
  void add_sliders(const Model& model);
  void choose_inner(const Model& model, const Matrix& K, const Matrix& C);
  void add_inner_accelerations(Matrix& acceleration, Matrix& size) const;
  [[nodiscard]] RowVector corner_row(const RowVector& pair, const RowVector& value, bool rated, double at) const;
};

/// What drives a model whose drives all repeat with the forcing. Its part of X follows from the phase and the lines of
/// the signals, so that an orbit needs no clock; of tones and other signals it would leave what was there before.
class PeriodicDrive {
 public:
  /// Refers to both. @throws InputError if there are tones, or signals that are not in periods
  PeriodicDrive(const Model& model, const Frame& frame);
  /// Writes cos, sin of the harmonics at a phase (periods), the signals and the constant 1 into X.
  void set(double turns, const std::vector<int>& lines, double* X) const;
  /// The derivative of X by the phase, and by a parameter at a fixed phase.
  [[nodiscard]] Vector by_turns(const Vector& X) const;
  [[nodiscard]] Vector by_parameter(const Model& rate, double turns, const std::vector<int>& lines) const;

 private:
  const Model& model_;
  const Frame& frame_;
};

}  // namespace slapstick::mode
