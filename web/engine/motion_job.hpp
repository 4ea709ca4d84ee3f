#pragma once
/// A motion for the mechanism, the time series and the phase portrait, in windows that follow one another.
///
/// Rows: time since the window's start in periods, the state, which contacts are at rest, the chosen quantities.
/// A contact is at rest if it sticks, is a closed stop, or a compliant stop that acts: bit by bit, as
/// System::contact_name.
/// At an event there are two rows, just before and just after it, so that jumps and corners are where they are.
/// Events: time as in the rows, kind (EventKind), contact, w; then the state just before.
#include <map>
#include <optional>

#include "choice.hpp"
#include "job.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/section/sampled_motion.hpp"

namespace slapstick::web {

struct MotionWish {
  int transient = 0;  ///< periods before the first window
  int periods = 4;    ///< length of a window
  int samples = 200;  ///< a period
  std::string of;     ///< quantities, separated by commas
};

class MotionJob : public Job {
 public:
  MotionJob(const Choice& choice, const MotionWish& wish);

  /// The next window, from where the last one ended; `advance` then computes it.
  void go_on();

 protected:
  bool work(const Deadline& deadline) override;

 private:
  void open_window(Motion motion);
  void add_row(double time, const State& state, ModeId mode, const std::vector<double>& of);
  double at_rest(ModeId mode);
  void add_event(const Motion& motion);

  MotionWish wish_;
  System system_;
  Reader reader_;
  std::map<ModeId, double> at_rest_;  ///< of the modes that were met
  std::optional<Motion> transient_;
  std::optional<SampledMotion> window_;
  Instant begin_;
};

}  // namespace slapstick::web
