/// Selects the linear system and the guards of a combination of contact states.
#include "mode/outline.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "mode/contact_force.hpp"
#include "mode/held.hpp"

namespace slapstick::mode {
namespace {

/// Fills an Outline; holds what its parts share.
class Builder {
 public:
  Builder(const Model& model, const Frame& frame, Outline& out)
      : model_(model), frame_(frame), out_(out), d_(frame.d), m_(frame.size()), held_(held_pairs(frame, out.states)) {}

  void select_linear_system();
  void arm_guards();
  void note_guard_structure();

 private:
  void hold(Matrix& acceleration, Matrix& size);
  void note_steady(const Matrix& G);
  void move_sliders();
  void arm_gap(int stop);
  void arm_compliant(int i);
  void arm_corners(int i);
  void arm_load(int friction);

  const Model& model_;
  const Frame& frame_;
  Outline& out_;
  const int d_, m_;
  std::vector<HeldPair> held_;
};

/// Along a displacement the holding force is f0 = -lambda, positive when it pushes a in the -x direction.
void Builder::select_linear_system() {
  Matrix acceleration = frame_.free, size = frame_.free_size;
  for (std::size_t i = 0; i < out_.states.frictions.size(); ++i) {
    const ContactRow& contact = frame_.frictions[i];
    const double force = direction(out_.states.frictions[i]) * model_.frictions[i].kinetic_friction;
    const Vector change = force * contact.sign * frame_.mass_inverse.col(contact.own);
    if (model_.frictions[i].normal) {
      const Matrix loaded = change * load_row(model_, frame_, out_.states, static_cast<int>(i));
      acceleration -= loaded;
      size += loaded.cwiseAbs();
      continue;
    }
    acceleration.col(frame_.one()) -= change;
    size.col(frame_.one()) += change.cwiseAbs();
  }
  for (std::size_t i = 0; i < out_.states.compliant.size(); ++i) {
    const CompliantState state = out_.states.compliant[i];
    if (state != CompliantState::on && state != CompliantState::bounded) continue;
    const ContactRow& contact = frame_.compliant[i];
    const Matrix change =
        contact.sign * frame_.mass_inverse.col(contact.own) * compliant_row(model_, frame_, static_cast<int>(i), state);
    acceleration -= change;
    size += change.cwiseAbs();
  }
  for (std::size_t i = 0; i < out_.states.pieces.size(); ++i) {
    const Matrix change =
        frame_.characteristics[i].push * frame_.force_row(model_, static_cast<int>(i), out_.states.pieces[i]);
    acceleration -= change;
    size += change.cwiseAbs();
  }
  Frame::drop_rounding(acceleration, size);
  if (!held_.empty()) hold(acceleration, size);
  out_.system = frame_.kinematics(model_.omega);
  out_.system_size = out_.system.cwiseAbs();
  out_.system.middleRows(d_, d_) = acceleration;
  out_.system_size.middleRows(d_, d_) = size.cwiseMax(acceleration.cwiseAbs());
  for (int i = 0; i < d_; ++i) {
    if (!out_.steady[i]) continue;
    out_.system.row(d_ + i).setZero();  // exactly
    out_.system_size.row(d_ + i).setZero();
  }
  move_sliders();
}

/// One that rests stays where it is; one that slips goes as its pair does.
void Builder::move_sliders() {
  for (const SliderRow& row : frame_.sliders) {
    const bool rests = row.rests(out_.states.pieces);
    const auto follow = [&](Matrix& of, double sign) {
      of.row(row.own).setZero();
      of.row(d_ + row.own).setZero();
      if (rests) return;
      of(row.own, d_ + row.pair.own) = sign;
      of.row(d_ + row.own) = sign * of.row(d_ + row.pair.own);
    };
    follow(out_.system, row.pair.sign);
    follow(out_.system_size, 1.0);
  }
}

/// Adds the forces that hold the pairs.
void Builder::hold(Matrix& acceleration, Matrix& size) {
  const Matrix G = selection(held_, d_);
  const Matrix D_inverse = least_norm_inverse(G * frame_.mass_inverse * G.transpose());
  const Matrix push = frame_.mass_inverse * G.transpose();
  const Matrix holding_size = D_inverse.cwiseAbs() * (G * size);
  out_.holding = D_inverse * (G * acceleration);
  Frame::drop_rounding(out_.holding, holding_size);
  acceleration -= push * out_.holding;
  size += push.cwiseAbs() * holding_size;
  Frame::drop_rounding(acceleration, size);
  note_steady(G);
}

/// A displacement whose rate follows from the held ones has no acceleration.
void Builder::note_steady(const Matrix& G) {
  const Matrix held = (G * frame_.W).transpose();
  const dense::LeastNorm span(held);
  for (int i = 0; i < d_; ++i) {
    const Vector row = frame_.W.row(i).transpose(), by_held = span.solve(row);
    out_.steady[i] = (held * by_held - row).norm() < 1e-10 * row.norm();
    if (!out_.steady[i]) continue;
    out_.follows.row(i) = by_held.transpose() * G;
    for (const HeldPair& pair : held_) {  // exactly
      const double sign = frame_.parallel(i, pair.displacement);
      if (sign != 0) out_.follows.row(i) = sign * RowVector::Unit(d_, pair.displacement);
    }
  }
}

/// In the order in which events at one instant are handled: gaps, relative velocities, forces.
void Builder::arm_guards() {
  for (std::size_t i = 0; i < out_.states.stops.size(); ++i) {
    if (out_.states.stops[i] == StopState::open) arm_gap(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < out_.states.compliant.size(); ++i) arm_compliant(static_cast<int>(i));
  for (std::size_t i = 0; i < out_.states.frictions.size(); ++i) {
    const double s = direction(out_.states.frictions[i]);
    if (s != 0.0)
      out_.guards.push_back({GuardKind::slip, static_cast<int>(i), s * frame_.velocity_row(frame_.frictions[i])});
  }
  for (const ForceLimit& limit : force_limits(frame_, held_)) {
    const RowVector friction = friction_limit(held_[limit.pair], model_, frame_, out_.states);
    const RowVector f0 = out_.holding.row(static_cast<Eigen::Index>(limit.pair));
    out_.guards.push_back({limit.kind, limit.contact, friction + limit.side * f0});
  }
  for (std::size_t i = 0; i < out_.states.frictions.size(); ++i) {
    if (model_.frictions[i].normal) arm_load(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < out_.states.pieces.size(); ++i) arm_corners(static_cast<int>(i));
}

/// Is N the force of a compliant stop alone, and that stop's own end the end of N? Not of one that pulls: its force is
/// negative before it leaves.
bool ends_with_stop(const Model& model, int friction) {
  const NormalForce& normal = *model.frictions[friction].normal;
  if (normal.compliant_stop < 0 || !normal.terms.empty() || normal.constant != 0.0) return false;
  if (model.is_pressed(friction)) return false;
  const CompliantStop& stop = model.compliant_stops[static_cast<std::size_t>(normal.compliant_stop)];
  return !stop.pulls || stop.damping == 0.0;
}

/// A contact that nothing presses is unloaded. In stick the limits +-f_s N of a contact alone on its pair say that
/// N > 0. Where a stop alone presses, the guard of the stop says it: two guards of one zero would be a tie that
/// rounding decides.
void Builder::arm_load(int friction) {
  const FrictionState state = out_.states.frictions[friction];
  RowVector load = load_row(model_, frame_, out_.states, friction);
  const bool pressed = !load.isZero(0.0);
  if (!pressed) load[frame_.one()] = -1.0;
  if (state == FrictionState::unloaded) return out_.guards.push_back({GuardKind::unloaded, friction, -load});
  if (state == FrictionState::stick && pressed && alone(held_, friction)) return;
  if (pressed && ends_with_stop(model_, friction)) return;
  out_.guards.push_back({GuardKind::load, friction, load});
}

void Builder::arm_compliant(int i) {
  const CompliantState state = out_.states.compliant[i];
  const RowVector gap = frame_.gap_row(frame_.compliant[i]), force = frame_.push_row(model_, i);
  const CompliantStop& stop = model_.compliant_stops[i];
  const bool by_force = !stop.pulls && stop.damping > 0.0;
  const RowVector excess = -2.0 * stop.stiffness * gap - force;  // of the spring force over the damping force
  switch (state) {
    case CompliantState::off:
      out_.guards.push_back({GuardKind::engage, i, gap});
      break;
    case CompliantState::on:
      out_.guards.push_back({by_force ? GuardKind::let_go : GuardKind::leave, i, by_force ? force : RowVector(-gap)});
      if (stop.bounded && by_force) out_.guards.push_back({GuardKind::bound, i, excess});
      break;
    case CompliantState::detached:
      out_.guards.push_back({GuardKind::leave, i, -gap});
      out_.guards.push_back({GuardKind::push, i, -force});
      break;
    case CompliantState::bounded:
      out_.guards.push_back({GuardKind::leave, i, -gap});
      out_.guards.push_back({GuardKind::beyond, i, -excess});
      break;
  }
}

/// The corners on both sides of the piece that is in force.
void Builder::arm_corners(int i) {
  const auto& corners = frame_.characteristics[static_cast<std::size_t>(i)].corners;
  const auto piece = static_cast<std::size_t>(out_.states.pieces[i]);
  if (const SliderRow* const slips = frame_.slider(i); slips != nullptr && piece != 1) {
    const bool above = piece == 0;
    const RowVector velocity = frame_.velocity_row(slips->pair);
    return out_.guards.push_back(
        {above ? GuardKind::corner_above : GuardKind::corner_below, i, (above ? -1.0 : 1.0) * velocity});
  }
  if (piece < corners.size()) out_.guards.push_back({GuardKind::corner_above, i, -corners[piece]});
  if (piece > 0) out_.guards.push_back({GuardKind::corner_below, i, corners[piece - 1]});
}

void Builder::note_guard_structure() {
  const Matrix kinematics = frame_.kinematics(model_.omega);
  for (Guard& guard : out_.guards) {
    for (int i = 0; i < m_; ++i)
      if (guard.row[i] != 0.0) guard.entries.push_back({i, guard.row[i]});
    const bool mechanical =
        guard.row.tail(m_ - 2 * d_).isZero(0.0);  // a phase has the clock's rounding besides its own
    if (mechanical && guard.entries.size() == 1 && !of_crossing(guard.kind)) {  // a corner is not made exactly zero
      guard.single = guard.entries.front().column;
      guard.factor = guard.entries.front().value;
      if (guard.single < d_ && frame_.drift[guard.single] == 0.0) guard.rate = frame_.u(guard.single);
    }
    if (guard.kind != GuardKind::slip) continue;
    for (std::size_t g = 0; g < out_.guards.size(); ++g) {
      if (out_.guards[g].kind != GuardKind::gap) continue;
      const RowVector rate = out_.guards[g].row * kinematics;  // gap' involves no acceleration
      if ((rate + guard.row).isZero(0.0)) guard.falls_with = static_cast<int>(g);
    }
  }
}

/// An open gap needs no guard where it cannot close: constant where its pair is held, growing while its pair slips
/// apart.
void Builder::arm_gap(int stop) {
  const ContactRow& contact = frame_.stops[stop];
  bool on_belt = false;
  for (std::size_t i = 0; i < out_.states.frictions.size(); ++i) {
    if (model_.frictions[i].belt_speed != 0.0) {
      on_belt = on_belt || out_.states.frictions[i] == FrictionState::stick;
      continue;
    }
    const ContactRow& friction = frame_.frictions[i];
    const double same = contact.sign * friction.sign * frame_.parallel(contact.own, friction.own);
    if (same * direction(out_.states.frictions[i]) < 0.0) return;
  }
  if (out_.steady[contact.own] && !on_belt) return;
  out_.guards.push_back({GuardKind::gap, stop, frame_.gap_row(contact)});
}

}  // namespace

std::string_view name(GuardKind kind) {
  constexpr std::string_view words[] = {"gap",  "slip",   "stick",  "stick", "press",    "engage", "leave", "let-go",
                                        "push", "corner", "corner", "load",  "unloaded", "bound",  "beyond"};
  return words[static_cast<int>(kind)];
}

int contact_index(GuardKind guard, int contact, const Model& model) {
  const auto stops = static_cast<int>(model.stops.size()), frictions = static_cast<int>(model.frictions.size());
  if (guard == GuardKind::gap || guard == GuardKind::press) return contact;
  if (of_friction(guard) || of_load(guard)) return stops + contact;
  if (!of_corner(guard)) return stops + frictions + contact;
  return stops + frictions + static_cast<int>(model.compliant_stops.size()) + contact;
}

Outline::Outline(const Model& model, const Frame& frame, ContactStates contact_states)
    : states(std::move(contact_states)),
      steady(static_cast<std::size_t>(frame.d), false),
      follows(Matrix::Zero(frame.d, frame.d)) {
  Builder builder(model, frame, *this);
  builder.select_linear_system();
  builder.arm_guards();
  builder.note_guard_structure();
}

Vector Outline::held_speeds(const Vector& drift) const {
  Matrix speeds = follows * drift - drift;
  Frame::drop_rounding(speeds, follows.cwiseAbs() * drift.cwiseAbs() + drift.cwiseAbs());
  for (std::size_t i = 0; i < steady.size(); ++i)
    if (!steady[i]) speeds(static_cast<Eigen::Index>(i), 0) = 0.0;
  return Vector(speeds);
}

}  // namespace slapstick::mode
