#include "property/newton.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace slapstick::test {
namespace {

Eigen::MatrixXd part(const SymmetricMatrix& values, int n) {
  if (values.empty()) return Eigen::MatrixXd::Zero(n, n);
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), n, n);
}

}  // namespace

Newton::Newton(const Model& model) : model_(model) {
  const int n = model.size();
  M_ = part(model.mass, n), C_ = part(model.damping, n), K_ = part(model.stiffness, n);
  for (int i = 0; i < n; ++i) M_(i, i) += model.coordinates[i].mass;
  for (const Spring& s : model.springs) K_.noalias() += s.stiffness * row(s.a, s.b).transpose() * row(s.a, s.b);
  for (const Damper& d : model.dampers) C_.noalias() += d.coefficient * row(d.a, d.b).transpose() * row(d.a, d.b);
  M_inverse_ = M_.inverse();
  for (const Stop& s : model.stops) least_.x = std::max(least_.x, std::abs(s.clearance));
  for (const CompliantStop& s : model.compliant_stops) least_.x = std::max(least_.x, std::abs(s.clearance));
  for (const FrictionContact& f : model.frictions) least_.v = std::max(least_.v, std::abs(f.belt_speed));
}

double Newton::difference(std::span<const double> state, int a, int b, int part) {
  const auto at = [&](int i) { return i == ground ? 0.0 : state[2 * static_cast<std::size_t>(i) + part]; };
  return at(a) - at(b);
}

Eigen::RowVectorXd Newton::row(int a, int b) const {
  Eigen::RowVectorXd g = Eigen::RowVectorXd::Zero(model_.size());
  if (a != ground) g[a] += 1.0;
  if (b != ground) g[b] -= 1.0;
  return g;
}

double Newton::mobility(int a, int b) const { return row(a, b) * M_inverse_ * row(a, b).transpose(); }

Eigen::VectorXd Newton::displacements(std::span<const double> state) {
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(state.data(), state.size() / 2);
}

Eigen::VectorXd Newton::velocities(std::span<const double> state) {
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(state.data() + 1, state.size() / 2);
}

double Newton::energy(std::span<const double> state) const {
  const Eigen::VectorXd x = displacements(state);
  return kinetic(velocities(state)) + 0.5 * x.dot(K_ * x);
}

/// All except the forces of held contacts.
Eigen::VectorXd Newton::force(std::span<const double> state, const mode::ContactStates& contacts, double theta) const {
  const Eigen::VectorXd x = displacements(state), v = velocities(state);
  Eigen::VectorXd total = -K_ * x - C_ * v;
  const auto add = [&](int i, double value) {
    if (i != ground) total[i] += value;
  };
  const auto pull = [&](int a, int b, double value) { add(a, -value), add(b, value); };
  for (const Force& f : model_.forces)
    add(f.coordinate, f.harmonic == 0 ? f.amplitude : f.amplitude * std::sin(f.harmonic * theta + f.phase));
  for (std::size_t i = 0; i < contacts.frictions.size(); ++i) {
    const FrictionContact& f = model_.frictions[i];
    if (contacts.frictions[i] == mode::FrictionState::unloaded) continue;
    pull(f.a, f.b, static_cast<int>(contacts.frictions[i]) * f.kinetic_friction * load(state, contacts, i));
  }
  for (std::size_t i = 0; i < contacts.compliant.size(); ++i)
    pull(model_.compliant_stops[i].a, model_.compliant_stops[i].b, compliant_force(state, contacts, i));
  for (std::size_t i = 0; i < contacts.pieces.size(); ++i)
    pull(model_.characteristics[i].a, model_.characteristics[i].b, bent_force(state, contacts, i));
  return total;
}

/// That of a bounded stop needs no state but its depth.
double Newton::compliant_force(std::span<const double> state, const mode::ContactStates& contacts,
                               std::size_t i) const {
  const CompliantStop& s = model_.compliant_stops[i];
  const double spring = s.stiffness * (difference(state, s.a, s.b, 0) - s.clearance);
  const double damper = s.damping * difference(state, s.a, s.b, 1);
  if (s.bounded && s.damping > 0.0) return spring > 0.0 ? spring + std::clamp(damper, -spring, spring) : 0.0;
  return contacts.compliant[i] == mode::CompliantState::on ? spring + damper : 0.0;
}

/// Of a polyline by its corners, whatever its piece; of zones by the zone, as the force jumps at an edge.
double Newton::bent_force(std::span<const double> state, const mode::ContactStates& contacts, std::size_t i) const {
  const Characteristic& c = model_.characteristics[i];
  const auto& corners = c.corners;
  const double v = difference(state, c.a, c.b, 1);
  if (c.over == Characteristic::Over::zones)
    return v *
           (contacts.pieces[i] == 0 ? c.slope_below : corners[static_cast<std::size_t>(contacts.pieces[i] - 1)].force);
  const double at = c.over == Characteristic::Over::velocity ? v : difference(state, c.a, c.b, 0);
  if (at <= corners.front().at) return corners.front().force + c.slope_below * (at - corners.front().at);
  if (at >= corners.back().at) return corners.back().force + c.slope_above * (at - corners.back().at);
  std::size_t k = 1;
  while (corners[k].at < at) ++k;
  const double part = (at - corners[k - 1].at) / (corners[k].at - corners[k - 1].at);
  return (1.0 - part) * corners[k - 1].force + part * corners[k].force;
}

double Newton::load(std::span<const double> state, const mode::ContactStates& contacts, std::size_t i) const {
  const auto& normal = model_.frictions[i].normal;
  if (!normal) return 1.0;
  double sum = normal->constant;
  for (const NormalForce::Term& term : normal->terms)
    sum += term.stiffness * difference(state, term.coordinate, ground, 0) +
           term.damping * difference(state, term.coordinate, ground, 1);
  const int stop = normal->compliant_stop;
  return stop < 0 ? sum : sum + compliant_force(state, contacts, static_cast<std::size_t>(stop));
}

double Newton::load_size(const Sizes& sizes, std::size_t i) const {
  const auto& normal = model_.frictions[i].normal;
  if (!normal) return 1.0;
  const double x = sizes.x + least_.x, v = sizes.v + least_.v;
  double sum = std::abs(normal->constant);
  for (const NormalForce::Term& term : normal->terms) sum += std::abs(term.stiffness) * x + std::abs(term.damping) * v;
  if (normal->compliant_stop < 0) return sum;
  const CompliantStop& s = model_.compliant_stops[static_cast<std::size_t>(normal->compliant_stop)];
  return sum + 2.0 * (s.stiffness * x + s.damping * v);
}

double Newton::power(std::span<const double> state, const mode::ContactStates& contacts, double theta) const {
  const Eigen::VectorXd v = velocities(state);
  double sum = v.dot(force(state, contacts, theta) + K_ * displacements(state));
  for (const Held& pair : held(state, contacts, theta)) sum += pair.force * pair.belt;
  return sum;
}

std::vector<Newton::Held> Newton::held_pairs(std::span<const double> state, const mode::ContactStates& contacts) const {
  std::vector<Held> pairs;
  const auto pair_of = [&](int a, int b) -> std::pair<Held&, bool> {
    for (Held& p : pairs) {
      if (p.a == a && p.b == b) return {p, false};
      if (p.a == b && p.b == a) return {p, true};
    }
    return {pairs.emplace_back(Held{a, b, 0.0, 0.0, 0.0, false, false, 0.0}), false};
  };
  for (std::size_t i = 0; i < contacts.stops.size(); ++i) {
    if (contacts.stops[i] != mode::StopState::closed) continue;
    const auto [pair, turned] = pair_of(model_.stops[i].a, model_.stops[i].b);
    (turned ? pair.high : pair.low) = true;
  }
  for (std::size_t i = 0; i < contacts.frictions.size(); ++i) {
    const FrictionContact& f = model_.frictions[i];
    if (contacts.frictions[i] != mode::FrictionState::stick) continue;
    const auto [pair, turned] = pair_of(f.a, f.b);
    pair.limit += f.static_friction * load(state, contacts, i);
    pair.belt = turned ? -f.belt_speed : f.belt_speed;
  }
  return pairs;
}

std::vector<Newton::Held> Newton::held(std::span<const double> state, const mode::ContactStates& contacts, double theta,
                                       const Sizes& sizes) const {
  std::vector<Held> pairs = held_pairs(state, contacts);
  const auto k = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd G(k, model_.size());
  for (Eigen::Index i = 0; i < k; ++i) G.row(i) = row(pairs[i].a, pairs[i].b);
  if (k == 0) return {};
  // Of least norm: what dependent pairs do together is the same for all solutions, and so is their power.
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> D(G * M_inverse_ * G.transpose());
  const Eigen::MatrixXd solve = D.pseudoInverse() * G * M_inverse_;
  const Eigen::VectorXd all = solve * force(state, contacts, theta);
  const Eigen::VectorXd size = solve.cwiseAbs() * force_size(sizes);
  for (Eigen::Index i = 0; i < k; ++i) {
    pairs[i].force = -all[i];
    pairs[i].size = D.rank() < k ? INFINITY : size[i];
  }
  return pairs;
}

void Sizes::note(std::span<const double> state) {
  for (std::size_t i = 0; i < state.size(); i += 2) {
    x = std::max(x, std::abs(state[i]));
    v = std::max(v, std::abs(state[i + 1]));
  }
}

Eigen::VectorXd Newton::force_size(const Sizes& sizes) const {
  const int n = model_.size();
  const double x = sizes.x + least_.x, v = sizes.v + least_.v;
  Eigen::VectorXd total =
      K_.cwiseAbs() * Eigen::VectorXd::Constant(n, x) + C_.cwiseAbs() * Eigen::VectorXd::Constant(n, v);
  const auto add = [&](int i, double value) {
    if (i != ground) total[i] += value;
  };
  for (const Force& f : model_.forces) add(f.coordinate, std::abs(f.amplitude));
  for (std::size_t i = 0; i < model_.frictions.size(); ++i) {
    const FrictionContact& f = model_.frictions[i];
    add(f.a, f.static_friction * load_size(sizes, i)), add(f.b, f.static_friction * load_size(sizes, i));
  }
  for (const Characteristic& c : model_.characteristics) {
    const double at = c.over == Characteristic::Over::displacement ? x : v;
    double force = std::max(std::abs(c.slope_below), std::abs(c.slope_above)) * at;
    for (std::size_t k = 0; k < c.corners.size(); ++k) {
      const Characteristic::Corner& corner = c.corners[k];
      if (c.over == Characteristic::Over::zones) {
        force = std::max(force, std::abs(corner.force) * v);
        continue;
      }
      const double slope =
          k == 0 ? 0.0 : std::abs((corner.force - c.corners[k - 1].force) / (corner.at - c.corners[k - 1].at));
      force = std::max(force, std::abs(corner.force) + slope * (at + std::abs(corner.at)));
    }
    add(c.a, force), add(c.b, force);
  }
  for (const CompliantStop& s : model_.compliant_stops) {
    const double force = 2.0 * (s.stiffness * x + s.damping * v);
    add(s.a, force), add(s.b, force);
  }
  return total;
}

double Newton::energy_size(const Sizes& sizes) const {
  const double x = sizes.x + least_.x, v = sizes.v + least_.v;
  return 0.5 * (M_.cwiseAbs().sum() * v * v + K_.cwiseAbs().sum() * x * x);
}

double Newton::acceleration_size(const Sizes& sizes) const {
  return (M_inverse_.cwiseAbs() * force_size(sizes)).maxCoeff();
}

}  // namespace slapstick::test
