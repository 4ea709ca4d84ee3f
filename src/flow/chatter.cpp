/// Proves chatter complete and encloses its limit.
#include "flow/chatter.hpp"

#include <algorithm>
#include <cmath>

#include "flow/mode_graph.hpp"
#include "mode/contact_force.hpp"

namespace slapstick::flow {
namespace {

/// True if a contact that slips cannot come to rest: its velocity changes by less than it is. delta bounds |X - X_0|.
bool slips_on(const CompiledSystem& system, int i, const double* X, const double* delta) {
  return delta[system.frame().u(system.frame().frictions[i].own)] < std::abs(sliding_velocity(system, i, X));
}

/// The friction forces during the chatter, as accelerations of the chattering pair.
struct Friction {
  double phi = 0.0;         ///< known: f_k on the same pair, against the motion
  double phi_static = 0.0;  ///< f_s on the same pair
  double steady = 0.0;      ///< known and constant: contacts that slip all the while (on a belt, on other pairs)
  double unknown = 0.0;  ///< any value up to this: friction at rest on other pairs, whose state the impulses may change
};

/// @param delta bound on the changes of X over the chatter, or null if none is known yet
Friction friction_on(const CompiledSystem& system, int stop, const double* X, const double* delta) {
  Friction friction;
  for (int i = 0; i < static_cast<int>(system.model().frictions.size()); ++i) {
    const FrictionContact& contact = system.model().frictions[i];
    const auto [effect, same_pair] = system.coupling(stop, i);
    const double w = sliding_velocity(system, i, X);
    if (same_pair) {
      friction.phi += std::abs(effect) * contact.kinetic_friction;
      friction.phi_static += std::abs(effect) * contact.static_friction;
    } else if (w != 0.0 && (delta == nullptr || slips_on(system, i, X, delta))) {
      friction.steady -= std::copysign(contact.kinetic_friction, w) * effect;
    } else {
      friction.unknown += std::abs(effect) * contact.static_friction;
    }
  }
  return friction;
}

double row_product(const mode::RowVector& row, const double* X) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < row.size(); ++j) sum += row[j] * X[j];
  return sum;
}

/// |u'| that friction can cause on coordinate i, at most.
double friction_rate(const CompiledSystem& system, int i) {
  const mode::Frame& frame = system.frame();
  double rate = 0.0;
  for (std::size_t k = 0; k < frame.frictions.size(); ++k) {
    const FrictionContact& contact = system.model().frictions[k];
    const double effect = frame.mass_inverse(i, frame.frictions[k].own);
    if (!contact.normal) rate += std::abs(effect) * contact.static_friction;
  }
  return rate;
}

/// What friction whose limit is f_s N can add to that: f_s |N|.
double loaded_friction_rate(const CompiledSystem& system, const mode::Mode& here, int i, const double* v) {
  const mode::Frame& frame = system.frame();
  double rate = 0.0;
  for (std::size_t k = 0; k < frame.frictions.size(); ++k) {
    const FrictionContact& contact = system.model().frictions[k];
    const double effect = frame.mass_inverse(i, frame.frictions[k].own);
    if (!contact.normal || effect == 0.0) continue;
    const mode::RowVector load = load_row(system.model(), frame, here.states(), static_cast<int>(k));
    for (Eigen::Index j = 0; j < load.size(); ++j)
      rate += std::abs(effect) * contact.static_friction * std::abs(load[j]) * v[j];
  }
  return rate;
}

/// out = |A| v, of the greater of |A| without contact forces, and with those of the mode that the flight is in.
void magnitude_product(const CompiledSystem& system, const mode::Mode& here, const double* v, double* out) {
  const mode::Frame& frame = system.frame();
  const int m = frame.size();
  for (int i = 0; i < frame.d; ++i) {
    out[i] = v[frame.u(i)] + std::abs(frame.drift[i]) * v[frame.one()];
    double sum = 0.0;
    for (int j = 0; j < m; ++j)
      sum += std::max(std::abs(frame.free(i, j)), std::abs(here.system()(frame.u(i), j))) * v[j];
    out[frame.u(i)] = sum + loaded_friction_rate(system, here, i, v);
  }
  for (std::size_t k = 0; k < frame.harmonics.size(); ++k) {
    const auto c = 2 * frame.d + 2 * static_cast<int>(k);
    const double rate = frame.harmonics[k] * system.model().omega;
    out[c] = rate * v[c + 1];
    out[c + 1] = rate * v[c];
  }
  for (std::size_t k = 0; k < frame.tones.size(); ++k) {
    out[frame.tone(k)] = frame.tones[k].frequency * v[frame.tone(k) + 1];
    out[frame.tone(k) + 1] = frame.tones[k].frequency * v[frame.tone(k)];
  }
  for (std::size_t k = 0; k < frame.signals.size(); ++k) {
    out[frame.signal(k)] = v[frame.signal(k) + 1] / frame.period;
    out[frame.signal(k) + 1] = 0.0;
  }
  out[frame.one()] = 0.0;
}

/// Duration of all flights from separation speed v, for given decelerations.
double series(double v, double a_rise, double a_return, double rho) {
  return v * (1.0 / a_rise + 1.0 / std::sqrt(a_rise * a_return)) / (1.0 - rho);
}

/// Can any other stop, rigid or compliant, begin or cease to act while X stays within delta?
bool others_change(const CompiledSystem& system, int stop, const double* X, const double* delta) {
  const mode::Frame& frame = system.frame();
  for (int i = 0; i < static_cast<int>(frame.stops.size()); ++i) {
    const double open = gap(system, i, X);
    if (i != stop && open > 0.0 && open <= delta[frame.stops[i].own]) return true;
  }
  for (int i = 0; i < static_cast<int>(frame.characteristics.size()); ++i) {
    const mode::RowVector& row = frame.value_row(system.model(), i);
    double value = 0.0, change = 0.0;
    for (Eigen::Index j = 0; j < row.size(); ++j) {
      value += row[j] * X[j];
      change += std::abs(row[j]) * delta[j];
    }
    for (const Characteristic::Corner& corner : system.model().characteristics[i].corners)
      if (std::abs(value - corner.at) <= change) return true;
  }
  for (int i = 0; i < static_cast<int>(frame.compliant.size()); ++i) {
    if (std::abs(depth(system, i, X)) <= delta[frame.compliant[i].own]) return true;
  }
  return false;
}

/// Acceleration of the stop's pair towards the stop without friction, in the pieces of the characteristics that are in
/// force.
double press(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X) {
  double towards = row_product(system.press(stop), X);
  const mode::ContactRow& own = system.frame().stops[stop];
  for (std::size_t i = 0; i < here.states().pieces.size(); ++i) {
    const int characteristic = static_cast<int>(i);
    const mode::Piece piece = mode::piece_of(system.model().characteristics[i], here.states().pieces[i]);
    towards -= own.sign * system.frame().characteristics[i].push[own.own] *
               (piece.slope * row_product(system.frame().slope_row(system.model(), characteristic), X) + piece.offset);
  }
  return towards;
}

/// The most that it can change while X changes by delta.
double press_change(const CompiledSystem& system, const mode::Mode& here, int stop, const double* delta) {
  double change = 0.0;
  const auto add = [&](const mode::RowVector& row, double factor) {
    for (Eigen::Index j = 0; j < row.size(); ++j) change += std::abs(factor * row[j]) * delta[j];
  };
  add(system.press(stop), 1.0);
  const mode::ContactRow& own = system.frame().stops[stop];
  for (std::size_t i = 0; i < here.states().pieces.size(); ++i)
    add(system.frame().slope_row(system.model(), static_cast<int>(i)),
        system.frame().characteristics[i].push[own.own] *
            mode::piece_of(system.model().characteristics[i], here.states().pieces[i]).slope);
  return change;
}

/// Bound on |R(X(t)) - R_0| over a window of length D, or infinity if the bound on the states cannot be verified.
double drift_of_R(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, double D,
                  double impulse_sum, std::span<double> scratch) {
  const mode::Frame& frame = system.frame();
  const int m = frame.size();
  double* magnitude = scratch.data();
  double* rate = magnitude + m;
  double* delta = rate + m;
  double* product = delta + m;
  for (int i = 0; i < m; ++i) magnitude[i] = std::abs(X[i]);
  magnitude_product(system, here, magnitude, rate);
  for (int i = 0; i < frame.d; ++i) rate[frame.u(i)] += friction_rate(system, i);
  const auto jump = [&](int i) {
    return i >= frame.d && i < 2 * frame.d ? std::abs(system.impulse(stop)[i - frame.d]) * impulse_sum : 0.0;
  };
  for (int i = 0; i < m; ++i) delta[i] = 2.0 * (D * rate[i] + jump(i));
  // Positions move by the velocities' own bound, which the first guess has not seen yet: one more round before the
  // check.
  magnitude_product(system, here, delta, product);
  for (int i = 0; i < m; ++i) delta[i] += 2.0 * D * product[i];
  magnitude_product(system, here, delta, product);
  for (int i = 0; i < m; ++i) {
    if (D * (rate[i] + product[i]) + jump(i) > delta[i]) return INFINITY;
  }
  if (others_change(system, stop, X, delta)) return INFINITY;
  return press_change(system, here, stop, delta);
}

/// The proof of the header, for friction as given; leaves the bounds on the changes of X in scratch[2 m ..].
ChatterLimit prove(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, double tolerance,
                   const Friction& friction, std::span<double> scratch) {
  const double r = system.model().stops[stop].restitution;
  const double v = -approach_velocity(system, stop, X);
  const double R = press(system, here, stop, X) + friction.steady;
  if (R - friction.phi - friction.unknown <= 0.0 || R - friction.unknown <= friction.phi_static) return {};
  const double nominal_rho = r * std::sqrt((R - friction.phi) / (R + friction.phi));
  if (!(nominal_rho < 1.0)) return {};
  const double nominal = series(v, R + friction.phi, R - friction.phi, nominal_rho);

  const double D = 2.0 * nominal;
  const double impulse_sum = 2.0 * (1.0 + r) / r * v * nominal_rho / (1.0 - nominal_rho);
  const double delta = drift_of_R(system, here, stop, X, D, impulse_sum, scratch) + friction.unknown;
  if (!(delta < R)) return {};
  const double rise_min = R + friction.phi - delta, rise_max = R + friction.phi + delta;
  const double fall_min = R - friction.phi - delta, fall_max = R - friction.phi + delta;
  if (!(R - delta > friction.phi_static) || !(fall_min > 0.0)) return {};
  const double rho_max = r * std::sqrt(fall_max / rise_min), rho_min = r * std::sqrt(fall_min / rise_max);
  if (!(rho_max < 1.0)) return {};
  const double longest = series(v, rise_min, fall_min, rho_max), shortest = series(v, rise_max, fall_max, rho_min);
  if (longest > D || (1.0 + r) / r * v * rho_max / (1.0 - rho_max) > impulse_sum) return {};
  const double error = std::max(longest - nominal, nominal - shortest);
  if (error > tolerance) return {};
  return {true, nominal, error};
}

/// Does any contact that was counted as steady come to rest?
bool all_slip_on(const CompiledSystem& system, int stop, const double* X, const double* delta) {
  for (int i = 0; i < static_cast<int>(system.model().frictions.size()); ++i) {
    const auto [effect, same_pair] = system.coupling(stop, i);
    if (same_pair || effect == 0.0 || sliding_velocity(system, i, X) == 0.0) continue;
    if (!slips_on(system, i, X, delta)) return false;
  }
  return true;
}

/// May the impacts move a friction contact of another pair through its rest? With room for bounds that are less sharp
/// than delta.
bool shakes(const CompiledSystem& system, int stop, const double* X, const double* delta) {
  constexpr double room = 4.0;
  for (int i = 0; i < static_cast<int>(system.model().frictions.size()); ++i) {
    const auto [effect, same_pair] = system.coupling(stop, i);
    const double moved = delta[system.frame().u(system.frame().frictions[i].own)];
    if (!same_pair && effect != 0.0 && std::abs(sliding_velocity(system, i, X)) <= room * moved) return true;
  }
  return false;
}

/// A closed stop, or a compliant one, that pushes on the chattering pair is more than the proof looks at; so is
/// friction whose limit changes with the state.
bool coupled_to_others(const CompiledSystem& system, int stop, const double* X) {
  const mode::Frame& frame = system.frame();
  const int own = frame.stops[stop].own;
  for (std::size_t i = 0; i < frame.stops.size(); ++i) {
    const bool in_contact = static_cast<int>(i) != stop && gap(system, static_cast<int>(i), X) == 0.0;
    if (in_contact && frame.mass_inverse(own, frame.stops[i].own) != 0.0) return true;
  }
  for (std::size_t i = 0; i < frame.frictions.size(); ++i) {
    if (system.model().frictions[i].normal && frame.mass_inverse(own, frame.frictions[i].own) != 0.0) return true;
  }
  for (std::size_t i = 0; i < frame.compliant.size(); ++i) {
    const bool acts = depth(system, static_cast<int>(i), X) >= 0.0;
    if (acts && frame.mass_inverse(own, frame.compliant[i].own) != 0.0) return true;
  }
  return false;
}

}  // namespace

bool slow_enough(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, double tolerance) {
  const double away = -approach_velocity(system, stop, X);
  const double R = press(system, here, stop, X) + friction_on(system, stop, X, nullptr).steady;
  return away > 0.0 && away < fastest_chatter(tolerance * system.period()) * R;
}

ChatterLimit prove_chatter(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X,
                           double tolerance, std::span<double> scratch) {
  const double v = -approach_velocity(system, stop, X);
  const Friction friction = friction_on(system, stop, X, nullptr);
  if (!slow_enough(system, here, stop, X, tolerance)) return {};
  if (coupled_to_others(system, stop, X)) return {};
  const auto& corners = system.model().stops[stop].corners;  // below the first the restitution is constant
  if (!corners.empty() && v > system.model().stops[stop].restitution * corners.front().speed) return {};

  ChatterLimit limit = prove(system, here, stop, X, tolerance, friction, scratch);
  const double* delta = scratch.data() + 2 * system.frame().size();
  if (limit.proven && !all_slip_on(system, stop, X, delta))  // one that may come to rest on the way can push either way
    limit = prove(system, here, stop, X, tolerance, friction_on(system, stop, X, delta), scratch);
  limit.shaken = limit.proven && shakes(system, stop, X, delta);
  return limit;
}

}  // namespace slapstick::flow
