#pragma once
/// What else is watched along the locus of a special point: functions whose zeros are points of codimension two.
#include <array>

#include "orbit/path.hpp"
#include "slapstick/orbit/branch.hpp"

namespace slapstick::orbit {

/// A place of a curve, as far as it is watched.
struct CurvePlace {
  const Watched& watched;
  std::array<double, 2> along;  ///< the tangent's components in both parameters
};

/// A function that changes sign at a point of codimension two.
struct CurveTest {
  std::string type;  ///< CurveEvent::type
  std::function<double(const CurvePlace&)> value;
  std::function<std::string(const Watched&)> what;  ///< there
  bool falls = false;                               ///< only from positive to negative
  std::function<bool(const Watched&)> holds = {};   ///< is a zero such a point? Empty: each is
};

/// The margins that are zero all along (indices of Watched::tests): the point's own, and those that say the same in other words, as the length of a
/// slip that dies with the speed of an impact.
/// @param tests  on the curve
/// @param off    of orbits of the same events beside it
[[nodiscard]] std::vector<bool> own_margins(const SpecialPoint& point, const std::vector<TestValue>& tests,
                                            const std::vector<std::vector<TestValue>>& off);

/// @param start  at the curve's first point
/// @param own    of own_margins
[[nodiscard]] std::vector<CurveTest> curve_tests(const Problem& problem, const SpecialPoint& point,
                                                 const Watched& start, const std::vector<bool>& own);

/// The pair of multipliers whose product is nearest to 1: their sum, 2 cos(2 pi rho) on the unit circle. With rho = 0 or 1/2 an NS curve ends:
/// beyond it they are real.
[[nodiscard]] double sum_of_pair(const Watched& watched);

/// Adds an event; several in one place are one, in whose words they stand together. @param ranges  of the parameters
void add_event(Curve& curve, CurveEvent event, const std::array<double, 2>& ranges);

/// What may be the cause where a curve cannot be followed: ", near the resonance 1:3", ", where ..", or nothing.
[[nodiscard]] std::string likely_cause(const Problem& problem, const SpecialPoint& point, const Orbit& orbit,
                                       const Watched& before, const Watched& here, const std::vector<bool>& own);

}  // namespace slapstick::orbit
