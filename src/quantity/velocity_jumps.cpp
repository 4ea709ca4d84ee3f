/// Finds the impulses between two pieces of a motion, and keeps the flights between impacts.
#include "quantity/velocity_jumps.hpp"

#include <algorithm>
#include <limits>

namespace slapstick::quantity {
namespace {

constexpr Number unknown{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

}  // namespace

Number value_at(const Quantity& quantity, const Struck& impact) {
  using Kind = Quantity::Kind;
  const bool one_stop = quantity.index >= 0;
  const Since& since = one_stop ? impact.own : impact.any;
  if (one_stop && quantity.index != impact.contact) return unknown;
  if (quantity.kind == Kind::speed) return impact.w;
  if (quantity.kind == Kind::impulse) return impact.impulse;
  if (quantity.kind == Kind::loss) return impact.loss;
  if (quantity.kind == Kind::flight) return since.flight;
  return quantity.kind == Kind::sliding ? since.sliding : unknown;
}

VelocityJumps::VelocityJumps(const Model& model, const mode::Frame& frame, Number period,
                             const std::vector<Quantity>& of, const Rates* rates)
    : model_(model),
      frame_(frame),
      period_(period),
      of_(of),
      rates_(rates),
      marks_(model.stops.size() + model.frictions.size() + model.compliant_stops.size() + 1) {}

void VelocityJumps::impact(int stop, double w, const Moving& before) {
  strike(std::uint32_t{1} << static_cast<unsigned>(stop));
  const auto known =
      std::find_if(impacts_.begin(), impacts_.end(), [&](const Struck& one) { return one.contact == stop; });
  if (known != impacts_.end()) return;
  const RowVector row = frame_.velocity_row(frame_.stops[static_cast<std::size_t>(stop)]);
  impacts_.push_back(meet(stop, {w, rates_ != nullptr ? row.dot(kicked(before, true).by) : 0.0}));
}

void VelocityJumps::begin_flight(int contact, Number time, Number slid) {
  const Mark mark{time, slid_ - slid};
  marks_[static_cast<std::size_t>(contact)] = mark;
  if (!marks_.back() || time.value >= marks_.back()->time.value) marks_.back() = mark;
}

void VelocityJumps::go_on(Number time, Number slid) {
  now_ = time;
  slid_ += slid;
}

/// @param contact  -1: any
Since VelocityJumps::since(int contact) const {
  const auto& mark = contact < 0 ? marks_.back() : marks_[static_cast<std::size_t>(contact)];
  return mark ? Since{(now_ - mark->time) / period_, (slid_ - mark->slid) / period_} : Since{unknown, unknown};
}

/// An impact here and now: it ends a flight and begins one.
Struck VelocityJumps::meet(int contact, Number w) {
  const Struck met{contact, w, {}, {}, since(-1), since(contact)};
  begin_flight(contact, now_, {});
  return met;
}

std::optional<VelocityJump> VelocityJumps::between(const mode::Outline& last, const Moving& before,
                                                   const mode::Outline& next, const Moving& after) {
  VelocityJump jump{now_, std::vector<Number>(of_.size()), {}};
  const bool struck = struck_ != 0 || !pulses_.empty();
  if (struck) {
    const Moving behind = kicked(before, true);
    const Impulses of = impulses(behind, after);
    const bool asked = std::any_of(of_.begin(), of_.end(), [](const Quantity& one) {
      return one.kind == Quantity::Kind::acceleration || one.kind == Quantity::Kind::input;
    });
    std::optional<Formulas> formulas;
    if (asked) formulas.emplace(model_, frame_, last);  // of velocities alone, those of any mode
    for (std::size_t k = 0; k < of_.size(); ++k) {
      jump.impulses[k] = share(of_[k], of_[k].index, of, formulas, before, after);
      if (of_[k].minus >= 0) jump.impulses[k] -= share(of_[k], of_[k].minus, of, formulas, before, after);
    }
    for (Struck& impact : impacts_) {
      const auto i =
          static_cast<std::size_t>(std::find(of.stops.begin(), of.stops.end(), impact.contact) - of.stops.begin());
      impact.impulse = of.P[i];
      impact.loss = of.loss[i];
      if ((chatter_ >> impact.contact & 1U) == 0) continue;
      const auto [impulse, loss] = plastic(impact);
      impact.impulse -= impulse;
      impact.loss -= loss;
    }
    jump.impacts = impacts_;
  }
  if (last.states.compliant != next.states.compliant) {
    let_go(last, next, before, jump);
    engage(last, next, before, jump);
  }
  const bool any = std::any_of(jump.impulses.begin(), jump.impulses.end(), [](Number one) { return one.value != 0.0; });
  const bool happens = struck || any || !jump.impacts.empty();
  forget();
  impacts_.clear();
  return happens ? std::optional(std::move(jump)) : std::nullopt;
}

/// What an impulse of one stop adds to the speed of another.
Matrix VelocityJumps::coupling(const std::vector<int>& stops, const Matrix& mass_inverse) const {
  const auto count = static_cast<Eigen::Index>(stops.size());
  const auto row = [&](Eigen::Index i) {
    return frame_.stops[static_cast<std::size_t>(stops[static_cast<std::size_t>(i)])];
  };
  Matrix D(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) D(i, j) = row(i).sign * row(j).sign * mass_inverse(row(i).own, row(j).own);
  return D;
}

/// Of the stops that were struck: made once for each set of stops.
const Matrix& VelocityJumps::inverse_coupling(const std::vector<int>& stops) {
  for (const auto& [struck, inverse] : inverses_)
    if (struck == struck_) return inverse;
  return inverses_.emplace_back(struck_, mode::least_norm_inverse(coupling(stops, frame_.mass_inverse))).second;
}

/// What the pulses of one kind make of a state. The jumps of a wall's speed come before the impacts that they make.
Moving VelocityJumps::kicked(Moving from, bool kinematic) const {
  for (const auto& [signal, area] : pulses_) {
    const auto k = static_cast<std::size_t>(signal);
    if (model_.signals[k].kinematic != kinematic) continue;
    frame_.kick(k, area.value, from.X.data());
    if (rates_ != nullptr)
      from.by.segment(frame_.d, frame_.d) += mode::kick_rate(frame_, rates_->frame, k, area.value, area.rate);
  }
  return from;
}

/// Of the forces that follow the pulses of one kind: p (v- + v+) / 2, the energy that comes in, also where stops bear
/// the jump.
Number VelocityJumps::work(const Formulas& formulas, const Moving& before, const Moving& after, bool kinematic) const {
  Number sum;
  for (const auto& [signal, area] : pulses_) {
    if (model_.signals[static_cast<std::size_t>(signal)].kinematic != kinematic) continue;
    for (std::size_t i = 0; i < model_.forces.size(); ++i) {
      const Force& force = model_.forces[i];
      if (force.signal != signal) continue;
      const RowVector row = formulas.velocity(force.coordinate).value;
      const double drifts =
          rates_ != nullptr ? frame_.W_inverse.row(force.coordinate).dot(rates_->frame.drift.head(frame_.n)) : 0.0;
      const auto speed = [&](const Moving& at) {
        return Number{row.dot(at.X), rates_ != nullptr ? row.dot(at.by) + drifts : 0.0};
      };
      const Number amplitude{force.amplitude, rates_ != nullptr ? rates_->model.forces[i].amplitude : 0.0};
      sum += 0.5 * amplitude * area * (speed(before) + speed(after));
    }
  }
  return sum;
}

/// M dv = p - sum_i g_i P_i over the stops that were struck, p of the pulses: in contact coordinates dw_i = k_i - sum_j
/// D_ij P_j. Each takes P_i (w_i- + w_i+) / 2. The derivative of P is -D^+ (dw' - k' + D' P).
VelocityJumps::Impulses VelocityJumps::impulses(const Moving& before, const Moving& after) {
  Impulses of;
  for (int i = 0; i < static_cast<int>(model_.stops.size()); ++i)
    if ((struck_ >> static_cast<unsigned>(i) & 1U) != 0) of.stops.push_back(i);
  if (of.stops.empty()) return of;
  const auto count = static_cast<Eigen::Index>(of.stops.size());
  const auto row = [&](Eigen::Index i) {
    return frame_.stops[static_cast<std::size_t>(of.stops[static_cast<std::size_t>(i)])];
  };
  const auto speeds = [&](const Vector& X) {
    Vector w(count);
    for (Eigen::Index i = 0; i < count; ++i) w[i] = row(i).sign * X[frame_.u(row(i).own)];
    return w;
  };
  const Matrix& inverse = inverse_coupling(of.stops);
  const Moving pushed = kicked(before, false);
  const Vector jump = speeds(after.X) - speeds(pushed.X), sum = speeds(after.X) + speeds(before.X);
  const Vector P = -inverse * jump;
  Vector P_rate = Vector::Zero(count), sum_rate = P_rate;
  if (rates_ != nullptr) {
    const Vector w = speeds(before.by), v = speeds(after.by);
    P_rate = -inverse * (v - speeds(pushed.by) + coupling(of.stops, rates_->frame.mass_inverse) * P);
    sum_rate = v + w;
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    of.P.push_back({P[i], P_rate[i]});
    of.loss.push_back(0.5 * of.P.back() * Number{sum[i], sum_rate[i]});
  }
  return of;
}

/// Impulse and loss of the plastic impact that begins the tail of a chatter, behind an impact at w+ = -r w:
///     P = w+ / D < 0,   E = w+^2 / (2 D).
std::pair<Number, Number> VelocityJumps::plastic(const Struck& impact) const {
  const auto at = static_cast<std::size_t>(impact.contact);
  const Rebound law = rebound(model_.stops[at], impact.w.value);
  const double r_rate =
      rates_ != nullptr ? rebound_rate(model_.stops[at], rates_->model.stops[at], impact.w.value) : 0.0;
  const int own = frame_.stops[at].own;
  const Number back{-law.restitution * impact.w.value, -law.rate * impact.w.rate - r_rate * impact.w.value},
      D{frame_.mass_inverse(own, own), rates_ != nullptr ? rates_->frame.mass_inverse(own, own) : 0.0};
  return {back / D, 0.5 * back * back / D};
}

/// The impulse of a quantity of one coordinate or contact.
Number VelocityJumps::share(const Quantity& quantity, int index, const Impulses& of,
                            const std::optional<Formulas>& formulas, const Moving& before, const Moving& after) const {
  if (quantity.kind == Quantity::Kind::acceleration) {
    const RowVector row = formulas->velocity(index).value.segment(frame_.d, frame_.n);
    const auto jump = [&](const Vector& from, const Vector& to) {
      const Vector change = to - from;  // the drift of a belt does not jump
      return row.dot(change.segment(frame_.d, frame_.n));
    };
    return {jump(before.X, after.X), rates_ != nullptr ? jump(before.by, after.by) : 0.0};
  }
  if (quantity.kind == Quantity::Kind::input) {
    const Moving behind = kicked(before, true);
    return work(*formulas, before, behind, true) + work(*formulas, behind, after, false);
  }
  const auto i = static_cast<std::size_t>(std::find(of.stops.begin(), of.stops.end(), index) - of.stops.begin());
  if (i == of.P.size()) return {};
  if (quantity.kind == Quantity::Kind::force) return of.P[i];
  return quantity.kind == Quantity::Kind::power ? of.loss[i] : Number{};
}

/// A compliant stop that lets go beyond its gap takes the energy of its spring; one that pushes again brings it back.
void VelocityJumps::let_go(const mode::Outline& last, const mode::Outline& next, const Moving& before,
                           VelocityJump& jump) const {
  for (std::size_t k = 0; k < of_.size(); ++k) {
    if (of_[k].kind != Quantity::Kind::power) continue;
    const int compliant = of_[k].index - static_cast<int>(model_.stops.size() + model_.frictions.size());
    if (compliant < 0 || compliant >= static_cast<int>(model_.compliant_stops.size())) continue;
    const auto at = static_cast<std::size_t>(compliant);
    const auto detached = [&](const mode::Outline& mode) {
      return mode.states.compliant[at] == mode::CompliantState::detached ? 1.0 : 0.0;
    };
    const double sense = detached(next) - detached(last);
    const int own = frame_.compliant[at].own;
    const Number delta{before.X[own], rates_ != nullptr ? before.by[own] : 0.0},
        stiffness{model_.compliant_stops[at].stiffness,
                  rates_ != nullptr ? rates_->model.compliant_stops[at].stiffness : 0.0};
    jump.impulses[k] += 0.5 * sense * stiffness * delta * delta;
  }
}

/// A compliant stop that is met from its free side, as section/stop_choice.hpp counts them.
void VelocityJumps::engage(const mode::Outline& last, const mode::Outline& next, const Moving& before,
                           VelocityJump& jump) {
  const int first = static_cast<int>(model_.stops.size() + model_.frictions.size());
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i) {
    const bool met =
        last.states.compliant[i] == mode::CompliantState::off && next.states.compliant[i] != mode::CompliantState::off;
    const RowVector row = frame_.velocity_row(frame_.compliant[i]);
    const Number w{met ? row.dot(before.X) : 0.0, rates_ != nullptr ? row.dot(before.by) : 0.0};
    if (!(w.value > 0.0)) continue;
    jump.impacts.push_back(meet(first + static_cast<int>(i), w));
    jump.impacts.back().impulse = jump.impacts.back().loss = unknown;
  }
}

}  // namespace slapstick::quantity
