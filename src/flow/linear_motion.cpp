/// Finds the eigenvalues of a linear machine, each to its own rounding.
#include "flow/linear_motion.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "base/dense.hpp"

namespace slapstick::flow {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

double size_of(Complex z) { return std::sqrt(std::norm(z)); }

/// Of a sum of k products whose terms have sizes that add up to 1: some sixty roundings each.
double rounding(Index k) { return 64.0 * static_cast<double>(k) * std::numeric_limits<double>::epsilon(); }

/// A basis of the kernel of A, whose entries are sums of terms of these sizes. Rows and columns have units of their
/// own.
MatrixXd kernel_of(const MatrixXd& A, const MatrixXd& size) {
  MatrixXd scaled = (A.array().abs() > rounding(A.cols()) * size.array()).select(A, 0.0);
  const auto by = [](double largest) { return largest > 0.0 ? 1.0 / largest : 1.0; };
  for (Index i = 0; i < scaled.rows(); ++i) scaled.row(i) *= by(scaled.row(i).cwiseAbs().maxCoeff());
  VectorXd of_column(scaled.cols());
  for (Index j = 0; j < scaled.cols(); ++j) {
    of_column[j] = by(scaled.col(j).cwiseAbs().maxCoeff());
    scaled.col(j) *= of_column[j];
  }
  if (scaled.isZero(0.0)) return MatrixXd::Identity(A.cols(), A.cols());
  return of_column.asDiagonal() * dense::kernel(scaled, rounding(A.cols())).basis;
}

/// Columns that complete those of a basis.
MatrixXd complement(const MatrixXd& basis) {
  if (basis.cols() == 0) return MatrixXd::Identity(basis.rows(), basis.rows());
  const MatrixXd all = dense::right_singular_vectors(basis.transpose());
  return all.rightCols(basis.rows() - basis.cols());
}

/// a = both alpha + slow gamma + seen beta: K sees beta only, C gamma' and beta'.
struct Directions {
  explicit Directions(const MatrixXd& K, const MatrixXd& C) : both(K.rows(), 0), slow(K.rows(), 0) {
    const MatrixXd unseen = kernel_of(K, K.cwiseAbs());
    seen = complement(unseen);
    if (unseen.cols() == 0) return;
    const MatrixXd turned = kernel_of(C * unseen, C.cwiseAbs() * unseen.cwiseAbs());
    both = unseen * turned;
    slow = unseen * complement(turned);
  }
  [[nodiscard]] MatrixXd all() const {
    MatrixXd T(seen.rows(), seen.rows());
    T << both, slow, seen;
    return T;
  }
  MatrixXd both, slow, seen;
};

LinearMotion at_zero(const VectorXd& shape) { return {0.0, 0.0, shape.cast<Complex>()}; }

/// Rows of lambda^2 - lambda C - K, and the sizes of their terms at phi.
struct Pencil {
  Pencil(const MatrixXd& K, const MatrixXd& C, Complex lambda)
      : T(-lambda * C - K.cast<Complex>()),
        rate(-C.cast<Complex>()),
        size(size_of(lambda) * C.cwiseAbs() + K.cwiseAbs()) {
    T.diagonal().array() += lambda * lambda;
    rate.diagonal().array() += 2.0 * lambda;
    size.diagonal().array() += std::norm(lambda);
  }
  MatrixXcd T, rate;
  MatrixXd size;
};

/// One Newton step for (lambda, phi) with phi[fixed] = 1: the step, and the error of lambda by the left vector.
struct Step {
  Complex lambda;
  VectorXcd shape;
  double error = 0.0;
};
Step newton(const Pencil& pencil, const VectorXcd& shape, Index fixed) {
  const Index k = shape.size();
  const VectorXd row = pencil.size.rowwise().maxCoeff().cwiseInverse();
  MatrixXcd bordered = MatrixXcd::Zero(k + 1, k + 1);
  bordered.topLeftCorner(k, k) = row.asDiagonal() * pencil.T;
  bordered.topRightCorner(k, 1) = row.asDiagonal() * (pencil.rate * shape);
  bordered(k, fixed) = 1.0;
  VectorXcd left_over = VectorXcd::Zero(k + 1);
  left_over.head(k) = -(row.asDiagonal() * (pencil.T * shape));
  const VectorXcd step = dense::solve_complex(bordered, left_over);
  const VectorXcd left = dense::solve_complex(bordered.adjoint(), VectorXcd::Unit(k + 1, k));
  const VectorXd terms = row.asDiagonal() * (pencil.size * shape.cwiseAbs2().cwiseSqrt());
  // The left vector has w^H T' phi = 1: an error of 8 k roundings of the terms moves lambda by no more than this.
  return {step[k], step.head(k), rounding(k) / 8.0 * left.head(k).cwiseAbs2().cwiseSqrt().dot(terms)};
}

/// What Newton's method makes of a first guess, or nothing where it does not stay with it.
std::optional<LinearMotion> improved(const MatrixXd& K, const MatrixXd& C, LinearMotion motion) {
  constexpr int most_steps = 4;  // digits double: from two of them to all, with one step to spare
  constexpr double stays = 0.1;  // of lambda: farther off it would be another eigenvalue, told twice
  Index fixed = 0;
  motion.shape.cwiseAbs2().maxCoeff(&fixed);
  motion.shape /= motion.shape[fixed];
  const Complex first = motion.lambda;
  for (int i = 0; i < most_steps; ++i) {
    const Step step = newton(Pencil(K, C, motion.lambda), motion.shape, fixed);
    motion.lambda += step.lambda;
    motion.shape += step.shape;
    motion.error = step.error;
    if (!std::isfinite(size_of(motion.lambda)) || !motion.shape.allFinite() || !std::isfinite(step.error))
      return std::nullopt;
    if (size_of(step.lambda) <= std::numeric_limits<double>::epsilon() * size_of(motion.lambda)) break;
  }
  if (size_of(motion.lambda - first) > stays * size_of(first)) return std::nullopt;
  return motion;
}

}  // namespace

VectorXd balance(MatrixXd& Q) {
  constexpr int most_rounds = 40;
  constexpr double gain = 0.95;
  VectorXd D = VectorXd::Ones(Q.rows());
  bool changed = true;
  for (int round = 0; round < most_rounds && changed; ++round) {
    changed = false;
    for (Index i = 0; i < Q.rows(); ++i) {
      const double own = std::abs(Q(i, i));
      const double column = Q.col(i).cwiseAbs().sum() - own, row = Q.row(i).cwiseAbs().sum() - own;
      if (!(column > 0.0 && row > 0.0)) continue;
      double f = 1.0;  // f^2 is row / column within a factor of two
      while (2.0 * f * f < row / column) f *= 2.0;
      while (f * f > 2.0 * row / column) f *= 0.5;
      if (f == 1.0 || column * f + row / f >= gain * (column + row)) continue;
      Q.col(i) *= f, Q.row(i) /= f, D[i] *= f;
      changed = true;
    }
  }
  return D;
}

/// In the coordinates (alpha, gamma, beta) of Directions, (beta, gamma', beta') are a system of their own; then
/// alpha'' = lambda^2 alpha and gamma' = lambda gamma give the rest of the shape.
std::vector<LinearMotion> linear_motions(const MatrixXd& K, const MatrixXd& C) {
  const Directions of(K, C);
  const Index k = K.rows(), u = of.both.cols(), s = of.slow.cols(), b = of.seen.cols();
  std::vector<LinearMotion> all;
  for (Index i = 0; i < u; ++i) all.insert(all.end(), 2, at_zero(of.both.col(i)));
  for (Index i = 0; i < s; ++i) all.push_back(at_zero(of.slow.col(i)));
  if (s + b == 0) return all;
  const MatrixXd T = of.all(), back = dense::inverse(T), K_seen = back * K * of.seen;
  const MatrixXd C_seen = back * C * T.rightCols(s + b);
  MatrixXd Q = MatrixXd::Zero(2 * b + s, 2 * b + s);
  Q.topRightCorner(b, b).setIdentity();
  Q.bottomLeftCorner(s + b, b) = K_seen.bottomRows(s + b);
  Q.bottomRightCorner(s + b, s + b) = C_seen.bottomRows(s + b);
  const VectorXd D = balance(Q);
  const dense::Eigenpairs pairs = dense::eigenpairs(Q);
  for (Index i = 0; i < pairs.values.size(); ++i) {
    const Complex lambda = pairs.values[i];
    const VectorXcd state = D.asDiagonal() * pairs.vectors.col(i), rates = state.tail(s + b);
    VectorXcd a(k);
    a << (K_seen.topRows(u) * state.head(b) + C_seen.topRows(u) * rates) / (lambda * lambda), rates.head(s) / lambda,
        state.head(b);
    const LinearMotion guess{lambda, std::sqrt(rounding(k)) * size_of(lambda), T * a};
    all.push_back(improved(K, C, guess).value_or(guess));
  }
  return all;
}

}  // namespace slapstick::flow
