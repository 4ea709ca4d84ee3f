#include "slapstick/mode/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slapstick::mode {
namespace {

/// Row over q of x_a - x_b.
RowVector pair_row(int n, int a, int b) {
  RowVector row = RowVector::Zero(n);
  if (a != ground) row[a] += 1.0;
  if (b != ground) row[b] -= 1.0;
  return row;
}

/// Adds coefficient * row^T row to a matrix: the stiffness or damping of one element.
void add_element(Matrix& matrix, int a, int b, double coefficient) {
  const RowVector row = pair_row(static_cast<int>(matrix.rows()), a, b);
  matrix += coefficient * row.transpose() * row;
}

/// Appends `row` to the basis if it is independent of the rows already there; returns its index or -1.
int extend(std::vector<RowVector>& basis, const RowVector& row) {
  Matrix trial(static_cast<Eigen::Index>(basis.size()) + 1, row.size());
  for (std::size_t i = 0; i < basis.size(); ++i) trial.row(static_cast<Eigen::Index>(i)) = basis[i];
  trial.row(trial.rows() - 1) = row;
  if (Eigen::FullPivLU<Matrix>(trial).rank() < trial.rows()) return -1;
  basis.push_back(row);
  return static_cast<int>(basis.size()) - 1;
}

/// Contact rows first, then unit rows from the last coordinate to the first.
Matrix contact_basis(const Model& model, std::vector<ContactRow>& stops, std::vector<ContactRow>& frictions) {
  const int n = model.size();
  std::vector<RowVector> basis;
  for (const Stop& stop : model.stops) {
    const RowVector row = pair_row(n, stop.a, stop.b);
    stops.push_back({row, extend(basis, row)});
  }
  for (const FrictionContact& contact : model.frictions) {
    const RowVector row = pair_row(n, contact.a, contact.b);
    frictions.push_back({row, extend(basis, row)});
  }
  for (int i = n - 1; i >= 0 && static_cast<int>(basis.size()) < n; --i) extend(basis, RowVector::Unit(n, i));
  Matrix W(n, n);
  for (int i = 0; i < n; ++i) W.row(i) = basis[i];
  return W;
}

}  // namespace

Frame::Frame(const Model& model) : n(model.size()) {
  for (const Force& force : model.forces) {
    if (force.harmonic > 0 && std::ranges::find(harmonics, force.harmonic) == harmonics.end())
      harmonics.push_back(force.harmonic);
  }
  std::ranges::sort(harmonics);
  W = contact_basis(model, stops, frictions);
  W_inverse = W.inverse();
  for (ContactRow& contact : stops) contact.row = contact.row * W_inverse;
  for (ContactRow& contact : frictions) contact.row = contact.row * W_inverse;
  shift = drift = Vector::Zero(n);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (stops[i].own >= 0) shift[stops[i].own] = model.stops[i].clearance;
  }
  for (std::size_t i = 0; i < frictions.size(); ++i) {
    if (frictions[i].own >= 0) drift[frictions[i].own] = model.frictions[i].belt_speed;
  }

  Matrix C = Matrix::Zero(n, n), K = Matrix::Zero(n, n), load = Matrix::Zero(n, size());
  Vector inverse_masses(n);
  for (int i = 0; i < n; ++i) inverse_masses[i] = 1.0 / model.coordinates[i].mass;
  for (const Spring& spring : model.springs) add_element(K, spring.a, spring.b, spring.stiffness);
  for (const Damper& damper : model.dampers) add_element(C, damper.a, damper.b, damper.coefficient);
  for (const Force& force : model.forces) {
    if (force.harmonic == 0) {
      load(force.coordinate, one()) += force.amplitude;
      continue;
    }
    const auto k = std::ranges::find(harmonics, force.harmonic) - harmonics.begin();
    // sin(j theta + phase) = sin(phase) cos(j theta) + cos(phase) sin(j theta)
    load(force.coordinate, 2 * n + 2 * k) += force.amplitude * std::sin(force.phase);
    load(force.coordinate, 2 * n + 2 * k + 1) += force.amplitude * std::cos(force.phase);
  }

  // q'' = M^{-1} (load X - C q' - K q),  q = W^{-1} (p + shift),  q' = W^{-1} (u + drift),  u' = W q''
  mass_inverse = W * inverse_masses.asDiagonal() * W.transpose();
  Matrix force = load;
  force.leftCols(n) -= K * W_inverse;
  force.middleCols(n, n) -= C * W_inverse;
  force.col(one()) -= K * W_inverse * shift + C * W_inverse * drift;
  free = W * inverse_masses.asDiagonal() * force;
}

RowVector Frame::velocity_row(const ContactRow& contact, double speed) const {
  RowVector row = RowVector::Zero(size());
  row.segment(n, n) = contact.row;
  row[one()] = contact.row.dot(drift) - speed;
  return row;
}

RowVector Frame::gap_row(const ContactRow& contact, double clearance) const {
  RowVector row = RowVector::Zero(size());
  row.head(n) = -contact.row;
  row[one()] = contact.own >= 0 ? 0.0 : clearance - contact.row.dot(shift);
  return row;
}

Matrix Frame::kinematics(double omega) const {
  Matrix A = Matrix::Zero(size(), size());
  for (int i = 0; i < n; ++i) {
    A(i, u(i)) = 1.0;
    A(i, one()) = drift[i];
  }
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(2 * n + 2 * k);
    A(c, c + 1) = -harmonics[k] * omega;
    A(c + 1, c) = harmonics[k] * omega;
  }
  return A;
}

void Frame::enter(const double* state, double* X) const {
  for (int i = 0; i < n; ++i) {
    double p = 0.0, rate = 0.0, size = std::abs(shift[i]);
    for (int j = 0; j < n; ++j) {
      p += W(i, j) * state[2 * j];
      rate += W(i, j) * state[2 * j + 1];
      size += std::abs(W(i, j) * state[2 * j]);
    }
    X[i] = p - shift[i];
    // A gap below the rounding of the coordinates it comes from is contact: a state written out on a closed stop reads back as one.
    if (shift[i] != 0.0 && std::abs(X[i]) <= 0x1p-51 * size) X[i] = 0.0;
    X[u(i)] = rate - drift[i];
  }
}

void Frame::set_phase(double fraction, double* X) const {
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    double turns = harmonics[k] * fraction;
    turns -= std::floor(turns);
    // Octant reduction in turns is exact: sin and cos are called with an angle of at most pi / 4.
    const double octant = std::nearbyint(4.0 * turns);
    const double angle = 2.0 * std::numbers::pi * (turns - 0.25 * octant);
    const double c = std::cos(angle), s = std::sin(angle);
    const int quadrant = static_cast<int>(octant) & 3;
    const double cosine = quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
    const double sine = quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
    X[2 * n + 2 * k] = cosine;
    X[2 * n + 2 * k + 1] = sine;
  }
  X[one()] = 1.0;
}

void Frame::leave(const double* X, double* state) const {
  for (int i = 0; i < n; ++i) {
    double q = 0.0, rate = 0.0;
    for (int j = 0; j < n; ++j) {
      q += W_inverse(i, j) * (X[j] + shift[j]);
      rate += W_inverse(i, j) * (X[u(j)] + drift[j]);
    }
    state[2 * i] = q;
    state[2 * i + 1] = rate;
  }
}

}  // namespace slapstick::mode
