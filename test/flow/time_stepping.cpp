#include "flow/time_stepping.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick::test {

using Eigen::VectorXd;

TimeStepping::Row TimeStepping::row(int a, int b) const {
  VectorXd g = VectorXd::Zero(inverse_mass_.size());
  if (a != ground) g[a] += 1.0;
  if (b != ground) g[b] -= 1.0;
  const VectorXd M_inverse_g = inverse_mass_.cwiseProduct(g);
  return {g, M_inverse_g, g.dot(M_inverse_g)};
}

TimeStepping::TimeStepping(const Model& model) : model_(model), inverse_mass_(model.size()) {
  const int n = model.size();
  for (int i = 0; i < n; ++i) inverse_mass_[i] = 1.0 / model.coordinates[i].mass;
  C_ = K_ = Eigen::MatrixXd::Zero(n, n);
  for (const Spring& s : model.springs) {
    const Row r = row(s.a, s.b);
    K_ += s.stiffness * r.g * r.g.transpose();
  }
  for (const Damper& d : model.dampers) {
    const Row r = row(d.a, d.b);
    C_ += d.coefficient * r.g * r.g.transpose();
  }
  for (const Stop& s : model.stops) {
    stops_.push_back(row(s.a, s.b));
    stops_.back().clearance = s.clearance;
    stops_.back().restitution = s.restitution;
  }
  for (const FrictionContact& f : model.frictions) {
    frictions_.push_back(row(f.a, f.b));
    frictions_.back().friction = f.kinetic_friction;
  }
}

void TimeStepping::contact_impulses(const VectorXd& middle, const VectorXd& before, double h, VectorXd& v) const {
  std::vector<double> P(stops_.size(), 0.0), F(frictions_.size(), 0.0);
  for (int sweep = 0; sweep < 400; ++sweep) {
    double change = 0.0;
    const auto apply = [&](const Row& r, double& impulse, double wanted) {
      v -= (wanted - impulse) * r.M_inverse_g;
      change = std::max(change, std::abs(wanted - impulse));
      impulse = wanted;
    };
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      const Row& r = stops_[i];
      if (r.g.dot(middle) < r.clearance) continue;
      const double excess = r.g.dot(v) + r.restitution * std::max(r.g.dot(before), 0.0);
      apply(r, P[i], std::max(P[i] + excess / r.mobility, 0.0));
    }
    for (std::size_t i = 0; i < frictions_.size(); ++i) {
      const Row& r = frictions_[i];
      apply(r, F[i], std::clamp(F[i] + r.g.dot(v) / r.mobility, -h * r.friction, h * r.friction));
    }
    if (change < 1e-15) return;
  }
}

VectorXd TimeStepping::positions(const State& start, double h, long steps) const {
  const int n = model_.size();
  VectorXd q(n), v(n);
  for (int i = 0; i < n; ++i) q[i] = start[2 * i], v[i] = start[2 * i + 1];
  for (long k = 0; k < steps; ++k) {
    const double t = (static_cast<double>(k) + 0.5) * h;
    const VectorXd middle = q + 0.5 * h * v;
    VectorXd force = -C_ * v - K_ * middle;
    for (const Force& f : model_.forces)
      force[f.coordinate] +=
          f.harmonic == 0 ? f.amplitude : f.amplitude * std::sin(f.harmonic * model_.omega * t + f.phase);
    const VectorXd before = v;
    v += h * inverse_mass_.cwiseProduct(force);
    contact_impulses(middle, before, h, v);
    q = middle + 0.5 * h * v;
  }
  return q;
}

}  // namespace slapstick::test
