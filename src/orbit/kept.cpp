/// Finds what rests in every leg of an orbit.
#include "orbit/kept.hpp"

#include <cmath>

#include "base/ranges.hpp"
#include "base/text.hpp"
#include "orbit/margins.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::orbit {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// The row of a number that is kept has zeros only, to the last bit: its rate is zero in every leg. Entries for numbers
/// that the cycle forgets do not count, as of the velocity of a held pair: their own closing makes them zero. Nor do
/// entries for instants that what is left of such numbers accounts for.
void keep_what_rests(const Problem& problem, const Orbit& orbit, Linearised& at) {
  // An instant moves y by u, and u moves y by a cycle: the ratio of the two, for an instant at either end and for its
  // rounding. More would keep what a belt moves slowly, less would lose what a velocity of rounding moves.
  constexpr double room = 4.0;
  const Index first = at.by.rows() - 1 - problem.numbers(), others = at.by.cols() - problem.numbers();
  const VectorXd left = problem.translations().numbers(orbit.x[0]).cwiseAbs();
  const double often = room * (1.0 + 1.0 / std::abs(orbit.t.back() - orbit.t.front()));
  std::vector<bool> forgotten;
  for (Index i = 0; i < problem.numbers(); ++i) {
    const auto row = at.by.row(first + i);
    forgotten.push_back(row[i] == -1.0 && (row.array() != 0.0).count() == 1);
    if (forgotten.back()) at.forgotten.push_back(i);
  }
  for (Index i = 0; i < problem.numbers() - problem.translations().velocities(); ++i) {
    const RowVectorXd row = at.by.row(first + i);
    bool moved = forgotten[static_cast<std::size_t>(i)];
    double accounted = 0.0;
    for (Index j = 0; j < problem.numbers(); ++j) {
      moved = moved || (row[j] != 0.0 && !forgotten[static_cast<std::size_t>(j)]);
      accounted += often * std::abs(row[j]) * left[j];
    }
    if (moved || row.tail(others).cwiseAbs().maxCoeff() > accounted) continue;
    at.kept.push_back(i);
    at.by.row(first + i) = RowVectorXd::Unit(at.by.cols(), i);
    at.residual[first + i] = 0.0;
  }
}

void settle_forgotten(const Problem& problem, const Linearised& at, const VectorXd& was, Orbit& orbit) {
  const Index first = at.residual.size() - 1 - problem.numbers();
  for (const Index i : at.forgotten) {
    const VectorXd number = problem.translations().representative(VectorXd::Unit(problem.numbers(), i));
    orbit.x[0] += (was[i] + at.residual[first + i] - problem.translations().numbers(orbit.x[0])[i]) * number;
  }
}

bool keeps(const Problem& problem, const std::vector<Index>& kept, Index displacement) {
  return ranges::any_of(kept, [&](Index i) {
    const VectorXd number = problem.translations().representative(VectorXd::Unit(problem.numbers(), i));
    return displacement < number.size() / 2 && number[displacement] == 1.0;
  });
}

void demand_off_limits(const Problem& problem, const ModeSet& set, const Orbit& orbit, const std::vector<Index>& kept) {
  // Of the way between the limits: what a motion leaves that draws the slider there. More would refuse a derivative
  // that there is, less would tell that of one side.
  constexpr double rounding = 1e-12;
  if (kept.empty()) return;
  for (const TestValue& test : test_values(set, orbit)) {
    const mode::SliderRow* slider = set.frame().slider(test.kind, test.contact);
    if (slider == nullptr || !keeps(problem, kept, slider->own)) continue;
    if (test.value <= rounding * (slider->high - slider->low))
      throw NumericalError("the orbit has no derivative by a parameter: the slider of " +
                           in_quotes(set.model().characteristics[static_cast<std::size_t>(test.contact)].name) +
                           " rests at its limit, and is drawn along to one side only; start from another state");
  }
}

bool may_be_drawn_along(const FrictionContact& friction) {
  return !friction.normal && friction.static_friction == friction.kinetic_friction;
}

int kept_numbers(const Problem& problem, const Orbit& orbit) {
  return static_cast<int>(linearise(problem, ModeSet(problem.family(), orbit.values), orbit).kept.size());
}

}  // namespace slapstick::orbit
