#pragma once
/// One contact query as a general-purpose solver gets it: from a start, does the gap of a forced linear oscillator
/// close until T, and when?
#include <array>
#include <vector>

namespace campaign {

/// y = (p, u), p' = u, u' = acceleration . (y, cos theta, sin theta, 1), theta = theta0 + omega t; the gap is
/// sign * y[own].
struct ContactProblem {
  static constexpr int most = 2;  ///< displacements
  static constexpr int most_columns = 2 * most + 3;
  using State = std::array<double, 2 * most>;  ///< of one displacement the upper half is zero

  int d = 1, own = 0;
  double sign = -1.0, omega = 1.0, duration = 0.0;
  double shortest_period = 0.0;  ///< of the motion, for solvers that are told a longest step
  std::array<std::array<double, most_columns>, most> acceleration{};

  [[nodiscard]] double gap(const State& y) const { return sign * y[own]; }
  /// `cosine` and `sine` of theta.
  void derivative(const State& y, State& out, double cosine, double sine) const {
    for (int i = 0; i < d; ++i) {
      const auto& a = acceleration[i];
      double sum = a[2 * d] * cosine + a[2 * d + 1] * sine + a[2 * d + 2];
      for (int k = 0; k < 2 * d; ++k) sum += a[k] * y[k];
      out[i] = y[d + i];
      out[d + i] = sum;
    }
  }
};

struct ContactQuery {
  ContactProblem::State start{};
  double theta0 = 0.0;
};

/// What a solver says of a query: the time of contact, `none`, or `failed` with an error of its own.
inline constexpr double no_contact = -1.0, solver_failed = -2.0;

/// SUNDIALS CVODE, Adams with fixed-point iteration, its own rootfinding on the gap (falling). @param longest_step  0:
/// CVODE's choice
std::vector<double> cvode_contacts(const ContactProblem& problem, const std::vector<ContactQuery>& queries,
                                   double tolerance, double longest_step);

/// Boost.odeint, controlled runge_kutta_fehlberg78; the sign of the gap at `samples` places of every step (1: its end),
/// each by taking the step anew as far as there; a change of sign is located by TOMS 748.
std::vector<double> odeint_contacts(const ContactProblem& problem, const std::vector<ContactQuery>& queries,
                                    double tolerance, int samples);

}  // namespace campaign
