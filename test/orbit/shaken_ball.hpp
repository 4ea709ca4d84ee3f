#pragma once
/// The onset of complete chatter of a ball on a shaken table, by simulations of one period.
#include <cmath>
#include <numbers>

#include "families.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::test {

/// Does a ball that a shaken table has released come to rest before the table releases it again?
inline bool comes_to_rest(double restitution, double acceleration) {
  const Model model = load_model("shaken-table").build({{"restitution", restitution}, {"acceleration", acceleration}});
  const System system(model);
  const double release = std::asin(1.0 / acceleration) / (2.0 * std::numbers::pi);
  Motion motion(system, {0.0, 0.0}, Instant{}.plus(release - 0.05));
  const Instant again = Instant{}.plus(release + 1.0);
  while (motion.advance(again) == Outcome::event)
    if (motion.event().kind == EventKind::chatter) return true;
  return false;
}

/// @param rests, bounces  accelerations at which the ball does and does not come to rest
inline double onset_by_bisection(double restitution, double rests, double bounces) {
  while (bounces - rests > 1e-13) {
    const double middle = 0.5 * (rests + bounces);
    (comes_to_rest(restitution, middle) ? rests : bounces) = middle;
  }
  return rests;
}

}  // namespace slapstick::test
