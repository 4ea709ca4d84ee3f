#pragma once
/// How far an orbit is from not being a motion: smooth functions of the orbit that are positive for a motion and change
/// sign where its events change.
#include <limits>
#include <vector>

#include "orbit/mode_set.hpp"
#include "slapstick/orbit/itinerary.hpp"

namespace slapstick::orbit {

enum class Test : std::uint8_t {
  /// the least value of a guard within a leg, or at its ends where it is not zero there by the events themselves
  guard,
  speed,     ///< how fast the guard of the leg's end falls through zero; of a gap, the speed of the impact
  duration,  ///< of a leg, in periods
  /// by how much the holding force exceeds static friction where a contact's velocity passes zero without stick;
  /// or what holds a contact, friction or a stop, where a point of a signal lets it go
  no_stick
};

struct TestValue {
  Test test = Test::guard;
  std::size_t leg = 0;
  mode::GuardKind kind = mode::GuardKind::gap;
  int contact = 0;
  double value = std::numeric_limits<double>::infinity();  ///< infinite where a guard has no minimum
  double at = 0.0;  ///< of a guard's least value: when, in periods from the leg's start
  /// Speed, duration: the guard that ends the leg is zero where it starts. A leg without length solves its equation
  /// too, and near one it is singular.
  bool starts_at_end = false;
};

/// All of them, in an order that depends on the shape alone.
[[nodiscard]] std::vector<TestValue> test_values(const ModeSet& set, const Orbit& orbit);

}  // namespace slapstick::orbit
