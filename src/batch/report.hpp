#pragma once
/// The events that a Motion would report of what a lane has seen.
#include <vector>

#include "batch/program.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::batch {

/// What has ended a mode, and w of its contact.
struct Ending {
  int mode = 0, slot = 0, side = 0;
  double w = 0.0;
};

/// @param next  the mode that follows; u: the velocities that it starts with
void report(const Shape& shape, const Model& model, const mode::Frame& frame, const Ending& ending, int next,
            Instant time, const double* u, std::vector<Event>& events);

}  // namespace slapstick::batch
