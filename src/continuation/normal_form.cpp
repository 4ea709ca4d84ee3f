/// The coefficients of normal forms, from the return map's exact Jacobian and differences of it.
#include "continuation/normal_form.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/dense.hpp"
#include "orbit/extremes.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr int halvings = 18;                 ///< of the step of differences, from 1/8 on
constexpr double error_of_no_matter = 1e-8;  ///< relative error of a coefficient after which there is nothing to gain
constexpr double believed = 1e-3;            ///< largest relative error of a coefficient
constexpr double resonant = 0.01;            ///< |mu^m - 1|, m = 1 .. 4: nearer the normal form has other terms
constexpr double at_circle = 1e-3;       ///< nearer to the unit circle another multiplier has a part in what happens
constexpr double off_multiplier = 1e-4;  ///< .. of the multiplier from what it is taken for

Orbit begun(Orbit orbit, std::size_t leg) {
  if (leg > 0) rotate(orbit, leg);
  return orbit;
}

ModeSet set_of(const Problem& problem, const Orbit& orbit) {
  return {constant_family(problem.family().model(orbit.values)), {}};
}

/// The largest displacement and the largest velocity over the cycle, for each of the numbers.
VectorXd largest_sizes(const Problem& problem, const ModeSet& set, const Orbit& orbit) {
  const std::vector<Extremes> all = extremes(set, orbit, number_functionals(problem, set.frame()));
  const auto displacements = problem.numbers() - problem.translations().velocities();
  const auto largest = [](auto first, auto last) {
    double most = 0.0;
    for (; first != last; ++first) most = std::max(most, first->largest());
    return most > 0.0 ? most : 1.0;
  };
  VectorXd sizes(problem.numbers());
  sizes << VectorXd::Constant(displacements, largest(all.begin(), all.begin() + displacements)),
      VectorXd::Constant(problem.translations().velocities(), largest(all.begin() + displacements, all.end()));
  return sizes;
}

/// A leg whose end is found by Newton's method from a guess.
LegValue ended(const ModeSet& set, const Leg& leg, const Leg& next, const VectorXd& x, double begin, double& end) {
  constexpr int most_newton_steps = 30;
  constexpr double instant_rounding = 4e-16;
  double before = INFINITY;
  for (int k = 0; k < most_newton_steps; ++k) {
    LegValue value = leg_value(set, leg, next, x, begin, end);
    if (leg.ending == Ending::cut) return value;
    const double step = -value.h.value()[0] / value.h.by_end()[0];
    if (!std::isfinite(step) || std::abs(step) > 1.0) break;
    const bool stalled = std::abs(step) < 1e-13 && std::abs(step) >= before;
    if (std::abs(step) <= instant_rounding * std::max(1.0, std::abs(end)) || stalled) return value;
    before = std::abs(step);
    end += step;
  }
  throw NumericalError("normal form: a leg beside the orbit does not end");
}

/// x -> d jacobian / d x along a direction: once and twice.
struct Differences {
  MatrixXd first, second;
};

Differences differences(const FixedPhaseMap& map, const MatrixXd& A, const VectorXd& along, double h) {
  const MatrixXd plus = map.jacobian(h * along), minus = map.jacobian(-h * along);
  return {(plus - minus) / (2.0 * h), (plus - 2.0 * A + minus) / (h * h)};
}

/// The formulas of the header, with derivatives by differences of step h.
double at_step(SpecialType type, const FixedPhaseMap& map, const MatrixXd& A, const Critical& direction, double h) {
  const VectorXcd& q = direction.q;
  const VectorXd a = q.real(), b = q.imag();
  const MatrixXd I = MatrixXd::Identity(A.rows(), A.cols());
  const Differences by_a = differences(map, A, a, h);
  if (type == SpecialType::LP) return std::abs(0.5 * (direction.p * (by_a.first * a))[0].real());
  if (type == SpecialType::PD) {
    const VectorXd shift = dense::solve(MatrixXd(I - A), VectorXd(by_a.first * a));
    const VectorXd third = by_a.second * a + 3.0 * by_a.first * shift;
    return (direction.p * third)[0].real() / 6.0;
  }
  const Differences by_b = differences(map, A, b, h);
  const Complex mu = direction.mu, i(0.0, 1.0);
  const MatrixXcd along = by_a.first + i * by_b.first, conjugate = along.conjugate();  // B(q, .), B(q*, .)
  const VectorXd still = dense::solve(MatrixXd(I - A), VectorXd(by_a.first * a + by_b.first * b));
  const VectorXcd twice = dense::solve_complex(MatrixXcd(mu * mu * I - A), VectorXcd(along * q));
  const VectorXcd third = (by_a.second + by_b.second) * q + 2.0 * (along * still) + conjugate * twice;
  return 0.5 * (std::conj(mu) * (direction.p * third)[0]).real();
}

/// Why the normal form does not decide what happens; verdict none if it does.
NormalForm obstacle(SpecialType type, Complex mu, const std::vector<Complex>& multipliers) {
  NormalForm form;
  Complex power = 1.0;
  for (int m = 1; type == SpecialType::NS && m <= 4; ++m) {
    power *= mu;
    if (std::abs(power - 1.0) >= resonant) continue;
    form.verdict = NormalForm::Verdict::resonance;
    form.resonance = m;
    return form;
  }
  int near = 0;
  for (const Complex& multiplier : multipliers) near += std::abs(std::abs(multiplier) - 1.0) < at_circle ? 1 : 0;
  if (near > (type == SpecialType::NS ? 2 : 1)) form.verdict = NormalForm::Verdict::other_critical;
  return form;
}

/// The multiplier that makes the point what it is.
Complex target(const SpecialPoint& point) {
  if (point.type == SpecialType::LP) return 1.0;
  if (point.type == SpecialType::PD) return -1.0;
  return std::polar(1.0, 2.0 * std::numbers::pi * point.rotation);
}

}  // namespace

FixedPhaseMap::FixedPhaseMap(const Problem& problem, Orbit orbit, std::size_t leg)
    : problem_(&problem),
      orbit_(begun(std::move(orbit), leg)),
      set_(set_of(problem, orbit_)),
      phase_(orbit_.t[0] + (orbit_.shape.n > 0 ? 0.5 * orbit_.duration(0) : 0.0)),
      state_(contact_state(set_, state_within(set_, orbit_, 0, phase_ - orbit_.t[0]))),
      sizes_(largest_sizes(problem, set_, orbit_)) {}

MatrixXd FixedPhaseMap::jacobian(const VectorXd& x) const {
  const std::size_t k = orbit_.legs();
  VectorXd state = state_ + problem_->translations().representative(sizes_.cwiseProduct(x));
  MatrixXd dx = MatrixXd::Identity(state.size(), state.size());
  RowVectorXd dt = RowVectorXd::Zero(state.size());
  double t = phase_;
  const auto pass = [&](const Leg& leg, const Leg& next, double& end) {
    const LegValue value = ended(set_, leg, next, state, t, end);
    RowVectorXd dt_end = RowVectorXd::Zero(state.size());
    if (leg.ending != Ending::cut) dt_end = -(value.h.by_state() * dx + value.h.by_begin() * dt) / value.h.by_end()[0];
    dx = value.after.by_state() * dx + value.after.by_begin() * dt + value.after.by_end() * dt_end;
    dt = dt_end;
    state = value.after.value();
    t = end;
  };
  for (std::size_t i = 0; i < k; ++i) {
    double end = orbit_.t[i + 1];
    pass(orbit_.shape.legs[i], orbit_.shape.legs[(i + 1) % k], end);
  }
  if (orbit_.shape.n > 0) {  // back to the phase of the start, in the first leg's mode
    Leg rest = orbit_.shape.legs[0];
    rest.ending = Ending::cut;
    rest.strikes.clear();
    double end = phase_ + orbit_.shape.n;
    pass(rest, orbit_.shape.legs[0], end);
  }
  return sizes_.cwiseInverse().asDiagonal() * problem_->translations().quotient(dx) * sizes_.asDiagonal();
}

Critical critical(const MatrixXd& A, Complex mu) {
  const auto nearest = [&](const MatrixXd& matrix) {
    const dense::Eigenpairs pairs = dense::eigenpairs(matrix);
    Index best = 0;
    for (Index i = 1; i < matrix.rows(); ++i)
      if (std::abs(pairs.values[i] - mu) < std::abs(pairs.values[best] - mu)) best = i;
    return std::pair<Complex, VectorXcd>(pairs.values[best], pairs.vectors.col(best));
  };
  const auto [value, q] = nearest(A);
  Critical direction{value, q / q.norm(), nearest(A.transpose()).second.transpose()};
  direction.p /= (direction.p * direction.q)[0];
  return direction;
}

Estimate coefficient(SpecialType type, const FixedPhaseMap& map, const Critical& direction) {
  const MatrixXd A = map.jacobian(VectorXd::Zero(map.sizes().size()));
  Estimate best{std::nan(""), INFINITY};
  const auto value_at = [&](double step) {
    try {
      return at_step(type, map, A, direction, step);
    } catch (const NumericalError&) {  // too far
      return std::nan("");
    }
  };
  double value = std::nan(""), last = value, before_last = value;  // extrapolated: the last two
  for (int k = 0; k < halvings && !(best.error <= error_of_no_matter * std::abs(best.value)); ++k) {
    const double coarse = std::exchange(value, value_at(std::ldexp(0.125, -k)));
    const double extrapolated = (4.0 * value - coarse) / 3.0;
    const double change = std::max(std::abs(last - before_last), std::abs(extrapolated - last));
    if (std::isfinite(extrapolated) && change < best.error) best = {last, change};
    before_last = std::exchange(last, extrapolated);
  }
  return best;
}

NormalForm normal_form(const Problem& problem, const SpecialPoint& point) {
  NormalForm form;
  try {
    const Orbit& orbit = point.solution.orbit;
    const FixedPhaseMap map(problem, orbit, freest_leg(set_of(problem, orbit), orbit));
    const Critical direction = critical(map.jacobian(VectorXd::Zero(map.sizes().size())), target(point));
    if (std::abs(direction.mu - target(point)) > off_multiplier) {
      form.verdict = NormalForm::Verdict::not_simple;
      return form;
    }
    form = obstacle(point.type, direction.mu, point.solution.multipliers);
    if (form.verdict != NormalForm::Verdict::none) return form;
    const Estimate found = coefficient(point.type, map, direction);
    form.error = found.error;
    if (!(found.error <= believed * std::abs(found.value))) {
      form.verdict = NormalForm::Verdict::too_inexact;
      return form;
    }
    form.coefficient = found.value;
    const bool stable = point.type == SpecialType::PD ? found.value > 0.0 : found.value < 0.0;
    using enum NormalForm::Verdict;
    form.verdict = point.type == SpecialType::LP ? fold : stable ? supercritical : subcritical;
  } catch (const NumericalError&) {
    form.verdict = NormalForm::Verdict::no_map;
  }
  return form;
}

}  // namespace slapstick::orbit
