#pragma once
/// Random machines that mix all that the model format knows.
#include "random.hpp"
#include "slapstick/model/model.hpp"

namespace campaign {

/// A valid model and a start that no stop forbids.
struct MixedMachine {
  slapstick::Model model;
  slapstick::State start;
};

/// One to four bodies with springs, dampers, two harmonics, a tone and a constant load; up to three stops (one pair of
/// them two-sided), friction contacts (some on belts, some with f_s > f_k, some on the pair of a stop), compliant stops
/// and polylines each, between any two bodies or to ground; every fourth one with matrices.
[[nodiscard]] MixedMachine mixed_machine(Random& random);

}  // namespace campaign
