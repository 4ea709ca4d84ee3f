#pragma once
/// A stretch of a motion as curves: few points where they are straight, many where they bend; with its events, and the
/// phases in which a contact sticks or touches.
#include <map>
#include <optional>
#include <vector>

#include "shown_motion.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/quantity/reader.hpp"

namespace slapstick::app {

/// Each segment is sampled so densely that the fastest motion of the model is a curve, then thinned: no point that is
/// left out lies farther than `tolerance` of a number's extent from the line between its neighbours.
class MotionRecord {
 public:
  static constexpr double tolerance = 2e-4;

  enum class Phase { apart, sticks, touches };  ///< touches: a rigid stop at rest, a compliant one beyond its gap
  struct Stretch {
    Phase phase;
    double from, to;
    std::vector<double> start, finish;  ///< the numbers where it begins and ends
  };
  struct Moment {
    EventKind kind;
    bool ours;  ///< an impact, graze or limit of a chatter of a contact that is shown; else just a jump
    double t;
    std::vector<double> before, after;  ///< the numbers
  };

  MotionRecord(const System& system, ShownMotion shown)
      : system_(system), shown_(std::move(shown)), reader_(system, shown_.of) {}

  /// Only what happens from `from` to `to` is kept; what was recorded before is forgotten.
  void keep(Instant from, Instant to);
  /// The segment of the last `advance`, which must have been called with every one.
  void add_segment(const Motion& motion);
  /// The event at which the motion stands, after its segment.
  void add_event(const Motion& motion);

  [[nodiscard]] const ShownMotion& shown() const { return shown_; }
  [[nodiscard]] bool empty() const { return t_.empty(); }
  [[nodiscard]] std::int64_t base() const { return from_.period; }  ///< all times are periods from this one on
  [[nodiscard]] double begin() const { return t_.front(); }
  [[nodiscard]] double end() const { return covered_; }
  /// The times of the points; NaN where a number jumps.
  [[nodiscard]] const std::vector<double>& times() const { return t_; }
  /// A number at them.
  [[nodiscard]] const std::vector<double>& values(int number) const {
    return values_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
  [[nodiscard]] const std::vector<Moment>& moments() const { return moments_; }

 private:
  using Columns = std::vector<std::vector<double>>;

  [[nodiscard]] double time(Instant instant) const { return instant.since({from_.period, 0.0}); }
  [[nodiscard]] std::vector<double> numbers(Instant now, const State& state,
                                            const std::vector<double>& quantities) const;
  [[nodiscard]] bool apart(const std::vector<double>& a, const std::vector<double>& b) const;
  [[nodiscard]] Phase phase(ModeId mode);
  void read(const Motion& motion, double from, double to, double start);
  void keep_bends(std::size_t first, std::size_t last, std::vector<bool>& kept) const;
  void note_phase(ModeId mode, double from, double to);
  void push(double t, const std::vector<double>& numbers);
  void join_jumps(const std::vector<double>& after);

  const System& system_;
  ShownMotion shown_;
  Reader reader_;
  Instant from_, to_;
  double covered_ = 0.0;  // up to here
  std::vector<double> t_;
  Columns values_;
  std::vector<double> dense_t_;
  Columns dense_;
  std::vector<double> least_, greatest_;
  std::vector<Stretch> stretches_;
  std::vector<Moment> moments_;
  std::optional<Instant> instant_;  ///< of the last event, and what there was before its first one
  std::vector<double> before_;
  std::size_t points_ = 0, first_moment_ = 0;
  std::map<ModeId, Phase> phases_;
};

}  // namespace slapstick::app
