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

/// One to four bodies with springs, dampers, two harmonics, a tone and a constant load; every fourth machine with
/// matrices. Up to three stops, of which one may be two-sided, three friction contacts, two compliant stops and two
/// polylines, between any two bodies or to ground. Some friction contacts are on belts, some have f_s > f_k, and some
/// are on the pair of a stop.
[[nodiscard]] MixedMachine mixed_machine(Random& random);

}  // namespace campaign
