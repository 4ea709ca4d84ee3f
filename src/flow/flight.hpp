#pragma once
/// Flying: the motion in one mode, window by window, up to the first zero of a guard. What happens there is
/// flow/engine.hpp's.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "flow/compiled_system.hpp"
#include "flow/flight_origin.hpp"
#include "flow/pile_ups.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::flow {

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

class Flight {
 public:
  [[nodiscard]] Instant time() const { return now_; }
  [[nodiscard]] ModeId mode_id() const { return mode_; }
  [[nodiscard]] const CompiledSystem& system() const { return *system_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }
  /// The user's state now, and within the last segment.
  void state(std::span<double> out) const;
  [[nodiscard]] Motion::Segment segment() const { return {segment_start_, segment_mode_, segment_duration_}; }
  void sample(double s, std::span<double> out) const;
  /// The extended state at time s of the last segment, in its mode: at a knot that ends it, with the slope before the
  /// knot. Valid until the next call of this or of `sample`.
  [[nodiscard]] std::span<const double> extended_within(double s) const;
  /// The windows that all calls of `sample` have stepped over.
  [[nodiscard]] long sampled_windows() const { return sampled_windows_; }
  /// The extended state now, and at the start of the last segment.
  [[nodiscard]] std::span<const double> extended() const { return X_.span(); }
  [[nodiscard]] std::span<const double> extended_at_start() const { return X_segment_.span(); }

 protected:
  struct Found {
    event::RootKind kind;
    int guard;
    double x;
    bool doubtful = false;
  };

  /// Where the present flight stands: `windows` whole windows after `start`. The start is moved along: see move_start.
  struct Place {
    Instant start;
    int windows = 0;
    bool moved = false;
    [[nodiscard]] double elapsed(double window) const { return windows * window; }
  };

  /// What has happened at the present instant of the clock; forgotten when the clock moves on.
  struct AtOneInstant {
    long events = 0;
    double fastest = 0.0;      ///< the fastest impact
    std::uint32_t struck = 0;  ///< the stops that were struck, bit by bit
    bool held = false;         ///< a release has been put off
    PileUps pile_ups = {};     ///< what has come to rest together, and after what

    void forget() {
      events = 0, fastest = 0.0, struck = 0, held = false;
      pile_ups.forget();
    }
  };

  Flight(const CompiledSystem& system, Instant start);

  void begin_flight();
  void begin_segment();
  void keep_segment_start();
  /// Goes on with the flight, up to `end`. The event that has ended it, at which the state and the clock stand; or
  /// nothing.
  std::optional<Found> fly(Instant end);
  void look(double x);
  void arrive(double x);
  [[nodiscard]] bool within_noise(int guard, double x) const;
  [[nodiscard]] double noise_of(int guard, double x) const;
  void note_magnitude(Extended& X);
  /// From the slopes of the signals in X_: after a start and behind a knot.
  void note_clock_sizes();

  const CompiledSystem* system_;
  Instant now_, segment_start_;
  ModeId mode_ = 0, segment_mode_ = 0;
  const mode::Mode* here_ = nullptr;  ///< the mode of mode_
  Place place_;
  AtOneInstant at_instant_;
  double arrived_x_ = 0.0;      ///< where in its window the last event was
  double elapsed_ = 0.0;        ///< time from the flight's start to now ..
  double segment_begun_ = 0.0;  ///< .. and to the segment's start
  double segment_duration_ = 0.0;
  Extended X_;               ///< now
  Extended X_window_;        ///< at the start of the present window
  Extended magnitude_;       ///< what its rounding is measured by, see note_magnitude
  Extended X_next_;          ///< scratch
  std::vector<int> orders_;  ///< of the zeros of the mode's guards at the start of the present window
  Counters counters_;

 private:
  Found first_event_in_window(double x_end);
  void clear_lingers();
  void next_window();
  void restart_window(double x);
  void sharpen_window();
  bool enclose(int guard, event::Hull& out) const;
  [[nodiscard]] double flown_noise(int guard) const;
  void move_start(double x, Extended& X);
  [[nodiscard]] Instant instant(double x) const;
  void stand(double x);
  [[nodiscard]] bool in_doubt(const Found& found) const;
  [[nodiscard]] double rate(const mode::Guard& guard) const;
  [[nodiscard]] double* stepped_to(double s) const;
  void set_clock_in_segment(double periods, double* X) const;

  FlightOrigin origin_;
  double size_ = 0.0;  ///< the sum of magnitude_
  Extended X_segment_, clock_sizes_;
  // Of `sample`: the state at the end of the first `sample_at_` windows of the segment (-1: of none), and scratch.
  mutable std::vector<double> sample_;
  mutable std::int64_t sample_at_ = -1;
  mutable event::Lanes sample_out_;
  mutable long sampled_windows_ = 0;
  std::vector<bool> lingers_;  ///< guards that are not clear of their noise at the window's end
  bool any_lingers_ = false;
};

}  // namespace slapstick::flow
