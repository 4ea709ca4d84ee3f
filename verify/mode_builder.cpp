/// Builds the linear system of a combination of contact states, and its conditions.
#include "mode_builder.hpp"

#include <algorithm>

#include "bodies.hpp"

namespace verify {

ModeBuilder::ModeBuilder(Mechanics& mechanics, const ContactStates& states)
    : m_(mechanics), states_(states), acceleration_(mechanics.free_) {}

Mode ModeBuilder::build() {
  const std::size_t d = m_.d();
  slipping();
  springs();
  gather_held();
  if (!held_.empty()) hold();
  mode_.A = zero_matrix(m_.size(), m_.size());
  Bodies bodies(m_.model().n);
  for (const Held& pair : held_) bodies.join(m_.model().numbers[pair.number].pair);
  for (std::size_t i = 0; i < d; ++i) {
    mode_.A[i][d + i] = Ball(1.0);
    mode_.A[i].back() = Ball(m_.model().numbers[i].drift);
    mode_.held.push_back(bodies.joined(m_.model().numbers[i].pair));
    if (!mode_.held[i]) mode_.A[d + i] = acceleration_[i];
  }
  std::vector<Ball> frequencies;
  for (const int j : m_.harmonics_) frequencies.push_back(Ball(static_cast<double>(j)) * Ball(m_.model().omega));
  for (const double frequency : m_.tones_) frequencies.emplace_back(frequency);
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    const std::size_t c = 2 * d + 2 * k;
    mode_.A[c][c + 1] = -frequencies[k];
    mode_.A[c + 1][c] = frequencies[k];
  }
  motion_conditions();
  compliant_conditions();
  force_conditions();
  load_conditions();
  corners();
  return std::move(mode_);
}

Balls ModeBuilder::unit(std::size_t column, double value) const {
  Balls row(m_.size());
  row[column] = Ball(value);
  return row;
}

/// A force pulls the pair of a number together: its effect on all numbers.
void ModeBuilder::push(std::size_t number, const Ball& factor, const Balls& force) {
  for (std::size_t i = 0; i < m_.d(); ++i) add(acceleration_[i], -(factor * m_.inertia()[i][number]), force);
}

void ModeBuilder::slipping() {
  for (std::size_t i = 0; i < states_.slip.size(); ++i) {
    const double kinetic = m_.model().frictions[i].kinetic;
    if (states_.slips(i)) push(m_.friction(i).own, Ball(states_.slip[i] * m_.friction(i).sign * kinetic), load_of(i));
  }
}

/// The normal force of a friction contact: 1 where the model gives forces instead of coefficients.
Balls ModeBuilder::load_of(std::size_t friction) const {
  const auto& normal = m_.model().frictions[friction].normal;
  if (!normal) return unit(m_.size() - 1, 1.0);
  Balls row = unit(m_.size() - 1, normal->constant);
  for (const Normal::Term& term : normal->terms) {
    add(row, Ball(term.stiffness), m_.over_state({term.coordinate, ground}, false));
    add(row, Ball(term.damping), m_.over_state({term.coordinate, ground}, true));
  }
  if (normal->compliant >= 0) add(row, Ball(1.0), acting_force_of(static_cast<std::size_t>(normal->compliant)));
  return row;
}

/// stiffness delta + damping delta'.
Balls ModeBuilder::force_of(std::size_t compliant) const {
  const Compliant& stop = m_.model().compliant[compliant];
  const Place& place = m_.compliant(compliant);
  Balls row(m_.size());
  row[place.own] = Ball(place.sign * stop.stiffness);
  row[m_.d() + place.own] = Ball(place.sign * stop.damping);
  return row;
}

/// stiffness delta - damping delta': what the spring's force is more than the damper's.
Balls ModeBuilder::excess_of_spring(std::size_t compliant) const {
  Balls row = force_of(compliant);
  const std::size_t rate = m_.d() + m_.compliant(compliant).own;
  row[rate] = -row[rate];
  return row;
}

Balls ModeBuilder::acting_force_of(std::size_t compliant) const {
  const ContactStates::Spring state = states_.compliant[compliant];
  if (state == ContactStates::Spring::on) return force_of(compliant);
  Balls row(m_.size());
  if (state == ContactStates::Spring::bounded) {  // 2 stiffness delta
    add(row, Ball(1.0), force_of(compliant));
    add(row, Ball(1.0), excess_of_spring(compliant));
  }
  return row;
}

Balls ModeBuilder::force_of_piece(const Polyline& line, int piece) const {
  if (line.over == Polyline::Over::zones) {
    const double coefficient = piece == 0 ? line.slope_below : line.corners[static_cast<std::size_t>(piece) - 1].force;
    Balls row(m_.size());
    add(row, Ball(coefficient), m_.over_state(line.pair, true));
    return row;
  }
  const auto k = static_cast<std::size_t>(piece > 0 ? piece - 1 : 0);
  const Corner& from = line.corners[k];
  Ball slope(piece == 0 ? line.slope_below : line.slope_above);
  if (piece > 0 && k + 1 < line.corners.size()) {
    const Corner& to = line.corners[k + 1];
    slope = (Ball(to.force) - Ball(from.force)) / (Ball(to.at) - Ball(from.at));
  }
  Balls row(m_.size());
  add(row, slope, m_.over_state(line.pair, line.over == Polyline::Over::velocity));
  row.back() += Ball(from.force) - slope * Ball(from.at);
  return row;
}

void ModeBuilder::springs() {
  for (std::size_t i = 0; i < states_.compliant.size(); ++i)
    push(m_.compliant(i).own, Ball(m_.compliant(i).sign), acting_force_of(i));
  for (std::size_t i = 0; i < states_.pieces.size(); ++i) {
    const Polyline& line = m_.model().polylines[i];
    const Balls force = force_of_piece(line, states_.pieces[i]);
    const Matrix effect = product(m_.W_, product(m_.mass_inverse_, transposed({m_.pair_row(line.pair)})));
    for (std::size_t k = 0; k < m_.d(); ++k) add(acceleration_[k], -effect[k][0], force);
  }
}

ModeBuilder::Held& ModeBuilder::held_pair(std::size_t number) {
  for (Held& pair : held_)
    if (m_.parallel(pair.number, number) != 0.0) return pair;
  return held_.emplace_back(Held{number, {}, {}});
}

void ModeBuilder::gather_held() {
  for (std::size_t i = 0; i < states_.closed.size(); ++i)
    if (states_.closed[i]) held_pair(m_.stop(i).own).stops.push_back(i);
  for (std::size_t i = 0; i < states_.slip.size(); ++i)
    if (states_.slip[i] == 0) held_pair(m_.friction(i).own).frictions.push_back(i);
}

/// The forces of pairs that form a forest hold all; those of the others are then taken into account.
void ModeBuilder::hold() {
  Bodies bodies(m_.model().n);
  std::vector<std::size_t> tree;
  Matrix D, rates;
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (bodies.join(m_.model().numbers[held_[k].number].pair)) tree.push_back(k);
  for (const std::size_t k : tree) {
    D.emplace_back();
    for (const std::size_t l : tree) D.back().push_back(m_.inertia()[held_[k].number][held_[l].number]);
    rates.push_back(acceleration_[held_[k].number]);
  }
  const auto forces = solve(std::move(D), std::move(rates));
  if (!forces) throw Unreadable(m_.line_, "contacts that hold each other have no certain forces");
  force_ = zero_matrix(held_.size(), m_.size());
  for (std::size_t t = 0; t < tree.size(); ++t) {
    force_[tree[t]] = (*forces)[t];
    push(held_[tree[t]].number, Ball(1.0), (*forces)[t]);
  }
  mode_.redundant = tree.size() < held_.size();
  if (mode_.redundant) share_forces(tree);
}

/// Of all forces with the same effect those of least norm: f - Z (Z^T Z)^-1 Z^T f, the columns of Z the loops of pairs.
/// A pair outside of the forest closes one loop, (R R^T) c = R r with the forest's rows R and its own row r.
void ModeBuilder::share_forces(const std::vector<std::size_t>& tree) {
  std::vector<bool> in_tree(held_.size());
  Matrix R, loops;
  for (const std::size_t k : tree) {
    in_tree[k] = true;
    R.push_back(m_.W_[held_[k].number]);
  }
  for (std::size_t e = 0; e < held_.size(); ++e) {
    if (in_tree[e]) continue;
    const auto c = solve(product(R, transposed(R)), product(R, transposed({m_.W_[held_[e].number]})));
    loops.emplace_back(held_.size());
    loops.back()[e] = Ball(1.0);
    for (std::size_t t = 0; c && t < tree.size(); ++t) loops.back()[tree[t]] = -(*c)[t][0];
  }
  const auto excess = solve(product(loops, transposed(loops)), product(loops, force_));
  if (!excess) throw Unreadable(m_.line_, "the forces of a loop of contacts are not certain");
  const Matrix shares = product(transposed(loops), *excess);
  for (std::size_t k = 0; k < held_.size(); ++k) add(force_[k], Ball(-1.0), shares[k]);
}

void ModeBuilder::demand(Condition::Kind kind, std::size_t contact, const std::string& name, Balls row) {
  mode_.conditions.push_back({kind, contact, name, std::move(row)});
}

void ModeBuilder::motion_conditions() {
  for (std::size_t i = 0; i < states_.closed.size(); ++i)
    if (!states_.closed[i])
      demand(Condition::Kind::gap, i, "gap of stop " + m_.model().stops[i].name,
             unit(m_.stop(i).own, -m_.stop(i).sign));
  for (std::size_t i = 0; i < states_.slip.size(); ++i)
    if (states_.slips(i))
      demand(Condition::Kind::slip, i, "slip of friction contact " + m_.model().frictions[i].name,
             unit(m_.d() + m_.friction(i).own, states_.slip[i] * m_.friction(i).sign));
}

/// Off: not beyond the gap. On: beyond it, and pushing unless it may pull, damped by no more than the spring's force if
/// that is the bound. Bounded: the damping force would be more. Detached: beyond the gap, its force would pull.
void ModeBuilder::compliant_conditions() {
  for (std::size_t i = 0; i < states_.compliant.size(); ++i) {
    const Place& place = m_.compliant(i);
    const Compliant& stop = m_.model().compliant[i];
    const std::string name = " of compliant stop " + stop.name;
    if (states_.compliant[i] == ContactStates::Spring::off) {
      demand(Condition::Kind::apart, i, "gap" + name, unit(place.own, -place.sign));
      continue;
    }
    demand(Condition::Kind::beyond, i, "depth" + name, unit(place.own, place.sign));
    Balls force = force_of(i), excess = excess_of_spring(i);
    const bool bounded = states_.compliant[i] == ContactStates::Spring::bounded;
    if (states_.compliant[i] == ContactStates::Spring::detached) {
      for (Ball& x : force) x = -x;
      demand(Condition::Kind::pulls, i, "missing pull" + name, std::move(force));
      continue;
    }
    if (!bounded && stop.lets_go()) demand(Condition::Kind::pushes, i, "push" + name, std::move(force));
    for (Ball& x : excess) x = bounded ? -x : x;
    if (bounded || (stop.law == Compliant::Law::bounded && stop.lets_go()))
      demand(Condition::Kind::bound, i, "bound" + name, std::move(excess));
  }
}

/// Friction bears up to the sum of its limits either way, a closed stop any push on its side.
void ModeBuilder::force_conditions() {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const Held& pair = held_[k];
    bool above = true, below = true;  // is the force along the number limited above, below?
    for (const std::size_t i : pair.stops)
      (m_.stop(i).sign * m_.parallel(m_.stop(i).own, pair.number) > 0.0 ? above : below) = false;
    Balls limit(m_.size());
    for (const std::size_t i : pair.frictions) add(limit, Ball(m_.model().frictions[i].static_limit), load_of(i));
    const bool pressed = !pair.stops.empty();
    const std::string name = pressed ? "push of stop " + m_.model().stops[pair.stops.front()].name
                                     : "hold of friction contact " + m_.model().frictions[pair.frictions.front()].name;
    for (const double side : {1.0, -1.0}) {
      if (!(side > 0.0 ? below : above)) continue;
      Balls row = limit;
      add(row, Ball(side), force_[k]);
      demand(pressed ? Condition::Kind::press : Condition::Kind::stick,
             pressed ? pair.stops.front() : pair.frictions.front(), name, std::move(row));
    }
  }
}

/// Friction with a normal force N acts where N >= 0, and is unloaded where -N >= 0, or where nothing ever presses.
void ModeBuilder::load_conditions() {
  for (std::size_t i = 0; i < states_.slip.size(); ++i) {
    const Friction& friction = m_.model().frictions[i];
    if (!friction.normal) continue;
    const bool loaded = states_.slip[i] != ContactStates::unloaded;
    Balls load = load_of(i);
    if (std::all_of(load.begin(), load.end(), [](const Ball& x) { return x.is_zero(); })) load.back() = Ball(-1.0);
    for (Ball& x : load) x = loaded ? x : -x;
    demand(loaded ? Condition::Kind::load : Condition::Kind::unloaded, i,
           (loaded ? "load of friction contact " : "missing load of friction contact ") + friction.name,
           std::move(load));
  }
}

void ModeBuilder::corners() {
  for (std::size_t i = 0; i < states_.pieces.size(); ++i) {
    const Polyline& line = m_.model().polylines[i];
    const Balls value = m_.over_state(line.pair, line.over == Polyline::Over::velocity);
    const auto piece = static_cast<std::size_t>(states_.pieces[i]);
    const auto away = [&](double sign, double corner) {
      Balls row(m_.size());
      add(row, Ball(sign), value);
      row.back() -= Ball(sign * corner);
      demand(Condition::Kind::corner, i, "corner of polyline " + line.name, std::move(row));
    };
    if (piece < line.corners.size()) away(-1.0, line.corners[piece].at);
    if (piece > 0) away(1.0, line.corners[piece - 1].at);
  }
}

}  // namespace verify
