#pragma once
/// What a map may be asked for.
#include "slapstick/sweep/map.hpp"

namespace slapstick::sweep {

/// @throws InputError for a meaningless problem, naming the field
void check_map(const MapProblem& problem);

}  // namespace slapstick::sweep
