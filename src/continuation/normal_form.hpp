#pragma once
/// What happens beyond the linear terms at a fold, a period doubling or a torus: the coefficient of the normal form of
/// the return map.
///
/// With the sequence of events fixed, the map from a fixed phase to the same phase a cycle later is analytic: each leg
/// ends at its guard's zero by Newton's method from the orbit's own instant. (Without forcing: from just after event 0
/// to just after it a cycle later.) With A, B, C its derivatives at the orbit, A q = mu q, and p A = mu p, p q = 1:
///
///   LP  a  = 1/2 p B(q,q), without its sign                                              mu = 1
///   PD  c  = 1/6 p (C(q,q,q) + 3 B(q, (I-A)^-1 B(q,q)))                                    mu = -1
///   NS  l1 = 1/2 Re(conj(mu) p (C(q,q,q*) + 2 B(q, (I-A)^-1 B(q,q*)) + B(q*, (mu^2 I-A)^-1 B(q,q)))),   q* = conj(q)
///
/// c > 0: a stable doubled orbit lives where this one is unstable (supercritical); l1 < 0: a stable torus does (if no
/// other multiplier is outside). With the opposite signs an unstable one lives where this one is stable (subcritical).
/// How large it is beside the point, to first order in the parameter:
///     doubled orbit  x = x_0 +- s q,  s^2 = -(1 + mu) / c;      torus  x = x_0 + 2 Re(z q),  |z|^2 = (1 - |mu|) / l1.
///
/// Normalisation: |q| = 1 when displacements are divided by the largest displacement of the orbit, and velocities by
/// the largest velocity: of the contact coordinates (mode/frame.hpp: from a stop, gaps; orbit/extremes.hpp), over the
/// whole cycle. In the middle of the leg in which least is held still, the longest of these; without forcing at its
/// start. Signs do not depend on it, and neither do the products with s^2, |z|^2.
///
/// A is exact; B and C are central differences of A along q, so that truncation is O(h^2), extrapolated to O(h^4), and
/// rounding eps / h^2. Steps are halved from 1/8 on; the value is the one which changes least from step to step, and
/// its error the larger of its changes to both neighbours.
///
/// Source: Kuznetsov, Elements of Applied Bifurcation Theory (3rd ed., 2004), section 5.4.
#include "orbit/equations.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// The return map around an orbit, in numbers of a contact state divided by their sizes.
class FixedPhaseMap {
 public:
  /// From the middle of a leg, no tail of a chatter. Without forcing: from its start.
  FixedPhaseMap(const Problem& problem, Orbit orbit, std::size_t leg);

  [[nodiscard]] const Orbit& orbit() const { return orbit_; }            ///< begun with that leg
  [[nodiscard]] double phase() const { return phase_; }                  ///< instant of the map's start, periods
  [[nodiscard]] const Eigen::VectorXd& state() const { return state_; }  ///< contact state of the orbit there
  [[nodiscard]] const Eigen::VectorXd& sizes() const { return sizes_; }  ///< largest over the cycle, of the numbers
  /// The map's derivative at the orbit's state + x. @throws NumericalError if a leg does not end there
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const;

 private:
  const Problem* problem_;
  Orbit orbit_;
  ModeSet set_;
  double phase_;
  Eigen::VectorXd state_;
  Eigen::VectorXd sizes_;
};

/// An eigenvector and what is dual to it.
struct Critical {
  std::complex<double> mu;
  Eigen::VectorXcd q;     ///< |q| = 1
  Eigen::RowVectorXcd p;  ///< p q = 1
};
[[nodiscard]] Critical critical(const Eigen::MatrixXd& A, std::complex<double> mu);

/// The coefficient of a special point with an eigenvector of any length, and its error; not a number if there is no
/// coefficient.
struct Estimate {
  double value = 0.0, error = 0.0;
};
[[nodiscard]] Estimate coefficient(SpecialType type, const FixedPhaseMap& map, const Critical& direction);

/// Of an LP, PD or NS. Where it has no coefficient the verdict says why.
[[nodiscard]] NormalForm normal_form(const Problem& problem, const SpecialPoint& point);

}  // namespace slapstick::orbit
