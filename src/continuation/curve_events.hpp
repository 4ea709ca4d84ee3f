#pragma once
/// What else is watched along the locus of a special point: functions whose zeros are points of codimension two.
#include <array>

#include "orbit/path.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// A place of a curve, as far as it is watched.
struct CurvePlace {
  const Watched& watched;
  std::array<double, 2> along;  ///< the tangent's components in both parameters
};

/// A function that changes sign at a point of codimension two.
struct CurveTest {
  Meeting met;  ///< what holds at its zero
  std::function<double(const CurvePlace&)> value;
  bool falls = false;                              ///< only from positive to negative
  double noise = 0.0;                              ///< a smaller value has no sign
  std::function<bool(const Watched&)> holds = {};  ///< is a zero such a point? Empty: each is
};

/// The margins that are zero all along (indices of Watched::tests): the point's own, and those that say the same in
/// other words, as the length of a slip that dies with the speed of an impact.
/// @param tests  on the curve
/// @param off    of orbits of the same events beside it
[[nodiscard]] std::vector<bool> own_margins(const SpecialPoint& point, const std::vector<TestValue>& tests,
                                            const std::vector<std::vector<TestValue>>& off);

/// @param start  at the curve's first point
/// @param own    of own_margins
[[nodiscard]] std::vector<CurveTest> curve_tests(const SpecialPoint& point, const Watched& start,
                                                 const std::vector<bool>& own);

/// The pair of multipliers whose product is nearest to 1: their sum, 2 cos(2 pi rho) on the unit circle. With rho = 0
/// or 1/2 an NS curve ends: beyond it they are real.
[[nodiscard]] double sum_of_pair(const Watched& watched);

/// Adds an event; several in one place are one. @param ranges  of the parameters
void add_event(Curve& curve, CurveEvent event, const std::array<double, 2>& ranges);

/// What may be the cause where a curve cannot be followed: `near` and `infinite_multiplier` of its end.
void find_cause(const SpecialPoint& point, const Watched& before, const Watched& here, const std::vector<bool>& own,
                CurveEnd& end);

}  // namespace slapstick::orbit
