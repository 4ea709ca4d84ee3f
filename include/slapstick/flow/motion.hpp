#pragma once
/// The hybrid flow: a trajectory of a System, event by event, without step-size error.
///
/// A *flight* is the motion in one mode from an event to the next, window by window. The event is the first zero of a
/// guard that is positive just after the start; a guard that is zero at the start is judged by its first non-zero
/// derivative, never nudged. A call of `advance` that ends before the event only looks at the flight: wherever and
/// however often a flight is cut, its event is the same to the last bit. At one instant events are handled in the order
/// impact, velocity reversal, stick test (the order of the guards); what an event makes due at the same instant follows
/// as an event of its own at the same time.
///
///   x-  state just before the event (what Event::before shows)
///   x*  the event's own condition made exact: gap = 0, w = 0 or (compliant stops) force = 0 in the stored state
///   x+  after the impact law; then the contact forces decide the next mode (docs/explanation/mode_graph.md)
///
/// Several contacts can have their events at one instant: whatever is within its rounding bound of zero there is made
/// zero too.
///
/// An impact keeps momentum and turns w into -r w; friction gives no impulse. A touch whose depth cannot be told from
/// zero is a `graze`: no impulse, contact at rest, the next mode by the forces. Infinitely many impacts in finite time
/// are reported as one `chatter` event at their limit, once that is proven (docs/developers/proofs.md).
///
/// Shapes: a state has 2 n numbers (x_1, v_1, x_2, v_2, ..) in the model's units; instants count forcing periods.
/// Threads: one Motion belongs to one thread at a time; copies are independent.
/// Source: docs/developers/proofs.md, docs/explanation/mode_graph.md; Moreau (1988), Glocker (2001) for impacts.
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "slapstick/base/clock.hpp"
#include "slapstick/flow/system.hpp"

namespace slapstick {

namespace flow {
class Engine;
}

enum class EventKind : std::uint8_t {
  impact,      ///< a stop is hit, at speed w
  slip_plus,   ///< w reached zero and goes on slipping with s = +1
  slip_minus,  ///< the same with s = -1
  stick,       ///< w reached zero and the contact sticks; also a stop that closes at rest
  release,     ///< stick or a closed stop ends
  graze,       ///< a guard touched zero without crossing it, within the rounding bound
  chatter,     ///< the limit of infinitely many impacts; the stop is closed
  engage,      ///< a compliant stop begins to act; w is its delta'
  disengage,   ///< .. and ceases to, at delta' = w
  separate,    ///< a compliant stop that had let go beyond its gap is back at it
  corner,      ///< a characteristic, or the force of a bounded compliant stop, passes a corner; w is that of the pair
  unload,      ///< the normal force of a friction contact has come to zero
  load,        ///< .. and becomes positive again
  knot         ///< the slope of a signal jumps
};

inline constexpr std::size_t event_kinds = 14;

/// "impact", "slip+", "slip-", "stick", "release", "graze", "chatter", "engage", "disengage", "separate", "corner",
/// "unload", "load", "knot".
std::string_view name(EventKind kind);

struct Event {
  EventKind kind = EventKind::impact;
  int contact = 0;  ///< stops, friction contacts, compliant stops, characteristics, signals; System::contact_name
  Instant time;
  double w = 0.0;      ///< relative velocity of the contact's pair just before, v_a - v_b - belt speed
  double error = 0.0;  ///< chatter: bound on the error of `time`, in time units; else 0
};

enum class Outcome { event, reached_end };

/// Work done, part of the interface: a change in it is noticed by the tests.
struct Counters {
  long events = 0, impacts = 0, segments = 0, windows = 0, evaluations = 0, grazes = 0;
  /// chatters of several stops that were ended, unproven, at one instant of the clock
  long pile_ups = 0;
  /// limits of chatter whose impacts may move another friction contact to and fro through its rest, a load through
  /// zero or a characteristic past a corner
  long shaken = 0;
};

struct MotionOptions {
  /// A chatter is replaced by its limit once the limit time is known to this fraction of a period.
  double chatter_tolerance = 1e-15;
  /// Events without an advance of one period before the motion gives up with a NumericalError (the "Zeno budget").
  long most_events_per_period = 1'000'000;
};

/// A trajectory. A copy goes on by itself from the same instant with the same bits. What was moved from may only be
/// assigned to or destroyed.
class Motion {
 public:
  /// Starts at `state` at instant `start`. The motion keeps the compiled model alive.
  /// @throws InputError if the state is invalid; NumericalError as `advance`
  Motion(const System& system, const State& state, Instant start = {}, MotionOptions options = {});
  Motion(const Motion& other);
  Motion(Motion&& other) noexcept;
  Motion& operator=(const Motion& other);
  Motion& operator=(Motion&& other) noexcept;
  ~Motion();

  /// Moves on to the next event, or to `end` if none comes first. An event exactly at `end` is reported. An `end`
  /// before `time()` is reached at once.
  /// Cost: no allocation except for modes met for the first time and models of more than 24 numbers; a few hundred
  /// nanoseconds per event for the paper's system.
  /// @throws NumericalError with a replayable state if events pile up or no mode fits
  Outcome advance(Instant end);

  /// The last event; valid once there was one, until the next call of `advance`.
  [[nodiscard]] const Event& event() const;
  /// The state just before the last event, in the user's coordinates; valid until the next call of `advance`.
  [[nodiscard]] std::span<const double> before() const;

  [[nodiscard]] Instant time() const;
  [[nodiscard]] State state() const;        ///< the state now (after the last event), user's coordinates
  void state(std::span<double> out) const;  ///< the same without allocation, into 2 n numbers
  [[nodiscard]] ModeId mode_id() const;
  [[nodiscard]] const System& system() const { return system_; }
  [[nodiscard]] const Counters& counters() const;

  /// The part of a flight that the last `advance` covered, from the last event or cut on: where it began, in which
  /// mode; `sample` evaluates it.
  struct Segment {
    Instant start;
    ModeId mode = 0;
    double duration = 0.0;  ///< time units
  };
  [[nodiscard]] Segment segment() const;
  /// User's state at time s in [0, duration] of that segment, into 2 n numbers. Cost: a step a window from the last s.
  void sample(double s, std::span<double> out) const;

  /// The impacts that ended the last segment, in order: the stops, bit by bit, that got an impulse together.
  struct Strike {
    std::uint32_t stops = 0;
    bool to_rest = false;  ///< whatever their restitution: the end of a pile-up
  };
  [[nodiscard]] std::span<const Strike> strikes() const;

  /// For the library's own sources: the type is private.
  [[nodiscard]] const flow::Engine& engine() const { return *engine_; }

 private:
  System system_;
  std::unique_ptr<flow::Engine> engine_;
};

}  // namespace slapstick
