#pragma once
/// Reference solution of a Model in 50 digits, for tests only. The oracle shares no code and no method with the engine.
///
/// In a mode the motion is expanded in Taylor series (remainder below 1e-54 per step); each guard is a polynomial per
/// step whose first zero is isolated and refined. Semantics: docs/explanation/mode_graph.md.
///
/// Limits: one stop and one friction contact. Event times are good to about 1e-45 times the sensitivity of the motion;
/// a guard is taken as zero, and a contact as a graze, when it comes within 1e-30 of the size of the guard's variation
/// in that segment.
///
/// Order at one instant: impact or graze, then velocity reversal, then release. One event is reported per instant, the
/// first of these; the modes after it are those the whole instant leads to.
#include <deque>
#include <optional>
#include <string>

#include "oracle/guards.hpp"

namespace slapstick::oracle {

struct OracleEvent {
  Real time;
  ///     impact   the stop is reached with w > 0
  ///     graze    the stop is reached with w = 0: no impulse; what follows (slip, closed) is decided by the forces
  ///     slip+-   w reaches 0 and slip goes on with this sign
  ///     stick    w reaches 0 and stays 0
  ///     release  the holding force exceeds f_s, or the closed stop lets go
  ///     chatter  limit of infinitely many impacts; the stop is closed from here on
  std::string kind;
  std::string contact;  ///< "stop" or "friction"; "stop" when a merged closed stop lets go
  Real w;               ///< x_a' - x_b' of that contact just before (less the belt speed)
  Vector before;        ///< x1, v1, x2, v2, ... just before
};

/// A segment whose mode is given and not decided: the state may carry the rounding of doubles.
struct SegmentStart {
  Vector state;
  Real phase_fraction = 0;  ///< time / period
  Mode mode;
  bool touching = false;  ///< take the gap as exactly 0 (just after an impact)
  bool no_slip = false;   ///< take w as exactly 0 (just after a reversal or release)
};

class Oracle {
 public:
  /// Starts at time phase_fraction * period(), in the mode that may start there. An impact at once is the first event.
  /// @throws std::invalid_argument for more than one stop or friction contact, or a violated stop.
  Oracle(const Model& model, const std::vector<double>& state, double phase_fraction = 0);
  Oracle(const Model& model, const Vector& state, const Real& phase_fraction);
  Oracle(const Model& model, const SegmentStart& start);

  /// The next event in (time(), t_end]; without one, time() is t_end. After an event the state is the one just after
  /// it; the last impact before a chatter's limit finds the state already at the limit, some 1e-22 later.
  std::optional<OracleEvent> next(const Real& t_end);
  /// All events up to t_end.
  std::vector<OracleEvent> run(const Real& t_end);

  [[nodiscard]] const Real& time() const { return t_; }
  [[nodiscard]] const Real& period() const { return mechanics_.period(); }
  [[nodiscard]] Vector state() const;  ///< x1, v1, x2, v2, ...
  [[nodiscard]] const Real& gap() const { return gap_; }
  [[nodiscard]] Mode mode() const { return mode_; }
  [[nodiscard]] bool sticking() const { return mechanics_.has_friction() && mode_.friction == 0; }
  [[nodiscard]] bool closed() const { return mode_.closed; }
  /// Sign of w; 0 in stick or without a friction contact.
  [[nodiscard]] int slip_sign() const { return mechanics_.has_friction() ? mode_.friction : 0; }
  /// f0 in stick, else 0.
  [[nodiscard]] Real holding_force() const;
  /// N of the closed stop, the least that is possible when friction acts beside it; 0 if open.
  [[nodiscard]] Real stop_force() const;

 private:
  struct Hit {
    GuardKind kind;
    Root root;
  };

  void split(const Vector& state);
  void start();
  void choose_mode(const Contact& contact);
  [[nodiscard]] std::vector<Mode> candidates(const Contact& contact) const;
  [[nodiscard]] std::optional<Hit> first_hit(const Jet& jet);
  [[nodiscard]] Real gap_curvature(const Jet& jet, const Real& s) const;
  void advance(const Jet& jet, const Real& s);
  OracleEvent handle(GuardKind kind, bool touch, const Real& gap_curvature);
  [[nodiscard]] OracleEvent make_event(const char* kind, bool at_stop) const;
  Contact collide(bool w_was_zero);
  void begin_segment(const Start& start_zeros);
  void sum_chatter();
  [[nodiscard]] Real velocity_scale() const;

  Mechanics mechanics_;
  Vector x_, v_;
  Real t_, gap_;
  Mode mode_;
  Start zeros_;       ///< zeros of the guards at the start of the current step
  Real step_;         ///< length of the next step
  Real since_event_;  ///< length of the current segment, summed from its steps to keep the digits of a tiny one
  Real gap_size_,
      slip_size_;      ///< largest size of the gap's and w's terms since they were last zero / since the last event
  Real since_impact_;  ///< like since_event_, from the last impact
  std::deque<Real> intervals_;       ///< the last intervals between impacts, newest last
  std::deque<OracleEvent> pending_;  ///< found but not yet returned
};

/// The first event of a segment that starts in a given mode; its time is counted from the start of the segment. A guard
/// that is negative at the start gives an event at 0. Without an event in (0, duration]: nothing.
[[nodiscard]] std::optional<OracleEvent> first_event(const Model& model, const SegmentStart& start,
                                                     const Real& duration);

}  // namespace slapstick::oracle
