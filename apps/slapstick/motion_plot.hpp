#pragma once
/// The picture of a motion: curves, jumps, the phases of its contacts shaded, its impacts marked, the stops dashed.
#include "figure/figure.hpp"
#include "motion_record.hpp"

namespace slapstick::app {

[[nodiscard]] figure::Figure motion_figure(const MotionRecord& record);

}  // namespace slapstick::app
