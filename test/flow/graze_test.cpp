/// A pair that comes to rest just where its gap vanishes: the touch is one event, whichever search ends an ulp earlier.
#include <gtest/gtest.h>

#include <cmath>

#include "slapstick/flow/motion.hpp"

namespace slapstick {
namespace {

Model rubbing_mass_before_a_wall(double clearance) {
  Model model;
  model.name = "rubbing mass";
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  model.forces = {{0, 1, 1.0, 5.72}};
  model.frictions = {{"rub", 0, ground, 0.0, 0.3, 0.3}};
  model.stops = {{"wall", 0, ground, clearance, 0.8}};
  model.omega = 0.2;
  return model;
}

TEST(Graze, RestAtTheStopIsATouchAndNotStickBehindIt) {
  // The clearance equals a turning point of the motion to rounding: zero velocity and zero gap at one instant.
  const double touching = 0.4016132589336505;
  double clearance = touching;
  for (int k = 0; k < 8; ++k) clearance = std::nextafter(clearance, -1.0);
  for (int offset = -8; offset <= 8; ++offset, clearance = std::nextafter(clearance, 1.0)) {
    const System system(rubbing_mass_before_a_wall(clearance));
    Motion motion(system, {-0.8220000000000001, 0.0});
    bool touched = false;
    ASSERT_NO_THROW({
      while (motion.advance(Instant{}.plus(20.0 / system.period())) == Outcome::event) {
        touched = touched || motion.event().kind == EventKind::graze || motion.event().kind == EventKind::impact;
        EXPECT_LE(motion.state()[0], clearance + 1e-15) << offset;
      }
    }) << offset;
    if (offset <= 0) {
      EXPECT_TRUE(touched) << offset;
    }
  }
}

}  // namespace
}  // namespace slapstick
