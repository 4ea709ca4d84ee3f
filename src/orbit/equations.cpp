/// Linearises the equations of an orbit and solves them by Newton's method.
#include "orbit/equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.hpp"
#include "mode/numbering.hpp"
#include "orbit/kept.hpp"
#include "orbit/ties.hpp"
#include "section/settling.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double far_too_long = 5.0;  ///< a leg, against the cycle that Newton's method began with: it goes nowhere

/// x_0 by its numbers: the columns of representatives.
MatrixXd representatives(const Problem& problem, Index size) {
  MatrixXd all(size, problem.numbers());
  for (Index j = 0; j < problem.numbers(); ++j)
    all.col(j) = problem.translations().representative(VectorXd::Unit(problem.numbers(), j));
  return all;
}

/// The columns' classes modulo translations, as their numbers.
MatrixXd classes(const Problem& problem, const MatrixXd& columns) {
  MatrixXd all(problem.numbers(), columns.cols());
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd x = columns.col(j);
    problem.translations().take_out(x);
    all.col(j) = problem.translations().numbers(x);
  }
  return all;
}

bool forced(const Orbit& orbit) { return orbit.shape.n > 0; }

/// Does no parameter drive the model, where it is not driven? A derivative that does not exist may be anything.
bool stays_free(const Family& family, const std::vector<double>& values) {
  try {
    for (std::size_t which = 0; which < family.names.size(); ++which)
      if (section::driven(family.rate(values, which))) return false;
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace

Problem::Problem(Family family, const std::vector<double>& values)
    : family_(mode::numbered_alike(std::move(family), values)),
      values_(values),
      base_(std::make_shared<const System>(family_.model(values))),
      translations_(*base_),
      least_sizes_(VectorXd::Zero(numbers())),
      free_(!section::driven(*base_) && (!base_->model().forced() || stays_free(family_, values))) {
  demand_period(base_->model());
}

Index Problem::numbers() const { return translations_.size(); }
Index Problem::unknowns(std::size_t legs) const { return numbers() + static_cast<Index>(legs) + 1 + parameters(); }
Index Problem::instant_column(std::size_t event) const { return numbers() + static_cast<Index>(event); }
Index Problem::parameter_column(std::size_t legs, Index j) const {
  return numbers() + static_cast<Index>(legs) + 1 + j;
}

MatrixXd by_unknowns(const Problem& problem, const Jet& jet, const MatrixXd& states, std::size_t leg,
                     std::size_t legs) {
  MatrixXd by = jet.by_state() * states;
  by.col(problem.instant_column(leg)) += jet.by_begin();
  by.col(problem.instant_column(leg + 1)) += jet.by_end();
  for (Index p = 0; p < jet.parameters; ++p) by.col(problem.parameter_column(legs, p)) += jet.by_parameter().col(p);
  return by;
}

Linearised linearise(const Problem& problem, const ModeSet& set, const Orbit& orbit) {
  const std::size_t k = orbit.legs();
  const auto rows = static_cast<Index>(k);
  const Index N = problem.unknowns(k), size = 2 * problem.base().compiled().frame().n;
  Linearised at;
  at.residual = VectorXd::Zero(rows + problem.numbers() + 1);
  at.by = MatrixXd::Zero(at.residual.size(), N);
  MatrixXd states = MatrixXd::Zero(size, N);
  states.leftCols(problem.numbers()) = representatives(problem, size);
  VectorXd defect = VectorXd::Zero(size);
  for (std::size_t i = 0; i < k; ++i) {
    at.states.push_back(states);
    at.defects.push_back(defect);
    const Leg& leg = orbit.shape.legs[i];
    const Leg& next = orbit.shape.legs[(i + 1) % k];
    at.legs.push_back(leg_value(set, leg, next, orbit.x[i], orbit.t[i], orbit.t[i + 1]));
    const LegValue& value = at.legs.back();
    const auto row = static_cast<Index>(i);
    if (leg.ending == Ending::cut) {
      at.residual[row] = orbit.t[0];
      at.by(row, problem.instant_column(0)) = 1.0;
    } else {
      at.residual[row] = value.h.value()[0] + value.h.by_state().row(0).dot(defect);
      at.by.row(row) = by_unknowns(problem, value.h, states, i, k);
    }
    const VectorXd expected = i + 1 < k ? orbit.x[i + 1] : orbit.x[0];
    const VectorXd missed = value.after.value() - expected + value.after.by_state() * defect;
    states = by_unknowns(problem, value.after, states, i, k);
    defect = missed;
  }
  states.leftCols(problem.numbers()) -= representatives(problem, size);
  at.advance = problem.translations().take_out(defect);
  at.residual.segment(rows, problem.numbers()) = problem.translations().numbers(defect);
  at.by.middleRows(rows, problem.numbers()) = classes(problem, states);
  keep_what_rests(problem, orbit, at);
  at.residual.tail(1)[0] = forced(orbit) ? orbit.t[k] - orbit.t[0] - orbit.shape.n : orbit.t[0];
  at.by(at.by.rows() - 1, problem.instant_column(0)) = forced(orbit) ? -1.0 : 1.0;
  if (forced(orbit)) at.by(at.by.rows() - 1, problem.instant_column(k)) = 1.0;
  return at;
}

void move(const Problem& problem, const Linearised& at, const VectorXd& change, double fraction, Orbit& orbit) {
  const std::size_t k = orbit.legs();
  for (std::size_t i = 0; i < k; ++i) orbit.x[i] += at.states[i] * change + fraction * at.defects[i];
  for (std::size_t i = 0; i <= k; ++i) orbit.t[i] += change[problem.instant_column(i)];
  for (Index j = 0; j < problem.parameters(); ++j)
    orbit.values[static_cast<std::size_t>(j)] += change[problem.parameter_column(k, j)];
  orbit.advance = at.advance;
}

bool at_rest(double velocity, double displacement, double cycle) {
  // Of the displacement: some thousand roundings, which gather in a cycle. More would take a slow creep for rest, less
  // would measure an orbit at rest by its rounding.
  constexpr double rounding = 0x1p-40;
  return velocity * cycle <= rounding * displacement;
}

VectorXd sizes(const Problem& problem, const Orbit& orbit) {
  constexpr int samples =
      4;  // of each leg: at its events an orbit may be next to nothing, as a lone mass that grazes its stop
  const ModeSet set(constant_family(problem.family().model(orbit.values)), {});
  const Index n = set.frame().n, d = set.frame().d;
  double displacement = 0.0, velocity = 0.0;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const Jet start = leg_start(set, orbit.shape.legs[i], orbit.x[i], orbit.t[i]);
    Jet X(start.all.rows(), 0, 0);
    X.value() = start.value();
    for (int k = 0; k <= samples; ++k) {
      displacement = std::max(displacement, X.value().head(n).cwiseAbs().maxCoeff());
      velocity = std::max(velocity, X.value().segment(d, n).cwiseAbs().maxCoeff());
      flow(set.mode(orbit.shape.legs[i].states), orbit.duration(i) * set.period() / samples, X);
    }
  }
  const double cycle = (orbit.t.back() - orbit.t.front()) * set.period();
  if (at_rest(velocity, displacement, cycle)) velocity = displacement / cycle;
  VectorXd state(2 * n);
  state << VectorXd::Constant(n, displacement > 0.0 ? displacement : 1.0),
      VectorXd::Constant(n, velocity > 0.0 ? velocity : 1.0);
  VectorXd all = VectorXd::Ones(problem.unknowns(orbit.legs()));
  if (!forced(orbit)) {
    const auto instants = static_cast<Index>(orbit.t.size());
    all.segment(problem.instant_column(0), instants).setConstant(orbit.t.back() - orbit.t.front());
  }
  all.head(problem.numbers()) = problem.translations().numbers(state);
  for (Index j = 0; j < problem.parameters(); ++j) {
    const double least = j == 0 ? problem.least_value() : 0.0;
    const double value = std::max(std::abs(orbit.values[static_cast<std::size_t>(j)]), least);
    all[problem.parameter_column(orbit.legs(), j)] = value > 0.0 ? value : 1.0;
  }
  return all;
}

VectorXd level_rows(MatrixXd& matrix) {
  VectorXd largest = matrix.cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-300);
  matrix = largest.cwiseInverse().asDiagonal() * matrix;
  return largest;
}

std::vector<Condition> fixed_parameters(const Problem& problem, std::size_t legs) {
  std::vector<Condition> conditions;
  for (Index j = 0; j < problem.parameters(); ++j)
    conditions.push_back({RowVectorXd::Unit(problem.unknowns(legs), problem.parameter_column(legs, j))});
  return conditions;
}

std::vector<Condition> fixed_length(const Problem& problem, std::size_t legs, std::size_t leg) {
  std::vector<Condition> conditions = fixed_parameters(problem, legs);
  conditions[0].row.setZero();
  conditions[0].row[problem.instant_column(leg + 1)] = 1.0;
  conditions[0].row[problem.instant_column(leg)] = -1.0;
  return conditions;
}

namespace {

/// One step from the linearisation: the change of the unknowns; not finite where the matrix is singular.
/// @param more  of the conditions
VectorXd newton_step(const Linearised& at, const std::vector<Residual>& more, const VectorXd& scale) {
  const auto count = static_cast<Index>(more.size());
  MatrixXd matrix(at.by.rows() + count, at.by.cols());
  VectorXd right(matrix.rows());
  matrix.topRows(at.by.rows()) = at.by;
  right.head(at.residual.size()) = -at.residual;
  for (Index c = 0; c < count; ++c) {
    matrix.row(at.by.rows() + c) = more[static_cast<std::size_t>(c)].by;
    right[at.by.rows() + c] = -more[static_cast<std::size_t>(c)].value;
  }
  matrix = matrix * scale.asDiagonal();
  right = right.cwiseQuotient(level_rows(matrix));
  return dense::solve(matrix, right);
}

/// How well rounding lets the instants of events be known: where a guard falls slowly, as at the last impacts of a
/// chatter, by the rounding of the leg's start over its rate.
double rounding(const Orbit& orbit, const Linearised& at) {
  constexpr double roundoff = 2e-16, worst = 1e-7;
  double largest = 0.0;
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const LegValue& leg = at.legs[i];
    if (orbit.shape.legs[i].ending != Ending::guard) continue;
    const double noise = roundoff * leg.h.by_state().row(0).cwiseAbs().dot(orbit.x[i].cwiseAbs());
    largest = std::max(largest, noise / std::abs(leg.h.by_end()[0]));
  }
  return std::min(largest, worst);
}

double longest_leg(const Orbit& orbit) {
  double longest = 0.0;
  for (std::size_t i = 0; i < orbit.legs(); ++i) longest = std::max(longest, std::abs(orbit.duration(i)));
  return longest;
}

/// The numbers of an orbit as unknowns.
VectorXd unknowns_of(const Problem& problem, const Orbit& orbit) {
  VectorXd all(problem.unknowns(orbit.legs()));
  VectorXd x = orbit.x[0];
  problem.translations().take_out(x);
  all << problem.translations().numbers(x), VectorXd::Map(orbit.t.data(), static_cast<Index>(orbit.t.size())),
      VectorXd::Map(orbit.values.data(), problem.parameters());
  return all;
}

/// Where orbits lie among the unknowns of one of the same shape, begun at any event that the shape lets them begin at,
/// in the nearest period.
std::vector<VectorXd> places(const Problem& problem, const std::vector<Orbit>& orbits, const Orbit& of) {
  std::vector<VectorXd> all;
  for (const Orbit& orbit : orbits) {
    if (orbit.legs() != of.legs() || orbit.shape.n != of.shape.n) continue;
    for (std::size_t first = 0; first < orbit.legs(); ++first) {
      Orbit turned = orbit;
      rotate(turned, first);
      if (!(turned.shape.legs == of.shape.legs)) continue;
      const double periods = forced(of) ? std::round(of.t[0] - turned.t[0]) : 0.0;
      for (double& t : turned.t) t += periods;
      all.push_back(unknowns_of(problem, turned));
    }
  }
  return all;
}

/// The factor of a Newton step s at v when solutions v_i are taken out: 1 / (1 - g . s), g the gradient of log prod
/// (1 + reach / |v - v_i|^2).
double deflation(const std::vector<VectorXd>& taken_out, const VectorXd& v, const VectorXd& scale,
                 const VectorXd& step) {
  constexpr double reach = 0.1 * 0.1;  // squared: farther away, as a part of the orbit's size, nothing is to be felt
  double slope = 0.0;
  for (const VectorXd& other : taken_out) {
    const VectorXd away = (v - other).cwiseQuotient(scale);
    const double square = away.squaredNorm();
    slope -= 2.0 * reach * away.dot(step) / (square * (reach + square));
  }
  return 1.0 / (1.0 - slope);
}

void newton(const Problem& problem, Orbit& orbit, const std::vector<Condition>& conditions, int most_steps,
            const std::vector<Orbit>& besides, NewtonResult& result) {
  const VectorXd scale = sizes(problem, orbit);
  const std::vector<VectorXd> taken_out = places(problem, besides, orbit);
  const double longest = orbit.t.back() - orbit.t.front();
  VectorXd moved = VectorXd::Zero(scale.size());
  double before = INFINITY;
  for (result.steps = 1; result.steps <= most_steps; ++result.steps) {
    const ModeSet set(problem.family(), orbit.values);
    const Linearised at = linearise(problem, set, orbit);
    std::vector<Residual> more;
    for (const Condition& condition : conditions)
      more.push_back(condition.function ? condition.function(set, at, orbit)
                                        : Residual{condition.row.dot(moved), condition.row});
    VectorXd step = newton_step(at, more, scale);
    if (!taken_out.empty()) step *= deflation(taken_out, unknowns_of(problem, orbit), scale, step);
    if (!step.allFinite()) return;
    result.last_step = step.cwiseAbs().maxCoeff();
    for (const VectorXd& defect : at.defects)
      result.last_step = std::max(
          result.last_step,
          problem.translations().numbers(defect).cwiseQuotient(scale.head(problem.numbers())).cwiseAbs().maxCoeff());
    const double fraction = std::min(1.0, longest_newton_step / step.cwiseAbs().maxCoeff());
    const VectorXd change = fraction * step.cwiseProduct(scale);
    moved += change;
    const VectorXd was = problem.translations().numbers(orbit.x[0]);
    move(problem, at, change, fraction, orbit);
    if (!at.kept.empty() && fraction == 1.0) settle_forgotten(problem, at, was, orbit);
    if (longest_leg(orbit) > far_too_long * longest) return;
    // Quadratic convergence: the next step would be its square. Rounding ends it in any case.
    const double alike = std::max(1e-10, rounding(orbit, at));
    const bool stalled = result.last_step < alike && result.last_step > 0.1 * before;
    result.converged = result.last_step < enough_step || stalled;
    if (result.converged) return;
    before = result.last_step;
  }
}

}  // namespace

NewtonResult solve(const Problem& problem, Orbit& orbit, const std::vector<Condition>& conditions, int most_steps,
                   const std::vector<Orbit>& besides) {
  NewtonResult result;
  try {
    newton(problem, orbit, conditions, most_steps, besides, result);
    if (result.converged) settle_ties(orbit, rounding_of_instants(result.last_step));
  } catch (const InputError& error) {
    result.refusal = error.what();
  } catch (const NumericalError& error) {
    result.refusal = error.what();
  }
  return result;
}

namespace {

/// How fast the function of a leg's end goes to zero.
/// Where it only touches zero, what rounding would leave: the rates have no bound there, and with 0 they would be no
/// numbers, also where a stick takes them out.
double rate_of_end(const LegValue& leg) {
  const double rate = leg.h.by_end()[0];
  return rate != 0.0 ? rate : std::numeric_limits<double>::epsilon() * leg.X_end.by_end().cwiseAbs().maxCoeff();
}

}  // namespace

ReturnRates return_rates(const Problem& problem, const ModeSet& set, const Orbit& orbit,
                         const std::vector<LegValue>& legs) {
  const std::size_t k = orbit.legs();
  const Index size = 2 * problem.base().compiled().frame().n, n = size / 2, columns = size + problem.parameters();
  MatrixXd dx = MatrixXd::Zero(size, columns);
  dx.leftCols(size).setIdentity();
  RowVectorXd dt = RowVectorXd::Zero(columns);
  for (std::size_t i = 0; i < k; ++i) {
    const LegValue& leg = legs[i];
    RowVectorXd dt_end = RowVectorXd::Zero(columns);
    if (orbit.shape.legs[i].ending != Ending::cut) {
      RowVectorXd dh = leg.h.by_state() * dx + leg.h.by_begin() * dt;
      dh.tail(problem.parameters()) += leg.h.by_parameter();
      dt_end = -dh / rate_of_end(leg);
    }
    dx = leg.after.by_state() * dx + leg.after.by_begin() * dt + leg.after.by_end() * dt_end;
    dx.rightCols(problem.parameters()) += leg.after.by_parameter();
    dt = dt_end;
  }
  // At fixed time: the flow of the first leg takes back what the last instant came late.
  const Jet start = leg_start(set, orbit.shape.legs[0], orbit.x[0], orbit.t[0]);
  const ModeRates& mode = set.mode(orbit.shape.legs[0].states);
  const VectorXd rate = set.period() * (mode.outline.system * start.value());
  VectorXd flow(size);
  flow << rate.head(n), rate.segment(problem.base().compiled().frame().d, n);
  dx -= flow * dt;
  return {problem.translations().quotient(dx.leftCols(size)), classes(problem, dx.rightCols(problem.parameters()))};
}

}  // namespace slapstick::orbit
