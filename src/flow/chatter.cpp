/// Proves chatter complete and encloses its limit.
#include "flow/chatter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ranges.hpp"
#include "flow/chatter_forces.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::flow {
namespace {

/// A stop that chatters.
struct Bouncing {
  int stop = 0;
  ChatterFriction friction = {};
  double r = 0.0, v = 0.0, R = 0.0;  ///< restitution, speed of separation, acceleration towards the stop
  double nominal = 0.0;              ///< the length of all flights if accelerations stay
  double impulse_sum = 0.0;          ///< bound on the changes of speed still to come
};

/// All that chatter from one instant on.
class Chattering {
 public:
  void add(const Bouncing& one) { all_[count_++] = one; }
  [[nodiscard]] std::span<Bouncing> stops() { return std::span(all_).first(count_); }
  [[nodiscard]] std::span<const Bouncing> stops() const { return std::span(all_).first(count_); }
  template <class Holds>
  [[nodiscard]] bool any(const Holds& holds) const {
    return ranges::any_of(stops(), [&](const Bouncing& one) { return holds(one.stop); });
  }

 private:
  std::array<Bouncing, System::most_contacts> all_;
  std::size_t count_ = 0;
};

/// Duration of all flights from separation speed v, for given decelerations.
double series(double v, double a_rise, double a_return, double rho) {
  return v * (1.0 / a_rise + 1.0 / std::sqrt(a_rise * a_return)) / (1.0 - rho);
}

/// The series of a stop's flights if accelerations stay. @returns false if friction may hold the pair off the stop, or
/// its impacts become no slower
bool begin_series(const CompiledSystem& system, const ChatterForces& forces, const double* X, Bouncing& one) {
  const ChatterFriction& friction = one.friction;
  one.r = system.model().stops[one.stop].restitution;
  one.v = -approach_velocity(system, one.stop, X);
  one.R = forces.press(one.stop) + friction.steady;
  const double least = one.R - friction.unknown;
  if (least - friction.phi <= 0.0 || least <= friction.phi_static) return false;
  const double rho = one.r * std::sqrt((one.R - friction.phi) / (one.R + friction.phi));
  if (!(rho < 1.0)) return false;
  one.nominal = series(one.v, one.R + friction.phi, one.R - friction.phi, rho);
  one.impulse_sum = 2.0 * (1.0 + one.r) / one.r * one.v * rho / (1.0 - rho);
  return true;
}

/// Bounds delta on |X(t) - X(0)| over a window of length D, in scratch[2 m ..]. @returns false if none can be verified
/// @param any_piece  continuous characteristics may pass their corners
bool bound_states(const CompiledSystem& system, const ChatterForces& forces, const Chattering& chattering,
                  const double* X, double D, bool any_piece, std::span<double> scratch) {
  const mode::Frame& frame = system.frame();
  const int m = frame.size();
  double* magnitude = scratch.data();
  double* rate = magnitude + m;
  double* delta = rate + m;
  double* product = delta + m;
  for (int i = 0; i < m; ++i) magnitude[i] = std::abs(X[i]);
  forces.magnitude_product(any_piece, magnitude, rate);
  for (int i = 0; i < frame.d; ++i) rate[frame.u(i)] += forces.friction_rate(i);
  const auto jump = [&](int i) {
    double sum = 0.0;
    for (const Bouncing& one : chattering.stops())
      if (i >= frame.d && i < 2 * frame.d) sum += std::abs(system.impulse(one.stop)[i - frame.d]) * one.impulse_sum;
    return sum;
  };
  for (int i = 0; i < m; ++i) delta[i] = 2.0 * (D * rate[i] + jump(i));
  // A position moves by the bound of its velocity, and what springs and dampers lead on to by the bounds before it: a
  // round passes one row of A, and the longest way leads through all positions and velocities. Once a round that leaves
  // no zero behind is no nearer than the one before, none will do.
  double excess = INFINITY, before = INFINITY;
  for (int round = 0; excess > 1.0; ++round) {
    if (round > 2 * frame.d || (excess < INFINITY && excess >= before)) return false;
    before = excess;
    forces.magnitude_product(any_piece, delta, product);
    for (int i = 0; i < m; ++i) delta[i] = 2.0 * (D * (rate[i] + product[i]) + jump(i));
    forces.magnitude_product(any_piece, delta, product);
    excess = 0.0;
    for (int i = 0; i < m; ++i) {
      const double needed = D * (rate[i] + product[i]) + jump(i);
      if (needed > delta[i]) excess = std::max(excess, needed / delta[i]);
    }
  }
  return true;
}

/// The limit time of one stop.
struct Enclosure {
  bool holds = false;
  double shortest = 0.0, longest = 0.0;
};

/// @param delta  bounds the change of R and of loads over a window of length D
Enclosure enclose_limit(const Bouncing& one, double delta, double D) {
  const double r = one.r, R = one.R, phi = one.friction.phi;
  if (!(delta < R)) return {};
  const double rise_min = R + phi - delta, rise_max = R + phi + delta;
  const double fall_min = R - phi - delta, fall_max = R - phi + delta;
  if (!(R - delta > one.friction.phi_static) || !(fall_min > 0.0)) return {};
  const double rho_max = r * std::sqrt(fall_max / rise_min), rho_min = r * std::sqrt(fall_min / rise_max);
  if (!(rho_max < 1.0)) return {};
  const double longest = series(one.v, rise_min, fall_min, rho_max);
  const double shortest = series(one.v, rise_max, fall_max, rho_min);
  if (longest > D || (1.0 + r) / r * one.v * rho_max / (1.0 - rho_max) > one.impulse_sum) return {};
  return {true, shortest, longest};
}

/// The proof of the header, for friction as given; leaves the bounds on the changes of X in scratch[2 m ..].
ChatterLimit prove(const CompiledSystem& system, const ChatterForces& forces, Chattering& chattering, const double* X,
                   double tolerance, std::span<double> scratch) {
  double nominal = 0.0;
  for (Bouncing& one : chattering.stops()) {
    if (!begin_series(system, forces, X, one)) return {};
    nominal = std::max(nominal, one.nominal);
  }
  const double D = 2.0 * nominal;
  const double* delta = scratch.data() + 2 * system.frame().size();
  if (!bound_states(system, forces, chattering, X, D, false, scratch)) return {};
  const bool any_piece = forces.bends(delta);
  if (any_piece && !bound_states(system, forces, chattering, X, D, true, scratch)) return {};
  double error = 0.0;
  for (const Bouncing& one : chattering.stops()) {
    if (forces.others_change(one.stop, delta)) return {};
    const double change = forces.press_change(one.stop, any_piece, delta) + forces.friction_change(one.stop, delta);
    const Enclosure limit = enclose_limit(one, change + one.friction.unknown, D);
    if (!limit.holds) return {};
    error = std::max({error, limit.longest - nominal, nominal - limit.shortest});
  }
  if (error > tolerance) return {};
  return {true, nominal, error};
}

}  // namespace

bool slow_enough(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, double tolerance) {
  const ChatterForces forces(system, here, X);
  const double away = -approach_velocity(system, stop, X);
  const double R = forces.press(stop) + forces.friction(stop, nullptr).steady;
  return away > 0.0 && away < fastest_chatter(tolerance * system.period()) * R;
}

ChatterLimit prove_chatter(const CompiledSystem& system, const mode::Mode& here, std::span<const int> stops,
                           const double* X, double tolerance, std::span<double> scratch) {
  const ChatterForces forces(system, here, X);
  Chattering chattering;
  for (const int stop : stops) {
    if (!slow_enough(system, here, stop, X, tolerance) || forces.strikes_others(stop)) return {};
    const Stop& law = system.model().stops[stop];  // below the first corner the restitution is constant
    const double v = -approach_velocity(system, stop, X);
    if (!law.corners.empty() && v > law.restitution * law.corners.front().speed) return {};
    chattering.add({stop, forces.friction(stop, nullptr)});
  }
  ChatterLimit limit = prove(system, forces, chattering, X, tolerance, scratch);
  const double* delta = scratch.data() + 2 * system.frame().size();
  // One that may come to rest on the way can push either way.
  if (limit.proven && chattering.any([&](int stop) { return !forces.all_slip_on(stop, delta); })) {
    for (Bouncing& one : chattering.stops()) one.friction = forces.friction(one.stop, delta);
    limit = prove(system, forces, chattering, X, tolerance, scratch);
  }
  limit.shaken = limit.proven && chattering.any([&](int stop) { return forces.shakes(stop, delta); });
  return limit;
}

}  // namespace slapstick::flow
