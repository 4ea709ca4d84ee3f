#pragma once
/// What a Motion does: flights, and what happens at their ends (ties, impacts, rest, chatter, the next mode). See
/// slapstick/flow/motion.hpp.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flow/flight.hpp"

namespace slapstick::flow {

class Engine : public Flight {
 public:
  Engine(const CompiledSystem& system, const State& state, Instant start, MotionOptions options);
  /// From displacements and velocities in contact coordinates (2 d numbers), as they are stored.
  Engine(const CompiledSystem& system, std::span<const double> coordinates, Instant start, MotionOptions options);

  Outcome advance(Instant end);
  /// Goes on from another state, as if made anew there.
  void restart(std::span<const double> coordinates, Instant start);
  /// Whether the impact that was last may be followed by a complete chatter: the next call looks for a proof.
  [[nodiscard]] bool may_chatter() const;
  /// Whether the next call of `advance` tells another event of this instant.
  /// Is `event()` the first of those of its instant?
  [[nodiscard]] bool is_first_event() const { return shown_ == 0; }
  [[nodiscard]] bool has_more_events() const { return shown_ + 1 < static_cast<int>(pending_.size()); }

  [[nodiscard]] const Event& event() const { return pending_.empty() ? last_ : pending_[shown_]; }
  /// All events of its instant, in order.
  [[nodiscard]] std::span<const Event> events_of_instant() const { return pending_; }
  [[nodiscard]] std::span<const double> before() const;
  /// The extended state just before `event()`, from which `before()` is taken.
  [[nodiscard]] std::span<const double> extended_of_event() const;
  /// The extended state just before the first event of the last instant that had one.
  [[nodiscard]] std::span<const double> extended_before() const { return X_before_.span(); }

  /// The guard whose zero ended the last segment; null if the segment ended without one (cut, chatter limit).
  [[nodiscard]] const mode::Guard* hit_guard() const {
    return hits_.empty() ? nullptr : &system_->mode(segment_mode_).guards()[hits_.front()];
  }
  /// The same and those that were zero at that instant too, as indices of that mode's guards.
  [[nodiscard]] std::span<const int> hits() const { return hits_; }
  [[nodiscard]] std::span<const Motion::Strike> strikes() const { return strikes_; }
  /// The stops whose complete chatter the last segment sums, bit by bit.
  [[nodiscard]] std::uint32_t chattered() const { return chattered_; }

 private:
  enum class Cause { start, impact, graze, reversal, force, compliant /* and characteristic */ };

  void reserve();
  void start();
  void pass_knot();
  void take_blow();
  bool kick(bool kinematic);
  void bear_blow();
  void look_ahead();
  void begin_segment();
  void handle(int guard, bool graze);
  void make_exact(const mode::Guard& hit);
  void set_velocity_zero(const mode::ContactRow& contact);
  void set_gap_zero(const mode::ContactRow& contact);
  void set_force_zero(int compliant);
  void gather_ties(int guard);
  [[nodiscard]] bool has_passed(int guard) const;
  void leave_touched_limits();
  bool leave_limits_at_start();
  [[nodiscard]] bool only_touches(int guard, double rounding) const;
  [[nodiscard]] std::optional<double> way_to_wall(int guard, double rounding) const;
  [[nodiscard]] bool turns_with(const mode::Guard& corner, const mode::Guard& slip) const;
  [[nodiscard]] int of_pair(int guard) const;
  [[nodiscard]] bool of_one_pair(const mode::Guard& a, const mode::Guard& b) const;
  [[nodiscard]] bool tail_is_quiet(double duration);
  [[nodiscard]] bool is_shaken(const mode::Guard& guard) const;
  void bring_chatter_to_rest(Extended& X) const;
  [[nodiscard]] std::span<const int> touching();
  [[nodiscard]] int approaching() const;
  void newton(int stop);
  void moreau(std::span<const int> stops);
  void strike_all();
  void end_pile_up();
  void bring_together(std::span<const int> stops);
  [[nodiscard]] bool piles_up_again(int stop);
  void reconcile_contacts();
  void compliant_limit(int compliant, mode::GuardKind kind);
  [[nodiscard]] int stop_touched_at_rest(int friction) const;
  void force_limit(int guard, int contact, bool graze);
  void set_crossing_guard(const mode::Guard& guard, double value);
  void set_holding_guard_zero(const mode::Guard& guard);
  void cross(int guard, bool graze);
  void touch(int stop, bool graze);
  bool end_chatter(double limit);
  void start_mode();
  struct ReportedEvent {
    EventKind kind;
    int contact;
    double w;  ///< as it was before the event
  };
  [[nodiscard]] ReportedEvent reported_event(EventKind kind, int contact) const {
    return {kind, contact, speed_of(kind, contact)};
  }
  void choose_next_mode(Cause cause, std::optional<ReportedEvent> reported = {});
  void postpone_release(double flown);
  void go_on();
  void report_changes(Cause cause, const std::optional<ReportedEvent>& reported, const mode::ContactStates& old);
  [[nodiscard]] double speed_of(EventKind kind, int contact) const;
  [[nodiscard]] double value_of(const mode::RowVector& row) const;
  void report(EventKind kind, int contact, double w) { report(kind, contact, w, X_); }
  void report(EventKind kind, int contact, double w, const Extended& before);
  void spend_budget();
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_pile_up() const;
  [[nodiscard]] int stops() const { return static_cast<int>(system_->model().stops.size()); }
  [[nodiscard]] int frictions() const { return static_cast<int>(system_->model().frictions.size()); }
  [[nodiscard]] int compliants() const { return static_cast<int>(system_->model().compliant_stops.size()); }

  MotionOptions options_;
  Instant knot_ = mode::SignalTable::never;  ///< the next one of a signal
  std::vector<int> bouncing_;                ///< stops just hit, whose chatter may be complete
  std::uint32_t chattered_ = 0;
  Extended X_before_;
  std::vector<double> scratch_;   ///< of the proof of a chatter
  std::vector<int> tail_orders_;  ///< of the guards' zeros at the start of a chatter's tail
  mutable State before_;
  std::vector<Event> pending_;        ///< the events of one instant, in order ..
  int shown_ = 0;                     ///< .. and which one `event()` is
  std::vector<double> later_before_;  ///< the states just before all of them but the first, one after the other
  Event last_;
  std::vector<int> touching_;
  std::vector<int> hits_;
  std::vector<Motion::Strike> strikes_;
  std::int64_t budget_period_ = 0;
  long budget_events_ = 0;
};

}  // namespace slapstick::flow
