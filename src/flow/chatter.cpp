/// Proves chatter complete and encloses its limit.
#include "flow/chatter.hpp"

#include <algorithm>
#include <cmath>

#include "base/ranges.hpp"
#include "flow/mode_graph.hpp"
#include "mode/contact_force.hpp"

namespace slapstick::flow {
namespace {

/// The most that factor * (row . X) can change while X changes by delta.
double row_change(const mode::RowVector& row, double factor, const double* delta) {
  double change = 0.0;
  for (Eigen::Index j = 0; j < row.size(); ++j) change += std::abs(factor * row[j]) * delta[j];
  return change;
}

/// The normal force N of a friction contact, or 1 if it has fixed limits, and the most that it can change while X
/// changes by delta. Friction is in proportion to max(N, 0), which changes by no more than N does.
struct Load {
  double N = 1.0, change = 0.0;
  [[nodiscard]] bool never() const { return N + change <= 0.0; }
  [[nodiscard]] bool may_end() const { return N - change <= 0.0; }
};

/// @param delta  or null for no change
Load load(const CompiledSystem& system, const mode::Mode& here, int i, const double* X, const double* delta) {
  if (!system.model().frictions[i].normal) return {};
  const mode::RowVector row = load_row(system.model(), system.frame(), here.states(), i);
  return {row_product(row, X), delta == nullptr ? 0.0 : row_change(row, 1.0, delta)};
}

/// True if a contact that slips cannot come to rest: its velocity changes by less than it is. delta bounds |X - X_0|.
bool slips_on(const CompiledSystem& system, int i, const double* X, const double* delta) {
  return delta[system.frame().u(system.frame().frictions[i].own)] < std::abs(sliding_velocity(system, i, X));
}

/// The friction forces during the chatter, as accelerations of the chattering pair.
struct Friction {
  double phi = 0.0;         ///< known: f_k N on the same pair, against the motion
  double phi_static = 0.0;  ///< f_s N on the same pair
  double steady = 0.0;      ///< known: contacts that slip all the while (on a belt, on other pairs)
  double unknown = 0.0;  ///< any value up to this: friction at rest on other pairs, whose state the impulses may change
};

/// @param delta bound on the changes of X over the chatter, or null if no bound is known yet
Friction friction_on(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X,
                     const double* delta) {
  Friction friction;
  for (int i = 0; i < static_cast<int>(system.model().frictions.size()); ++i) {
    const FrictionContact& contact = system.model().frictions[i];
    const auto [effect, same_pair] = system.coupling(stop, i);
    if (effect == 0.0) continue;
    const double w = sliding_velocity(system, i, X), N = std::max(load(system, here, i, X, nullptr).N, 0.0);
    if (same_pair) {
      friction.phi += std::abs(effect) * contact.kinetic_friction * N;
      friction.phi_static += std::abs(effect) * contact.static_friction * N;
    } else if (w != 0.0 && (delta == nullptr || slips_on(system, i, X, delta))) {
      friction.steady -= std::copysign(contact.kinetic_friction, w) * effect * N;
    } else {
      friction.unknown += std::abs(effect) * contact.static_friction * N;
    }
  }
  return friction;
}

/// The most by which friction can be another one than that because loads change: by f_s |N - N_0|, whatever the state.
double friction_change(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X,
                       const double* delta) {
  double change = 0.0;
  for (int i = 0; i < static_cast<int>(system.model().frictions.size()); ++i) {
    const double effect = system.coupling(stop, i).effect;
    if (effect == 0.0) continue;
    const Load on = load(system, here, i, X, delta);
    if (!on.never()) change += std::abs(effect) * system.model().frictions[i].static_friction * on.change;
  }
  return change;
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

/// Is the force of a characteristic continuous at its corners? That of zones jumps.
bool is_continuous(const CompiledSystem& system, int characteristic) {
  return system.model().characteristics[characteristic].over != Characteristic::Over::zones;
}

/// May a characteristic pass a corner while X stays within delta?
bool passes_corner(const CompiledSystem& system, int characteristic, const double* X, const double* delta) {
  return ranges::any_of(system.frame().characteristics[characteristic].corners, [&](const mode::RowVector& row) {
    return std::abs(row_product(row, X)) <= row_change(row, 1.0, delta);
  });
}

/// The steepest of its pieces.
double steepest(const Characteristic& characteristic) {
  double most = 0.0;
  for (int piece = 0; piece <= static_cast<int>(characteristic.corners.size()); ++piece)
    most = std::max(most, std::abs(mode::piece_of(characteristic, piece).slope));
  return most;
}

/// May any continuous one pass a corner?
bool bends(const CompiledSystem& system, const double* X, const double* delta) {
  for (int i = 0; i < static_cast<int>(system.frame().characteristics.size()); ++i)
    if (is_continuous(system, i) && passes_corner(system, i, X, delta)) return true;
  return false;
}

/// The slope by which the force of a characteristic can change at most: of its piece, or of its steepest one.
double slope_bound(const CompiledSystem& system, const mode::Mode& here, int i, bool any_piece) {
  const Characteristic& characteristic = system.model().characteristics[i];
  if (any_piece && is_continuous(system, i)) return steepest(characteristic);
  return std::abs(mode::piece_of(characteristic, here.states().pieces[static_cast<std::size_t>(i)]).slope);
}

/// What the pieces of continuous characteristics can add to that.
double bend_rate(const CompiledSystem& system, const mode::Mode& here, int i, const double* v) {
  double rate = 0.0;
  for (int k = 0; k < static_cast<int>(system.frame().characteristics.size()); ++k)
    rate += row_change(
        system.frame().slope_row(system.model(), k),
        system.frame().characteristics[static_cast<std::size_t>(k)].push[i] * slope_bound(system, here, k, true), v);
  return rate;
}

/// out = |A| v, of the greater of |A| without contact forces, and with those of the mode that the flight is in.
/// @param any_piece  of continuous characteristics
void magnitude_product(const CompiledSystem& system, const mode::Mode& here, bool any_piece, const double* v,
                       double* out) {
  const mode::Frame& frame = system.frame();
  const int m = frame.size();
  for (int i = 0; i < frame.d; ++i) {
    out[i] = v[frame.u(i)] + std::abs(frame.drift[i]) * v[frame.one()];
    double sum = 0.0;
    for (int j = 0; j < m; ++j)
      sum += std::max(std::abs(frame.free(i, j)), std::abs(here.system()(frame.u(i), j))) * v[j];
    out[frame.u(i)] = sum + loaded_friction_rate(system, here, i, v);
    if (any_piece) out[frame.u(i)] += bend_rate(system, here, i, v);
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

/// Does a force along a contact accelerate the pair of a stop?
bool acts_on(const mode::Frame& frame, int stop, const mode::ContactRow& contact) {
  return frame.mass_inverse(frame.stops[stop].own, contact.own) != 0.0;
}

/// Can any other stop, rigid or compliant, begin or cease to act while X stays within delta?
bool others_change(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X,
                   const double* delta) {
  const mode::Frame& frame = system.frame();
  for (int i = 0; i < static_cast<int>(frame.stops.size()); ++i) {
    const double open = gap(system, i, X);
    if (i != stop && open > 0.0 && open <= delta[frame.stops[i].own]) return true;
  }
  for (int i = 0; i < static_cast<int>(frame.characteristics.size()); ++i)
    if (!is_continuous(system, i) && passes_corner(system, i, X, delta)) return true;
  for (int i = 0; i < static_cast<int>(frame.compliant.size()); ++i) {
    const mode::ContactRow &contact = frame.compliant[i], &own = frame.stops[stop];
    if (contact.own == own.own && contact.sign == own.sign) continue;  // the contact begins where the stop's gap ends
    if (std::abs(depth(system, i, X)) <= delta[contact.own]) return true;
  }
  for (const mode::Guard& guard : here.guards()) {
    const bool of_force =
        guard.kind == mode::GuardKind::let_go || guard.kind == mode::GuardKind::push || of_bound(guard.kind);
    if (of_force && acts_on(frame, stop, frame.compliant[guard.contact]) && guard.at(X) <= guard.size(delta))
      return true;
  }
  return false;
}

/// Calls add(row, factor) with the force factor * (row . X) towards the stop of each compliant stop that acts on its
/// pair.
template <class Add>
void for_compliant_forces(const CompiledSystem& system, const mode::Mode& here, int stop, const Add& add) {
  const mode::Frame& frame = system.frame();
  const mode::ContactRow& own = frame.stops[stop];
  for (int i = 0; i < static_cast<int>(frame.compliant.size()); ++i) {
    const mode::CompliantState state = here.states().compliant[i];
    const bool pushes = state == mode::CompliantState::on || state == mode::CompliantState::bounded;
    if (!pushes || !acts_on(frame, stop, frame.compliant[i])) continue;
    const double effect = own.sign * frame.compliant[i].sign * frame.mass_inverse(own.own, frame.compliant[i].own);
    add(compliant_row(system.model(), frame, i, state), -effect);
  }
}

/// Acceleration of the stop's pair towards the stop without friction, in the states of the compliant stops and the
/// pieces of the characteristics that are in force.
double press(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X) {
  double towards = row_product(system.press(stop), X);
  const mode::ContactRow& own = system.frame().stops[stop];
  for (std::size_t i = 0; i < here.states().pieces.size(); ++i) {
    const int characteristic = static_cast<int>(i);
    const mode::Piece piece = mode::piece_of(system.model().characteristics[i], here.states().pieces[i]);
    towards -= own.sign * system.frame().characteristics[i].push[own.own] *
               (piece.slope * row_product(system.frame().slope_row(system.model(), characteristic), X) + piece.offset);
  }
  for_compliant_forces(system, here, stop,
                       [&](const mode::RowVector& row, double factor) { towards += factor * row_product(row, X); });
  return towards;
}

/// The most that it can change while X changes by delta.
/// @param any_piece  of continuous characteristics
double press_change(const CompiledSystem& system, const mode::Mode& here, int stop, bool any_piece,
                    const double* delta) {
  double change = 0.0;
  const auto add = [&](const mode::RowVector& row, double factor) { change += row_change(row, factor, delta); };
  add(system.press(stop), 1.0);
  const mode::ContactRow& own = system.frame().stops[stop];
  for (std::size_t i = 0; i < here.states().pieces.size(); ++i)
    add(system.frame().slope_row(system.model(), static_cast<int>(i)),
        system.frame().characteristics[i].push[own.own] * slope_bound(system, here, static_cast<int>(i), any_piece));
  for_compliant_forces(system, here, stop, add);
  return change;
}

/// Bound on |R(X(t)) - R_0| over a window of length D, or infinity if the bound on the states cannot be verified.
/// @param any_piece  continuous characteristics may pass their corners: tried where one is in reach
double drift_of_R(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, double D,
                  double impulse_sum, bool any_piece, std::span<double> scratch) {
  const mode::Frame& frame = system.frame();
  const int m = frame.size();
  double* magnitude = scratch.data();
  double* rate = magnitude + m;
  double* delta = rate + m;
  double* product = delta + m;
  for (int i = 0; i < m; ++i) magnitude[i] = std::abs(X[i]);
  magnitude_product(system, here, any_piece, magnitude, rate);
  for (int i = 0; i < frame.d; ++i) rate[frame.u(i)] += friction_rate(system, i);
  const auto jump = [&](int i) {
    return i >= frame.d && i < 2 * frame.d ? std::abs(system.impulse(stop)[i - frame.d]) * impulse_sum : 0.0;
  };
  for (int i = 0; i < m; ++i) delta[i] = 2.0 * (D * rate[i] + jump(i));
  // A position moves by the bound of its velocity, and what springs and dampers lead on to by the bounds before it: a
  // round passes one row of A, and the longest way leads through all positions and velocities. Once a round that leaves
  // no zero behind is no nearer than the one before, none will do.
  double excess = INFINITY, before = INFINITY;
  for (int round = 0; excess > 1.0; ++round) {
    if (round > 2 * frame.d || (excess < INFINITY && excess >= before)) return INFINITY;
    before = excess;
    magnitude_product(system, here, any_piece, delta, product);
    for (int i = 0; i < m; ++i) delta[i] = 2.0 * (D * (rate[i] + product[i]) + jump(i));
    magnitude_product(system, here, any_piece, delta, product);
    excess = 0.0;
    for (int i = 0; i < m; ++i) {
      const double needed = D * (rate[i] + product[i]) + jump(i);
      if (needed > delta[i]) excess = std::max(excess, needed / delta[i]);
    }
  }
  if (others_change(system, here, stop, X, delta)) return INFINITY;
  if (!any_piece && bends(system, X, delta)) return drift_of_R(system, here, stop, X, D, impulse_sum, true, scratch);
  return press_change(system, here, stop, any_piece, delta) + friction_change(system, here, stop, X, delta);
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
  const double delta = drift_of_R(system, here, stop, X, D, impulse_sum, false, scratch) + friction.unknown;
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
bool all_slip_on(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, const double* delta) {
  for (int i = 0; i < static_cast<int>(system.model().frictions.size()); ++i) {
    const auto [effect, same_pair] = system.coupling(stop, i);
    if (same_pair || effect == 0.0 || sliding_velocity(system, i, X) == 0.0) continue;
    if (!slips_on(system, i, X, delta) && !load(system, here, i, X, delta).never()) return false;
  }
  return true;
}

/// May the impacts move a friction contact of another pair through its rest, a load through zero, or a characteristic
/// past a corner? With room for bounds that are less sharp than delta.
bool shakes(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, const double* delta) {
  constexpr double room = 4.0;
  for (int i = 0; i < static_cast<int>(system.model().frictions.size()); ++i) {
    const auto [effect, same_pair] = system.coupling(stop, i);
    Load on = load(system, here, i, X, delta);
    on.change *= room;
    if (effect == 0.0 || on.never()) continue;
    const double moved = delta[system.frame().u(system.frame().frictions[i].own)];
    if (!same_pair && std::abs(sliding_velocity(system, i, X)) <= room * moved) return true;
    if (on.may_end()) return true;
  }
  return bends(system, X, delta);
}

/// Is there another closed stop that the impacts strike too?
bool strikes_others(const CompiledSystem& system, int stop, const double* X) {
  const mode::Frame& frame = system.frame();
  for (std::size_t i = 0; i < frame.stops.size(); ++i) {
    const bool in_contact = static_cast<int>(i) != stop && gap(system, static_cast<int>(i), X) == 0.0;
    if (in_contact && acts_on(frame, stop, frame.stops[i])) return true;
  }
  return false;
}

}  // namespace

bool slow_enough(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X, double tolerance) {
  const double away = -approach_velocity(system, stop, X);
  const double R = press(system, here, stop, X) + friction_on(system, here, stop, X, nullptr).steady;
  return away > 0.0 && away < fastest_chatter(tolerance * system.period()) * R;
}

ChatterLimit prove_chatter(const CompiledSystem& system, const mode::Mode& here, int stop, const double* X,
                           double tolerance, std::span<double> scratch) {
  const double v = -approach_velocity(system, stop, X);
  const Friction friction = friction_on(system, here, stop, X, nullptr);
  if (!slow_enough(system, here, stop, X, tolerance)) return {};
  if (strikes_others(system, stop, X)) return {};
  const auto& corners = system.model().stops[stop].corners;  // below the first the restitution is constant
  if (!corners.empty() && v > system.model().stops[stop].restitution * corners.front().speed) return {};

  ChatterLimit limit = prove(system, here, stop, X, tolerance, friction, scratch);
  const double* delta = scratch.data() + 2 * system.frame().size();
  // One that may come to rest on the way can push either way.
  if (limit.proven && !all_slip_on(system, here, stop, X, delta))
    limit = prove(system, here, stop, X, tolerance, friction_on(system, here, stop, X, delta), scratch);
  limit.shaken = limit.proven && shakes(system, here, stop, X, delta);
  return limit;
}

}  // namespace slapstick::flow
