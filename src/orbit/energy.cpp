/// Integrates the powers of a cycle: where its energy comes from and goes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/dense.hpp"
#include "base/elementary.hpp"
#include "base/ranges.hpp"
#include "mode/contact_force.hpp"
#include "orbit/equations.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::VectorXd;
using mode::GuardKind;

/// Nodes and weights of Gauss and Legendre on [-1, 1], eight points; exact to degree 15.
constexpr std::array<double, 4> gauss_nodes = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                               0.9602898564975363};
constexpr std::array<double, 4> gauss_weights = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                 0.1012285362903763};

class Account {
 public:
  Account(const ModeSet& set, Energy& energy) : set_(set), frame_(set.frame()), model_(set.model()), energy_(energy) {
    energy_.friction.assign(model_.frictions.size(), 0.0);
    energy_.impacts.assign(model_.stops.size(), 0.0);
  }

  void leg(const Leg& leg, const VectorXd& x, double t_begin, double t_end);
  void end(const Leg& leg, const LegValue& value);

 private:
  void powers(const ModeRates& mode, const VectorXd& X, double weight);
  void friction_power(const ModeRates& mode, std::size_t i, const VectorXd& X, double weight);
  [[nodiscard]] VectorXd velocity(const VectorXd& u) const {
    return frame_.W_inverse * (u + frame_.drift.head(frame_.n));
  }
  [[nodiscard]] double kinetic(const VectorXd& u) const;

  const ModeSet& set_;
  const mode::Frame& frame_;
  const Model& model_;
  Energy& energy_;
};

double Account::kinetic(const VectorXd& u) const {
  // M = W^T (W M^{-1} W^T)^{-1} W of the independent displacements
  const VectorXd w = u + frame_.drift.head(frame_.n);
  return 0.5 * w.dot(dense::solve_definite(frame_.mass_inverse.topLeftCorner(frame_.n, frame_.n), w));
}

/// Power of everything at one instant, by weight.
void Account::powers(const ModeRates& mode, const VectorXd& X, double weight) {
  const VectorXd v = velocity(X.segment(frame_.d, frame_.n));
  const auto rate = [&](int a, int b) { return (a == ground ? 0.0 : v[a]) - (b == ground ? 0.0 : v[b]); };
  for (const Force& force : model_.forces) {
    double size = force.amplitude;
    if (force.harmonic > 0) {
      const auto k = ranges::find(frame_.harmonics, force.harmonic) - frame_.harmonics.begin();
      size *= fixed::sin(force.phase) * X[2 * frame_.d + 2 * k] + fixed::cos(force.phase) * X[2 * frame_.d + 2 * k + 1];
    }
    energy_.input += weight * size * v[force.coordinate];
  }
  for (const Damper& damper : model_.dampers)
    energy_.damping += weight * damper.coefficient * rate(damper.a, damper.b) * rate(damper.a, damper.b);
  if (!model_.damping.empty()) {
    const Eigen::Map<const mode::Matrix> C(model_.damping.data(), frame_.n, frame_.n);
    energy_.damping += weight * v.dot(C * v);
  }
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i) {
    const mode::CompliantState state = mode.outline.states.compliant[i];
    const CompliantStop& stop = model_.compliant_stops[i];
    const double speed = rate(stop.a, stop.b);
    if (state == mode::CompliantState::on) energy_.damping += weight * stop.damping * speed * speed;
    if (state == mode::CompliantState::bounded)  // as much as the spring's force
      energy_.damping += weight * stop.stiffness * -frame_.gap_row(frame_.compliant[i]).dot(X) * speed;
  }
  for (std::size_t i = 0; i < model_.characteristics.size(); ++i) {
    const Characteristic& one_of = model_.characteristics[i];
    if (one_of.over == Characteristic::Over::displacement) continue;
    const mode::RowVector force = frame_.force_row(model_, static_cast<int>(i), mode.outline.states.pieces[i]);
    energy_.damping += weight * force.dot(X) * rate(one_of.a, one_of.b);
  }
  for (std::size_t i = 0; i < model_.frictions.size(); ++i) friction_power(mode, i, X, weight);
}

/// Friction takes f_k |w|; what a belt drives it with is input.
void Account::friction_power(const ModeRates& mode, std::size_t i, const VectorXd& X, double weight) {
  const FrictionContact& contact = model_.frictions[i];
  const auto state = mode.outline.states.frictions[i];
  if (state == mode::FrictionState::unloaded) return;
  const double load = load_row(model_, frame_, mode.outline.states, static_cast<int>(i)).dot(X);
  const double w = frame_.frictions[i].sign * X[frame_.u(frame_.frictions[i].own)];
  double force = -static_cast<double>(state) * contact.kinetic_friction * load;  // on a
  if (state == mode::FrictionState::stick && contact.belt_speed != 0.0) {
    const std::size_t g = mode.guard(GuardKind::stick_above, static_cast<int>(i));  // f_s - f0, f0 against a
    force = mode.outline.guards[g].row.dot(X) - contact.static_friction * load;
  }
  if (state != mode::FrictionState::stick) energy_.friction[i] += weight * contact.kinetic_friction * load * std::abs(w);
  energy_.input += weight * force * contact.belt_speed;
}

/// What the impacts of a leg's end take, and the spring energy of a compliant stop that is let go beyond its gap; one
/// that pushes again there brings the energy back.
void Account::end(const Leg& leg, const LegValue& value) {
  const VectorXd X = value.X_end.value();
  if (!leg.strikes.empty()) {
    const double lost = kinetic(X.segment(frame_.d, frame_.n)) - kinetic(value.after.value().tail(frame_.n));
    energy_.impacts[static_cast<std::size_t>(std::countr_zero(leg.strikes.front().stops))] += lost;
  }
  if (leg.ending == Ending::guard && (leg.kind == GuardKind::let_go || leg.kind == GuardKind::push)) {
    const mode::ContactRow& own = frame_.compliant[leg.contact];
    const double sign = leg.kind == GuardKind::let_go ? 1.0 : -1.0;
    energy_.damping += sign * 0.5 * model_.compliant_stops[leg.contact].stiffness * X[own.own] * X[own.own];
  }
}

void Account::leg(const Leg& leg, const VectorXd& x, double t_begin, double t_end) {
  const ModeRates& mode = set_.mode(leg.states);
  const Jet begin = leg_start(set_, leg, x, t_begin);
  if (leg.ending == Ending::chatter)
    energy_.impacts[static_cast<std::size_t>(leg.contact)] +=
        kinetic(x.tail(frame_.n)) - kinetic(begin.value().segment(frame_.d, frame_.n));
  const double s = (t_end - t_begin) * set_.period();
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(s) / mode.longest_step)));
  const double half = 0.5 * s / count;
  for (int i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 2 * gauss_nodes.size(); ++k) {
      const double node = k < gauss_nodes.size() ? gauss_nodes[k] : -gauss_nodes[k - gauss_nodes.size()];
      Jet X(begin.all.rows(), 0, 0);
      X.value() = begin.value();
      flow(mode, (2.0 * i + 1.0 + node) * half, X);
      powers(mode, X.value(), gauss_weights[k % gauss_nodes.size()] * half);
    }
  }
}

}  // namespace

double Energy::balance() const {
  double rest = input - damping;
  for (double lost : friction) rest -= lost;
  for (double lost : impacts) rest -= lost;
  return rest;
}

Energy energy(const Problem& problem, const Orbit& orbit) {
  const ModeSet set(problem.family(), orbit.values);
  Energy total;
  Account account(set, total);
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const Leg& leg = orbit.shape.legs[i];
    account.leg(leg, orbit.x[i], orbit.t[i], orbit.t[i + 1]);
    const Leg& next = orbit.shape.legs[(i + 1) % orbit.legs()];
    account.end(leg, leg_value(set, leg, next, orbit.x[i], orbit.t[i], orbit.t[i + 1]));
  }
  return total;
}

}  // namespace slapstick::orbit
