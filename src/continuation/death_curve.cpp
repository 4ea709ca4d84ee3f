/// Deaths followed in two parameters, by arclength on their equations.
#include "continuation/death_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/dense.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "change/change_kind.hpp"
#include "change/death.hpp"
#include "change/death_equations.hpp"
#include "continuation/curve_walk.hpp"
#include "orbit/kept.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/sentences.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double undetermined = 1e-10;  ///< a singular value, of the largest: a direction in which the equations hold

struct DeathPlace {
  Death death;
  VectorXd along;   ///< the tangent, of length 1: the unknowns of DeathEquations, then the second parameter
  Index first = 0;  ///< the place of the first parameter in it
  Watched watched;
};

class DeathCurve : public CurveWalk<DeathPlace> {
 public:
  DeathCurve(const Problem& problem, const SpecialPoint& point, const CurveOptions& options)
      : CurveWalk(options), problem_(problem), point_(point) {
    // A motion that dies out altogether has no size: that of the branch's last orbit, and 0 for no parameter.
    problem_.set_least(sizes(problem, point.solution.orbit).head(problem.numbers()), 0.0);
    Orbit& orbit = point_.death->orbit;  // known on a branch in the first parameter alone
    const double own = orbit.parameter();
    orbit.values = point.solution.orbit.values;
    orbit.parameter() = own;
    point_.solution.orbit = orbit;
  }

  Curve run(double sign);

 private:
  using Place = DeathPlace;
  /// row . (all steps from a death) = length, beside the equations of the death.
  struct Demand {
    Eigen::RowVectorXd row;
    double length = 0.0;
  };

  [[nodiscard]] const std::vector<double>& values(const Place& here) const override { return here.death.orbit.values; }
  [[nodiscard]] std::array<double, 2> rates(const Place& here) const override {
    return {here.along[here.first], here.along[here.along.size() - 1]};
  }
  [[nodiscard]] std::optional<Place> next(const Place& here, const CurveStep& step) const override;
  [[nodiscard]] bool goes_on(const Place& here, const Place& ahead) const override {
    return straight(here.along.dot(ahead.along)) && !runs_back(here, ahead);
  }
  [[nodiscard]] CurvePoint point(const Place& here) const override;
  [[nodiscard]] CurvePlace watched(const Place& here) const override { return {here.watched, rates(here)}; }
  bool pass(const Place& before, Place& now, double length, Curve& curve) const override;

  [[nodiscard]] VectorXd units(const DeathEquations& at) const;
  [[nodiscard]] Place place(Death death, const VectorXd& forward) const;
  [[nodiscard]] std::optional<Death> solved(Death death, const Demand& demand) const;
  [[nodiscard]] std::vector<bool> own_margins_at(const Place& here) const;
  [[nodiscard]] const TestValue* violated(const Place& here) const;
  [[nodiscard]] double bend(const Place& here) const;
  [[nodiscard]] bool runs_back(const Place& before, const Place& now) const;

  Problem problem_;
  SpecialPoint point_;
};

/// Of a step of `along`, in those of DeathEquations. The parameters' are their ranges. A motion that dies out has no
/// size: numbers of less effect in the equations than 1 have the unit that gives them that.
VectorXd DeathCurve::units(const DeathEquations& at) const {
  VectorXd all = VectorXd::Ones(at.units.size() + 1);
  for (Index j = 0; j < problem_.numbers(); ++j)
    if (const double effect = at.by.col(j).cwiseAbs().maxCoeff(); effect > 0.0) all[j] = std::max(1.0, 1.0 / effect);
  all[at.parameter] = ranges()[0] / at.units[at.parameter];
  all[at.units.size()] = ranges()[1] / at.units_of_others[0];
  return all;
}

/// @param forward  what the tangent does not turn against; empty: the second parameter grows
/// @throws NumericalError where the equations hold in no direction, or in several
DeathPlace DeathCurve::place(Death death, const VectorXd& forward) const {
  const DeathEquations at(problem_, death);
  MatrixXd matrix(at.by.rows(), at.by.cols() + 1);
  matrix << at.by, at.by_others.col(0);
  const dense::SingularVectors all = dense::singular_vectors(matrix * units(at).asDiagonal());
  const Index regular = (all.values.array() > undetermined * all.values[0]).count();
  if (regular + 1 != matrix.cols())
    throw NumericalError("curve: the place where legs die out is no curve over both parameters at " +
                         shown(death.orbit.parameter()) + ", " + shown(death.orbit.values[1]));
  Place here;
  here.along = all.right.rightCols(1);
  const double sense = forward.size() > 0 ? here.along.dot(forward) : here.along[here.along.size() - 1];
  if (sense < 0.0) here.along = -here.along;
  here.first = at.parameter;
  here.watched = point_of(problem_, death.orbit, ranges()[0], {}).watched;
  here.death = std::move(death);
  return here;
}

std::optional<Death> DeathCurve::solved(Death death, const Demand& demand) const {
  constexpr int most_steps = 12;
  constexpr double most = 2.0;  // a step; that of a number which is rounding is its own size
  VectorXd taken = VectorXd::Zero(demand.row.size());
  double before = INFINITY;
  for (int k = 0; k < most_steps; ++k) {
    const DeathEquations at(problem_, death);
    const VectorXd scale = units(at);
    MatrixXd matrix(at.by.rows() + 1, scale.size());
    matrix << at.by, at.by_others.col(0), Eigen::RowVectorXd::Zero(scale.size());
    matrix = matrix * scale.asDiagonal();
    matrix.bottomRows(1) = demand.row;
    VectorXd right(matrix.rows());
    right << -at.residual, demand.length - demand.row.dot(taken);
    if (!matrix.allFinite()) return std::nullopt;
    const VectorXd step = dense::LeastNorm(matrix).solve(right);
    const double now = length(problem_, at, step);
    if (!(now <= most)) return std::nullopt;
    const VectorXd was = problem_.translations().numbers(death.orbit.x[0]);
    move(problem_, at, step.cwiseProduct(scale), 1.0, death);
    settle_forgotten(problem_, at.orbit, was, death.orbit);
    taken += step;
    if (now < enough_step || (now < death_rounding && now > 0.1 * before))
      return in_order(death) && holds_together(problem_, death) ? std::optional(death) : std::nullopt;
    before = now;
  }
  return std::nullopt;
}

std::optional<DeathPlace> DeathCurve::next(const Place& here, const CurveStep& step) const {
  Demand demand{here.along.transpose(), step.length};
  if (step.wall) {
    const std::size_t j = *step.wall;
    const Index column = j == 0 ? here.first : here.along.size() - 1;
    demand = {Eigen::RowVectorXd::Unit(here.along.size(), column), (step.value - values(here)[j]) / ranges()[j]};
  }
  try {
    if (auto death = solved(here.death, demand)) return place(std::move(*death), here.along);
  } catch (const InputError&) {  // no model there
  } catch (const NumericalError&) {
  }
  return std::nullopt;
}

/// Which margins are zero because of the touches: those whose least value lies at one.
std::vector<bool> DeathCurve::own_margins_at(const Place& here) const {
  constexpr double at_once =
      1e-6;  // of the cycle: a least value is found to half the digits; a nearer swing is not seen
  const Orbit& orbit = here.death.orbit;
  const double cycle = orbit.t.back() - orbit.t.front();
  std::vector<bool> own;
  for (const TestValue& test : here.watched.tests) {
    const double instant = orbit.t[test.leg] + test.at;
    own.push_back(ranges::any_of(here.death.touches, [&](const Touch& touch) {
      const double there = touch.place == Touch::Place::within  ? touch.t
                           : touch.place == Touch::Place::start ? orbit.t[touch.leg]
                                                                : orbit.t[touch.leg + 1];
      const double off = (instant - there) / cycle;
      return test.test == Test::guard && std::abs(off - std::round(off)) < at_once &&
             ranges::any_of(touch.guards, [&](const Touch::Guard& guard) {
               return guard.kind == test.kind && guard.contact == test.contact;
             });
    }));
  }
  return own;
}

/// The margin that is used up beside those of the touches; null if the orbit is a motion apart from these.
const TestValue* DeathCurve::violated(const Place& here) const {
  const std::vector<bool> own = own_margins_at(here);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!own[i] && here.watched.tests[i].value < 0.0) return &here.watched.tests[i];
  return nullptr;
}

/// The least rate at which the slope of a guard rises at its touch within a leg.
double DeathCurve::bend(const Place& here) const {
  const Orbit& orbit = here.death.orbit;
  const ModeSet set(problem_.family(), orbit.values);
  double least = INFINITY;
  for (const Touch& touch : here.death.touches) {
    if (touch.place != Touch::Place::within) continue;
    const ModeRates& mode = set.mode(orbit.shape.legs[touch.leg].states);
    const VectorXd X = state_within(set, orbit, touch.leg, touch.t - orbit.t[touch.leg]);
    const auto& row = mode.outline.guards[mode.guard(touch.guards[0].kind, touch.guards[0].contact)].row;
    least = std::min(least, row.dot(mode.outline.system * (mode.outline.system * X)));
  }
  return least;
}

/// Do two touches become one between two places? Their equations lead back then, or on with a guard that is greatest at
/// its touch.
bool DeathCurve::runs_back(const Place& before, const Place& now) const {
  const std::array<double, 2> was = rates(before), is = rates(now);
  return (was[0] * is[0] < 0.0 && was[1] * is[1] < 0.0) || (bend(before) > 0.0 && !(bend(now) > 0.0));
}

CurvePoint DeathCurve::point(const Place& here) const {
  const Orbit& orbit = here.death.orbit;
  CurvePoint point{orbit.values, describe(problem_, orbit, nullptr)};
  point.solution.is_motion = true;
  if (const TestValue* margin = violated(here)) {
    point.solution.is_motion = false;
    point.solution.why = describe(used(*margin), orbit.shape, problem_.base());
  }
  return point;
}

/// Besides, a guard may be used up at another instant than its touch's, in the same leg.
bool DeathCurve::pass(const Place& before, Place& now, double length, Curve& curve) const {
  note(before, now, length, curve);
  const TestValue* margin = violated(now);
  if (margin == nullptr || violated(before) != nullptr) return false;
  const auto left = [&](const Place& here) { return violated(here) != nullptr ? -1.0 : 1.0; };
  const std::optional<Place> there = located(before, now, length, left);
  const Meeting met{
      .kind = Meeting::Kind::margin, .type = type_of(*margin, now.death.orbit.shape), .margin = used(*margin)};
  add_event(curve, {{met}, values(there ? *there : now), curve.points.size() - 1}, ranges());
  return false;
}

Curve DeathCurve::run(double sign) {
  Place here = place(*point_.death, {});
  if (rates(here)[1] * sign < 0.0) here.along = -here.along;
  tests_ = curve_tests(point_, here.watched, own_margins_at(here));
  return walk(point_.solution.orbit.shape, problem_.family().names, std::move(here), options_.longest_step);
}

}  // namespace

Curve death_curve(const Problem& problem, const SpecialPoint& point, const CurveOptions& options, double sign) {
  return DeathCurve(problem, point, options).run(sign);
}

}  // namespace slapstick::orbit
