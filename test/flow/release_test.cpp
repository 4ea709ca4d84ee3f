/// Releases: what ends a rest is told once.
#include <gtest/gtest.h>

#include <random>

#include "flow/engine.hpp"

namespace slapstick::flow {
namespace {

/// Two blocks in a row. The first chatters against a stop, the forces on the second press it there and let it go.
Model pressed_block(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Model m;
  m.omega = 0.3 + 1.2 * share(random);
  m.coordinates = {{"x", 0.3 + share(random)}, {"y", 1.0 + 4.0 * share(random)}};
  m.springs = {{0, ground, 1.0 + 3.0 * share(random)}, {1, 0, 0.3 + share(random)}};
  m.dampers = {{0, ground, 0.2 * share(random)}};
  m.stops = {{"stop", 0, ground, 0.01 * share(random), 0.3 + 0.6 * share(random)}};
  m.forces = {{1, 0, 1.2 * share(random), 0.0}, {1, 1, 1.0 + share(random), share(random)}};
  return m;
}

/// Where the flight begins decides how the force is rounded at its zero.
/// The choice of the mode may see that force hold.
TEST(Release, IsToldOnceFromWhereverInTheRestTheFlightBegins) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  long releases = 0;
  for (int k = 0; k < 24; ++k) {
    const CompiledSystem system(pressed_block(random), {});
    Engine motion(system, State{-0.5, 0.0, 0.0, 0.0}, {0, 0.0}, {});
    while (motion.advance({30, 0.0}) == Outcome::event) {
      if (motion.event().kind != EventKind::chatter) continue;
      for (int c = 0; c < 20; ++c) {
        Engine rest = motion;
        if (rest.advance(motion.time().plus(0.3 * share(random))) == Outcome::event) continue;
        Engine flight(system, rest.extended().first(4), rest.time(), {});
        if (flight.advance({60, 0.0}) != Outcome::event || flight.event().kind != EventKind::release) continue;
        ++releases;
        if (flight.advance({60, 0.0}) == Outcome::event) {
          ASSERT_EQ(flight.event().kind, EventKind::impact) << k;
        }
      }
    }
  }
  EXPECT_GT(releases, 2000);
}

}  // namespace
}  // namespace slapstick::flow
