#pragma once
/// The test systems of the failure catalogue (test/catalogue), as models.
#include "slapstick/model/model.hpp"

namespace slapstick::oracle {

/// B: g'' = -1 above the floor g = 0.
inline Model ball(double restitution) {
  Model m;
  m.name = "ball";
  m.coordinates = {{"x", 1.0}};
  m.forces = {{0, 0, -1.0, 0.0}};
  m.stops = {{"floor", ground, 0, 0.0, restitution}};
  return m;
}

/// BC: g'' = -cos t when started at phase fraction 1/4: -sin(t + pi/2) without a rounded phase.
inline Model cosine_ball(double restitution) {
  Model m = ball(restitution);
  m.omega = 1.0;
  m.forces = {{0, 1, -1.0, 0.0}};
  return m;
}

/// I: x'' + damping x' + x = amplitude sin(omega t), x <= clearance.
inline Model oscillator_with_stop(double clearance, double restitution = 0.5, double amplitude = 0.0,
                                  double omega = 1.0, double damping = 0.0) {
  Model m;
  m.name = "oscillator_with_stop";
  m.coordinates = {{"x", 1.0}};
  m.springs = {{0, ground, 1.0}};
  m.dampers = {{0, ground, damping}};
  m.forces = {{0, 1, amplitude, 0.0}};
  m.stops = {{"wall", 0, ground, clearance, restitution}};
  m.omega = omega;
  return m;
}

/// F: x'' + x = amplitude sin(omega t) - f_k sgn x'.
inline Model friction_oscillator(double static_friction, double kinetic_friction, double amplitude = 0.0,
                                 double omega = 1.0) {
  Model m = oscillator_with_stop(0.0, 0.5, amplitude, omega);
  m.name = "friction_oscillator";
  m.stops.clear();
  m.frictions = {{"floor", 0, ground, 0.0, static_friction, kinetic_friction}};
  return m;
}

/// S: the paper's oscillator (NOTATION.md) with its settled parameters.
inline Model vibro_impact(double omega) {
  const double mass_ratio = 10, stiffness_ratio = 5, dashpot_ratio = 5, damping_ratio = 0.1, friction = 0.15;
  Model m;
  m.name = "vibro_impact";
  m.coordinates = {{"x1", 1.0}, {"x2", mass_ratio}};
  m.springs = {{0, 1, 1.0}, {1, ground, stiffness_ratio}};
  m.dampers = {{0, 1, 2 * damping_ratio}, {1, ground, 2 * damping_ratio * dashpot_ratio}};
  m.forces = {{0, 1, 1.0, 0.0}};
  m.frictions = {{"blocks", 0, 1, 0.0, friction, friction}};
  m.stops = {{"gap", 0, 1, 0.0, 0.8}};
  m.omega = omega;
  return m;
}

}  // namespace slapstick::oracle
