#pragma once
/// Equations of motion of a Model in one mode, as Taylor series in 50 digits.
///
///     M x'' = -C x' - K x + F(t) - r_f^T s f_k        (slip, s = +-1)
///     M x'' = -C x' - K x + F(t) + R^T lambda         (stick and/or closed stop), R x'' = 0
///
/// r_f and r_s are the rows of the friction contact and the stop: r x = x_a - x_b. R holds the rows of those that are
/// stuck or closed.
#include "oracle/real.hpp"
#include "slapstick/model/model.hpp"

namespace slapstick::oracle {

/// Contact states. Without a friction contact `friction` is +1 and means nothing.
struct Mode {
  int friction = 1;     ///< -1 slip with w < 0, 0 stick, +1 slip with w > 0
  bool closed = false;  ///< the stop is closed
  bool operator==(const Mode&) const = default;
};

/// Taylor coefficients in s = (t - t0) / step: x_i(t) = sum_k x[i][k] s^k.
struct Jet {
  Real step;
  std::vector<Vector> x, v;
  Vector holding;    ///< f0: minus the contact force on a; filled in stick
  Vector press;      ///< push of the closed stop on a, towards -x; with the friction force if the stop is merged
  Real force_scale;  ///< sum of the sizes of all terms that make up the forces
};

class Mechanics {
 public:
  /// @throws std::invalid_argument for more than one stop or friction contact.
  explicit Mechanics(const Model& model);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] bool has_friction() const { return !model_.frictions.empty(); }
  [[nodiscard]] bool has_stop() const { return !model_.stops.empty(); }
  [[nodiscard]] const FrictionContact& friction() const { return model_.frictions.front(); }
  [[nodiscard]] const Stop& stop() const { return model_.stops.front(); }

  /// Stop and friction act on the same pair and at zero belt speed: r_f = merged_sign() r_s. Else merged_sign() is 0.
  [[nodiscard]] int merged_sign() const { return merged_sign_; }
  /// Stop and friction share no mass: r_f M^-1 r_s^T = 0.
  [[nodiscard]] bool uncoupled() const { return coupling_ == 0; }
  /// 2 pi / omega; 1 without harmonic forcing.
  [[nodiscard]] const Real& period() const { return period_; }
  /// The longest step: 0.9 / (a bound of all rates of the model).
  [[nodiscard]] const Real& longest_step() const { return longest_step_; }
  /// The order whose remainder is below 1e-54 of the motion for this step.
  [[nodiscard]] int order(const Real& step) const;

  [[nodiscard]] Jet expand(const Mode& mode, const Vector& x, const Vector& v, const Real& t, const Real& step,
                           int order) const;

  /// Coefficients of x_a - x_b for the stop or friction contact, from jet.x or jet.v, and the size of the terms they
  /// come from.
  struct Difference {
    Vector coefficients;
    Real scale;
  };
  [[nodiscard]] Difference gap_series(const Jet& jet) const;   ///< -(x_a - x_b): the gap less its start, [0] = 0
  [[nodiscard]] Difference slip_series(const Jet& jet) const;  ///< w

  [[nodiscard]] Real gap(const Vector& x) const;               ///< clearance - (x_a - x_b)
  [[nodiscard]] Real closing_velocity(const Vector& v) const;  ///< u = v_a - v_b of the stop, positive towards it
  [[nodiscard]] Real slip_velocity(const Vector& v) const;     ///< w = v_a - v_b - belt_speed of the friction contact

  /// Newton's impact: v += M^-1 r_s^T J with u+ = -r u-.
  void impact(Vector& v) const;
  /// v += M^-1 R^T J so that stuck and closed contacts have no relative velocity.
  void project(const Mode& mode, Vector& v) const;

 private:
  struct Row {
    int a = ground, b = ground;
  };

  [[nodiscard]] Real difference(const Row& row, const Vector& q) const;
  void push(const Row& row, const Real& force, Vector& q) const;  ///< q += M^-1 r^T force
  [[nodiscard]] Real mobility(const Row& p, const Row& q) const;  ///< p M^-1 q^T
  [[nodiscard]] std::vector<Row> constraints(const Mode& mode) const;
  [[nodiscard]] Vector multipliers(const std::vector<Row>& rows, const Vector& target) const;
  [[nodiscard]] Vector applied_force(Jet& jet, std::size_t k) const;
  void add_forcing(std::vector<Vector>& force, const Real& t, const Real& step) const;
  [[nodiscard]] Real rate_bound() const;

  Model model_;
  Vector inverse_mass_;
  Row friction_row_, stop_row_;
  int merged_sign_ = 0;
  Real coupling_, period_, longest_step_;
};

}  // namespace slapstick::oracle
