#pragma once
/// The quantities that must stay positive in a mode, as polynomials over one step.
#include <array>

#include "oracle/mechanics.hpp"
#include "oracle/polynomial.hpp"

namespace slapstick::oracle {

enum class GuardKind {
  gap,    ///< open stop: clearance - (x_a - x_b)
  slip,   ///< slip: |w|
  upper,  ///< stick: f_s - f0
  lower,  ///< stick: f_s + f0
  press   ///< closed stop: N; merged with a friction contact: N + friction + f_s
};
inline constexpr std::size_t guard_kinds = 5;

struct Guard {
  GuardKind kind;
  Polynomial p;  ///< in s = (t - t0) / step
  Real scale;    ///< size of the terms that make up p
};

/// The guards of a mode. `gap` is the gap at the start of the step, kept apart from x because it is exactly 0 after a
/// contact and tiny, but known to all its digits, inside a chatter.
[[nodiscard]] std::vector<Guard> guards_of(const Mechanics& mechanics, const Mode& mode, const Jet& jet,
                                           const Real& gap);

/// Which quantities are exactly zero at an instant.
struct Contact {
  bool touching = false;  ///< gap = 0
  bool at_rest = false;   ///< touching and u = 0
  bool no_slip = false;   ///< w = 0
};

/// Number of leading derivatives of each guard that vanish at the start of a segment. The guard's zero there is divided
/// out.
struct Start {
  static constexpr int never = -1;  ///< the guard is zero identically
  std::array<int, guard_kinds> zeros{};
  int& operator[](GuardKind kind) { return zeros[static_cast<std::size_t>(kind)]; }
  int operator[](GuardKind kind) const { return zeros[static_cast<std::size_t>(kind)]; }
};

/// The outcome of asking whether a mode may start: each guard positive, or zero with its first non-zero derivative
/// positive.
struct StartTest {
  bool admissible = true;
  GuardKind violated{};
  Start start;
};

/// A guard that is zero identically is admissible in contact (stick, closed), not out of it. v is taken after
/// projection to the mode.
[[nodiscard]] StartTest may_start(const Mechanics& mechanics, const Mode& mode, const Contact& contact, const Vector& x,
                                  Vector v, const Real& gap, const Real& t);

}  // namespace slapstick::oracle
