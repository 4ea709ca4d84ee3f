#pragma once
/// The answers of the verbs about orbits and branches.
#include <array>

#include "neutral/answer.hpp"

namespace slapstick::neutral {

/// The values of a parameter that a branch goes through.
[[nodiscard]] std::array<double, 2> range_of(double value);

void answer_orbit(const ModelDefinition& definition, Answer& answer);
/// The branch in the file's first parameter, from the orbit that its motion settles on: its special points and ends.
void answer_branch(const ModelDefinition& definition, Answer& answer);
/// The curve of the branch's first special point, in the file's first two parameters.
void answer_curve(const ModelDefinition& definition, Answer& answer);

}  // namespace slapstick::neutral
