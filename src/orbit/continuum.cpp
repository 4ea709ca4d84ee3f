/// Continua of orbits at the same parameters: null vectors of the orbit equations, and whether moving along them keeps
/// solving.
#include "orbit/continuum.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "orbit/cyclic.hpp"
#include "orbit/extent.hpp"
#include "orbit/kept.hpp"
#include "orbit/record.hpp"
#include "orbit/short_legs.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double almost_singular =
    1e-6;  ///< of the largest singular value: small enough to be looked at; what is found is then proved
constexpr double is_rounding = 1e-11;  ///< a step, or a levelled residual, that is rounding

/// The equations at fixed parameters, in units of the orbit's sizes, their rows levelled once.
class Equations {
 public:
  Equations(const Problem& problem, const Orbit& orbit)
      : problem_(problem), fixed_(fixed_parameters(problem, orbit.legs())), scale_(sizes(problem, orbit)) {}

  /// The residual r and its derivative M, after which `step` can be taken.
  void linearise_at(const Orbit& orbit) {
    const ModeSet set(problem_.family(), orbit.values);
    at_ = linearise(problem_, set, orbit);
    const auto more = static_cast<Index>(fixed_.size());
    matrix.resize(at_->by.rows() + more, at_->by.cols());
    residual = VectorXd::Zero(matrix.rows());
    matrix.topRows(at_->by.rows()) = at_->by;
    residual.head(at_->residual.size()) = at_->residual;
    for (Index c = 0; c < more; ++c) matrix.row(at_->by.rows() + c) = fixed_[static_cast<std::size_t>(c)].row;
    matrix = matrix * scale_.asDiagonal();
    if (level_.size() == 0) level_ = row_sizes();
    matrix = level_.cwiseInverse().asDiagonal() * matrix;
    residual = residual.cwiseQuotient(level_);
  }

  /// Moves the orbit by a step in units of its sizes.
  void step(const VectorXd& by, Orbit& orbit) const { move(problem_, *at_, by.cwiseProduct(scale_), 1.0, orbit); }

  [[nodiscard]] double defect() const {
    double most = 0.0;
    for (const VectorXd& missed : at_->defects)
      most = std::max(
          most,
          problem_.translations().numbers(missed).cwiseQuotient(scale_.head(problem_.numbers())).cwiseAbs().maxCoeff());
    return most;
  }

  MatrixXd matrix;
  VectorXd residual;

 private:
  /// The greatest entries. A row that closes the cycle, of the map minus the identity, may be nothing but rounding: no
  /// less than the identity's entry.
  [[nodiscard]] VectorXd row_sizes() const {
    VectorXd largest = matrix.cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-300);
    const Index first = at_->by.rows() - 1 - problem_.numbers();
    auto closing = largest.segment(first, problem_.numbers());
    closing = closing.cwiseMax(scale_.head(problem_.numbers()));
    return largest;
  }

  const Problem& problem_;
  std::vector<Condition> fixed_;
  VectorXd scale_, level_;
  std::optional<Linearised> at_;
};

/// The null vectors of M and of its transpose, by columns.
struct Null {
  MatrixXd right, left;
};

Null null_vectors(const MatrixXd& matrix) {
  const dense::SingularVectors all = dense::singular_vectors(matrix);
  const VectorXd& values = all.values;
  Index count = 0;
  while (count < values.size() && values[values.size() - 1 - count] <= almost_singular * values[0]) ++count;
  return {all.right.rightCols(count), all.left.rightCols(count)};
}

/// Newton's method on the bordered equations at V^T (v - v_0) = s. The orbit is moved to where they hold.
/// @returns the size of mu; infinite if it does not come there
double solve_bordered(const Problem& problem, Orbit& orbit, const Null& null, const VectorXd& s) {
  constexpr int most_steps = 12;
  Equations equations(problem, orbit);
  const Index size = problem.unknowns(orbit.legs()), count = s.size();
  VectorXd moved = VectorXd::Zero(size);
  for (int k = 0; k < most_steps; ++k) {
    equations.linearise_at(orbit);
    MatrixXd bordered = MatrixXd::Zero(size + count, size + count);
    bordered.topLeftCorner(size, size) = equations.matrix;
    bordered.topRightCorner(size, count) = null.left;
    bordered.bottomLeftCorner(count, size) = null.right.transpose();
    VectorXd right(size + count);
    right << -equations.residual, s - null.right.transpose() * moved;
    const VectorXd solution = dense::solve(bordered, right), step = solution.head(size);
    if (!solution.allFinite()) return INFINITY;
    const bool there = step.cwiseAbs().maxCoeff() < is_rounding && equations.defect() < is_rounding;
    equations.step(step, orbit);
    if (there) return count > 0 ? solution.tail(count).cwiseAbs().maxCoeff() : 0.0;
    moved += step;
  }
  return INFINITY;
}

Null null_vectors_at(const Problem& problem, const Orbit& orbit) {
  Equations equations(problem, orbit);
  equations.linearise_at(orbit);
  return equations.matrix.allFinite() ? null_vectors(equations.matrix) : Null{};
}

/// Has it a multiplier 1 too? Those beside a point of inflection, where the parameter is a cube, have not: 1 - mu is a
/// square.
bool has_multiplier_one(const Problem& problem, const Orbit& beside) {
  constexpr double half_the_digits = 1e-6;  // a double one is known to no more
  const ModeSet set(problem.family(), beside.values);
  const auto all = multipliers(problem, set, beside, linearise(problem, set, beside).legs);
  return ranges::any_of(all, [](std::complex<double> mu) { return std::abs(mu - 1.0) < half_the_digits; });
}

/// Is the j-th null direction one along which orbits lie, in both senses?
bool leads_along(const Problem& problem, const Orbit& orbit, const Null& null, Index j) {
  constexpr double left_of_a_leg = 0.5;    // less is not of the way: a leg that dies solves its equations anywhere
  constexpr double distance_along = 1e-2;  // in units of the orbit's size: its cube is far above rounding
  for (const double sense : {1.0, -1.0}) {
    Orbit beside = orbit;
    const VectorXd s = sense * distance_along * VectorXd::Unit(null.right.cols(), j);
    if (!(solve_bordered(problem, beside, null, s) < is_rounding)) return false;
    if (shrunk_legs(orbit, beside, left_of_a_leg) > 0 || !has_multiplier_one(problem, beside)) return false;
  }
  return true;
}

}  // namespace

int continuum(const Problem& problem, const Orbit& orbit, const std::vector<std::complex<double>>& multipliers) {
  constexpr double from_one = 1e-4;  // a double multiplier 1, as of a conservative model, is known to half the digits
  // Each dimension has a multiplier 1. To look for more costs much where many short legs make the equations singular.
  const auto most =
      ranges::count_if(multipliers, [](std::complex<double> mu) { return std::abs(mu - 1.0) < from_one; });
  if (most == 0) return 0;
  int dimension = 0;
  try {
    dimension = kept_numbers(problem, orbit);
    if (dimension >= most) return dimension;
    const Null null = null_vectors_at(problem, orbit);
    for (Index j = 0; j < null.right.cols(); ++j) dimension += leads_along(problem, orbit, null, j) ? 1 : 0;
  } catch (const InputError&) {
  } catch (const NumericalError&) {  // a direction in which there are no orbits, as of a chatter's short legs
  }
  return dimension;
}

namespace {

/// Newton's method at right angles to the null vectors.
std::optional<Orbit> refine_with_least_change(const Problem& problem, Orbit guess) {
  try {
    const Null null = null_vectors_at(problem, guess);
    const VectorXd in_place = VectorXd::Zero(null.right.cols());
    if (solve_bordered(problem, guess, null, in_place) < is_rounding) return guess;
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

/// Beside a curved family the equations are singular up to the guess's own distance from it.
bool nearly_singular(const Problem& problem, const Orbit& guess) {
  try {
    Equations equations(problem, guess);
    equations.linearise_at(guess);
    return equations.matrix.allFinite() && !(dense::reciprocal_condition(equations.matrix) > almost_singular);
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
  return false;
}

}  // namespace

std::optional<Orbit> refine_in_place(const Problem& problem, const Orbit& guess, const std::vector<Orbit>& besides) {
  if (nearly_singular(problem, guess))
    if (auto kept = refine_with_least_change(problem, guess)) return kept;
  return refine(problem, guess, besides);
}

namespace {

/// The point of the line from a to b, which has the same legs, at this part of the way.
Orbit on_the_way(const Orbit& a, const Orbit& b, double part) {
  const double periods = a.shape.n > 0 ? std::round(a.t[0] - b.t[0]) : 0.0;
  Orbit middle = a;
  for (std::size_t i = 0; i < a.x.size(); ++i) middle.x[i] += part * (b.x[i] - a.x[i]);
  for (std::size_t i = 0; i < a.t.size(); ++i) middle.t[i] += part * (b.t[i] + periods - a.t[i]);
  return middle;
}

/// Do orbits that are motions lie near the line from a to b?
bool orbits_between(const Problem& problem, const Orbit& a, const Orbit& b) {
  constexpr double longest_detour = 0.1;  // of the way
  const Extent extent(problem, a);
  const double way = extent.distance(a.x[0], b.x[0]);
  for (const double part : {0.25, 0.5, 0.75}) {
    const Orbit guess = on_the_way(a, b, part);
    const std::optional<Orbit> orbit = refine_with_least_change(problem, guess);
    if (!orbit || extent.distance(orbit->x[0], guess.x[0]) > longest_detour * way || !is_motion(problem, *orbit))
      return false;
  }
  return true;
}

}  // namespace

bool in_one_family(const Problem& problem, const Orbit& a, const Orbit& b) {
  if (a.shape.n != b.shape.n) return false;
  return from_some_event(a, b, [&](std::size_t shift) {
    Orbit turned = b;
    rotate(turned, shift);
    return orbits_between(problem, a, turned);
  });
}

}  // namespace slapstick::orbit
