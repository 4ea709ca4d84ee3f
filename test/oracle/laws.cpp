#include "oracle/laws.hpp"

#include <stdexcept>

namespace slapstick::oracle {
namespace {

constexpr int taylor_order = 44;

Polynomial times(Polynomial p, const Real& factor) {
  for (Real& c : p) c *= factor;
  return p;
}

Polynomial sum(Polynomial p, const Polynomial& q, const Real& factor) {
  for (std::size_t k = 0; k < p.size(); ++k) p[k] += factor * q[k];
  return p;
}

/// r of an impact speed, straight from the corners.
Real restitution(const Stop& stop, const Real& speed) {
  if (stop.corners.empty() || speed <= Real(stop.corners.front().speed)) return Real(stop.restitution);
  if (speed >= Real(stop.corners.back().speed)) return Real(stop.corners.back().restitution);
  std::size_t k = 1;
  while (Real(stop.corners[k].speed) < speed) ++k;
  const Stop::Corner &from = stop.corners[k - 1], &to = stop.corners[k];
  const Real part = (speed - Real(from.speed)) / (Real(to.speed) - Real(from.speed));
  return Real(from.restitution) + part * (Real(to.restitution) - Real(from.restitution));
}

}  // namespace

void LawOracle::Row::add(const Row& other, const Real& factor) {
  for (std::size_t i = 0; i < k.size(); ++i) k[i] += factor * other.k[i], c[i] += factor * other.c[i];
  constant += factor * other.constant;
  zero = zero && other.zero;
}

LawOracle::LawOracle(const Model& model, const Vector& state) : model_(model) {
  if (model.frictions.size() > 1 || !model.mass.empty())
    throw std::invalid_argument("law oracle: one friction contact, no mass matrix");
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    inverse_mass_.push_back(1 / Real(model.coordinates[i].mass));
    x_.push_back(state[2 * i]), v_.push_back(state[2 * i + 1]);
  }
  period_ = model.forced() ? 2 * pi() / Real(model.omega) : Real(1);
  Real stiffness = 0, damping = 0, lightest = 0;
  for (const Real& m : inverse_mass_) lightest = std::max(lightest, m);
  for (const Spring& s : model.springs) stiffness += std::abs(s.stiffness);
  for (const Damper& d : model.dampers) damping += std::abs(d.coefficient);
  for (const double k : model.stiffness) stiffness += std::abs(k);
  for (const double c : model.damping) damping += std::abs(c);
  for (const CompliantStop& s : model.compliant_stops) stiffness += 2 * s.stiffness, damping += s.damping;
  for (const Characteristic& c : model.characteristics)
    for (std::size_t p = 0; p <= c.corners.size(); ++p) {
      const Row row = bent_row(static_cast<std::size_t>(&c - model.characteristics.data()), static_cast<int>(p));
      for (std::size_t i = 0; i < row.k.size(); ++i) stiffness += abs(row.k[i]), damping += abs(row.c[i]);
    }
  step_ = 1 / (2 * sqrt(stiffness * lightest) + 2 * damping * lightest + 3 * Real(model.omega) + 1);
  cell_ = cell_here({});
}

LawOracle::Row LawOracle::empty() const { return {Vector(x_.size()), Vector(x_.size()), Real(0), true}; }

LawOracle::Row LawOracle::pair(int a, int b, bool velocity, const Real& factor) const {
  Row row = empty();
  Vector& entries = velocity ? row.c : row.k;
  if (a != ground) entries[static_cast<std::size_t>(a)] += factor;
  if (b != ground) entries[static_cast<std::size_t>(b)] -= factor;
  row.zero = false;
  return row;
}

LawOracle::Row LawOracle::value_row(std::size_t i) const {
  const Characteristic& c = model_.characteristics[i];
  return pair(c.a, c.b, c.over == Characteristic::Over::velocity, Real(1));
}

LawOracle::Row LawOracle::bent_row(std::size_t i, int piece) const {
  const Characteristic& c = model_.characteristics[i];
  const auto at = static_cast<std::size_t>(piece);
  if (c.over == Characteristic::Over::zones)
    return pair(c.a, c.b, true, Real(piece == 0 ? c.slope_below : c.corners[at - 1].force));
  const Characteristic::Corner& from = c.corners[piece == 0 ? 0 : at - 1];
  Real slope = piece == 0 ? c.slope_below : c.slope_above;
  if (piece > 0 && at < c.corners.size())
    slope = (Real(c.corners[at].force) - Real(from.force)) / (Real(c.corners[at].at) - Real(from.at));
  Row row = value_row(i);
  for (std::size_t j = 0; j < row.k.size(); ++j) row.k[j] *= slope, row.c[j] *= slope;
  row.constant = Real(from.force) - slope * Real(from.at);
  return row;
}

LawOracle::Row LawOracle::compliant_row(std::size_t i, int state) const {
  const CompliantStop& s = model_.compliant_stops[i];
  if (state == 0 || state == 2) return empty();
  const Real k = (state == 3 ? 2 : 1) * Real(s.stiffness);
  Row row = pair(s.a, s.b, false, k);
  row.constant = -k * Real(s.clearance);
  if (state == 1) row.add(pair(s.a, s.b, true, Real(s.damping)), Real(1));
  row.zero = false;
  return row;
}

LawOracle::Row LawOracle::load_row(std::size_t i, const Cell& cell) const {
  Row row = empty();
  const auto& normal = model_.frictions[i].normal;
  if (!normal) {
    row.constant = 1, row.zero = false;
    return row;
  }
  row.constant = Real(normal->constant);
  row.zero = normal->terms.empty() && normal->constant == 0.0;
  for (const NormalForce::Term& term : normal->terms) {
    row.k[static_cast<std::size_t>(term.coordinate)] += Real(term.stiffness);
    row.c[static_cast<std::size_t>(term.coordinate)] += Real(term.damping);
  }
  if (normal->compliant_stop < 0) return row;
  const auto stop = static_cast<std::size_t>(normal->compliant_stop);
  row.add(compliant_row(stop, cell.compliant[stop]), Real(1));
  return row;
}

Real LawOracle::at(const Row& row) const {
  Real value = row.constant;
  for (std::size_t i = 0; i < x_.size(); ++i) value += row.k[i] * x_[i] + row.c[i] * v_[i];
  return value;
}

Polynomial LawOracle::along(const Row& row, const Series& series) const {
  Polynomial p(series.x.front().size());
  for (std::size_t n = 0; n < p.size(); ++n)
    for (std::size_t i = 0; i < x_.size(); ++i) p[n] += row.k[i] * series.x[i][n] + row.c[i] * series.v[i][n];
  p[0] += row.constant;
  return p;
}

int LawOracle::compliant_state(std::size_t i) const {
  const CompliantStop& s = model_.compliant_stops[i];
  Row depth = pair(s.a, s.b, false, Real(1));
  depth.constant = -Real(s.clearance);
  if (at(depth) < 0) return 0;
  if (s.pulls || s.damping == 0.0) return 1;
  const Real spring = Real(s.stiffness) * at(depth), damper = at(pair(s.a, s.b, true, Real(s.damping)));
  if (spring + damper < 0) return 2;
  return s.bounded && damper > spring ? 3 : 1;
}

LawOracle::Cell LawOracle::cell_here(const Said& said) const {
  Cell cell;
  for (std::size_t i = 0; i < model_.characteristics.size(); ++i) {
    const Real value = at(value_row(i));
    int piece = 0;
    for (const Characteristic::Corner& corner : model_.characteristics[i].corners) piece += value > Real(corner.at);
    cell.pieces.push_back(said.of == Said::Of::piece && said.index == i ? said.state : piece);
  }
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i)
    cell.compliant.push_back(said.of == Said::Of::compliant && said.index == i ? said.state : compliant_state(i));
  for (std::size_t i = 0; i < model_.frictions.size(); ++i) {
    const FrictionContact& f = model_.frictions[i];
    const Row row = load_row(i, cell);
    const Real w = at(pair(f.a, f.b, true, Real(1))) - Real(f.belt_speed);
    const bool unloaded = said.of == Said::Of::load ? said.state != 0 : row.zero || at(row) < 0;
    if (said.of == Said::Of::slip && !unloaded) {
      cell.frictions.push_back(said.state);
      continue;
    }
    cell.frictions.push_back(unloaded ? 2 : w > zero_share ? 1 : w < -zero_share ? -1 : 0);
    if (cell.frictions.back() != 0) continue;
    const Real f0 = holding(cell), limit = Real(f.static_friction) * at(row);
    if (abs(f0) > limit * (1 + zero_share)) cell.frictions.back() = f0 > 0 ? 1 : -1;
  }
  return cell;
}

void LawOracle::pull(Vector& force, int a, int b, const Real& value) const {
  if (a != ground) force[static_cast<std::size_t>(a)] -= value;
  if (b != ground) force[static_cast<std::size_t>(b)] += value;
}

/// f0 of the friction contact that sticks.
Real LawOracle::holding(const Cell& cell) const { return expand(cell, Real(1), 1).holding.front(); }

std::vector<LawOracle::Element> LawOracle::elements(const Cell& cell) const {
  std::vector<Element> all;
  for (const Spring& e : model_.springs) all.push_back({e.a, e.b, pair(e.a, e.b, false, Real(e.stiffness))});
  for (const Damper& e : model_.dampers) all.push_back({e.a, e.b, pair(e.a, e.b, true, Real(e.coefficient))});
  for (std::size_t i = 0; i < x_.size() && !(model_.stiffness.empty() && model_.damping.empty()); ++i) {
    Row row = empty();
    for (std::size_t j = 0; j < x_.size(); ++j) {
      if (!model_.stiffness.empty()) row.k[j] = Real(model_.stiffness[i * x_.size() + j]);
      if (!model_.damping.empty()) row.c[j] = Real(model_.damping[i * x_.size() + j]);
    }
    all.push_back({static_cast<int>(i), ground, row});
  }
  for (std::size_t i = 0; i < cell.compliant.size(); ++i)
    all.push_back({model_.compliant_stops[i].a, model_.compliant_stops[i].b, compliant_row(i, cell.compliant[i])});
  for (std::size_t i = 0; i < cell.pieces.size(); ++i)
    all.push_back({model_.characteristics[i].a, model_.characteristics[i].b, bent_row(i, cell.pieces[i])});
  for (std::size_t i = 0; i < cell.frictions.size(); ++i) {
    if (cell.frictions[i] != 1 && cell.frictions[i] != -1) continue;
    Row force = empty();
    force.add(load_row(i, cell), cell.frictions[i] * Real(model_.frictions[i].kinetic_friction));
    all.push_back({model_.frictions[i].a, model_.frictions[i].b, force});
  }
  return all;
}

/// Taylor coefficients of A sin(b + a s): A a^k / k! sin(b + k pi / 2).
std::vector<Vector> LawOracle::forcing(const Real& step, std::size_t terms) const {
  std::vector<Vector> loads(x_.size(), Vector(terms));
  for (const Force& f : model_.forces) {
    Vector& load = loads[static_cast<std::size_t>(f.coordinate)];
    if (f.harmonic == 0) {
      load[0] += Real(f.amplitude);
      continue;
    }
    const Real frequency = f.harmonic * Real(model_.omega), angle = frequency * t_ + Real(f.phase);
    Real sine = Real(f.amplitude) * sin(angle), cosine = Real(f.amplitude) * cos(angle);
    for (std::size_t k = 0; k < terms; ++k) {
      load[k] += sine;
      const Real factor = frequency * step / static_cast<int>(k + 1), next = cosine * factor;
      cosine = -sine * factor;
      sine = next;
    }
  }
  return loads;
}

/// M x'' = F, coefficient by coefficient; a contact that sticks takes what keeps w'.
LawOracle::Series LawOracle::expand(const Cell& cell, const Real& step, int order) const {
  const std::size_t n = x_.size(), terms = static_cast<std::size_t>(order) + 1;
  Series s{std::vector<Vector>(n, Vector(terms)), std::vector<Vector>(n, Vector(terms)), Polynomial(terms)};
  for (std::size_t i = 0; i < n; ++i) s.x[i][0] = x_[i], s.v[i][0] = v_[i];
  const std::vector<Element> all = elements(cell);
  const std::vector<Vector> loads = forcing(step, terms);
  for (std::size_t k = 0; k < terms; ++k) {
    Vector a(n);
    for (const Element& e : all) {
      Real value = k == 0 ? e.row.constant : Real(0);
      for (std::size_t i = 0; i < n; ++i) value += e.row.k[i] * s.x[i][k] + e.row.c[i] * s.v[i][k];
      pull(a, e.a, e.b, value);
    }
    for (std::size_t i = 0; i < n; ++i) a[i] += loads[i][k];
    for (std::size_t i = 0; i < n; ++i) a[i] *= inverse_mass_[i];
    if (!cell.frictions.empty() && cell.frictions.front() == 0) {
      const FrictionContact& f = model_.frictions.front();
      Vector unit(n);
      pull(unit, f.a, f.b, Real(-1));
      Real mobility = 0, rate = 0;
      for (std::size_t i = 0; i < n; ++i) mobility += unit[i] * unit[i] * inverse_mass_[i], rate += unit[i] * a[i];
      s.holding[k] = rate / mobility;
      for (std::size_t i = 0; i < n; ++i) a[i] -= inverse_mass_[i] * unit[i] * s.holding[k];
    }
    if (k + 1 == terms) break;
    for (std::size_t i = 0; i < n; ++i) {
      s.x[i][k + 1] = s.v[i][k] * step / static_cast<int>(k + 1);
      s.v[i][k + 1] = a[i] * step / static_cast<int>(k + 1);
    }
  }
  return s;
}

void LawOracle::compliant_guards(std::size_t i, const Series& series, std::vector<Guard>& all) const {
  const CompliantStop& s = model_.compliant_stops[i];
  Row depth = pair(s.a, s.b, false, Real(1));
  depth.constant = -Real(s.clearance);
  const Polynomial delta = along(depth, series), force = along(compliant_row(i, 1), series);
  const Polynomial excess = sum(times(delta, 2 * Real(s.stiffness)), force, Real(-1));
  const bool free = !s.pulls && s.damping > 0.0;
  const auto add = [&](const Polynomial& p, int after) { all.push_back({p, {Said::Of::compliant, i, after}}); };
  const int state = cell_.compliant[i];
  if (state == 0) add(times(delta, Real(-1)), s.bounded && free ? 3 : 1);
  if (state == 1) add(free ? force : delta, free ? 2 : 0);
  if (state == 1 && s.bounded && free) add(excess, 3);
  if (state == 2) add(delta, 0), add(times(force, Real(-1)), 1);
  if (state == 3) add(delta, 0), add(times(excess, Real(-1)), 1);
}

std::vector<LawOracle::Guard> LawOracle::guards(const Series& series) const {
  std::vector<Guard> all;
  for (std::size_t i = 0; i < model_.stops.size(); ++i) {
    Row gap = pair(model_.stops[i].a, model_.stops[i].b, false, Real(-1));
    gap.constant = Real(model_.stops[i].clearance);
    all.push_back({along(gap, series), {}, static_cast<int>(i)});
  }
  for (std::size_t i = 0; i < cell_.compliant.size(); ++i) compliant_guards(i, series, all);
  for (std::size_t i = 0; i < cell_.pieces.size(); ++i) {
    const auto& corners = model_.characteristics[i].corners;
    const Polynomial value = along(value_row(i), series);
    const auto piece = static_cast<std::size_t>(cell_.pieces[i]);
    const auto add = [&](std::size_t corner, int sign) {
      Polynomial p = times(value, Real(-sign));
      p[0] += sign * Real(corners[corner].at);
      all.push_back({p, {Said::Of::piece, i, cell_.pieces[i] + sign}});
    };
    if (piece < corners.size()) add(piece, 1);
    if (piece > 0) add(piece - 1, -1);
  }
  for (std::size_t i = 0; i < cell_.frictions.size(); ++i) {
    const FrictionContact& f = model_.frictions[i];
    const int state = cell_.frictions[i];
    const Row row = load_row(i, cell_);
    const Polynomial load = along(row, series);
    // The force of a stop alone ends with the stop: two polynomials of one zero would be two events at an instant.
    const bool of_stop = f.normal && f.normal->compliant_stop >= 0 && f.normal->terms.empty() &&
                         f.normal->constant == 0.0 &&
                         !model_.compliant_stops[static_cast<std::size_t>(f.normal->compliant_stop)].pulls;
    if (f.normal && !row.zero && state != 0 && !of_stop)
      all.push_back({times(load, Real(state == 2 ? -1 : 1)), {Said::Of::load, i, state == 2 ? 0 : 1}});
    if (state == 2) continue;
    Row w = pair(f.a, f.b, true, Real(1));
    w.constant = -Real(f.belt_speed);
    if (state != 0) all.push_back({times(along(w, series), Real(state)), {}});
    if (state != 0) continue;
    for (const int side : {1, -1})
      all.push_back(
          {sum(times(load, Real(f.static_friction)), series.holding, Real(-side)), {Said::Of::slip, i, side}});
  }
  return all;
}

void LawOracle::strike(int stop) {
  const Stop& s = model_.stops[static_cast<std::size_t>(stop)];
  const Real u = at(pair(s.a, s.b, true, Real(1)));
  Vector unit(x_.size());
  pull(unit, s.a, s.b, Real(-1));
  Real mobility = 0;
  for (std::size_t i = 0; i < x_.size(); ++i) mobility += unit[i] * unit[i] * inverse_mass_[i];
  for (std::size_t i = 0; i < x_.size(); ++i)
    v_[i] -= (1 + restitution(s, u)) * u / mobility * inverse_mass_[i] * unit[i];
}

/// A guard that is zero up to rounding where the cell begins has that zero divided out.
std::vector<Real> LawOracle::run(const Real& t_end) {
  std::vector<Real> times;
  while (t_ < t_end) {
    const Real step = std::min(step_, Real(t_end - t_));
    const Series series = expand(cell_, step, taylor_order);
    std::optional<Real> first;
    Guard hit;
    for (Guard& guard : guards(series)) {
      const Real size = magnitude(guard.p);
      Polynomial p = guard.p;
      while (p.size() > 1 && abs(p.front()) <= zero_share * size) p.erase(p.begin());
      const std::optional<Root> root = first_root(p, zero_share * size, false);
      if (!root || (first && root->s >= *first)) continue;
      first = root->s;
      hit = std::move(guard);
    }
    const Real s = first.value_or(Real(1));
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = evaluate(series.x[i], s), v_[i] = evaluate(series.v[i], s);
    t_ += s * step;
    if (!first) continue;
    if (hit.stop >= 0) strike(hit.stop);
    const Cell before = cell_;
    cell_ = cell_here(hit.after);
    if (hit.stop >= 0 || !(before == cell_)) times.push_back(t_);
  }
  return times;
}

Vector LawOracle::state() const {
  Vector state;
  for (std::size_t i = 0; i < x_.size(); ++i) state.push_back(x_[i]), state.push_back(v_[i]);
  return state;
}

}  // namespace slapstick::oracle
