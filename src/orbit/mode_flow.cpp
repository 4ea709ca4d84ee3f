/// exp(A s) by its series on short steps, and by doubling.
#include "orbit/mode_flow.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double negligible = 0x1p-60;  ///< a term, against the sum, that ends it
constexpr int most_terms = 80;

/// Largest of each column over the displacements, the velocities and the rest: three rows that are not of one unit.
MatrixXd block_sizes(const MatrixXd& Z, Index d) {
  MatrixXd sizes(3, Z.cols());
  sizes << Z.topRows(d).cwiseAbs().colwise().maxCoeff(), Z.middleRows(d, d).cwiseAbs().colwise().maxCoeff(),
      Z.bottomRows(Z.rows() - 2 * d).cwiseAbs().colwise().maxCoeff();
  return sizes;
}

/// One step of the series of exp(A s).
/// @param width  columns at the front of X whose derivatives with respect to the parameters stand at its end, in blocks
/// of as many columns, one for each parameter
void step(const ModeRates& mode, double s, Index width, Index parameters, MatrixXd& X) {
  const auto d = static_cast<Index>(mode.outline.steady.size());
  MatrixXd term = X;
  MatrixXd sizes = block_sizes(X, d);
  int small = 0;
  for (int j = 1; j <= most_terms && small < 3; ++j) {
    MatrixXd next = mode.outline.system * term;
    for (Index p = 0; p < parameters; ++p)
      next.middleCols(next.cols() - (parameters - p) * width, width) +=
          mode.rates[static_cast<std::size_t>(p)].system * term.leftCols(width);
    term = (s / j) * next;
    X += term;
    const MatrixXd added = block_sizes(term, d);
    sizes = sizes.cwiseMax(added);
    small = (added.array() <= negligible * sizes.array()).all() ? small + 1 : 0;
  }
}

/// E, and beside it D_p of each parameter, of twice the time.
MatrixXd twice(const MatrixXd& all) {
  const Index size = all.rows(), parameters = all.cols() / size - 1;
  const auto E = all.leftCols(size);
  MatrixXd doubled(size, all.cols());
  doubled.leftCols(size) = E * E;
  for (Index p = 0; p < parameters; ++p) {
    const auto D = all.middleCols((1 + p) * size, size);
    doubled.middleCols((1 + p) * size, size) = D * E + E * D;
  }
  return doubled;
}

/// The largest power of two that is a step: multiples of it are exact.
double round_step(const ModeRates& mode) { return std::exp2(std::floor(std::log2(mode.longest_step))); }

/// Of a round step, doubled k times.
const MatrixXd& doubling(const ModeRates& mode, std::size_t k) {
  std::vector<MatrixXd>& known = mode.doublings;
  if (known.empty()) {
    const Index size = mode.outline.system.rows(), parameters = static_cast<Index>(mode.rates.size());
    known.emplace_back(MatrixXd::Identity(size, (1 + parameters) * size));
    step(mode, round_step(mode), size, parameters, known.front());
  }
  while (known.size() <= k) known.push_back(twice(known.back()));
  return known[k];
}

void apply(const MatrixXd& all, Jet& X) {
  const Index size = all.rows();
  MatrixXd moved = all.leftCols(size) * X.all;
  for (Index p = 0; p < X.parameters; ++p)
    moved.col(moved.cols() - X.parameters + p) += all.middleCols((1 + p) * size, size) * X.value();
  X.all = std::move(moved);
}

}  // namespace

bool is_long(const ModeRates& mode, double s) {
  constexpr double worth = 4.0;  // of the rows of X: it decides on time alone
  return s > 0.0 && mode.steps(s) > worth * static_cast<double>(mode.outline.system.rows());
}

void flow(const ModeRates& mode, double s, Jet& X) {
  if (is_long(mode, s)) {
    const double h = round_step(mode), whole = std::floor(s / h);
    auto steps = static_cast<std::uint64_t>(whole);
    for (std::size_t k = 0; steps != 0; ++k, steps >>= 1U)
      if ((steps & 1U) != 0) apply(doubling(mode, k), X);
    s -= whole * h;
  }
  const double steps = mode.steps(s);
  for (int i = 0; i < static_cast<int>(steps); ++i) step(mode, s / steps, 1, X.parameters, X.all);
}

MatrixXd short_flow(const ModeRates& mode, double s) {
  const Index size = mode.outline.system.rows();
  MatrixXd E = MatrixXd::Identity(size, size);
  step(mode, s, size, 0, E);
  return E;
}

}  // namespace slapstick::orbit
