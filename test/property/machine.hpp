#pragma once
/// Random machines, the one generator of all tests that need some: a function of a seed, which shrinks to the smallest
/// machine that fails.
#include <rapidcheck.h>

#include <cstdint>
#include <iosfwd>

#include "slapstick/model/model.hpp"

namespace slapstick::test {

/// A model and a start that violates no stop.
struct Machine {
  Model model;
  State start;
  std::uint64_t seed = 0;  ///< what it was made from, for choices that a test makes itself (where to cut)
};

/// What may be drawn. At least one contact there is always.
struct Shape {
  int least_coordinates = 1, most_coordinates = 4;
  int most_stops = 2, most_frictions = 2, most_compliant = 1;
  double most_restitution = 0.95;
  double least_gap = 0.0;        ///< of every stop at the start; at 0 some start in contact
  bool one_restitution = false;  ///< the same for all stops: then no impact makes energy
  bool one_friction = false;     ///< f_s = f_k and no belts
  bool loops =
      true;  ///< contacts on pairs that depend on each other: of those at rest together no one force is determined
  bool at_rest = true;   ///< one in four starts at rest at the origin: all friction contacts stick
  bool sequence = true;  ///< the impact law `sequence` too
  bool laws = false;     ///< polylines, zones, normal forces, bounded stops, restitution over the speed
};

/// Chains and networks with springs, dampers, up to two harmonics and a constant load; masses and stiffnesses over more
/// than a decade. Contacts between any two coordinates or to ground, some on the pair of another one, some on belts,
/// some stops two-sided.
[[nodiscard]] Machine random_machine(std::uint64_t seed, const Shape& shape);

/// Machines that are simpler by one step: without one contact, coordinate, force, spring or damper, or with one number
/// rounder. All are valid, and of the shape.
[[nodiscard]] std::vector<Machine> simpler(const Machine& machine, const Shape& shape);

/// Does it have what a shape asks for, and is it valid?
[[nodiscard]] bool is_of(const Shape& shape, const Machine& machine);

/// The generator, shrinking by `simpler`.
[[nodiscard]] rc::Gen<Machine> machines(const Shape& shape);

/// As a model file, with its start: what `slapstick simulate` runs.
std::ostream& operator<<(std::ostream& out, const Machine& machine);

}  // namespace slapstick::test
