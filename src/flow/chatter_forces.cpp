/// Bounds what a chatter can do to the forces on its pairs.
#include "flow/chatter_forces.hpp"

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

/// The steepest of its pieces.
double steepest(const Characteristic& characteristic) {
  double most = 0.0;
  for (int piece = 0; piece <= static_cast<int>(characteristic.corners.size()); ++piece)
    most = std::max(most, std::abs(mode::piece_of(characteristic, piece).slope));
  return most;
}

}  // namespace

/// @param delta  or null for no change
ChatterForces::Load ChatterForces::load(int friction, const double* delta) const {
  if (!model().frictions[friction].normal) return {};
  const mode::RowVector row = load_row(model(), frame_, here_.states(), friction);
  return {row_product(row, X_), delta == nullptr ? 0.0 : row_change(row, 1.0, delta)};
}

/// True if a contact that slips cannot come to rest: its velocity changes by less than it is.
bool ChatterForces::slips_on(int friction, const double* delta) const {
  return delta[frame_.u(frame_.frictions[friction].own)] < std::abs(sliding_velocity(system_, friction, X_));
}

ChatterFriction ChatterForces::friction(int stop, const double* delta) const {
  ChatterFriction friction;
  for (int i = 0; i < frictions(); ++i) {
    const FrictionContact& contact = model().frictions[i];
    const auto [effect, same_pair] = system_.coupling(stop, i);
    if (effect == 0.0) continue;
    const double w = sliding_velocity(system_, i, X_), N = std::max(load(i, nullptr).N, 0.0);
    if (same_pair) {
      friction.phi += std::abs(effect) * contact.kinetic_friction * N;
      friction.phi_static += std::abs(effect) * contact.static_friction * N;
    } else if (w != 0.0 && (delta == nullptr || slips_on(i, delta))) {
      friction.steady -= std::copysign(contact.kinetic_friction, w) * effect * N;
    } else {
      friction.unknown += std::abs(effect) * contact.static_friction * N;
    }
  }
  return friction;
}

double ChatterForces::friction_change(int stop, const double* delta) const {
  double change = 0.0;
  for (int i = 0; i < frictions(); ++i) {
    const double effect = system_.coupling(stop, i).effect;
    if (effect == 0.0) continue;
    const Load on = load(i, delta);
    if (!on.never()) change += std::abs(effect) * model().frictions[i].static_friction * on.change;
  }
  return change;
}

double ChatterForces::friction_rate(int i) const {
  double rate = 0.0;
  for (std::size_t k = 0; k < frame_.frictions.size(); ++k) {
    const FrictionContact& contact = model().frictions[k];
    const double effect = frame_.mass_inverse(i, frame_.frictions[k].own);
    if (!contact.normal) rate += std::abs(effect) * contact.static_friction;
  }
  return rate;
}

/// What friction whose limit is f_s N can add to that: f_s |N|.
double ChatterForces::loaded_friction_rate(int i, const double* v) const {
  double rate = 0.0;
  for (std::size_t k = 0; k < frame_.frictions.size(); ++k) {
    const FrictionContact& contact = model().frictions[k];
    const double effect = frame_.mass_inverse(i, frame_.frictions[k].own);
    if (!contact.normal || effect == 0.0) continue;
    const mode::RowVector load = load_row(model(), frame_, here_.states(), static_cast<int>(k));
    for (Eigen::Index j = 0; j < load.size(); ++j)
      rate += std::abs(effect) * contact.static_friction * std::abs(load[j]) * v[j];
  }
  return rate;
}

/// Is the force of a characteristic continuous at its corners? That of zones jumps.
bool ChatterForces::is_continuous(std::size_t characteristic) const {
  return model().characteristics[characteristic].over != Characteristic::Over::zones;
}

bool ChatterForces::passes_corner(std::size_t characteristic, const double* delta) const {
  return ranges::any_of(frame_.characteristics[characteristic].corners, [&](const mode::RowVector& row) {
    return std::abs(row_product(row, X_)) <= row_change(row, 1.0, delta);
  });
}

bool ChatterForces::bends(const double* delta) const {
  for (std::size_t i = 0; i < frame_.characteristics.size(); ++i)
    if (is_continuous(i) && passes_corner(i, delta)) return true;
  return false;
}

/// The slope by which the force of a characteristic can change at most: of its piece, or of its steepest one.
double ChatterForces::slope_bound(std::size_t characteristic, bool any_piece) const {
  const Characteristic& law = model().characteristics[characteristic];
  if (any_piece && is_continuous(characteristic)) return steepest(law);
  return std::abs(mode::piece_of(law, here_.states().pieces[characteristic]).slope);
}

/// What the pieces of continuous characteristics can add to |A|.
double ChatterForces::bend_rate(int i, const double* v) const {
  double rate = 0.0;
  for (std::size_t k = 0; k < frame_.characteristics.size(); ++k)
    rate += row_change(frame_.slope_row(model(), static_cast<int>(k)),
                       frame_.characteristics[k].push[i] * slope_bound(k, true), v);
  return rate;
}

void ChatterForces::magnitude_product(bool any_piece, const double* v, double* out) const {
  const int m = frame_.size();
  for (int i = 0; i < frame_.d; ++i) {
    out[i] = v[frame_.u(i)] + std::abs(frame_.drift[i]) * v[frame_.one()];
    double sum = 0.0;
    for (int j = 0; j < m; ++j)
      sum += std::max(std::abs(frame_.free(i, j)), std::abs(here_.system()(frame_.u(i), j))) * v[j];
    out[frame_.u(i)] = sum + loaded_friction_rate(i, v);
    if (any_piece) out[frame_.u(i)] += bend_rate(i, v);
  }
  for (std::size_t k = 0; k < frame_.harmonics.size(); ++k) {
    const auto c = 2 * frame_.d + 2 * static_cast<int>(k);
    const double rate = frame_.harmonics[k] * model().omega;
    out[c] = rate * v[c + 1];
    out[c + 1] = rate * v[c];
  }
  for (std::size_t k = 0; k < frame_.tones.size(); ++k) {
    out[frame_.tone(k)] = frame_.tones[k].frequency * v[frame_.tone(k) + 1];
    out[frame_.tone(k) + 1] = frame_.tones[k].frequency * v[frame_.tone(k)];
  }
  for (std::size_t k = 0; k < frame_.signals.size(); ++k) {
    out[frame_.signal(k)] = v[frame_.signal(k) + 1] / frame_.period;
    out[frame_.signal(k) + 1] = 0.0;
  }
  out[frame_.one()] = 0.0;
}

/// Does a force along a contact accelerate the pair of a stop?
bool ChatterForces::acts_on(int stop, const mode::ContactRow& contact) const {
  return frame_.mass_inverse(frame_.stops[stop].own, contact.own) != 0.0;
}

bool ChatterForces::others_change(int stop, const double* delta) const {
  for (int i = 0; i < static_cast<int>(frame_.stops.size()); ++i) {
    const double open = gap(system_, i, X_);  // of those that chatter it is zero
    if (open > 0.0 && open <= delta[frame_.stops[i].own]) return true;
  }
  for (std::size_t i = 0; i < frame_.characteristics.size(); ++i)
    if (!is_continuous(i) && passes_corner(i, delta)) return true;
  for (int i = 0; i < static_cast<int>(frame_.compliant.size()); ++i) {
    const mode::ContactRow &contact = frame_.compliant[i], &own = frame_.stops[stop];
    if (contact.own == own.own && contact.sign == own.sign) continue;  // the contact begins where the stop's gap ends
    if (std::abs(depth(system_, i, X_)) <= delta[contact.own]) return true;
  }
  return ranges::any_of(here_.guards(), [&](const mode::Guard& guard) {
    const bool of_force =
        guard.kind == mode::GuardKind::let_go || guard.kind == mode::GuardKind::push || of_bound(guard.kind);
    return of_force && acts_on(stop, frame_.compliant[guard.contact]) && guard.at(X_) <= guard.size(delta);
  });
}

/// Calls add(row, factor) with the force factor * (row . X) towards the stop of each compliant stop that acts on its
/// pair.
template <class Add>
void ChatterForces::for_compliant_forces(int stop, const Add& add) const {
  const mode::ContactRow& own = frame_.stops[stop];
  for (int i = 0; i < static_cast<int>(frame_.compliant.size()); ++i) {
    const mode::CompliantState state = here_.states().compliant[i];
    const bool pushes = state == mode::CompliantState::on || state == mode::CompliantState::bounded;
    if (!pushes || !acts_on(stop, frame_.compliant[i])) continue;
    const double effect = own.sign * frame_.compliant[i].sign * frame_.mass_inverse(own.own, frame_.compliant[i].own);
    add(compliant_row(model(), frame_, i, state), -effect);
  }
}

double ChatterForces::press(int stop) const {
  double towards = row_product(system_.press(stop), X_);
  const mode::ContactRow& own = frame_.stops[stop];
  for (std::size_t i = 0; i < here_.states().pieces.size(); ++i) {
    const mode::Piece piece = mode::piece_of(model().characteristics[i], here_.states().pieces[i]);
    towards -= own.sign * frame_.characteristics[i].push[own.own] *
               (piece.slope * row_product(frame_.slope_row(model(), static_cast<int>(i)), X_) + piece.offset);
  }
  for_compliant_forces(stop,
                       [&](const mode::RowVector& row, double factor) { towards += factor * row_product(row, X_); });
  return towards;
}

double ChatterForces::press_change(int stop, bool any_piece, const double* delta) const {
  double change = 0.0;
  const auto add = [&](const mode::RowVector& row, double factor) { change += row_change(row, factor, delta); };
  add(system_.press(stop), 1.0);
  const mode::ContactRow& own = frame_.stops[stop];
  for (std::size_t i = 0; i < here_.states().pieces.size(); ++i)
    add(frame_.slope_row(model(), static_cast<int>(i)),
        frame_.characteristics[i].push[own.own] * slope_bound(i, any_piece));
  for_compliant_forces(stop, add);
  return change;
}

bool ChatterForces::all_slip_on(int stop, const double* delta) const {
  for (int i = 0; i < frictions(); ++i) {
    const auto [effect, same_pair] = system_.coupling(stop, i);
    if (same_pair || effect == 0.0 || sliding_velocity(system_, i, X_) == 0.0) continue;
    if (!slips_on(i, delta) && !load(i, delta).never()) return false;
  }
  return true;
}

bool ChatterForces::shakes(int stop, const double* delta) const {
  constexpr double room = 4.0;
  for (int i = 0; i < frictions(); ++i) {
    const auto [effect, same_pair] = system_.coupling(stop, i);
    Load on = load(i, delta);
    on.change *= room;
    if (effect == 0.0 || on.never()) continue;
    const double moved = delta[frame_.u(frame_.frictions[i].own)];
    if (!same_pair && std::abs(sliding_velocity(system_, i, X_)) <= room * moved) return true;
    if (on.may_end()) return true;
  }
  return bends(delta);
}

bool ChatterForces::strikes_others(int stop) const {
  for (std::size_t i = 0; i < frame_.stops.size(); ++i) {
    const bool in_contact = static_cast<int>(i) != stop && gap(system_, static_cast<int>(i), X_) == 0.0;
    if (in_contact && acts_on(stop, frame_.stops[i])) return true;
  }
  return false;
}

}  // namespace slapstick::flow
