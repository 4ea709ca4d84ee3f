#pragma once
/// The events that a Motion would report of what a lane has seen.
#include <vector>

#include "batch/program.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::batch {

/// @param mode, slot, side  what has ended; next: the mode that follows; w: the speed of the contact
void report(const Shape& shape, const mode::Frame& frame, int mode, int slot, int side, int next, Instant time, double w,
            std::vector<Event>& events);

}  // namespace slapstick::batch
