/// Linearises the equations of a death: the orbit's own, and the guards at its touches.
#include "change/death_equations.hpp"

#include <algorithm>
#include <limits>

#include "orbit/kept.hpp"

namespace slapstick::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;
using Place = Touch::Place;

constexpr double roundoff = std::numeric_limits<double>::epsilon();

/// The rows one after another, in the orbit's unknowns, all parameters and the touches' instants.
class Rows {
 public:
  Rows(const Problem& problem, const Death& death, const Linearised& at)
      : problem_(problem), death_(death), at_(at), set_(problem.family(), death.orbit.values) {
    Index count = at.residual.size();
    for (const Touch& touch : death.touches) count += static_cast<Index>(touch.guards.size()) + 1;
    by = MatrixXd::Zero(count, at.by.cols() + static_cast<Index>(death.touches.size()));
    residual = noise = VectorXd::Zero(count);
    add_orbit();
    for (std::size_t i = 0; i < death.touches.size(); ++i) add_touch(i);
  }

  MatrixXd by;
  VectorXd residual, noise;

 private:
  /// The displacement that a dying contact comes to rest at, by its column of a contact state; -1 where it has none.
  [[nodiscard]] Index resting_place(const Touch::Guard& guard) const {
    const mode::Frame& frame = set_.frame();
    if (mode::of_friction(guard.kind)) return frame.frictions[static_cast<std::size_t>(guard.contact)].own;
    if (!mode::of_corner(guard.kind)) return -1;
    const mode::SliderRow* slider = frame.slider(guard.contact);
    return slider != nullptr ? slider->own : -1;
  }

  /// Where a contact comes to rest its touches say: what it leaves at rest is not kept as it is.
  void release_what_dies() {
    for (const Touch& touch : death_.touches)
      for (const Touch::Guard& guard : touch.guards)
        for (const Index i : at_.kept)
          if (const Index place = resting_place(guard); place >= 0 && keeps(problem_, {i}, place))
            by.row(static_cast<Index>(death_.orbit.legs()) + i).setZero();
  }

  void add_orbit() {
    const Orbit& orbit = death_.orbit;
    used_ = at_.residual.size();
    residual.head(used_) = at_.residual;
    by.topLeftCorner(used_, at_.by.cols()) = at_.by;
    release_what_dies();
    for (std::size_t i = 0; i < orbit.legs(); ++i)
      if (orbit.shape.legs[i].ending != Ending::cut)
        noise[static_cast<Index>(i)] = roundoff * at_.legs[i].h.by_state().row(0).cwiseAbs().dot(orbit.x[i].cwiseAbs());
    const VectorXd last = at_.legs.back().after.value().cwiseAbs();
    noise.segment(static_cast<Index>(orbit.legs()), problem_.numbers()) =
        roundoff * problem_.translations().numbers(last).cwiseAbs();
    noise[used_ - 1] = roundoff * (orbit.t.back() - orbit.t.front());
  }

  /// row . X = 0 at a touch. @param rates  of the row, by each parameter
  void add(const Jet& X, const RowVectorXd& row, const std::vector<RowVectorXd>& rates, std::size_t which) {
    const Touch& touch = death_.touches[which];
    const std::size_t legs = death_.orbit.legs();
    Jet value(1, X.states, X.parameters);
    value.all = row * X.all;
    for (Index p = 0; p < X.parameters; ++p)
      value.by_parameter()(0, p) += rates[static_cast<std::size_t>(p)].dot(X.value());
    if (touch.place == Place::within) by(used_, at_.by.cols() + static_cast<Index>(which)) = value.by_end()[0];
    if (touch.place == Place::start) value.by_begin() += value.by_end();
    if (touch.place != Place::end) value.by_end().setZero();
    by.row(used_).head(at_.by.cols()) = by_unknowns(problem_, value, at_.states[touch.leg], touch.leg, legs);
    residual[used_] = value.value()[0] + value.by_state().row(0).dot(at_.defects[touch.leg]);
    noise[used_] = roundoff * row.cwiseAbs().dot(X.value().cwiseAbs());
    ++used_;
  }

  void add_touch(std::size_t which) {
    const Touch& touch = death_.touches[which];
    const Orbit& orbit = death_.orbit;
    Leg leg = orbit.shape.legs[touch.leg];
    leg.strikes.clear();
    if (leg.ending == Ending::guard) leg.ending = Ending::cut;  // the state at the instant is all that is wanted
    const double begin = orbit.t[touch.leg];
    const double end = touch.place == Place::start ? begin
                       : touch.place == Place::end ? orbit.t[touch.leg + 1]
                                                   : touch.t;
    if (touch.place != Place::within)  // its instant is the event's, and no unknown
      by(used_++, at_.by.cols() + static_cast<Index>(which)) = 1.0;
    const ModeRates& mode = set_.mode(leg.states);
    const Jet X = leg_value(set_, leg, leg, orbit.x[touch.leg], begin, end).X_end;
    for (const Touch::Guard& guard : touch.guards) {
      const std::size_t g = mode.guard(guard.kind, guard.contact);
      const RowVectorXd& row = mode.outline.guards[g].row;
      std::vector<RowVectorXd> rates, slope_rates;
      for (const mode::OutlineDerivative& rate : mode.rates) {
        rates.emplace_back(rate.guards[g]);
        slope_rates.emplace_back(rate.guards[g] * mode.outline.system + row * rate.system);
      }
      add(X, row, rates, which);
      if (touch.place == Place::within && &guard == touch.guards.data())
        add(X, row * mode.outline.system, slope_rates, which);
    }
  }

  const Problem& problem_;
  const Death& death_;
  const Linearised& at_;
  ModeSet set_;
  Index used_ = 0;
};

}  // namespace

DeathEquations::DeathEquations(const Problem& problem, const Death& death)
    : orbit(linearise(problem, ModeSet(problem.family(), death.orbit.values), death.orbit)) {
  const Rows rows(problem, death, orbit);
  const auto touches = static_cast<Index>(death.touches.size());
  const VectorXd all = sizes(problem, death.orbit);
  parameter = problem.parameter_column(death.orbit.legs(), 0);
  units.resize(parameter + 1 + touches);
  units << all.head(parameter + 1), VectorXd::Constant(touches, all[problem.instant_column(0)]);
  units.head(problem.numbers()) = units.head(problem.numbers()).cwiseMax(problem.least_sizes());
  by.resize(rows.by.rows(), units.size());
  by << rows.by.leftCols(parameter + 1), rows.by.rightCols(touches);
  by = by * units.asDiagonal();
  const VectorXd level =
      by.cwiseAbs().rowwise().maxCoeff().cwiseMax(rows.noise / roundoff).cwiseMax(std::numeric_limits<double>::min());
  by = level.cwiseInverse().asDiagonal() * by;
  units_of_others = all.tail(problem.parameters() - 1);
  by_others = level.cwiseInverse().asDiagonal() * rows.by.middleCols(parameter + 1, units_of_others.size()) *
              units_of_others.asDiagonal();
  residual = rows.residual.cwiseQuotient(level);
  noise = rows.noise.cwiseQuotient(level);
}

bool holds_together(const Problem& problem, const Death& death) {
  return DeathEquations(problem, death).residual.cwiseAbs().maxCoeff() < hold_together;
}

double length(const Problem& problem, const DeathEquations& at, const VectorXd& step) {
  double longest = step.cwiseAbs().maxCoeff();
  for (const VectorXd& defect : at.orbit.defects) {
    const VectorXd off = problem.translations().numbers(defect).cwiseQuotient(at.units.head(problem.numbers()));
    longest = std::max(longest, off.cwiseAbs().maxCoeff());
  }
  return longest;
}

void move(const Problem& problem, const DeathEquations& at, const VectorXd& step, double fraction, Death& death) {
  const Index own = at.units.size(), others = step.size() - own;
  const VectorXd change = fraction * step.head(own).cwiseProduct(at.units);
  VectorXd of_orbit = VectorXd::Zero(problem.unknowns(death.orbit.legs()));
  of_orbit.head(at.parameter + 1) = change.head(at.parameter + 1);
  of_orbit.segment(at.parameter + 1, others) =
      fraction * step.tail(others).cwiseProduct(at.units_of_others.head(others));
  move(problem, at.orbit, of_orbit, fraction, death.orbit);
  for (std::size_t i = 0; i < death.touches.size(); ++i)
    death.touches[i].t += change[at.parameter + 1 + static_cast<Index>(i)];
}

}  // namespace slapstick::orbit
