/// The extremes of linear functionals along a leg: those of the polynomials that they are on short steps.
#include "orbit/extremes.hpp"

#include <algorithm>
#include <cmath>

#include "event/polynomial.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int degree = 20;  ///< the terms of exp(A h) fall at least like those of e: 1 / 20! is below rounding
constexpr double part_of_step = 0.5;  ///< .. over this part of ModeRates::longest_step

void note(Extremes& known, double value, std::size_t leg, double at) {
  if (value < known.least.value) known.least = {value, leg, at};
  if (value > known.most.value) known.most = {value, leg, at};
}

void look_along(const ModeSet& set, const Orbit& orbit, std::size_t leg, const MatrixXd& functionals,
                std::vector<Extremes>& all) {
  const ModeRates& mode = set.mode(orbit.shape.legs[leg].states);
  const double whole = orbit.duration(leg) * set.period();
  const double steps = mode.steps(whole / part_of_step);
  const double h = whole / steps;
  VectorXd X = leg_start(set, orbit.shape.legs[leg], orbit.x[leg], orbit.t[leg]).value();
  MatrixXd terms(X.size(), degree + 1);
  for (int i = 0; i < static_cast<int>(steps); ++i) {
    terms.col(0) = X;
    for (int j = 1; j <= degree; ++j) terms.col(j) = (h / j) * (mode.outline.system * terms.col(j - 1));
    X = terms.rowwise().sum();
    const MatrixXd coefficients = functionals * terms;
    for (std::size_t k = 0; k < all.size(); ++k) {
      event::Polynomial f;
      f.degree = degree;
      for (int j = 0; j <= degree; ++j) f.a[static_cast<std::size_t>(j)] = coefficients(static_cast<Index>(k), j);
      event::possible_extremes(
          f, [&](double x, double value) { note(all[k], value, leg, orbit.duration(leg) * (i + x) / steps); });
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
