#pragma once
/// The states of contacts, whose combination is a *mode*, and the kinds of guards that end a mode.
///
/// In a mode every contact keeps its state, and the model is a linear system. A *guard* is a number that is positive
/// while the mode lasts: a gap, a relative velocity, a distance of a force from its limit. The zero of a guard is an
/// event.
///
/// Plain data: no errors, no cost; values may be shared between threads as any other.
/// Source: docs/mode_graph.md; Leine and Nijmeijer (2004), chapter 6.
#include <cstdint>
#include <string_view>
#include <vector>

namespace slapstick {

/// A combination of contact states as one number: stops are digits of base 2, then friction contacts and compliant
/// stops digits of base 3. `System::states` and `System::mode_id` translate.
using ModeId = std::int64_t;

namespace mode {

enum class StopState : std::int8_t { open = 0, closed = 1 };
enum class FrictionState : std::int8_t { slip_minus = -1, stick = 0, slip_plus = 1 };
/// A compliant stop beyond its gap that does not pull is `detached` once its force has come to zero.
enum class CompliantState : std::int8_t { off = 0, on = 1, detached = 2 };

/// The state of every contact of the model, in the model's order.
struct ContactStates {
  std::vector<StopState> stops;
  std::vector<FrictionState> frictions;
  std::vector<CompliantState> compliant = {};
  friend bool operator==(const ContactStates&, const ContactStates&) = default;
};

/// What a guard measures. w is the relative velocity of a friction contact, s = sgn w; f0 the force that holds it in
/// stick, f_s its static friction; N the force of a closed stop; delta how far a compliant stop is beyond its gap.
enum class GuardKind {
  gap,          ///< open stop: clearance - (x_a - x_b)
  slip,         ///< slipping contact: s w
  stick_above,  ///< sticking contact: f_s - f0
  stick_below,  ///< sticking contact: f_s + f0
  press,    ///< closed stop: the largest stop force that its contact forces allow: N, or f0 + f_s with a sticking pair
  engage,   ///< compliant stop off: -delta
  leave,    ///< compliant stop beyond its gap: delta
  let_go,   ///< compliant stop that pushes: its force
  push      ///< compliant stop detached: minus the force it would have
};

/// "gap", "slip", "stick" (either limit), "press", "engage", "leave", "let-go", "push".
[[nodiscard]] std::string_view name(GuardKind kind);

/// True for the guards of friction contacts.
[[nodiscard]] inline bool of_friction(GuardKind kind) {
  return kind == GuardKind::slip || kind == GuardKind::stick_above || kind == GuardKind::stick_below;
}

}  // namespace mode
}  // namespace slapstick
