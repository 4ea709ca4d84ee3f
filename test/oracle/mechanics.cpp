#include "oracle/mechanics.hpp"

#include <cmath>
#include <stdexcept>

namespace slapstick::oracle {

Mechanics::Mechanics(const Model& model) : model_(model) {
  if (model.stops.size() > 1 || model.frictions.size() > 1)
    throw std::invalid_argument("oracle: at most one stop and one friction contact");
  for (const Coordinate& c : model.coordinates) inverse_mass_.push_back(1 / Real(c.mass));
  bool forced = false;
  for (const Force& f : model.forces) forced = forced || f.harmonic > 0;
  period_ = forced ? 2 * pi() / Real(model.omega) : Real(1);
  longest_step_ = Real("0.9") / rate_bound();
  if (has_friction()) friction_row_ = {friction().a, friction().b};
  if (has_stop()) stop_row_ = {stop().a, stop().b};
  if (!has_friction() || !has_stop()) return;
  coupling_ = mobility(friction_row_, stop_row_);
  if (friction().belt_speed != 0) return;
  if (friction_row_.a == stop_row_.a && friction_row_.b == stop_row_.b) merged_sign_ = 1;
  if (friction_row_.a == stop_row_.b && friction_row_.b == stop_row_.a) merged_sign_ = -1;
}

// Frobenius norms of M^-1/2 K M^-1/2 and M^-1/2 C M^-1/2 do not grow under constraints, which are orthogonal
// projections there.
Real Mechanics::rate_bound() const {
  const auto norm = [&](auto&& elements, auto&& weight) {
    std::vector<Vector> matrix(inverse_mass_.size(), Vector(inverse_mass_.size()));
    const auto add = [&](int i, int j, const Real& value) {
      if (i != ground && j != ground) matrix[i][j] += value * sqrt(inverse_mass_[i] * inverse_mass_[j]);
    };
    for (const auto& e : elements) {
      const Real c(weight(e));
      add(e.a, e.a, c), add(e.b, e.b, c), add(e.a, e.b, -c), add(e.b, e.a, -c);
    }
    Real sum = 0;
    for (const Vector& row : matrix)
      for (const Real& c : row) sum += c * c;
    return sqrt(sum);
  };
  Real rate = sqrt(norm(model_.springs, [](const Spring& s) { return s.stiffness; })) +
              norm(model_.dampers, [](const Damper& d) { return d.coefficient; });
  int harmonic = 0;
  for (const Force& f : model_.forces) harmonic = std::max(harmonic, f.harmonic);
  rate += harmonic * Real(model_.omega);
  return rate > 0 ? rate : Real(1);
}

int Mechanics::order(const Real& step) const {
  const double z = (step / longest_step_).convert_to<double>() * 0.9;
  double remainder = z;
  int n = 1;
  while (remainder > 1e-54 || n < 6) remainder *= z / ++n;  // z^n / n!
  return n;
}

Real Mechanics::difference(const Row& row, const Vector& q) const {
  return (row.a == ground ? Real(0) : q[row.a]) - (row.b == ground ? Real(0) : q[row.b]);
}

void Mechanics::push(const Row& row, const Real& force, Vector& q) const {
  if (row.a != ground) q[row.a] += inverse_mass_[row.a] * force;
  if (row.b != ground) q[row.b] -= inverse_mass_[row.b] * force;
}

Real Mechanics::mobility(const Row& p, const Row& q) const {
  Vector column(inverse_mass_.size());
  push(q, Real(1), column);
  return difference(p, column);
}

Real Mechanics::gap(const Vector& x) const { return Real(stop().clearance) - difference(stop_row_, x); }
Real Mechanics::closing_velocity(const Vector& v) const { return difference(stop_row_, v); }
Real Mechanics::slip_velocity(const Vector& v) const {
  return difference(friction_row_, v) - Real(friction().belt_speed);
}

Mechanics::Difference Mechanics::gap_series(const Jet& jet) const {
  Difference d{Vector(jet.x.front().size()), jet.force_scale * mobility(stop_row_, stop_row_) * jet.step * jet.step};
  for (std::size_t k = 1; k < d.coefficients.size(); ++k)
    for (const int i : {stop_row_.a, stop_row_.b}) {
      if (i == ground) continue;
      d.coefficients[k] -= i == stop_row_.a ? jet.x[i][k] : -jet.x[i][k];
      d.scale += abs(jet.x[i][k]);
    }
  return d;
}

Mechanics::Difference Mechanics::slip_series(const Jet& jet) const {
  Difference d{Vector(jet.v.front().size()), jet.force_scale * mobility(friction_row_, friction_row_) * jet.step};
  d.coefficients[0] = -Real(friction().belt_speed);
  for (std::size_t k = 0; k < d.coefficients.size(); ++k)
    for (const int i : {friction_row_.a, friction_row_.b}) {
      if (i == ground) continue;
      d.coefficients[k] += i == friction_row_.a ? jet.v[i][k] : -jet.v[i][k];
      d.scale += abs(jet.v[i][k]);
    }
  return d;
}

// The order is fixed: the stop's row first; a merged friction contact adds no row.
std::vector<Mechanics::Row> Mechanics::constraints(const Mode& mode) const {
  std::vector<Row> rows;
  if (has_stop() && mode.closed) rows.push_back(stop_row_);
  if (has_friction() && mode.friction == 0 && !(mode.closed && merged_sign_ != 0)) rows.push_back(friction_row_);
  return rows;
}

/// lambda with (R M^-1 R^T) lambda = target, for one or two rows.
Vector Mechanics::multipliers(const std::vector<Row>& rows, const Vector& target) const {
  if (rows.empty()) return {};
  const Real g00 = mobility(rows[0], rows[0]);
  if (rows.size() == 1) return {target[0] / g00};
  const Real g01 = mobility(rows[0], rows[1]), g11 = mobility(rows[1], rows[1]), det = g00 * g11 - g01 * g01;
  if (det == 0) throw std::domain_error("oracle: stick on a moving belt and a closed stop exclude each other");
  return {(g11 * target[0] - g01 * target[1]) / det, (g00 * target[1] - g01 * target[0]) / det};
}

void Mechanics::impact(Vector& v) const {
  const Real u = closing_velocity(v);
  push(stop_row_, -(1 + Real(stop().restitution)) * u / mobility(stop_row_, stop_row_), v);
}

void Mechanics::project(const Mode& mode, Vector& v) const {
  const std::vector<Row> rows = constraints(mode);
  Vector target;
  for (const Row& row : rows) target.push_back(-difference(row, v));
  if (has_friction() && mode.friction == 0 && !(mode.closed && merged_sign_ != 0))
    target.back() += Real(friction().belt_speed);
  const Vector impulse = multipliers(rows, target);
  for (std::size_t i = 0; i < rows.size(); ++i) push(rows[i], impulse[i], v);
}

/// Taylor coefficients of F(t): A sin(a + b s) has A b^k / k! sin(a + k pi / 2), with b = harmonic omega step.
void Mechanics::add_forcing(std::vector<Vector>& force, const Real& t, const Real& step) const {
  for (const Force& f : model_.forces) {
    Vector& row = force[f.coordinate];
    if (f.harmonic == 0) {
      row[0] += Real(f.amplitude);
      continue;
    }
    const Real frequency = f.harmonic * Real(model_.omega), angle = frequency * t + Real(f.phase),
               advance = frequency * step;
    Real sine = Real(f.amplitude) * sin(angle), cosine = Real(f.amplitude) * cos(angle);
    for (std::size_t k = 0; k < row.size(); ++k) {
      row[k] += sine;
      const Real factor = advance / static_cast<int>(k + 1), next_sine = cosine * factor;
      cosine = -sine * factor;
      sine = next_sine;
    }
  }
}

/// Coefficient k of -K x - C v.
Vector Mechanics::applied_force(Jet& jet, std::size_t k) const {
  Vector force(inverse_mass_.size());
  const auto pull = [&](int a, int b, const Real& coefficient, const std::vector<Vector>& q) {
    const Real f = coefficient * ((a == ground ? Real(0) : q[a][k]) - (b == ground ? Real(0) : q[b][k]));
    jet.force_scale += abs(f);
    if (a != ground) force[a] -= f;
    if (b != ground) force[b] += f;
  };
  for (const Spring& s : model_.springs) pull(s.a, s.b, Real(s.stiffness), jet.x);
  for (const Damper& d : model_.dampers) pull(d.a, d.b, Real(d.coefficient), jet.v);
  return force;
}

Jet Mechanics::expand(const Mode& mode, const Vector& x, const Vector& v, const Real& t, const Real& step,
                      int order) const {
  const std::size_t n = inverse_mass_.size(), terms = static_cast<std::size_t>(order) + 1;
  Jet jet{step, std::vector<Vector>(n, Vector(terms)), std::vector<Vector>(n, Vector(terms)), {}, {}, Real(0)};
  std::vector<Vector> forcing(n, Vector(terms));
  add_forcing(forcing, t, step);
  for (std::size_t i = 0; i < n; ++i) jet.x[i][0] = x[i], jet.v[i][0] = v[i];

  const std::vector<Row> rows = constraints(mode);
  const bool slipping = has_friction() && mode.friction != 0;
  for (std::size_t k = 0; k < terms; ++k) {
    Vector a = applied_force(jet, k);
    for (std::size_t i = 0; i < n; ++i) {
      jet.force_scale += abs(forcing[i][k]);
      a[i] = (a[i] + forcing[i][k]) * inverse_mass_[i];
    }
    if (slipping && k == 0) push(friction_row_, -mode.friction * Real(friction().kinetic_friction), a);
    Vector target;
    for (const Row& row : rows) target.push_back(-difference(row, a));  // R x'' = 0
    const Vector lambda = multipliers(rows, target);
    for (std::size_t i = 0; i < rows.size(); ++i) push(rows[i], lambda[i], a);
    if (mode.closed && !rows.empty()) jet.press.push_back(-lambda.front());
    if (has_friction() && mode.friction == 0)
      jet.holding.push_back(mode.closed && merged_sign_ != 0 ? -merged_sign_ * lambda.front() : -lambda.back());
    if (k + 1 == terms) break;
    const Real factor = step / static_cast<int>(k + 1);
    for (std::size_t i = 0; i < n; ++i) {
      jet.x[i][k + 1] = jet.v[i][k] * factor;  // (k+1) x_{k+1} = step v_k
      jet.v[i][k + 1] = a[i] * factor;         // (k+1) v_{k+1} = step a_k
    }
  }
  return jet;
}

}  // namespace slapstick::oracle
