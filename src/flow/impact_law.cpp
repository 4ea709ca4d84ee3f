/// Solves impacts: Newton's law for one stop, Lemke's method for several.
#include "flow/impact_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/dense.hpp"
#include "flow/mode_graph.hpp"

namespace slapstick::flow {
namespace {

constexpr int most = System::most_contacts;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
using Tableau = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, 2 * most + 2>;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;

/// Sets the velocity of a stop to `v` towards it, and that of the displacements of the same pair.
void set_velocity(const mode::Frame& frame, const mode::ContactRow& stop, double v, double* X) {
  X[frame.u(stop.own)] = stop.sign * v;
  frame.match_velocities(stop.own, X);
}

/// Lemke's method for w = D z - q, w >= 0, z >= 0, w . z = 0. The tableau is I w - D z - 1 z0 = -q; columns w, z, z0,
/// right-hand side.
class Lemke {
 public:
  Lemke(const Square& D, const Column& q) : n_(D.rows()), T_(n_, 2 * n_ + 2), scale_(D.cwiseAbs().maxCoeff()) {
    T_.leftCols(n_).setIdentity();
    T_.middleCols(n_, n_) = -D;
    T_.col(2 * n_).setConstant(-1.0);
    T_.col(2 * n_ + 1) = -q;
    for (Eigen::Index i = 0; i < n_; ++i) basis_[i] = static_cast<int>(i);
  }

  bool solve(Column& z) {
    z.setZero(n_);
    Eigen::Index row = 0;
    if (T_.col(2 * n_ + 1).minCoeff(&row) >= 0.0) return true;
    auto entering = static_cast<int>(2 * n_);
    for (int step = 0; step < 50 * most; ++step) {
      const int leaving = basis_[row];
      pivot(row, entering);
      if (leaving == 2 * n_) return read(z);
      entering = leaving < n_ ? leaving + static_cast<int>(n_) : leaving - static_cast<int>(n_);
      row = ratio_test(entering);
      if (row < 0) return false;
    }
    return false;
  }

 private:
  void pivot(Eigen::Index row, int column) {
    T_.row(row) /= T_(row, column);
    for (Eigen::Index i = 0; i < n_; ++i) {
      const double factor = T_(i, column);
      if (i != row && factor != 0.0) T_.row(i) -= factor * T_.row(row);
    }
    basis_[row] = column;
  }

  /// The row that limits the entering variable; z0's among equals, so that it ends as soon as it can. -1: a ray.
  [[nodiscard]] Eigen::Index ratio_test(int entering) const {
    Eigen::Index best = -1;
    double least = INFINITY;
    for (Eigen::Index i = 0; i < n_; ++i) {
      const double slope = T_(i, entering);
      if (slope <= 1e-12 * scale_) continue;
      const double ratio = std::max(T_(i, 2 * n_ + 1), 0.0) / slope;
      const bool ends = basis_[i] == 2 * n_ && ratio <= least * (1.0 + 1e-14);
      if (ratio < least || ends) {
        best = i;
        least = ratio;
      }
    }
    return best;
  }

  bool read(Column& z) const {
    for (Eigen::Index i = 0; i < n_; ++i) {
      if (basis_[i] >= n_ && basis_[i] < 2 * n_) z[basis_[i] - n_] = std::max(T_(i, 2 * n_ + 1), 0.0);
    }
    return true;
  }

  Eigen::Index n_;
  Tableau T_;
  double scale_;
  std::array<int, most> basis_{};
};

}  // namespace

void strike(const CompiledSystem& system, int stop, double restitution, double* X) {
  const mode::Frame& frame = system.frame();
  const double v = approach_velocity(system, stop, X);
  for (int i = 0; i < frame.d; ++i) X[frame.u(i)] -= (1.0 + restitution) * v * system.impulse(stop)[i];
  set_velocity(frame, frame.stops[stop], -restitution * v, X);
}

namespace {

/// D_ij = g_i M^{-1} g_j^T, and the velocities towards the stops.
void assemble(const CompiledSystem& system, std::span<const int> stops, const double* X, Square& D, Column& v) {
  const mode::Frame& frame = system.frame();
  const auto n = static_cast<Eigen::Index>(stops.size());
  D.resize(n, n);
  v.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const mode::ContactRow& a = frame.stops[stops[i]];
    v[i] = approach_velocity(system, stops[i], X);
    for (Eigen::Index j = 0; j < n; ++j) {
      const mode::ContactRow& b = frame.stops[stops[j]];
      D(i, j) = a.sign * b.sign * frame.mass_inverse(a.own, b.own);
    }
  }
}

void push(const CompiledSystem& system, std::span<const int> stops, const Column& P, double* X) {
  const mode::Frame& frame = system.frame();
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const mode::ContactRow& a = frame.stops[stops[i]];
    for (int j = 0; j < frame.d; ++j)
      X[frame.u(j)] -= P[static_cast<Eigen::Index>(i)] * a.sign * frame.mass_inverse(j, a.own);
  }
}

}  // namespace

namespace {

/// Moreau's law with a restitution for each stop, which `law(stop, v)` says.
template <class Law>
bool solve_together(const CompiledSystem& system, std::span<const int> stops, double* X, std::span<bool> hit, Law law) {
  Square D;
  Column v, P;
  assemble(system, stops, X, D, v);
  Column r = v;
  for (std::size_t i = 0; i < stops.size(); ++i)
    r[static_cast<Eigen::Index>(i)] = law(stops[i], v[static_cast<Eigen::Index>(i)]);
  const Column q = v.cwiseProduct((1.0 + r.array()).matrix());
  // Lemke's method compares entries of D: in units in which its diagonal is one.
  const Column unit = D.diagonal().cwiseSqrt().cwiseInverse();
  if (!Lemke(unit.asDiagonal() * D * unit.asDiagonal(), unit.cwiseProduct(q)).solve(P)) return false;
  P = P.cwiseProduct(unit).eval();
  push(system, stops, P, X);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    hit[i] = P[k] > 0.0;
    if (hit[i]) set_velocity(system.frame(), system.frame().stops[stops[i]], -r[k] * v[k], X);
  }
  return true;
}

}  // namespace

bool strike_together(const CompiledSystem& system, std::span<const int> stops, double* X, std::span<bool> hit) {
  return solve_together(system, stops, X, hit,
                        [&](int stop, double v) { return rebound(system.model().stops[stop], v).restitution; });
}

bool bear(const CompiledSystem& system, std::span<const int> stops, double* X, std::span<bool> hit) {
  return solve_together(system, stops, X, hit, [](int, double) { return 0.0; });
}

void bring_to_rest(const CompiledSystem& system, std::span<const int> stops, double* X) {
  Square D;
  Column v;
  assemble(system, stops, X, D, v);
  const Eigen::MatrixXd full = D;
  push(system, stops, Column(dense::LeastNorm(full).solve(Eigen::VectorXd(v))), X);
  for (int stop : stops) set_velocity(system.frame(), system.frame().stops[stop], 0.0, X);
}

}  // namespace slapstick::flow
