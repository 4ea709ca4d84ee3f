#pragma once
/// A trajectory as people plot it: samples at equidistant times, and the events between them.
///
/// Samples are read from the segments between events, so they disturb nothing: the events are the same bits with any
/// number of samples.
/// Shapes and threads are those of the Motion; a sample costs one evaluation of the state.
#include "slapstick/flow/motion.hpp"

namespace slapstick {

class SampledMotion {
 public:
  enum class Item { event, sample, end };

  struct Sample {
    Instant time;         ///< k / samples_per_period exactly
    ModeId mode = 0;      ///< of the motion up to here; at the start the mode that starts, after impacts due there
    State state;          ///< user's coordinates; just before an event that falls on this very instant
    double within = 0.0;  ///< time since the start of the motion's last segment, as Motion::sample takes it
  };

  /// Takes the motion over; its System must outlive this object. The first sample is at the first multiple of a
  /// period / `samples_per_period` that is neither before the motion's instant nor before `from`. 0 samples: events
  /// only.
  SampledMotion(Motion motion, int samples_per_period, Instant from = {});

  /// What comes next up to `end`, in order of time; a sample comes before an event of the same instant. No allocation
  /// after the first.
  /// @throws NumericalError as Motion::advance; the samples since the last event are then lost
  Item next(Instant end);

  /// The motion: after Item::event it stands at the event, after Item::end at `end`; after Item::sample it may be
  /// ahead.
  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] const Sample& sample() const { return sample_; }  ///< after Item::sample

 private:
  void read_sample();
  void aim(std::int64_t index);

  Motion motion_;
  int per_period_;
  std::int64_t index_ = 0;
  Instant due_;  ///< of the next sample
  bool flown_ = false;
  Outcome outcome_ = Outcome::event;
  Instant reached_;
  Sample sample_;
};

}  // namespace slapstick
