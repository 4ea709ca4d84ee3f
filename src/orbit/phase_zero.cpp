/// Finds the state of an orbit at phase 0.
#include <cmath>

#include "orbit/equations.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {

State at_phase_zero(const Problem& problem, const Orbit& orbit, int period) {
  const ModeSet set(constant_family(problem.family().model(orbit.values)), {});
  const mode::Frame& frame = set.frame();
  const double at = orbit.shape.n > 0 ? std::ceil(orbit.t[0]) + period : orbit.t[0];
  std::size_t i = 0;
  while (i + 1 < orbit.legs() && orbit.t[i + 1] <= at) ++i;
  const ModeRates& mode = set.mode(orbit.shape.legs[i].states);
  Eigen::VectorXd state = state_within(set, orbit, i, at - orbit.t[i]);
  for (const mode::Guard& guard : mode.outline.guards)  // at an impact the gap is rounding, of either sign
    if (guard.kind == mode::GuardKind::gap && guard.at(state.data()) < 0.0) state[frame.stops[guard.contact].own] = 0.0;
  State user(2 * static_cast<std::size_t>(frame.n));
  frame.leave(state.data(), state.data() + frame.d, user.data());
  return user;
}

}  // namespace slapstick::orbit
