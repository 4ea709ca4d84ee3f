#pragma once
/// A change of events on a branch, as it is handed from the continuation to what looks beyond it.
#include "orbit/path.hpp"
#include "slapstick/orbit/special_point.hpp"

namespace slapstick::orbit {

/// A point of a branch at which the orbit ceases to be a motion.
struct Change {
  SpecialPoint special;
  PathPoint at;
  double length = 0.0;  ///< from `from` to there
  TestValue test;
};
}  // namespace slapstick::orbit
