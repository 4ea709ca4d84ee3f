#pragma once
/// The outline of a mode: the linear system that a combination of contact states selects, and the guards that end it.
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "slapstick/mode/frame.hpp"

namespace slapstick::mode {

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

/// A guard is a linear functional h of X that is positive while the mode lasts; its zero ends the mode.
enum class GuardKind {
  gap,          ///< open stop: clearance - (x_a - x_b)
  slip,         ///< slipping contact: s w
  stick_above,  ///< sticking contact: f_s - f0
  stick_below,  ///< sticking contact: f_s + f0
  press,  ///< closed stop: the largest stop force that its contact forces allow. N alone, or f0 + f_s with a sticking pair
  engage,  ///< compliant stop off: -delta
  leave,   ///< compliant stop beyond its gap: delta
  let_go,  ///< compliant stop that pushes: its force
  push     ///< compliant stop detached: minus the force it would have
};

/// "gap", "slip", "stick" (either limit), "press", "engage", "leave", "let-go", "push".
[[nodiscard]] std::string_view name(GuardKind kind);

/// True for the guards of friction contacts.
[[nodiscard]] inline bool of_friction(GuardKind kind) {
  return kind == GuardKind::slip || kind == GuardKind::stick_above || kind == GuardKind::stick_below;
}

struct Guard {
  GuardKind kind;
  int contact;    ///< index among the stops (gap, press), friction contacts (slip, stick) or compliant stops (others)
  RowVector row;  ///< h = row . X
  /// Index of the gap guard of the same pair whose rate of fall this slip guard is (h = -gap'), or -1. While such a gap is proven to
  /// fall, the slip guard is positive: y and w are one function and its derivative.
  int falls_with = -1;
  /// h = factor * X[single] if the row has one entry only, for p or u (then h has no rounding error but its own), else -1.
  int single = -1;
  double factor = 0.0;
  /// Then, if X[single] is a displacement without drift, the index of its velocity: h' = factor * X[rate]. Else -1.
  int rate = -1;

  /// The entries of the row that are not zero.
  struct Entry {
    int column;
    double value;
  };
  std::vector<Entry> entries = {};
  /// h at X, and the sum of the sizes of its terms (magnitude = |X|).
  [[nodiscard]] double at(const double* X) const {
    double sum = 0.0;
    for (const Entry& entry : entries) sum += entry.value * X[entry.column];
    return sum;
  }
  [[nodiscard]] double size(const double* magnitude) const {
    double sum = 0.0;
    for (const Entry& entry : entries) sum += std::abs(entry.value) * magnitude[entry.column];
    return sum;
  }
};

/// X' = system X in a combination of contact states, and what must stay positive while it lasts. Cost: O(m^3), some microseconds.
///
/// Slip: kinetic friction -s f_k on a. Compliant stops: their force on b, the opposite on a. Held contacts: M u' = R(X) + G^T lambda
/// with G u' = 0, so that lambda = -(G M^{-1} G^T)^{-1} G M^{-1} R is a linear functional of X. Contacts on one pair are held by one
/// multiplier and share their limits; where other held contacts depend on each other lambda is the solution of least norm.
struct Outline {
  Outline(const Model& model, const Frame& frame, ContactStates contact_states);

  ContactStates states;
  Matrix system;       ///< m x m
  Matrix system_size;  ///< the sums of the sizes of the terms that each of its entries was made of
  std::vector<Guard>
      guards;  ///< in the order in which events at one instant are handled: gaps, relative velocities, forces
  std::vector<bool> steady;  ///< u_i keeps its value to the last bit: its pair is held
};

}  // namespace slapstick::mode
