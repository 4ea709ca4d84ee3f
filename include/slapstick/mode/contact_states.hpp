#pragma once
/// The states of contacts, whose combination is a *mode*, and the kinds of guards that end a mode.
///
/// In a mode every contact keeps its state, and the model is a linear system. A *guard* is a number that is positive
/// while the mode lasts: a gap, a relative velocity, a distance of a force from its limit. The zero of a guard is an
/// event.
///
/// Plain data: no errors, no cost; values may be shared between threads as any other.
/// Source: docs/explanation/mode_graph.md; Leine and Nijmeijer (2004), chapter 6.
#include <cstdint>
#include <string_view>
#include <vector>

namespace slapstick {

struct Model;

/// A combination of contact states as one number: stops are digits of base 2, then friction contacts and compliant
/// stops digits of base 3 (4 where they have four states), then characteristics digits of as many values as they have
/// pieces. `System::states` and `System::mode_id` translate.
using ModeId = std::int64_t;

namespace mode {

enum class StopState : std::int8_t { open = 0, closed = 1 };
/// A friction contact is `unloaded` while its normal force is not positive: it carries no force, whatever its velocity.
enum class FrictionState : std::int8_t { slip_minus = -1, stick = 0, slip_plus = 1, unloaded = 2 };
/// A compliant stop beyond its gap that does not pull is `detached` once its force has come to zero, and `bounded`
/// where its damping force would exceed the force of its spring.
enum class CompliantState : std::int8_t { off = 0, on = 1, detached = 2, bounded = 3 };

/// s = sgn w of a contact that slips, else 0.
[[nodiscard]] constexpr int direction(FrictionState state) {
  return state == FrictionState::unloaded ? 0 : static_cast<int>(state);
}

/// The state of every contact of the model, in the model's order.
struct ContactStates {
  std::vector<StopState> stops;
  std::vector<FrictionState> frictions;
  std::vector<CompliantState> compliant = {};
  std::vector<int> pieces = {};  ///< of each characteristic: how many of its corners lie below
  friend bool operator==(const ContactStates&, const ContactStates&) = default;
};

/// Does a contact rest: does a friction contact stick, or is a stop closed?
[[nodiscard]] inline bool rests(const ContactStates& states) {
  for (const FrictionState state : states.frictions)
    if (state == FrictionState::stick) return true;
  for (const StopState state : states.stops)
    if (state == StopState::closed) return true;
  return false;
}

/// What a guard measures. w is the relative velocity of a friction contact, s = sgn w; f0 the force that holds it in
/// stick, f_s its static friction; N the force of a closed stop, or the normal force of a friction contact; delta how
/// far a compliant stop is beyond its gap.
enum class GuardKind {
  gap,          ///< open stop: clearance - (x_a - x_b)
  slip,         ///< slipping contact: s w
  stick_above,  ///< sticking contact: f_s - f0
  stick_below,  ///< sticking contact: f_s + f0
  press,   ///< closed stop: the largest stop force that its contact forces allow: N, or f0 + f_s with a sticking pair
  engage,  ///< compliant stop off: -delta
  leave,   ///< compliant stop beyond its gap: delta
  let_go,  ///< compliant stop that pushes: its force
  push,    ///< compliant stop detached: minus the force it would have
  corner_above,  ///< characteristic: its next corner minus the displacement (velocity)
  corner_below,  ///< characteristic: the displacement (velocity) minus the corner below it
  load,          ///< loaded friction contact: N
  unloaded,      ///< unloaded friction contact: -N
  bound,         ///< compliant stop on: spring force minus damping force
  beyond         ///< compliant stop bounded: damping force minus spring force
};

/// "gap", "slip", "stick" (either limit), "press", "engage", "leave", "let-go", "push", "corner" (either), "load",
/// "unloaded", "bound", "beyond".
[[nodiscard]] std::string_view name(GuardKind kind);

/// True for the guards of a friction contact's velocity and force.
[[nodiscard]] inline bool of_friction(GuardKind kind) {
  return kind == GuardKind::slip || kind == GuardKind::stick_above || kind == GuardKind::stick_below;
}

/// True for the guards of characteristics.
[[nodiscard]] inline bool of_corner(GuardKind kind) {
  return kind == GuardKind::corner_above || kind == GuardKind::corner_below;
}

/// True for the guards of a friction contact's normal force.
[[nodiscard]] inline bool of_load(GuardKind kind) { return kind == GuardKind::load || kind == GuardKind::unloaded; }

/// True for the guards of a compliant stop's bounded damping force.
[[nodiscard]] inline bool of_bound(GuardKind kind) { return kind == GuardKind::bound || kind == GuardKind::beyond; }

/// True for guards whose zero is a line that motions cross: the guard of the state behind it is the same number with
/// the other sign. The velocity does not jump there, and the force only at the edge of a zone.
[[nodiscard]] inline bool of_crossing(GuardKind kind) { return of_corner(kind) || of_load(kind) || of_bound(kind); }

/// A contact of a guard's kind, as System::contact_name numbers all contacts.
[[nodiscard]] int contact_index(GuardKind guard, int contact, const Model& model);

}  // namespace mode
}  // namespace slapstick
