/// Differentiates frames and outlines by the product rule.
#include "mode/derivative.hpp"

#include <cmath>

#include "base/elementary.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "mode/assembly.hpp"
#include "mode/contact_force.hpp"
#include "mode/held.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::mode {
namespace {

/// The derivatives of the shifts, or of the drifts. Contacts that share a number must agree in its derivative.
class SharedRates {
 public:
  SharedRates(Vector& rates, const char* shared, const char* quantities)
      : rates_(rates), owners_(static_cast<std::size_t>(rates.size())), shared_(shared), quantities_(quantities) {}

  template <class Contact>
  void set(const char* kind, const Contact& contact, const ContactRow& row, double rate) {
    auto& owner = owners_[static_cast<std::size_t>(row.own)];
    const std::string name = kind + (" " + in_quotes(contact.name));
    double& known = rates_[row.own];
    if (owner.empty()) {
      owner = name;
      known = row.sign * rate;
    } else if (std::abs(known - row.sign * rate) > 0x1p-40 * (std::abs(known) + std::abs(rate))) {
      throw InputError(owner + " and " + name + " share one " + shared_ + " because their " + quantities_ +
                       " agree, and the parameter parts them: change both, or start from different " + quantities_);
    }
  }

 private:
  Vector& rates_;
  std::vector<std::string> owners_;
  const char *shared_, *quantities_;
};

/// T (1 / T)', T the period of the clock.
double clock_rate(const Model& model, const Model& rate) { return model.forced() ? rate.omega / model.omega : 0.0; }

Matrix load_rate(const Model& model, const Model& rate, const Frame& frame) {
  Matrix load = Matrix::Zero(frame.n, frame.size());
  for (std::size_t i = 0; i < model.forces.size(); ++i)
    if (model.forces[i].presses < 0) load.row(model.forces[i].coordinate) += drive_rate(model, rate, frame, i);
  return load;
}

/// Fills an OutlineDerivative; the steps are those of Outline, each with its derivative beside it.
class Differentiator {
 public:
  Differentiator(const Model& model, const Model& rate, const Frame& frame, const FrameDerivative& change,
                 const Outline& outline)
      : model_(model),
        rate_(rate),
        frame_(frame),
        change_(change),
        outline_(outline),
        held_(held_pairs(frame, outline.states)),
        acceleration_(frame.free),
        acceleration_rate_(change.free) {}

  [[nodiscard]] Matrix system();
  [[nodiscard]] std::vector<RowVector> guards() const;
  [[nodiscard]] const Matrix& holding() const { return holding_rate_; }

 private:
  void push_away(const ContactRow& contact, const RowVector& force, const RowVector& force_rate);
  void hold();
  void piece(int i, int k);
  [[nodiscard]] RowVector moved(const RowVector& row) const;
  [[nodiscard]] RowVector compliant_rate(const Guard& guard) const;
  [[nodiscard]] RowVector limit_rate(const HeldPair& pair) const;
  [[nodiscard]] RowVector corner_rate(const Guard& guard) const;
  [[nodiscard]] RowVector rate_of(const Guard& guard) const;

  const Model &model_, &rate_;
  const Frame& frame_;
  const FrameDerivative& change_;
  const Outline& outline_;
  std::vector<HeldPair> held_;
  Matrix acceleration_, acceleration_rate_, holding_rate_;
};

/// A force on b along a contact's displacement, the opposite on a.
void Differentiator::push_away(const ContactRow& contact, const RowVector& force, const RowVector& force_rate) {
  const Vector column = contact.sign * frame_.mass_inverse.col(contact.own);
  acceleration_ -= column * force;
  acceleration_rate_ -= column * force_rate + contact.sign * change_.mass_inverse.col(contact.own) * force;
}

/// Of a row over displacements p + shift and velocities u + drift.
RowVector Differentiator::moved(const RowVector& row) const {
  const double change = row.head(frame_.d).dot(change_.shift) + row.segment(frame_.d, frame_.d).dot(change_.drift);
  return change * RowVector::Unit(frame_.size(), frame_.one());
}

/// -push (slope value + offset), push = W M^{-1} (e_a - e_b).
void Differentiator::piece(int i, int k) {
  const Characteristic& one_of = model_.characteristics[i];
  const Piece line = piece_of(one_of, k), rate = piece_rate(one_of, rate_.characteristics[i], k);
  RowVector force_rate = rate.slope * frame_.slope_row(model_, i) + line.slope * moved(frame_.slope_row(model_, i));
  force_rate[frame_.one()] += rate.offset;
  const RowVector force = frame_.force_row(model_, i, k);
  acceleration_ -= frame_.characteristics[i].push * force;
  acceleration_rate_ -= frame_.characteristics[i].push * force_rate + change_.push[static_cast<std::size_t>(i)] * force;
}

/// holding = D^+ G a and a - M^{-1} G^T holding. The range of D is that of G W, a constant one, so that
/// (D^+)' = -D^+ D' D^+ on it, whether or not held contacts depend on each other.
void Differentiator::hold() {
  const Matrix G = selection(held_, frame_.d);
  const Matrix D_inverse = least_norm_inverse(G * frame_.mass_inverse * G.transpose());
  const Matrix D_rate = G * change_.mass_inverse * G.transpose();
  const Matrix holding = D_inverse * (G * acceleration_);
  holding_rate_ = D_inverse * (G * acceleration_rate_ - D_rate * holding);
  acceleration_rate_ -=
      change_.mass_inverse * G.transpose() * holding + frame_.mass_inverse * G.transpose() * holding_rate_;
}

Matrix Differentiator::system() {
  const RowVector one = RowVector::Unit(frame_.size(), frame_.one());
  for (std::size_t i = 0; i < frame_.frictions.size(); ++i) {
    const double s = direction(outline_.states.frictions[i]);
    const int contact = static_cast<int>(i);
    const RowVector load = load_row(model_, frame_, outline_.states, contact),
                    load_change = load_rate(model_, rate_, frame_, change_, outline_.states, contact);
    push_away(frame_.frictions[i], s * model_.frictions[i].kinetic_friction * load,
              s * (rate_.frictions[i].kinetic_friction * load + model_.frictions[i].kinetic_friction * load_change));
  }
  for (std::size_t i = 0; i < frame_.compliant.size(); ++i) {
    const CompliantState state = outline_.states.compliant[i];
    if (state != CompliantState::on && state != CompliantState::bounded) continue;
    const int stop = static_cast<int>(i);
    push_away(frame_.compliant[i], compliant_row(model_, frame_, stop, state),
              compliant_row(rate_, frame_, stop, state));
  }
  for (std::size_t i = 0; i < outline_.states.pieces.size(); ++i) piece(static_cast<int>(i), outline_.states.pieces[i]);
  if (!held_.empty()) hold();
  Matrix A = frame_.kinematics(change_.omega);
  for (std::size_t k = 0; k < frame_.signals.size(); ++k)
    A(frame_.signal(k), frame_.signal(k) + 1) = clock_rate(model_, rate_) / frame_.period;  // of 1 / T
  for (int i = 0; i < frame_.d; ++i) {
    A(i, frame_.u(i)) = 0.0;  // p' = u + drift
    A(i, frame_.one()) = change_.drift[i];
    if (outline_.steady[static_cast<std::size_t>(i)]) acceleration_rate_.row(i).setZero();
  }
  A.middleRows(frame_.d, frame_.d) = acceleration_rate_;
  for (const SliderRow& row : frame_.sliders) {
    A.row(row.own).setZero();
    A.row(frame_.u(row.own)).setZero();
    if (!row.rests(outline_.states.pieces)) A.row(frame_.u(row.own)) = row.pair.sign * A.row(frame_.u(row.pair.own));
  }
  return A;
}

/// Guards of gaps and velocities are single numbers; those of forces change.
std::vector<RowVector> Differentiator::guards() const {
  const std::vector<ForceLimit> limits = force_limits(frame_, held_);
  std::vector<RowVector> rows;
  std::size_t next = 0;
  for (const Guard& guard : outline_.guards) {
    const bool of_force =
        guard.kind == GuardKind::stick_above || guard.kind == GuardKind::stick_below || guard.kind == GuardKind::press;
    if (!of_force) {
      rows.push_back(rate_of(guard));
      continue;
    }
    const ForceLimit& limit = limits[next++];
    rows.push_back(limit.side * holding_rate_.row(static_cast<Eigen::Index>(limit.pair)) +
                   limit_rate(held_[limit.pair]));
  }
  return rows;
}

RowVector Differentiator::rate_of(const Guard& guard) const {
  const RowVector zero = RowVector::Zero(frame_.size());
  switch (guard.kind) {
    case GuardKind::leave:
    case GuardKind::let_go:
    case GuardKind::push:
    case GuardKind::bound:
    case GuardKind::beyond:
      return compliant_rate(guard);
    case GuardKind::corner_above:
    case GuardKind::corner_below:
      return corner_rate(guard);
    case GuardKind::load:
    case GuardKind::unloaded: {
      if (load_row(model_, frame_, outline_.states, guard.contact).isZero(0.0)) return zero;
      const RowVector rate = load_rate(model_, rate_, frame_, change_, outline_.states, guard.contact);
      return guard.kind == GuardKind::load ? rate : RowVector(-rate);
    }
    default:
      return zero;
  }
}

/// Of the sum of f_s, or f_s N, over a pair's friction contacts.
RowVector Differentiator::limit_rate(const HeldPair& pair) const {
  RowVector sum = RowVector::Zero(frame_.size());
  for (int i : pair.frictions)
    sum += rate_.frictions[i].static_friction * load_row(model_, frame_, outline_.states, i) +
           model_.frictions[i].static_friction * load_rate(model_, rate_, frame_, change_, outline_.states, i);
  return sum;
}

RowVector Differentiator::corner_rate(const Guard& guard) const {
  const bool above = guard.kind == GuardKind::corner_above;
  const SliderRow* const slider = frame_.slider(guard.contact);
  if (slider != nullptr && !slider->rests(outline_.states.pieces)) return RowVector::Zero(frame_.size());
  const int k = outline_.states.pieces[guard.contact] - (above ? 0 : 1);
  RowVector row = -moved(frame_.characteristics[static_cast<std::size_t>(guard.contact)].corners[k]);
  row[frame_.one()] += rate_.characteristics[guard.contact].corners[k].at;
  return above ? row : RowVector(-row);
}

RowVector Differentiator::compliant_rate(const Guard& guard) const {
  const RowVector force = frame_.push_row(rate_, guard.contact);
  const RowVector excess =
      -2.0 * rate_.compliant_stops[guard.contact].stiffness * frame_.gap_row(frame_.compliant[guard.contact]) - force;
  if (guard.kind == GuardKind::let_go) return force;
  if (guard.kind == GuardKind::push) return -force;
  if (guard.kind == GuardKind::bound) return excess;
  if (guard.kind == GuardKind::beyond) return -excess;
  const CompliantStop& stop = model_.compliant_stops[guard.contact];
  if (stop.pulls || outline_.states.compliant[guard.contact] != CompliantState::on)
    return RowVector::Zero(frame_.size());
  // delta here, with no damping; (stiffness delta + damping delta') / stiffness as soon as there is some
  return rate_.compliant_stops[guard.contact].damping / stop.stiffness *
         frame_.velocity_row(frame_.compliant[guard.contact]);
}

}  // namespace

Vector kick_rate(const Frame& frame, const FrameDerivative& rate, std::size_t signal, double area, double area_rate) {
  const int column = frame.signal(signal);
  return rate.free.col(column) * area + frame.free.col(column) * area_rate;
}

/// Of amplitude (sin(phase) cos(j theta) + cos(phase) sin(j theta)), and of amplitude times a signal or its slope / T.
RowVector drive_rate(const Model& model, const Model& of_model, const Frame& frame, std::size_t i) {
  const Force &force = model.forces[i], &rate = of_model.forces[i];
  RowVector row = RowVector::Zero(frame.size());
  if (force.signal >= 0) {
    const int value = frame.signal(static_cast<std::size_t>(force.signal));
    if (!force.rate) row[value] = rate.amplitude;
    if (force.rate) row[value + 1] = (rate.amplitude + force.amplitude * clock_rate(model, of_model)) / frame.period;
    return row;
  }
  if (force.harmonic == 0) {
    row[frame.one()] = rate.amplitude;
    return row;
  }
  const auto k = ranges::find(frame.harmonics, force.harmonic) - frame.harmonics.begin();
  const double sine = fixed::sin(force.phase), cosine = fixed::cos(force.phase), turn = force.amplitude * rate.phase;
  row[2 * frame.d + 2 * k] = rate.amplitude * sine + turn * cosine;
  row[2 * frame.d + 2 * k + 1] = rate.amplitude * cosine - turn * sine;
  return row;
}

FrameDerivative::FrameDerivative(const Model& model, const Model& rate, const Frame& frame)
    : shift(Vector::Zero(frame.d)), drift(Vector::Zero(frame.d)), omega(rate.omega) {
  SharedRates shifts(shift, "displacement", "clearances"), drifts(drift, "velocity", "belt speeds");
  const auto own = [&](const char* kind, const auto& stop, const ContactRow& row, double clearance) {
    shifts.set(kind, stop, row, clearance);
    drifts.set(kind, stop, row, 0.0);
  };
  for (std::size_t i = 0; i < model.stops.size(); ++i)
    own("stop", model.stops[i], frame.stops[i], rate.stops[i].clearance);
  for (std::size_t i = 0; i < model.compliant_stops.size(); ++i)
    own("compliant stop", model.compliant_stops[i], frame.compliant[i], rate.compliant_stops[i].clearance);
  for (std::size_t i = 0; i < model.frictions.size(); ++i)
    drifts.set("friction contact", model.frictions[i], frame.frictions[i], rate.frictions[i].belt_speed);
  for (const SliderRow& row : frame.sliders)
    drifts.set("characteristic", model.characteristics[static_cast<std::size_t>(row.characteristic)], row.pair, 0.0);

  // free = W M^{-1} force;  force = load X - C q' - K q,  q = W^{-1} (p + shift),  q' = W^{-1} (u + drift)
  const Eigen::Index n = frame.n;
  const Matrix K = stiffness_matrix(model), C = damping_matrix(model);
  const Matrix K_rate = stiffness_matrix(rate) * frame.W_inverse, C_rate = damping_matrix(rate) * frame.W_inverse;
  Matrix force = load_rate(model, rate, frame);
  force.leftCols(n) -= K_rate;
  force.middleCols(frame.d, n) -= C_rate;
  force.col(frame.one()) -= K_rate * frame.shift.head(n) + K * (frame.W_inverse * shift.head(n));
  force.col(frame.one()) -= C_rate * frame.drift.head(n) + C * (frame.W_inverse * drift.head(n));
  const Matrix W_over_M = frame.W * inverse_mass(model), M_rate = mass_matrix(rate);
  mass_inverse = -W_over_M * M_rate * W_over_M.transpose();
  free = W_over_M * (force - M_rate * (frame.W_inverse * frame.free.topRows(n)));
  for (const InnerRow& row : frame.inner) add_inner(row, K, C, stiffness_matrix(rate), damping_matrix(rate), frame);
  for (const Characteristic& one_of : model.characteristics)
    push.emplace_back(-W_over_M * (M_rate * (inverse_mass(model) * pair_row(frame.n, one_of).transpose())));
}

/// Of row = -(K q)_s / c and settling = 2 k / c, and of what Frame makes of them.
void FrameDerivative::add_inner(const InnerRow& row, const Matrix& K, const Matrix& C, const Matrix& K_rate,
                                const Matrix& C_rate, const Frame& frame) {
  const int i = row.coordinate, n = frame.n;
  const double c = C(i, i), c_rate = C_rate(i, i), faster = 2.0 * (K_rate(i, i) - K(i, i) * c_rate / c) / c;
  RowVector change = RowVector::Zero(frame.size());
  change.head(n) = -(K_rate.row(i) * frame.W_inverse) / c - c_rate / c * row.rate.head(n);
  change[frame.one()] = change.head(n).dot(frame.shift.head(n)) + row.rate.head(n).dot(shift.head(n));
  RowVector acceleration = row.settling * change + faster * row.rate;
  acceleration.segment(frame.d, n) += change.head(n);
  acceleration[frame.one()] += change.head(n).dot(frame.drift.head(n)) + row.rate.head(n).dot(drift.head(n));
  acceleration[frame.u(row.own)] -= faster;
  free.row(row.own) += acceleration;
  inner_rate.push_back(std::move(change));
}

OutlineDerivative::OutlineDerivative(const Model& model, const Model& rate, const Frame& frame,
                                     const FrameDerivative& change, const Outline& outline) {
  Differentiator differentiator(model, rate, frame, change, outline);
  system = differentiator.system();
  guards = differentiator.guards();
  holding = differentiator.holding();
}

}  // namespace slapstick::mode
