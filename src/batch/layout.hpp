#pragma once
/// Where the numbers of a flat program are, and what ends a mode. No more than a kernel includes: plain types, every
/// function inlined.
#include <cstdint>

namespace slapstick::batch {

inline constexpr int most_coordinates = 4, most_contacts = 4, most_streams = 4, most_slots = 8, most_candidates = 16;

/// Where the words of a mode are. n coordinates, k streams.
struct Layout {
  int n = 0, k = 0, slots = 0;

  static constexpr int window = 0;          ///< H, in the model's unit of time
  static constexpr int window_periods = 1;  ///< the same in forcing periods
  static constexpr int inverse_speed = 2;   ///< the norm of a state is the largest of |p_i|, |u_i| times this, ..
  static constexpr int least_size = 3;      ///< .. and this, for streams and the constant
  static constexpr int chatter = 4;         ///< an impact that leaves slower than this times the norm may begin a
                                            ///< complete chatter that a Motion proves
  static constexpr int rates = 5;           ///< of the streams: j omega H
  [[nodiscard, gnu::always_inline]] constexpr int drift(int i) const { return rates + k + i; }  ///< times H
  /// u_i': n of K, n of C, k of F, R.
  [[nodiscard, gnu::always_inline]] constexpr int row(int i) const { return drift(n) + i * row_size(); }
  [[nodiscard, gnu::always_inline]] constexpr int row_size() const { return 2 * n + k + 1; }
  /// n over p, n over u, k over f, the constant; then what `Slot...` name, then the gap that falls with the slot: n
  /// over p.
  [[nodiscard, gnu::always_inline]] constexpr int slot(int s) const { return row(n) + s * slot_size(); }
  [[nodiscard, gnu::always_inline]] constexpr int slot_size() const { return row_size() + slot_numbers + n; }
  [[nodiscard, gnu::always_inline]] constexpr int slot_number(int s, int which) const {
    return slot(s) + row_size() + which;
  }
  [[nodiscard, gnu::always_inline]] constexpr int gap(int s) const { return slot(s) + row_size() + slot_numbers; }
  static constexpr int lower = 0, upper = 1;
  static constexpr int norm = 2;        ///< |v| is at most this times the norm of the state; 0: there is no such slot
  static constexpr int start_norm = 3;  ///< the same for the rounding of v at the window's start: 0 of a single number
  static constexpr int linked = 4;      ///< 1 if a gap falls with this slot
  static constexpr int slot_numbers = 5;
  [[nodiscard, gnu::always_inline]] constexpr int size() const { return slot(slots); }
};

/// A limit beyond all numbers.
inline constexpr double no_limit = 1e300;

/// What the state does at an event. `own` is the number of the contact's pair, sign that of the contact.
enum class Jump : std::uint8_t {
  none,           ///< a force at its limit
  impact,         ///< gap 0, velocity -r w, impulses on the others
  velocity_zero,  ///< velocity 0
  gap_zero,       ///< displacement 0
  force_zero,     ///< velocity -stiffness/damping displacement
  leave_it        ///< not for lanes
};

/// What ends a mode: a slot at one of its limits, or the gap that falls with it.
struct Action {
  Jump jump = Jump::leave_it;
  std::int8_t own = 0, sign = 1;
  std::int8_t contact = 0;  ///< in the numbering of Event
  std::int8_t stop = 0;     ///< of an impact: which; of force_zero: which compliant stop
  std::int8_t candidates = 0;
  std::int16_t candidate[most_candidates] = {};  ///< the modes that may follow, in order of preference

  /// The same of actions that do the same to a state.
  [[nodiscard, gnu::always_inline]] int key() const {
    return static_cast<int>(jump) | own << 8 | (sign > 0 ? 1 : 0) << 16 | stop << 24;
  }
};
/// Sides of a slot.
inline constexpr int at_lower = 0, at_upper = 1, at_gap = 2, sides = 3;

}  // namespace slapstick::batch
