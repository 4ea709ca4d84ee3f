#include "property/newton.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
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

/// All but the forces of held contacts.
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
    pull(f.a, f.b, static_cast<int>(contacts.frictions[i]) * f.kinetic_friction);
  }
  for (std::size_t i = 0; i < contacts.compliant.size(); ++i) {
    const CompliantStop& s = model_.compliant_stops[i];
    if (contacts.compliant[i] != mode::CompliantState::on) continue;
    const double delta = difference(state, s.a, s.b, 0) - s.clearance;
    pull(s.a, s.b, s.stiffness * delta + s.damping * difference(state, s.a, s.b, 1));
  }
  return total;
}

double Newton::power(std::span<const double> state, const mode::ContactStates& contacts, double theta) const {
  const Eigen::VectorXd v = velocities(state);
  double sum = v.dot(force(state, contacts, theta) + K_ * displacements(state));
  for (const Held& pair : held(state, contacts, theta)) sum += pair.force * pair.belt;
  return sum;
}

std::vector<Newton::Held> Newton::held_pairs(const mode::ContactStates& contacts) const {
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
    pair.limit += f.static_friction;
    pair.belt = turned ? -f.belt_speed : f.belt_speed;
  }
  return pairs;
}

std::vector<Newton::Held> Newton::held(std::span<const double> state, const mode::ContactStates& contacts, double theta,
                                       const Sizes& sizes) const {
  std::vector<Held> pairs = held_pairs(contacts);
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
  for (const FrictionContact& f : model_.frictions) add(f.a, f.static_friction), add(f.b, f.static_friction);
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
