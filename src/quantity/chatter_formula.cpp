/// What quantities are in the tail of a complete chatter, whose impacts carry what the closed stop would bear.
#include <algorithm>
#include <cmath>

#include "quantity/formula.hpp"

namespace slapstick::quantity {

using Kind = Quantity::Kind;

/// The held pair of a closed stop, or one past the last.
std::size_t Formulas::pair_of(int stop) const {
  const auto has = [&](const mode::HeldPair& pair) {
    return std::find(pair.stops.begin(), pair.stops.end(), stop) != pair.stops.end();
  };
  return static_cast<std::size_t>(std::find_if(held_.begin(), held_.end(), has) - held_.begin());
}

/// The acceleration of a coordinate for each unit of the stop's press is minus this: sign e_i W^-1 M^-1 g^T.
Number Formulas::moved_by(int stop, int coordinate) const {
  const mode::ContactRow& own = frame_.stops[static_cast<std::size_t>(stop)];
  const auto along = [&](const Matrix& mass_inverse) {
    return own.sign * frame_.W_inverse.row(coordinate).dot(mass_inverse.col(own.own).head(frame_.n));
  };
  return {along(frame_.mass_inverse), rates_ ? along(rates_->frame.mass_inverse) : 0.0};
}

/// Kinetic friction at X, f_k N.
Number Formulas::kinetic_at(int friction, const Vector& X, const Vector& by) const {
  const Number kinetic = number(&Model::frictions, friction, &FrictionContact::kinetic_friction);
  if (!model_.frictions[static_cast<std::size_t>(friction)].normal) return kinetic;
  const Number N = load(friction).at(X, by);
  return N.value > 0.0 ? kinetic * N : Number{};
}

/// Friction f_k helps a flight to return while the pair rises, for T_rise, and hinders for T_fall. With the press f0,
/// T_rise : T_fall = sqrt(f0 - f_k) : sqrt(f0 + f_k), so that friction bears in the mean
///     f_k (T_fall - T_rise) / (T_fall + T_rise) = f0 - sqrt(f0^2 - f_k^2).
/// Each contact has its part of that.
Formulas::Borne Formulas::borne_in_chatter(int stop, const Vector& X, const Vector& by) const {
  Borne borne{stop};
  const std::size_t k = pair_of(stop);
  if (k == held_.size() || held_[k].frictions.empty()) return borne;
  Number kinetic;
  for (const int i : held_[k].frictions) kinetic += kinetic_at(i, X, by);
  const Number f0 = sense(held_[k], frame_.stops[static_cast<std::size_t>(stop)]) * holding(k).at(X, by);
  const Number square = f0 * f0 - kinetic * kinetic;
  const double root = std::sqrt(square.value);
  borne.all = square.value > 0.0 ? f0 - Number{root, 0.5 * square.rate / root} : kinetic;
  for (const int i : held_[k].frictions)
    borne.of.push_back(kinetic.value == 0.0 ? Number{} : borne.all * (kinetic_at(i, X, by) / kinetic));
  return borne;
}

Row Formulas::press_in_chatter(const Borne& borne) const {
  const std::size_t k = pair_of(borne.stop);
  if (k == held_.size()) return none();
  return sense(held_[k], frame_.stops[static_cast<std::size_t>(borne.stop)]) * holding(k) - borne.all * one();
}

/// Nothing if it is on another pair.
std::optional<Row> Formulas::friction_in_chatter(int friction, const Borne& borne) const {
  const std::size_t k = pair_of(borne.stop);
  if (k == held_.size()) return std::nullopt;
  const auto& of_pair = held_[k].frictions;
  const auto at = std::find(of_pair.begin(), of_pair.end(), friction);
  if (at == of_pair.end()) return std::nullopt;
  const double side = sense(held_[k], frame_.stops[static_cast<std::size_t>(borne.stop)]) *
                      sense(held_[k], frame_.frictions[static_cast<std::size_t>(friction)]);
  return side * borne.of[static_cast<std::size_t>(at - of_pair.begin())] * one() + constant_part(friction);
}

Row Formulas::single_in_chatter(const Quantity& quantity, int index, const std::vector<bool>& above,
                                const std::vector<Borne>& chatter) const {
  if (quantity.kind == Kind::acceleration) {
    Row free = acceleration(index);
    for (const Borne& borne : chatter) free += moved_by(borne.stop, index) * press_in_chatter(borne);
    return free;
  }
  for (const Borne& borne : chatter) {
    if (index == borne.stop) return none();
    if (const auto friction = friction_in_chatter(index - stops(), borne)) return *friction;
  }
  return force(index, above);
}

Formula Formulas::in_chatter(const Quantity& quantity, const std::vector<bool>& above,
                             const std::vector<Borne>& chatter) const {
  if (quantity.kind != Kind::acceleration && quantity.kind != Kind::force) return of(quantity, above);
  Row row = single_in_chatter(quantity, quantity.index, above, chatter);
  if (quantity.minus >= 0) row -= single_in_chatter(quantity, quantity.minus, above, chatter);
  return {row};
}

Number Formulas::single_share(const Quantity& quantity, int index, int stop) const {
  if (quantity.kind == Kind::acceleration) return -moved_by(stop, index);
  return Number{quantity.kind == Kind::force && index == stop ? 1.0 : 0.0, 0.0};
}

Number Formulas::share_in_chatter(const Quantity& quantity, int stop) const {
  const Number share = single_share(quantity, quantity.index, stop);
  return quantity.minus >= 0 ? share - single_share(quantity, quantity.minus, stop) : share;
}

}  // namespace slapstick::quantity
