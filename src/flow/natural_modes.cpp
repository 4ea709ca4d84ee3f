/// Computes the eigenvalues of a machine without contact.
#include "slapstick/flow/natural_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/dense.hpp"
#include "flow/compiled_system.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick {
namespace {

/// The contact states at a state, without stops and without stick.
mode::ContactStates without_contact(const System& system, const State& state) {
  mode::ContactStates states = system.states(Motion(system, state).mode_id());
  std::fill(states.stops.begin(), states.stops.end(), mode::StopState::open);
  std::fill(states.compliant.begin(), states.compliant.end(), mode::CompliantState::off);
  std::replace(states.frictions.begin(), states.frictions.end(), mode::FrictionState::stick,
               mode::FrictionState::slip_plus);
  return states;
}

/// A over the first n displacements and velocities: those that depend on them follow them.
Eigen::MatrixXd independent(const mode::Frame& frame, const mode::Matrix& A) {
  const Eigen::Index n = frame.n, d = frame.d;
  Eigen::MatrixXd follow = Eigen::MatrixXd::Zero(2 * d, 2 * n);
  follow.topLeftCorner(d, n) = frame.dependence;
  follow.bottomRightCorner(d, n) = frame.dependence;
  const Eigen::MatrixXd all = A.topLeftCorner(2 * d, 2 * d) * follow;
  Eigen::MatrixXd result(2 * n, 2 * n);
  result << all.topRows(n), all.middleRows(d, n);
  return result;
}

}  // namespace

std::vector<NaturalMode> natural_modes(const System& system, const State& state) {
  const ModeId id = system.mode_id(without_contact(system, state));
  const Eigen::MatrixXd A = independent(system.compiled().frame(), system.compiled().mode(id).system());
  const Eigen::VectorXcd lambdas = dense::eigenvalues(A);
  // A double eigenvalue, as the zero of a free translation, is known to the square root of rounding only.
  const double rounding = static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon();
  const double zero = std::sqrt(rounding * lambdas.cwiseAbs2().maxCoeff());
  std::vector<NaturalMode> modes;
  for (const std::complex<double>& lambda : lambdas) {
    const double size = std::sqrt(std::norm(lambda));
    if (size <= zero)
      modes.push_back({});
    else if (lambda.imag() == 0.0)
      modes.push_back({.decay = -lambda.real()});
    else if (lambda.imag() > 0.0)
      modes.push_back({.decay = -lambda.real(), .frequency = size});
  }
  std::sort(modes.begin(), modes.end(), [](const NaturalMode& a, const NaturalMode& b) {
    return std::tie(a.frequency, a.decay) < std::tie(b.frequency, b.decay);
  });
  return modes;
}

}  // namespace slapstick
