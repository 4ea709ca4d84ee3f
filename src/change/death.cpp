/// Solves for a death: the orbit without its dying legs, and the touches that are left of these.
#include "change/death.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "change/coincident.hpp"
#include "change/death_equations.hpp"
#include "change/touches.hpp"
#include "orbit/short_legs.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

bool within(const Touch& touch) { return touch.place == Touch::Place::within; }

/// What the rounding of the equations makes of the parameter; infinite where they do not hold together or leave the
/// parameter open.
double parameter_error(const Problem& problem, const Death& death) {
  constexpr double determined = 1e-6;  // off 1: the parameter by itself
  constexpr double operations = 4.0;   // whose roundings a residual has, beyond its noise as a sum
  const DeathEquations at(problem, death);
  const Eigen::MatrixXd inverse = dense::LeastNorm(at.by).pseudo_inverse();
  const Eigen::RowVectorXd of_parameter = inverse.row(at.parameter);
  if (!(at.residual.cwiseAbs().maxCoeff() < hold_together)) return INFINITY;
  if (!(std::abs(of_parameter.dot(at.by.col(at.parameter)) - 1.0) < determined)) return INFINITY;
  return operations * at.units[at.parameter] * of_parameter.cwiseAbs().dot(at.noise);
}

/// @returns whether the Gauss-Newton method came to a solution
bool solve_death(const Problem& problem, Death& death) {
  constexpr int most_steps = 20;
  double before = INFINITY;
  for (int k = 0; k < most_steps; ++k) {
    const DeathEquations at(problem, death);
    if (!at.by.allFinite()) return false;
    const VectorXd step = -dense::LeastNorm(at.by).solve(at.residual);
    if (!step.allFinite()) return false;
    const double now = length(problem, at, step);
    move(problem, at, step, std::min(1.0, longest_newton_step / step.cwiseAbs().maxCoeff()), death);
    if (now < enough_step || (now < death_rounding && now > 0.1 * before)) return true;
    before = now;
  }
  return false;
}

}  // namespace

bool in_order(const Death& death) {
  if (death.orbit.shape.legs[0].ending == Ending::cut) return true;
  for (std::size_t i = 0; i < death.orbit.legs(); ++i)
    if (!death.orbit.tied(i) && !(death.orbit.duration(i) > 0.0)) return false;
  return ranges::all_of(death.touches, [&](const Touch& touch) {
    return !within(touch) || (touch.t > death.orbit.t[touch.leg] && touch.t < death.orbit.t[touch.leg + 1]);
  });
}

namespace {

/// The farthest that an instant has moved.
double moved(const Death& from, const Death& to) {
  double most = 0.0;
  for (std::size_t i = 0; i < from.orbit.t.size(); ++i)
    most = std::max(most, std::abs(to.orbit.t[i] - from.orbit.t[i]));
  for (std::size_t i = 0; i < from.touches.size(); ++i)
    if (within(from.touches[i])) most = std::max(most, std::abs(to.touches[i].t - from.touches[i].t));
  return most;
}

std::optional<LocatedDeath> solved(const Problem& problem, const Orbit& near, const std::vector<bool>& dying,
                                   bool impacts_stay) {
  // No solution lies farther from the guess: nearer bounds lose deaths that a long step has come to, farther ones take
  // another death for this. Of the dying legs' length; of the cycle, where these are next to nothing.
  constexpr double farthest_solution = 10.0, least_distance = 1e-4;
  const ModeSet set(problem.family(), near.values);
  const std::vector<Shortened> shapes = shortened(set, near, dying, impacts_stay);
  if (shapes.empty()) return std::nullopt;
  const auto left = touches(set, near, dying, shapes.front());
  if (!left) return std::nullopt;
  const Death guess{shapes.front().orbit, *left};
  LocatedDeath found{guess, INFINITY, 0};
  if (!solve_death(problem, found.death) || !in_order(found.death)) return std::nullopt;
  double longest = 0.0;
  for (std::size_t i = 0; i < near.legs(); ++i)
    if (dying[i] && near.duration(i) > longest) longest = near.duration(found.leg = i);
  const double most = std::max(farthest_solution * longest, least_distance * (near.t.back() - near.t.front()));
  found.error = parameter_error(problem, found.death);
  if (!std::isfinite(found.error) || moved(guess, found.death) > most) return std::nullopt;
  return found;
}

}  // namespace

std::optional<LocatedDeath> death_near(const Problem& problem, const Orbit& near, const std::vector<bool>& dying) {
  std::vector<std::vector<bool>> sets = {dying};
  if (std::vector<bool> at_once = with_ties(near, dying); at_once != dying) sets.push_back(std::move(at_once));
  for (const bool impacts_stay : {true, false}) {
    for (const std::vector<bool>& legs : sets) {
      try {
        if (auto found = solved(problem, near, legs, impacts_stay)) return found;
      } catch (const InputError&) {  // no model there
      } catch (const NumericalError&) {
      }
    }
  }
  return std::nullopt;
}

std::optional<LocatedDeath> death_ahead(const Problem& problem, const PathPoint& at) {
  constexpr double together_with_soonest =
      10.0;  // a leg like the fourth power of another seems to be dead after a quarter of the way
  const Orbit& orbit = at.orbit;
  std::vector<double> left;  // arclength to where a leg would be dead, if it shrank on as there
  for (std::size_t i = 0; i < orbit.legs(); ++i) {
    const Index begin = problem.instant_column(i), end = problem.instant_column(i + 1);
    const double shrinks = at.tangent[begin] * at.units[begin] - at.tangent[end] * at.units[end];
    left.push_back(orbit.tied(i) || in_burst(orbit, i) || !(shrinks > 0.0) ? INFINITY : orbit.duration(i) / shrinks);
  }
  const double soonest = *ranges::min_element(left);
  std::vector<bool> dying;
  for (const double way : left) dying.push_back(way < together_with_soonest * soonest);
  return death_near(problem, orbit, dying);
}

namespace {

/// .. of the legs of which less than a part of their length is left.
std::optional<LocatedDeath> death_at(const Problem& problem, const PathPoint& from, const Orbit& change,
                                     const TestValue& test, double part) {
  const std::size_t legs = change.legs();
  std::vector<bool> dying = dead_legs(from.orbit, change, part);
  if (test.test == Test::speed && test.kind == mode::GuardKind::gap) {  // a slip may die with its speed, at any length
    const ModeSet set(problem.family(), change.values);
    for (std::size_t i = 0; i < legs; ++i) dying[i] = dying[i] || slip_dies(set, from.orbit, change, i, test.leg);
  }
  const std::size_t before = (test.leg + legs - 1) % legs, behind = (test.leg + 1) % legs;
  const std::vector<bool> at_once = with_ties(change, dying);
  if (!at_once[test.leg] && !at_once[before] && !at_once[behind]) return std::nullopt;
  return death_near(problem, change, dying);
}

}  // namespace

std::optional<LocatedDeath> death_at(const Problem& problem, const PathPoint& from, const Orbit& change,
                                     const TestValue& test) {
  auto found = death_at(problem, from, change, test, dead);
  return found ? found : death_at(problem, from, change, test, hardly_left);
}

std::vector<double> death_rates(const Problem& problem, const Death& death) {
  const DeathEquations at(problem, death);
  const dense::LeastNorm solver(at.by);
  std::vector<double> rates;
  for (Index j = 0; j < at.by_others.cols(); ++j) {
    const VectorXd right = -at.by_others.col(j), moves = solver.solve(right);
    const bool together = (at.by * moves - right).cwiseAbs().maxCoeff() < hold_together;
    rates.push_back(together ? moves[at.parameter] * at.units[at.parameter] / at.units_of_others[j] : std::nan(""));
  }
  return rates;
}

}  // namespace slapstick::orbit
