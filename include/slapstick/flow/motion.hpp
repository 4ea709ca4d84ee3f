#pragma once
/// The hybrid flow: a trajectory of a System, event by event, without step-size error.
///
/// A *flight* is the motion in one mode from an event to the next, window by window. The event is the first zero of a guard that is
/// positive just after the start; a guard that is zero at the start is judged by its first non-zero derivative, never nudged.
/// A call of `advance` that ends before the event only looks at the flight: wherever and however often a flight is cut, its event
/// is the same to the last bit. At one instant events are handled in the order impact, velocity reversal, stick test (the order of the guards); what
/// an event makes due at the same instant follows as an event of its own at the same time.
///
///   x-  state just before the event (what Event::before shows)
///   x*  the event's own condition made exact: gap = 0, w = 0 or (compliant stops) force = 0 in the stored state
///   x+  after the impact law; then `select_mode` decides the next mode
///
/// Several contacts can have their events at one instant: whatever is within its rounding bound of zero there is made zero too.
///
/// An impact keeps momentum and turns w into -r w; friction gives no impulse. A touch whose depth cannot be told from zero is a
/// `graze`: no impulse, contact at rest, the next mode by the forces. Infinitely many impacts in finite time are
/// reported as one `chatter` event at their limit (flow/chatter.hpp).
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "slapstick/base/clock.hpp"
#include "slapstick/flow/flight_origin.hpp"
#include "slapstick/flow/system.hpp"

namespace slapstick {

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
  separate     ///< a compliant stop that had let go beyond its gap is back at it
};

inline constexpr std::size_t event_kinds = 10;

/// "impact", "slip+", "slip-", "stick", "release", "graze", "chatter", "engage", "disengage", "separate".
std::string_view name(EventKind kind);

struct Event {
  EventKind kind = EventKind::impact;
  int contact = 0;  ///< stops first, then friction contacts; System::contact_name
  Instant time;
  double w = 0.0;      ///< relative velocity of the contact's pair just before, v_a - v_b - belt speed
  double error = 0.0;  ///< chatter: bound on the error of `time`, in time units; else 0
};

enum class Outcome { event, reached_end };

/// Work done, part of the interface: a change in it is noticed by the tests.
struct Counters {
  long events = 0, impacts = 0, segments = 0, windows = 0, evaluations = 0, grazes = 0;
  long pile_ups = 0;  ///< chatters of several stops that were ended, unproven, at one instant of the clock
};

struct MotionOptions {
  /// A chatter is replaced by its limit once the limit time is known to this fraction of a period.
  double chatter_tolerance = 1e-15;
  /// Events without an advance of one period before the motion gives up with a NumericalError (the "Zeno budget").
  long most_events_per_period = 1'000'000;
};

class Motion {
 public:
  /// Starts at `state` (x_1, v_1, x_2, v_2, ..) at instant `start`. @throws InputError if the state is invalid.
  Motion(const System& system, const State& state, Instant start = {}, MotionOptions options = {});

  /// Moves on to the next event, or to `end` if none comes first. An event exactly at `end` is reported.
  /// Cost: no allocation but for modes met for the first time and models of more than 24 numbers; a few hundred nanoseconds per event for the paper's system.
  /// @throws NumericalError with a replayable state if events pile up or no mode fits.
  Outcome advance(Instant end);

  /// The last event; valid once there was one.
  [[nodiscard]] const Event& event() const { return pending_.empty() ? last_ : pending_[shown_]; }
  /// The state just before the last event, in the user's coordinates.
  [[nodiscard]] std::span<const double> before() const;

  [[nodiscard]] Instant time() const { return now_; }
  [[nodiscard]] State state() const;        ///< the state now (after the last event), user's coordinates
  void state(std::span<double> out) const;  ///< the same without allocation
  [[nodiscard]] ModeId mode_id() const { return mode_; }
  [[nodiscard]] const System& system() const { return *system_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }

  /// The part of a flight that the last `advance` covered, from the last event or cut on: where it began, in which mode; `sample`
  /// evaluates it.
  struct Segment {
    Instant start;
    ModeId mode = 0;
    double duration = 0.0;      ///< time units
    std::span<const double> X;  ///< extended state at its start
  };
  [[nodiscard]] Segment segment() const;
  /// User's state at time s in [0, duration] of that segment.
  void sample(double s, std::span<double> out) const;

  /// The guard whose zero ended the last segment; null if the segment ended without one (cut, chatter limit).
  [[nodiscard]] const mode::Guard* hit_guard() const {
    return hits_.empty() ? nullptr : &system_->mode(segment_mode_).guards()[hits_.front()];
  }
  /// The same and those that were zero at that instant too, as indices of that mode's guards.
  [[nodiscard]] std::span<const int> hits() const { return hits_; }
  /// The impacts that ended the last segment, in order: the stops, bit by bit, that got an impulse together.
  struct Strike {
    std::uint32_t stops = 0;
    bool to_rest = false;  ///< whatever their restitution: the end of a pile-up
  };
  [[nodiscard]] std::span<const Strike> strikes() const { return strikes_; }

  /// The extended state now, and just before the last event, for analyses that work in contact coordinates.
  [[nodiscard]] std::span<const double> extended() const { return X_.span(); }
  [[nodiscard]] std::span<const double> extended_before() const { return X_before_.span(); }

 private:
  enum class Cause { impact, graze, reversal, force, compliant };
  struct Found {
    event::RootKind kind;
    int guard;
    double x;
    bool doubtful = false;
  };

  /// An extended state, padded to whole lanes.
  class Extended {
   public:
    explicit Extended(int size) : lanes_((size + 7) / 8) {}
    Extended(const Extended&) = default;
    Extended(Extended&&) = default;
    Extended& operator=(const Extended& X) {  // of the same size; a call of memmove takes longer
      for (std::size_t b = 0; b < lanes_.size(); ++b) lanes_[b] = X.lanes_[b];
      return *this;
    }
    Extended& operator=(Extended&&) = default;
    ~Extended() = default;
    double* data() { return reinterpret_cast<double*>(lanes_.data()); }
    [[nodiscard]] const double* data() const { return reinterpret_cast<const double*>(lanes_.data()); }
    [[nodiscard]] std::span<const double> span() const { return {data(), 8 * lanes_.size()}; }
    event::Lanes& lanes() { return lanes_; }
    [[nodiscard]] const event::Lanes& lanes() const { return lanes_; }

   private:
    event::Lanes lanes_;
  };

  /// Where the present flight stands: `windows` whole windows after `start`. The start is moved along: see move_start.
  struct Flight {
    Instant start;
    int windows = 0;
    [[nodiscard]] double elapsed(double window) const { return windows * window; }
  };

  void start();
  void begin_flight();
  void clear_lingers();
  void begin_segment();
  bool fly(Instant end);
  Found first_event_in_window(double x_end);
  void next_window();
  void restart_window(double x);
  void sharpen_window();
  [[nodiscard]] event::Hull enclosed(int guard) const;
  [[nodiscard]] double flown_noise(int guard) const;
  void move_start(double x, Extended& X);
  [[nodiscard]] Instant instant(double x) const;
  void look(double x);
  void arrive(double x);
  void stand(double x);
  void handle(int guard, bool graze);
  void rest(const mode::ContactRow& contact);
  void land(const mode::ContactRow& contact);
  void let_off(int compliant);
  void gather_ties(int guard);
  [[nodiscard]] bool of_one_pair(const mode::Guard& a, const mode::Guard& b) const;
  [[nodiscard]] bool tail_is_quiet(int stop, double duration);
  [[nodiscard]] bool in_doubt(const Found& found) const;
  [[nodiscard]] bool within_noise(int guard, double x) const;
  [[nodiscard]] double rate(const mode::Guard& guard) const;
  [[nodiscard]] std::span<const int> touching();
  [[nodiscard]] int approaching() const;
  void newton(int stop);
  void moreau(std::span<const int> stops);
  void strike_all();
  void end_pile_up();
  void reconcile_contacts();
  void compliant_limit(int compliant, mode::GuardKind kind);
  void report_others(const mode::ContactStates& old);
  [[nodiscard]] int stop_touched_at_rest(int friction) const;
  void force_limit(int guard, int contact, bool graze);
  void touch(int stop, bool graze);
  bool end_chatter(double limit);
  void choose_mode();
  void settle(Cause cause);
  void report_settled(Cause cause, const mode::ContactStates& old);
  void report(EventKind kind, int contact, double w);
  void note_magnitude(Extended& X);
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_pile_up() const;
  [[nodiscard]] int stops() const { return static_cast<int>(system_->model().stops.size()); }
  [[nodiscard]] int frictions() const { return static_cast<int>(system_->model().frictions.size()); }
  [[nodiscard]] int compliants() const { return static_cast<int>(system_->model().compliant_stops.size()); }

  const System* system_;
  MotionOptions options_;
  Instant now_, segment_start_;
  ModeId mode_ = 0, segment_mode_ = 0;
  const mode::Mode* here_ = nullptr;  ///< the mode of mode_
  Flight flight_;
  flow::FlightOrigin origin_;
  double arrived_x_ = 0.0;      ///< where in its window the last event was
  double elapsed_ = 0.0;        ///< time from the flight's start to now ..
  double segment_begun_ = 0.0;  ///< .. and to the segment's start
  double segment_duration_ = 0.0;
  int chatter_stop_ = -1;  ///< the stop just hit, whose chatter may be complete
  Extended X_;             ///< now
  Extended X_window_;      ///< at the start of the present window
  Extended magnitude_;     ///< what its rounding is measured by, see note_magnitude
  double size_ = 0.0;      ///< the sum of that
  Extended X_before_, X_segment_, X_next_, phase_floor_;
  mutable std::vector<double> scratch_;
  mutable event::Lanes sample_out_;
  std::vector<int> orders_;       ///< of the zeros of the mode's guards at the start of the present window
  std::vector<int> tail_orders_;  ///< the same at the start of a chatter's tail
  std::vector<bool> lingers_;     ///< guards that are not clear of their noise at its end
  bool any_lingers_ = false;
  mutable State before_;
  std::vector<Event> pending_;  ///< the events of one instant, in order ..
  int shown_ = 0;               ///< .. and which one `event()` is
  Event last_;
  std::vector<int> touching_;
  std::vector<int> hits_;
  std::vector<Strike> strikes_;
  Counters counters_;
  std::int64_t budget_period_ = 0;
  long budget_events_ = 0;
  long at_one_instant_ = 0;       ///< events since the clock has moved ..
  double fastest_now_ = 0.0;      ///< .. the fastest impact among them ..
  std::uint32_t struck_now_ = 0;  ///< .. and the stops that were struck, bit by bit
};

}  // namespace slapstick
