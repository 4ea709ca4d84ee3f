#pragma once
/// The paper's oscillator with its numbers as compile-time constants, the fairest form for a peer.
///
/// Relative coordinates: y = x1 - x2, w = v1 - v2 = y', so that the gap and the relative velocity are state components
/// and an event test subtracts nothing. Source: docs/reference/notation.md (eqs. 2, 5, 6, 7 of the paper).

#include <array>
#include <cmath>

namespace slapstick::bench {

/// (y, w, x2, v2)
using State = std::array<double, 4>;
enum Component : unsigned { relative_displacement, relative_velocity, base_displacement, base_velocity };

/// What the contact does. `closed` is stick on the stop, y = b: there only f0 < -f_s releases.
enum class Mode { slip_minus, slip_plus, stick, closed };

constexpr bool is_slip(Mode mode) { return mode == Mode::slip_minus || mode == Mode::slip_plus; }
constexpr double slip_sign(Mode mode) { return mode == Mode::slip_plus ? 1.0 : -1.0; }

struct PaperOscillator {
  static constexpr double mass_ratio = 10.0;
  static constexpr double stiffness_ratio = 5.0;
  static constexpr double dashpot_ratio = 5.0;
  static constexpr double damping_ratio = 0.1;
  static constexpr double clearance = 0.0;
  static constexpr double static_friction = 0.15;
  static constexpr double kinetic_friction = 0.15;
  static constexpr double restitution = 0.8;

  double omega;

  /// Force of the base's own spring and damper.
  static double base_force(const State& x) {
    return 2.0 * damping_ratio * dashpot_ratio * x[base_velocity] + stiffness_ratio * x[base_displacement];
  }

  /// Eq. (2) in relative coordinates; `friction` is s f_k, all of the forcing acts on M1.
  void slip(const State& x, State& dxdt, double t, double friction) const {
    const double coupling =
        2.0 * damping_ratio * x[relative_velocity] + x[relative_displacement] + friction;  // on M2, from M1
    const double base = (coupling - base_force(x)) * (1.0 / mass_ratio);
    dxdt[relative_displacement] = x[relative_velocity];
    dxdt[relative_velocity] = std::sin(omega * t) - coupling - base;
    dxdt[base_displacement] = x[base_velocity];
    dxdt[base_velocity] = base;
  }

  /// Eq. (5): y rests, both blocks move as one.
  void stick(const State& x, State& dxdt, double t) const {
    dxdt[relative_displacement] = 0.0;
    dxdt[relative_velocity] = 0.0;
    dxdt[base_displacement] = x[base_velocity];
    dxdt[base_velocity] = (std::sin(omega * t) - base_force(x)) * (1.0 / (1.0 + mass_ratio));
  }

  void derivative(Mode mode, const State& x, State& dxdt, double t) const {
    if (is_slip(mode)) {
      slip(x, dxdt, t, slip_sign(mode) * kinetic_friction);
    } else {
      stick(x, dxdt, t);
    }
  }

  /// Eq. (6): the force that holds M1 against M2, positive when it pushes M1 in the -x direction.
  double holding_force(const State& x, double t) const {
    return (mass_ratio * std::sin(omega * t) + base_force(x)) / (1.0 + mass_ratio) - x[relative_displacement];
  }

  /// d f0 / dt in stick; `slope` is the state's derivative.
  double holding_force_rate(const State& slope, double t) const {
    return (mass_ratio * omega * std::cos(omega * t) + base_force(slope)) / (1.0 + mass_ratio);
  }

  /// Eq. (7) with restitution `r`: momentum kept, w+ = -r w-. On the stop afterwards, exactly.
  static State after_impact(State x, double r) {
    x[base_velocity] += (1.0 + r) * x[relative_velocity] / (1.0 + mass_ratio);
    x[relative_velocity] *= -r;
    x[relative_displacement] = clearance;
    return x;
  }
};

}  // namespace slapstick::bench
