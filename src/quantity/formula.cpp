/// Writes the quantities of coordinates and the energies as polynomials in the extended state; those of contacts are in
/// contact_formula.cpp.
#include "quantity/formula.hpp"

#include "base/elementary.hpp"
#include "base/ranges.hpp"
#include "mode/assembly.hpp"

namespace slapstick::quantity {

using Kind = Quantity::Kind;

/// A row over q and q' where q = W^{-1} (p + shift) and q' = W^{-1} (u + drift).
Row Formulas::moved(RowVector row) const {
  Row made = still(std::move(row));
  if (rates_)
    made.rate[frame_.one()] = made.value.head(frame_.n).dot(rates_->frame.shift.head(frame_.n)) +
                              made.value.segment(frame_.d, frame_.n).dot(rates_->frame.drift.head(frame_.n));
  return made;
}

/// x = W^{-1} (p + shift)
Row Formulas::displacement(int coordinate) const {
  RowVector row = zero();
  row.head(frame_.n) = frame_.W_inverse.row(coordinate);
  row[frame_.one()] = frame_.W_inverse.row(coordinate).dot(frame_.shift.head(frame_.n));
  return moved(std::move(row));
}

/// v = W^{-1} (u + drift)
Row Formulas::velocity(int coordinate) const {
  RowVector row = zero();
  row.segment(frame_.d, frame_.n) = frame_.W_inverse.row(coordinate);
  row[frame_.one()] = frame_.W_inverse.row(coordinate).dot(frame_.drift.head(frame_.n));
  return moved(std::move(row));
}

/// a = W^{-1} u', u' = A X
Row Formulas::acceleration(int coordinate) const {
  const auto row_of = [&](const Matrix& system) {
    return RowVector(frame_.W_inverse.row(coordinate) * system.middleRows(frame_.d, frame_.n));
  };
  return {row_of(outline_.system), rates_ ? row_of(rates_->outline->system) : zero()};
}

Formula Formulas::of(const Quantity& quantity, const std::vector<bool>& above) const {
  Formula formula = single(quantity, quantity.index, above);
  if (quantity.minus >= 0) formula.linear -= single(quantity, quantity.minus, above).linear;
  return formula;
}

Formula Formulas::single(const Quantity& quantity, int index, const std::vector<bool>& above) const {
  switch (quantity.kind) {
    case Kind::displacement:
      return {displacement(index)};
    case Kind::velocity:
      return {velocity(index)};
    case Kind::acceleration:
      return {acceleration(index)};
    case Kind::gap:
      return {gap(index)};
    case Kind::relative:
      return {relative(index)};
    case Kind::force:
      return {force(index, above)};
    case Kind::normal:
      return {load(index - stops())};
    case Kind::power:
      return power(index, above);
    case Kind::damping:
      return damping();
    case Kind::input:
      return input(above);
    case Kind::kinetic:
      return kinetic();
    case Kind::potential:
      return potential();
    case Kind::parameter:
      return {quantity.value * one()};
    case Kind::speed:
    case Kind::impulse:
    case Kind::loss:
    case Kind::flight:
    case Kind::sliding:
      break;  // between impacts they are nothing
  }
  return {none()};
}

/// sum c (v_a - v_b)^2 + v^T C v
Formula Formulas::damping() const {
  Formula formula{none()};
  for (int i = 0; i < static_cast<int>(model_.dampers.size()); ++i) {
    const Damper& damper = model_.dampers[static_cast<std::size_t>(i)];
    const Row rate = difference(damper, true);
    formula.products.emplace_back(number(&Model::dampers, i, &Damper::coefficient) * rate, rate);
  }
  for (int i = 0; i < frame_.n && !model_.damping.empty(); ++i) {
    Row force = none();
    for (int j = 0; j < frame_.n; ++j) {
      const auto at = static_cast<std::size_t>(i * frame_.n + j);
      force += Number{model_.damping[at], rates_ ? rates_->model.damping[at] : 0.0} * velocity(j);
    }
    formula.products.emplace_back(velocity(i), force);
  }
  return formula;
}

/// A force of the model.
Row Formulas::drive(int i) const {
  const auto at = static_cast<std::size_t>(i);
  const mode::RowVector rates = rates_ ? mode::drive_rate(model_, rates_->model, frame_, at) : zero();
  return {frame_.drive_row(model_.forces[at]), rates};
}

/// Forces times the velocities that they act on, and the belts: of the force F of a contact -F belt_speed.
Formula Formulas::input(const std::vector<bool>& above) const {
  Formula formula{none()};
  for (std::size_t i = 0; i < model_.forces.size(); ++i)
    if (model_.forces[i].presses < 0 && model_.forces[i].contact < 0)
      formula.products.emplace_back(drive(static_cast<int>(i)), velocity(model_.forces[i].coordinate));
  for (int i = 0; i < frictions(); ++i) {
    const Number belt = number(&Model::frictions, i, &FrictionContact::belt_speed);
    if (belt.value != 0.0 || belt.rate != 0.0) formula.linear -= belt * force(stops() + i, above);
  }
  return formula;
}

namespace {

/// A product's factors z / 2 and M z, for all coordinates.
template <class RowOf>
void add_quadratic(const Matrix& M, const Matrix* rate, const Row& none, const RowOf& row_of, Formula& formula) {
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    Row other = none;
    for (Eigen::Index j = 0; j < M.rows(); ++j)
      other += Number{M(i, j), rate != nullptr ? (*rate)(i, j) : 0.0} * row_of(static_cast<int>(j));
    formula.products.emplace_back(0.5 * row_of(static_cast<int>(i)), other);
  }
}

}  // namespace

/// v^T M v / 2
Formula Formulas::kinetic() const {
  Formula formula{none()};
  const Matrix rate = rates_ ? mode::mass_matrix(rates_->model) : Matrix();
  add_quadratic(
      mode::mass_matrix(model_), rates_ ? &rate : nullptr, none(), [&](int i) { return velocity(i); }, formula);
  return formula;
}

/// x^T K x / 2, stiffness delta^2 / 2 of the compliant stops that act, and the integrals of the characteristics over
/// displacements
Formula Formulas::potential() const {
  Formula formula{none()};
  const Matrix rate = rates_ ? mode::stiffness_matrix(rates_->model) : Matrix();
  add_quadratic(
      mode::stiffness_matrix(model_), rates_ ? &rate : nullptr, none(), [&](int i) { return displacement(i); },
      formula);
  for (int i = 0; i < compliants(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const mode::CompliantState state = outline_.states.compliant[at];
    if (state != mode::CompliantState::on && state != mode::CompliantState::bounded) continue;
    const Row gap = still(frame_.gap_row(frame_.compliant[at]));
    formula.products.emplace_back(0.5 * number(&Model::compliant_stops, i, &CompliantStop::stiffness) * gap, gap);
  }
  for (int i = 0; i < bends(); ++i) add_bend(i, formula);
  return formula;
}

/// c of slope x^2 / 2 + offset x + c in a piece: continuous at the corners, zero at x = 0.
Number Formulas::energy_offset(int i, int here) const {
  const auto index = static_cast<std::size_t>(i);
  const Characteristic& bend = model_.characteristics[index];
  const auto within = [&](int piece, Number x) {
    const mode::Piece line = mode::piece_of(bend, piece),
                      rate =
                          rates_ ? mode::piece_rate(bend, rates_->model.characteristics[index], piece) : mode::Piece{};
    return (Number{0.5 * line.slope, 0.5 * rate.slope} * x + Number{line.offset, rate.offset}) * x;
  };
  const auto corner = [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    return Number{bend.corners[at].at, rates_ ? rates_->model.characteristics[index].corners[at].at : 0.0};
  };
  int zero = 0;  // the piece of x = 0
  while (zero < static_cast<int>(bend.corners.size()) && corner(zero).value < 0.0) ++zero;
  Number c;
  for (int k = zero; k < here; ++k) c += within(k, corner(k)) - within(k + 1, corner(k));
  for (int k = zero; k > here; --k) c += within(k, corner(k - 1)) - within(k - 1, corner(k - 1));
  return c;
}

void Formulas::add_bend(int i, Formula& energy) const {
  const auto index = static_cast<std::size_t>(i);
  const Characteristic& bend = model_.characteristics[index];
  if (bend.over != Characteristic::Over::displacement) return;
  const int here = outline_.states.pieces[index];
  const mode::Piece line = mode::piece_of(bend, here),
                    rate = rates_ ? mode::piece_rate(bend, rates_->model.characteristics[index], here) : mode::Piece{};
  const Row x = difference(bend, false);
  energy.products.emplace_back(Number{0.5 * line.slope, 0.5 * rate.slope} * x, x);
  energy.linear += Number{line.offset, rate.offset} * x;
  energy.linear += energy_offset(i, here) * one();
}

}  // namespace slapstick::quantity
