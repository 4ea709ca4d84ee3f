/// Writes the quantities of coordinates and the energies as polynomials in the extended state; those of contacts are in
/// contact_formula.cpp.
#include "quantity/formula.hpp"

#include "base/elementary.hpp"
#include "base/ranges.hpp"
#include "mode/assembly.hpp"

namespace slapstick::quantity {

using Kind = Quantity::Kind;

/// x = W^{-1} (p + shift)
RowVector Formulas::displacement(int coordinate) const {
  RowVector row = none();
  row.head(frame_.n) = frame_.W_inverse.row(coordinate);
  row[frame_.one()] = frame_.W_inverse.row(coordinate).dot(frame_.shift.head(frame_.n));
  return row;
}

/// v = W^{-1} (u + drift)
RowVector Formulas::velocity(int coordinate) const {
  RowVector row = none();
  row.segment(frame_.d, frame_.n) = frame_.W_inverse.row(coordinate);
  row[frame_.one()] = frame_.W_inverse.row(coordinate).dot(frame_.drift.head(frame_.n));
  return row;
}

/// a = W^{-1} u', u' = A X
RowVector Formulas::acceleration(int coordinate) const {
  return frame_.W_inverse.row(coordinate) * outline_.system.middleRows(frame_.d, frame_.n);
}

/// x_a - x_b, or v_a - v_b
RowVector Formulas::difference(int a, int b, bool velocities) const {
  RowVector row = none();
  if (a != ground) row += velocities ? velocity(a) : displacement(a);
  if (b != ground) row -= velocities ? velocity(b) : displacement(b);
  return row;
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
  for (const Damper& damper : model_.dampers) {
    const RowVector rate = difference(damper.a, damper.b, true);
    formula.products.emplace_back(damper.coefficient * rate, rate);
  }
  for (int i = 0; i < frame_.n && !model_.damping.empty(); ++i) {
    RowVector force = none();
    for (int j = 0; j < frame_.n; ++j)
      force += model_.damping[static_cast<std::size_t>(i * frame_.n + j)] * velocity(j);
    formula.products.emplace_back(velocity(i), force);
  }
  return formula;
}

/// Forces times the velocities that they act on, and the belts: of the force F of a contact -F belt_speed.
Formula Formulas::input(const std::vector<bool>& above) const {
  Formula formula{none()};
  for (const Force& of : model_.forces) {
    formula.products.emplace_back(frame_.drive_row(of), velocity(of.coordinate));
  }
  for (int i = 0; i < frictions(); ++i)
    if (const double belt = model_.frictions[static_cast<std::size_t>(i)].belt_speed; belt != 0.0)
      formula.linear -= belt * force(stops() + i, above);
  return formula;
}

/// v^T M v / 2
Formula Formulas::kinetic() const {
  Formula formula{none()};
  const Matrix M = mode::mass_matrix(model_);
  for (int i = 0; i < frame_.n; ++i) {
    RowVector momentum = none();
    for (int j = 0; j < frame_.n; ++j) momentum += M(i, j) * velocity(j);
    formula.products.emplace_back(0.5 * velocity(i), momentum);
  }
  return formula;
}

/// x^T K x / 2, stiffness delta^2 / 2 of the compliant stops that act, and the integrals of the characteristics over
/// displacements
Formula Formulas::potential() const {
  Formula formula{none()};
  const Matrix K = mode::stiffness_matrix(model_);
  for (int i = 0; i < frame_.n; ++i) {
    RowVector force = none();
    for (int j = 0; j < frame_.n; ++j) force += K(i, j) * displacement(j);
    formula.products.emplace_back(0.5 * displacement(i), force);
  }
  for (int i = 0; i < compliants(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const mode::CompliantState state = outline_.states.compliant[at];
    if (state != mode::CompliantState::on && state != mode::CompliantState::bounded) continue;
    const RowVector gap = frame_.gap_row(frame_.compliant[at]);
    formula.products.emplace_back(0.5 * model_.compliant_stops[at].stiffness * gap, gap);
  }
  for (int i = 0; i < static_cast<int>(model_.characteristics.size()); ++i) add_bend(i, formula);
  return formula;
}

/// slope x^2 / 2 + offset x + c of the piece in force: continuous at the corners, zero at x = 0.
void Formulas::add_bend(int i, Formula& energy) const {
  const Characteristic& bend = model_.characteristics[static_cast<std::size_t>(i)];
  if (bend.over != Characteristic::Over::displacement) return;
  const auto within = [&](int piece, double x) {
    const mode::Piece line = mode::piece_of(bend, piece);
    return (0.5 * line.slope * x + line.offset) * x;
  };
  const int here = outline_.states.pieces[static_cast<std::size_t>(i)];
  int zero = 0;  // the piece of x = 0
  while (zero < static_cast<int>(bend.corners.size()) && bend.corners[static_cast<std::size_t>(zero)].at < 0.0) ++zero;
  double c = 0.0;
  for (int k = zero; k < here; ++k) {
    const double at = bend.corners[static_cast<std::size_t>(k)].at;
    c += within(k, at) - within(k + 1, at);
  }
  for (int k = zero; k > here; --k) {
    const double at = bend.corners[static_cast<std::size_t>(k) - 1].at;
    c += within(k, at) - within(k - 1, at);
  }
  const mode::Piece line = mode::piece_of(bend, here);
  const RowVector x = difference(bend.a, bend.b, false);
  energy.products.emplace_back(0.5 * line.slope * x, x);
  energy.linear += line.offset * x + c * one();
}

}  // namespace slapstick::quantity
