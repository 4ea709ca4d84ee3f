// A user's program: a bouncing mass above a wall, accepted; with an impossible restitution, refused with the reason.
#include <iostream>

#include "slapstick/base/error.hpp"
#include "slapstick/model/model.hpp"

int main() {
  slapstick::Model model;
  model.name = "bouncing mass";
  model.coordinates = {{.name = "x", .mass = 1.0}};
  model.forces = {{.coordinate = 0, .harmonic = 0, .amplitude = -9.81}};
  model.stops = {{.name = "floor", .a = slapstick::ground, .b = 0, .clearance = 0.0, .restitution = 0.8}};
  slapstick::validate(model);

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
