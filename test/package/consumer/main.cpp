// A user's program: a bouncing mass above a wall, accepted, run and copied; with an impossible restitution, refused
// with the reason.
#include <cmath>
#include <iostream>
#include <utility>

#include "slapstick/slapstick.hpp"

namespace {

slapstick::Model bouncing_mass() {
  slapstick::Model model;
  model.name = "bouncing mass";
  model.coordinates = {{.name = "x", .mass = 1.0}};
  model.forces = {{.coordinate = 0, .harmonic = 0, .amplitude = -9.81}};
  model.stops = {{.name = "floor", .a = slapstick::ground, .b = 0, .clearance = 0.0, .restitution = 0.8}};
  return model;
}

/// From rest at height 1 it falls for sqrt(2 / g); a copy goes on as the motion does, also when the System is gone.
bool falls_as_galilei_says() {
  auto made = [] {
    const slapstick::System system(bouncing_mass());
    return slapstick::Motion(system, {1.0, 0.0});
  };
  slapstick::Motion motion = made();
  slapstick::Motion copy = motion;
  const slapstick::Instant end{.period = 1, .fraction = 0.0};
  if (motion.advance(end) != slapstick::Outcome::event || copy.advance(end) != slapstick::Outcome::event) return false;
  const slapstick::Motion moved = std::move(motion);
  const double fall = moved.event().time.seconds(moved.system().period());
  return std::abs(fall - std::sqrt(2.0 / 9.81)) < 1e-15 && moved.state() == copy.state();
}

}  // namespace

int main() {
  slapstick::Model model = bouncing_mass();
  slapstick::validate(model);
  if (!falls_as_galilei_says()) {
    std::cout << "it does not fall as it should\n";
    return 1;
  }
  model.stops[0].restitution = 1.2;
  try {
    slapstick::validate(model);
  } catch (const slapstick::InputError& error) {
    std::cout << "refused: " << error.what() << '\n';
    return 0;
  }
  std::cout << "restitution 1.2 was accepted\n";
  return 1;
}
