/// The extremes of linear functionals along a leg: roots of the derivative, isolated by the changes of sign in Bernstein's basis.
#include "orbit/extremes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bracketed_root.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int degree = 20;  ///< the terms of exp(A h) fall at least like those of e: 1 / 20! is below rounding
constexpr double part_of_step = 0.5;  ///< .. over this part of ModeRates::longest_step
constexpr double most_steps = 1e4;    ///< as in flow(): a mass may be next to nothing
constexpr double unit_rounding = 0x1p-53;

using Polynomial = std::array<double, degree + 1>;  ///< coefficients of x^j, x in [0, 1]
using Bernstein = std::array<double, degree>;       ///< of a derivative, degree - 1

double value_at(const Polynomial& f, double x) {
  double sum = 0.0;
  for (int j = degree; j >= 0; --j) sum = sum * x + f[static_cast<std::size_t>(j)];
  return sum;
}

double slope_at(const Polynomial& f, double x) {
  double sum = 0.0;
  for (int j = degree; j > 0; --j) sum = sum * x + j * f[static_cast<std::size_t>(j)];
  return sum;
}

/// b_i = sum_{j <= i} C(i, j) / C(n, j) a_j, n = degree - 1; a: coefficients of the derivative.
Bernstein slope_of(const Polynomial& f) {
  constexpr int n = degree - 1;
  Bernstein b{};
  for (int i = 0; i <= n; ++i) {
    double weight = 1.0;  // C(i, j) / C(n, j)
    for (int j = 0; j <= i; ++j) {
      b[static_cast<std::size_t>(i)] += weight * (j + 1) * f[static_cast<std::size_t>(j) + 1];
      weight *= static_cast<double>(i - j) / (n - j > 0 ? n - j : 1);
    }
  }
  return b;
}

/// de Casteljau: `b` becomes the right half's. @returns the left half's
Bernstein halve(Bernstein& b) {
  Bernstein left{};
  for (std::size_t k = 0; k < b.size(); ++k) {
    left[k] = b[0];
    for (std::size_t i = 0; i + 1 < b.size() - k; ++i) b[i] = 0.5 * (b[i] + b[i + 1]);
  }
  return left;
}

int changes_of_sign(const Bernstein& b) {
  int changes = 0;
  double last = 0.0;
  for (const double value : b) {
    if (value * last < 0.0) ++changes;
    if (value != 0.0) last = std::copysign(1.0, value);
  }
  return changes;
}

/// One functional on one step: hands every place to `take` at which it may have an extreme.
template <class Take>
class Search {
 public:
  Search(const Polynomial& f, const Take& take) : f_(f), take_(take) {
    for (const double a : f) size_ += std::abs(a);
  }

  void within(Bernstein slope, double from, double to) const {
    double steepest = 0.0;
    for (const double b : slope) steepest = std::max(steepest, std::abs(b));
    const int changes = changes_of_sign(slope);
    if (changes == 0) return;  // monotone
    const double middle = 0.5 * (from + to);
    if (steepest * (to - from) <= unit_rounding * size_) return take_(middle, value_at(f_, middle));
    if (changes == 1 && slope.front() != 0.0 && slope.back() != 0.0) {
      const double x = bracketed_root([&](double at) { return slope_at(f_, at); }, from, to, unit_rounding);
      return take_(x, value_at(f_, x));
    }
    take_(middle, value_at(f_, middle));
    const Bernstein left = halve(slope);
    within(left, from, middle);
    within(slope, middle, to);
  }

 private:
  const Polynomial& f_;
  const Take& take_;
  double size_ = 0.0;
};

void note(Extremes& known, double value, std::size_t leg, double at) {
  if (value < known.least.value) known.least = {value, leg, at};
  if (value > known.most.value) known.most = {value, leg, at};
}

void look_along(const ModeSet& set, const Orbit& orbit, std::size_t leg, const MatrixXd& functionals,
                std::vector<Extremes>& all) {
  const ModeRates& mode = set.mode(orbit.shape.legs[leg].states);
  const double whole = orbit.duration(leg) * set.period();
  const double steps = std::max(1.0, std::ceil(std::abs(whole) / (part_of_step * mode.longest_step)));
  if (!(steps <= most_steps)) throw NumericalError("orbit: a leg is too long for the rates of its mode");
  const double h = whole / steps;
  VectorXd X = leg_start(set, orbit.shape.legs[leg], orbit.x[leg], orbit.t[leg]).value();
  MatrixXd terms(X.size(), degree + 1);
  for (int i = 0; i < static_cast<int>(steps); ++i) {
    terms.col(0) = X;
    for (int j = 1; j <= degree; ++j) terms.col(j) = (h / j) * (mode.outline.system * terms.col(j - 1));
    X = terms.rowwise().sum();
    const MatrixXd coefficients = functionals * terms;
    for (std::size_t k = 0; k < all.size(); ++k) {
      Polynomial f;
      for (int j = 0; j <= degree; ++j) f[static_cast<std::size_t>(j)] = coefficients(static_cast<Index>(k), j);
      const auto take = [&](double x, double value) {
        note(all[k], value, leg, orbit.duration(leg) * (i + x) / steps);
      };
      take(0.0, f[0]);
      take(1.0, value_at(f, 1.0));
      Search(f, take).within(slope_of(f), 0.0, 1.0);
    }
  }
}

std::vector<Extremes> none(const MatrixXd& functionals) {
  return std::vector<Extremes>(static_cast<std::size_t>(functionals.rows()), {{INFINITY, 0, 0.0}, {-INFINITY, 0, 0.0}});
}

}  // namespace

std::vector<Extremes> extremes(const ModeSet& set, const Orbit& orbit, std::size_t leg, const MatrixXd& functionals) {
  std::vector<Extremes> all = none(functionals);
  look_along(set, orbit, leg, functionals, all);
  return all;
}

std::vector<Extremes> extremes(const ModeSet& set, const Orbit& orbit, const MatrixXd& functionals) {
  std::vector<Extremes> all = none(functionals);
  for (std::size_t leg = 0; leg < orbit.legs(); ++leg) look_along(set, orbit, leg, functionals, all);
  return all;
}

MatrixXd coordinate_functionals(const mode::Frame& frame) {
  const Index n = frame.n, d = frame.d;
  MatrixXd rows = MatrixXd::Zero(2 * n, frame.size());  // x = W^-1 (p + shift), v = W^-1 (u + drift)
  rows.block(0, 0, n, n) = frame.W_inverse;
  rows.block(n, d, n, n) = frame.W_inverse;
  rows.col(frame.one()).head(n) = frame.W_inverse * frame.shift.head(n);
  rows.col(frame.one()).tail(n) = frame.W_inverse * frame.drift.head(n);
  return rows;
}

MatrixXd number_functionals(const Problem& problem, const mode::Frame& frame) {
  const Index n = frame.n;
  MatrixXd rows = MatrixXd::Zero(problem.numbers(), frame.size());
  for (Index i = 0; i < 2 * n; ++i) {
    VectorXd x = VectorXd::Unit(2 * n, i);
    problem.translations().take_out(x);
    rows.col(i < n ? i : frame.d + i - n) = problem.translations().numbers(x);
  }
  return rows;
}

}  // namespace slapstick::orbit
