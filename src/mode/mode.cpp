#include "slapstick/mode/mode.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mode/series.hpp"

namespace slapstick::mode {
namespace {

/// A group of constrained contacts that act along one direction: row_contact = sign * row of the group.
struct Constraint {
  RowVector row;               ///< over p
  std::vector<int> stops;      ///< closed stops
  std::vector<int> frictions;  ///< sticking friction contacts
  double belt_speed = 0.0;
};

/// +1 or -1 if the rows are parallel, else 0.
int parallel(const RowVector& a, const RowVector& b) {
  if ((a - b).cwiseAbs().maxCoeff() < 1e-12) return 1;
  if ((a + b).cwiseAbs().maxCoeff() < 1e-12) return -1;
  return 0;
}

Constraint& find_or_add(std::vector<Constraint>& groups, const RowVector& row) {
  for (Constraint& group : groups) {
    if (parallel(group.row, row) != 0) return group;
  }
  return groups.emplace_back(Constraint{row, {}, {}, 0.0});
}

std::vector<Constraint> constraints(const Model& model, const Frame& frame, const ContactStates& states,
                                    bool& possible) {
  std::vector<Constraint> groups;
  for (std::size_t i = 0; i < states.stops.size(); ++i) {
    if (states.stops[i] == StopState::closed)
      find_or_add(groups, frame.stops[i].row).stops.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < states.frictions.size(); ++i) {
    if (states.frictions[i] != FrictionState::stick) continue;
    Constraint& group = find_or_add(groups, frame.frictions[i].row);
    const double speed = model.frictions[i].belt_speed;
    if (!group.stops.empty() && speed != 0.0) possible = false;
    group.frictions.push_back(static_cast<int>(i));
    group.belt_speed = speed;
  }
  return groups;
}

/// A pair held by a closed stop does not slip, unless on a moving belt.
bool slips_where_held(const Model& model, const Frame& frame, const ContactStates& states,
                      const std::vector<Constraint>& groups) {
  for (std::size_t i = 0; i < states.frictions.size(); ++i) {
    if (states.frictions[i] == FrictionState::stick || model.frictions[i].belt_speed != 0.0) continue;
    for (const Constraint& group : groups) {
      if (!group.stops.empty() && parallel(group.row, frame.frictions[i].row) != 0) return true;
    }
  }
  return false;
}

}  // namespace

/// The contacts that a mode holds still, with the multipliers that hold them: f0 = holding * X, one row per group.
struct Mode::Held {
  std::vector<Constraint> groups;
  std::vector<RowVector> rows;
  Matrix holding;
};

Mode::Mode(const Model& model, const Frame& frame, ContactStates states)
    : states_(std::move(states)), n_(frame.n), m_(frame.size()) {
  drift_.assign(frame.drift.begin(), frame.drift.end());
  steady_.assign(n_, false);
  Held held{constraints(model, frame, states_, possible_), {}, {}};
  if (slips_where_held(model, frame, states_, held.groups)) possible_ = false;
  if (!possible_) return;
  select_linear_system(model, frame, held);
  arm_guards(model, frame, held);
  note_guard_structure(frame.kinematics(model.omega));
  build_operators(frame, model);
}

/// Slip: kinetic friction -s f_k on a. Held contacts: M u' = R(X) + G^T lambda with G u' = 0, so that
/// lambda = -(G M^{-1} G^T)^{-1} G M^{-1} R is a linear functional of X; along a row the holding force is f0 = -lambda, positive when
/// it pushes a in the -x direction.
void Mode::select_linear_system(const Model& model, const Frame& frame, Held& held) {
  Matrix acceleration = frame.free;
  for (std::size_t i = 0; i < states_.frictions.size(); ++i) {
    const double force = static_cast<double>(states_.frictions[i]) * model.frictions[i].kinetic_friction;
    acceleration.col(frame.one()) -= force * (frame.mass_inverse * frame.frictions[i].row.transpose());
  }
  Matrix G(static_cast<Eigen::Index>(held.groups.size()), n_);
  for (std::size_t k = 0; k < held.groups.size(); ++k) {
    held.rows.push_back(held.groups[k].row);
    G.row(static_cast<Eigen::Index>(k)) = held.rows.back();
  }
  if (!held.groups.empty()) {
    held.holding = (G * frame.mass_inverse * G.transpose()).fullPivLu().solve(G * acceleration);
    acceleration -= frame.mass_inverse * G.transpose() * held.holding;
  }
  A_ = frame.kinematics(model.omega);
  A_.middleRows(n_, n_) = acceleration;
  for (int i = 0; i < n_; ++i) {  // a held contact coordinate has exactly no acceleration
    for (const RowVector& row : held.rows) {
      if (parallel(row, RowVector::Unit(n_, i)) == 0) continue;
      A_.row(n_ + i).setZero();
      steady_[i] = true;
    }
  }
}

/// In the order in which events at one instant are handled: gaps, relative velocities, forces.
void Mode::arm_guards(const Model& model, const Frame& frame, const Held& held) {
  for (std::size_t i = 0; i < states_.stops.size(); ++i) {
    if (states_.stops[i] == StopState::open) arm_gap(model, frame, static_cast<int>(i), held.rows);
  }
  for (std::size_t i = 0; i < states_.frictions.size(); ++i) {
    const auto s = static_cast<double>(states_.frictions[i]);
    const RowVector w = frame.velocity_row(frame.frictions[i], model.frictions[i].belt_speed);
    if (s != 0.0) guards_.push_back({GuardKind::slip, static_cast<int>(i), s * w});
  }
  for (std::size_t k = 0; k < held.groups.size(); ++k) {
    const Constraint& group = held.groups[k];
    const RowVector f0 = held.holding.row(static_cast<Eigen::Index>(k));
    RowVector limit = RowVector::Zero(m_);
    for (int i : group.frictions) limit[frame.one()] += model.frictions[i].static_friction;
    if (!group.stops.empty()) {
      guards_.push_back({GuardKind::press, group.stops.front(), f0 + limit});
      continue;
    }
    const int contact = group.frictions.front();
    const int sense = parallel(group.row, frame.frictions[contact].row);
    guards_.push_back({GuardKind::stick_above, contact, limit - sense * f0});
    guards_.push_back({GuardKind::stick_below, contact, limit + sense * f0});
  }
}

void Mode::note_guard_structure(const Matrix& kinematics) {
  for (Guard& guard : guards_) {
    const bool mechanical =
        guard.row.tail(m_ - 2 * n_).isZero(0.0);  // a phase has the clock's rounding besides its own
    if (mechanical && (guard.row.array() != 0.0).count() == 1) {
      guard.row.cwiseAbs().maxCoeff(&guard.single);
      guard.factor = guard.row[guard.single];
    }
    if (guard.kind != GuardKind::slip) continue;
    for (std::size_t g = 0; g < guards_.size(); ++g) {
      if (guards_[g].kind != GuardKind::gap) continue;
      const RowVector rate = guards_[g].row * kinematics;  // gap' involves no acceleration
      if ((rate + guard.row).isZero(0.0)) guard.falls_with = static_cast<int>(g);
    }
  }
}

/// An open gap needs no guard where it cannot close: constant in stick on the same pair, growing while its pair slips apart.
void Mode::arm_gap(const Model& model, const Frame& frame, int stop, const std::vector<RowVector>& constrained) {
  const RowVector& row = frame.stops[stop].row;
  for (const RowVector& held : constrained) {
    double speed = 0.0;
    for (std::size_t i = 0; i < states_.frictions.size(); ++i) {
      if (parallel(held, frame.frictions[i].row) != 0) speed = model.frictions[i].belt_speed;
    }
    if (parallel(held, row) != 0 && speed == 0.0) return;
  }
  for (std::size_t i = 0; i < states_.frictions.size(); ++i) {
    const int same = parallel(row, frame.frictions[i].row);
    if (same * static_cast<int>(states_.frictions[i]) < 0 && model.frictions[i].belt_speed == 0.0) return;
  }
  guards_.push_back({GuardKind::gap, stop, frame.gap_row(frame.stops[stop], model.stops[stop].clearance)});
}

/// exp(A H): positions from their own series, u = p' - drift from its derivative, the oscillators as rotations.
Matrix Mode::flow_over_window(const Series& series, std::size_t first_coordinate, const Frame& frame,
                              double omega) const {
  Matrix flow = Matrix::Identity(m_, m_);
  for (int i = 0; i < n_; ++i) {
    flow.row(i) = series.end_value(first_coordinate + i);
    flow.row(n_ + i) = series.end_slope(first_coordinate + i);
    flow(n_ + i, m_ - 1) -= drift_[i];
    if (steady_[i]) flow.row(n_ + i) = RowVector::Unit(m_, n_ + i);
  }
  for (std::size_t k = 0; k < frame.harmonics.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(2 * n_ + 2 * k);
    const double angle = frame.harmonics[k] * omega * window_;
    flow.block<2, 2>(c, c) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  }
  return flow;
}

void Mode::build_operators(const Frame& frame, const Model& model) {
  std::vector<RowVector> rows;
  for (const Guard& guard : guards_) rows.push_back(guard.row);
  for (int i = 0; i < n_; ++i) rows.push_back(RowVector::Unit(m_, i));
  const Series series(A_, rows, model.forcing_period());
  window_ = series.window();
  window_in_periods_ = series.window_in_periods();
  noise_factor_ = (m_ + 16.0) * event::unit_roundoff;

  const auto guards = guards_.size();
  state_blocks_ = (m_ + 7) / 8;
  step_.assign(static_cast<std::size_t>(state_blocks_) * m_, event::Lane8{});
  taylor_.assign(3 * guards * m_, event::Lane8{});
  leading_noise_.assign(guards * m_, event::Lane8{});
  coordinates_.assign(3 * static_cast<std::size_t>(n_) * m_, event::Lane8{});

  const Matrix flow = flow_over_window(series, guards, frame, model.omega);
  for (int i = 0; i < m_; ++i) {
    for (int r = 0; r < m_; ++r) step_[(r / 8) * m_ + i][r % 8] = flow(r, i);
    for (int j = 0; j < event::terms; ++j) {
      for (std::size_t g = 0; g < guards; ++g) taylor_[(3 * g + j / 8) * m_ + i][j % 8] = series.taylor(g, j, i);
      for (std::size_t k = 0; k < static_cast<std::size_t>(n_); ++k)
        coordinates_[(3 * k + j / 8) * m_ + i][j % 8] = series.taylor(guards + k, j, i);
    }
    for (std::size_t g = 0; g < guards; ++g)
      leading_noise_[g * m_ + i] = noise_factor_ * event::magnitude(taylor_[3 * g * m_ + i]);
  }
  for (int g = 0; g < guard_count(); ++g) {
    for (int order = 0; order < stored_orders; ++order) {
      for (int i = 0; i < m_; ++i) {
        const event::Hull hull = hull_column(g, order, i);
        hulls_.push_back(hull.bernstein);
        hull_bounds_.push_back(hull.bounds);
      }
    }
  }
}

/// The hull of column i of guard g, x^order divided out. The terms beyond the stored ones are below a quarter rounding of the largest.
event::Hull Mode::hull_column(int g, int order, int i) const {
  std::array<double, event::terms> a{};
  double largest = 0.0;
  for (int n = 0; n < event::terms; ++n) {
    const double c = taylor_[(3 * g + n / 8) * m_ + i][n % 8];
    largest = std::max(largest, std::abs(c));
    if (n >= order) a[n - order] = c;
  }
  event::Hull hull = event::enclose(a.data(), event::terms - order, noise_factor_);
  hull.bounds += 0.25 * event::unit_roundoff * largest * event::Lane8{1, 1, 1, 0, 0, 1, 1, 1};
  return hull;
}

namespace {

/// out[b] = sum_i data[b * m + i] * x[i], for m known to the compiler.
template <int m>
void multiply_fixed(const event::Lane8* data, int blocks, const double* x, event::Lane8* out) {
  for (int b = 0; b < blocks; ++b, data += m) {
    event::Lane8 sum = data[0] * x[0];
    for (int i = 1; i < m; ++i) sum += data[i] * x[i];
    out[b] = sum;
  }
}

/// The same for any m. The sizes of one to three coordinates with one harmonic are unrolled.
inline void multiply(const event::Lane8* data, int blocks, int m, const double* x, event::Lane8* out) {
  switch (m) {
    case 3:
      return multiply_fixed<3>(data, blocks, x, out);
    case 5:
      return multiply_fixed<5>(data, blocks, x, out);
    case 7:
      return multiply_fixed<7>(data, blocks, x, out);
    case 9:
      return multiply_fixed<9>(data, blocks, x, out);
    default:
      break;
  }
  for (int b = 0; b < blocks; ++b, data += m) {
    event::Lane8 sum = data[0] * x[0];
    for (int i = 1; i < m; ++i) sum += data[i] * x[i];
    out[b] = sum;
  }
}

}  // namespace

void Mode::step(const double* X, event::Lane8* out) const { multiply(step_.data(), state_blocks_, m_, X, out); }

void Mode::enclose(int g, int order, const double* X, const double* magnitude, event::Hull& out) const {
  if (order < stored_orders) {
    const auto at = static_cast<std::ptrdiff_t>(g * stored_orders + order) * m_;
    multiply(hulls_.data() + at, 1, m_, X, &out.bernstein);
    multiply(hull_bounds_.data() + at, 1, m_, magnitude, &out.bounds);
    return;
  }
  out = event::Hull{{}, {}};
  for (int i = 0; i < m_; ++i) {
    const event::Hull column = hull_column(g, order, i);
    out.bernstein += column.bernstein * X[i];
    out.bounds += column.bounds * magnitude[i];
  }
}

void Mode::taylor(int g, int order, const double* X, event::Coefficients& out) const {
  multiply(taylor_.data() + static_cast<std::ptrdiff_t>(3 * g) * m_, 3, m_, X, out.data());
  for (int p = 0; p < order; ++p) out = event::divided_by_x(out);
}

void Mode::leading(int g, const double* X, const double* magnitude, event::Lane8& coefficients,
                   event::Lane8& noise) const {
  multiply(taylor_.data() + static_cast<std::ptrdiff_t>(3 * g) * m_, 1, m_, X, &coefficients);
  multiply(leading_noise_.data() + static_cast<std::ptrdiff_t>(g) * m_, 1, m_, magnitude, &noise);
}

void Mode::state_at(double x, const double* X, double* out) const {
  const event::Powers powers(x);
  const double per_time = 1.0 / window_;
  for (int k = 0; k < n_; ++k) {
    event::Coefficients a;
    multiply(coordinates_.data() + 3 * k * m_, 3, m_, X, a.data());
    out[k] = event::value(a, powers);
    out[n_ + k] = steady_[k] ? X[n_ + k] : event::value(event::derivative(a), powers) * per_time - drift_[k];
  }
}

}  // namespace slapstick::mode
