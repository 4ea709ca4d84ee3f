#pragma once
/// Two equal oscillators that do not act on each other: whatever happens to one happens to the other, at the same
/// instant.
#include "slapstick/model/model.hpp"

namespace slapstick::test {

/// Without stops. With equal stops and starts all events come in pairs.
inline Model twins() {
  Model model;
  model.name = "twins";
  model.coordinates = {{"left", 1.0}, {"right", 1.0}};
  model.springs = {{0, ground, 1.0}, {1, ground, 1.0}};
  model.dampers = {{0, ground, 0.1}, {1, ground, 0.1}};
  model.forces = {{0, 1, 1.0}, {1, 1, 1.0}};
  model.omega = 1.3;
  return model;
}

}  // namespace slapstick::test
