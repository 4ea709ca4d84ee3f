/// Writes compliant forces and normal forces as rows over X.
#include "mode/contact_force.hpp"

#include "mode/derivative.hpp"

namespace slapstick::mode {
namespace {

/// The factors of the displacements and of the velocities of a normal force, over p and u: q = W^{-1} (p + shift).
struct Factors {
  RowVector displacement, velocity;
};

Factors factors_of(const NormalForce& normal, const Frame& frame) {
  RowVector k = RowVector::Zero(frame.n), c = RowVector::Zero(frame.n);
  for (const NormalForce::Term& term : normal.terms) {
    k[term.coordinate] += term.stiffness;
    c[term.coordinate] += term.damping;
  }
  const auto over_contacts = [&](const RowVector& row) {
    Matrix product = row * frame.W_inverse;
    Frame::drop_rounding(product, row.cwiseAbs() * frame.W_inverse.cwiseAbs());
    return RowVector(product);
  };
  return {over_contacts(k), over_contacts(c)};
}

/// The terms of a normal force, with the frame's shifts and drifts.
RowVector linear_row(const NormalForce& normal, const Frame& frame) {
  const auto [k, c] = factors_of(normal, frame);
  RowVector row = RowVector::Zero(frame.size());
  row.head(frame.n) = k;
  row.segment(frame.d, frame.n) = c;
  row[frame.one()] = normal.constant + k.dot(frame.shift.head(frame.n)) + c.dot(frame.drift.head(frame.n));
  return row;
}

}  // namespace

RowVector compliant_row(const Model& model, const Frame& frame, int i, CompliantState state) {
  if (state == CompliantState::on) return frame.push_row(model, i);
  if (state == CompliantState::bounded)
    return -2.0 * model.compliant_stops[i].stiffness * frame.gap_row(frame.compliant[i]);
  return RowVector::Zero(frame.size());
}

RowVector load_row(const Model& model, const Frame& frame, const ContactStates& states, int i) {
  const auto& normal = model.frictions[i].normal;
  if (!normal) return RowVector::Unit(frame.size(), frame.one());
  RowVector row = linear_row(*normal, frame);
  for (const Force& force : model.forces)
    if (force.presses == i) row += frame.drive_row(force);
  const int stop = normal->compliant_stop;
  return stop < 0 ? row : RowVector(row + compliant_row(model, frame, stop, states.compliant[stop]));
}

RowVector load_rate(const Model& model, const Model& rate, const Frame& frame, const FrameDerivative& change,
                    const ContactStates& states, int i) {
  const auto& normal = model.frictions[i].normal;
  if (!normal) return RowVector::Zero(frame.size());
  const auto [k, c] = factors_of(*normal, frame);
  RowVector row = linear_row(*rate.frictions[i].normal, frame);
  for (std::size_t j = 0; j < model.forces.size(); ++j)
    if (model.forces[j].presses == i) row += drive_rate(model, rate, frame, j);
  const int stop = normal->compliant_stop;
  if (stop >= 0) row += compliant_row(rate, frame, stop, states.compliant[stop]);
  row[frame.one()] += k.dot(change.shift.head(frame.n)) + c.dot(change.drift.head(frame.n));
  return row;
}

}  // namespace slapstick::mode
