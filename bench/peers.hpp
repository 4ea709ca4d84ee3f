#pragma once
/// The benchmark peers: the paper's oscillator (NOTATION.md) run by two general-purpose integrators.
///
/// Both start at x1 = -0.5, x2 = 0, at rest, at time 0, and run for a number of forcing periods 2 pi / omega.
/// Everything is dimensionless as in the paper's eq. (4).

#include <vector>

namespace slapstick::bench {

/// A peer ends chatter when an impact leaves with less than this relative speed; the blocks are then at rest on the
/// stop. That speed is a bare threshold: the peers carry no bound on the flights it cuts. A flight that rounding or the
/// solver's error ends at or beyond the stop ends chatter too.
inline constexpr double peer_rest_speed = 1e-9;

/// What one run did.
struct PeerRun {
  std::vector<double> impact_times;  ///< times of contact in [0, periods * 2 pi / omega], ascending
  long evaluations = 0;              ///< evaluations of the right-hand side
  long steps = 0;                    ///< accepted solver steps
  long phases = 0;                   ///< solver starts: one per slip or stick phase
};

/// Boost.odeint, controlled runge_kutta_fehlberg78 with absolute and relative tolerance `tolerance`.
/// An event is located by re-taking the step with other lengths, so it is as accurate as a step: Newton's method from
/// the step's Hermite cubic (two re-taken steps as a rule), TOMS 748 where Newton fails. TOMS 748 alone
/// needs six to nine: 1.2 times the evaluations at omega 2.2, 1.5 times at 1.5, 2.3 times in chatter.
PeerRun run_odeint(double omega, int periods, double tolerance);

/// SUNDIALS CVODE, Adams with fixed-point iteration, absolute and relative tolerance `tolerance`.
/// A phase starts with the first step length of the phase before: measured, fewer evaluations than with the last one or
/// with CVODE's own choice. Events are located the same way, but on CVODE's interpolant (CVodeGetDky), almost without
/// evaluations. In chatter (omega 0.552) the last flights sink below its error: the last three of 19 impacts per period
/// are cut, and contact begins 4e-6 early.
PeerRun run_cvode(double omega, int periods, double tolerance);

}  // namespace slapstick::bench
