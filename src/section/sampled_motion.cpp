/// Reads equidistant samples from the segments of a motion.
#include "slapstick/section/sampled_motion.hpp"

#include <algorithm>
#include <cmath>

namespace slapstick {

SampledMotion::SampledMotion(Motion motion, int samples_per_period, Instant from)
    : motion_(std::move(motion)), per_period_(samples_per_period) {
  sample_.state.resize(2 * static_cast<std::size_t>(motion_.system().model().size()));
  if (per_period_ == 0) return;
  const Instant start = std::max(motion_.time(), from);
  aim(start.period * per_period_ + static_cast<std::int64_t>(std::floor(start.fraction * per_period_)));
  while (due_ < start) aim(index_ + 1);
}

void SampledMotion::aim(std::int64_t index) {
  index_ = index;
  std::int64_t period = index / per_period_, part = index % per_period_;
  if (part < 0) {
    part += per_period_;
    --period;
  }
  due_ = {period, static_cast<double>(part) / per_period_};
}

SampledMotion::Item SampledMotion::next(Instant end) {
  if (!flown_) {
    outcome_ = motion_.advance(end);
    reached_ = outcome_ == Outcome::event ? motion_.event().time : motion_.time();
    flown_ = true;
  }
  if (per_period_ > 0 && due_ <= reached_) {
    read_sample();
    aim(index_ + 1);
    return Item::sample;
  }
  flown_ = false;
  return outcome_ == Outcome::event ? Item::event : Item::end;
}

void SampledMotion::read_sample() {
  sample_.time = due_;
  const Motion::Segment segment = motion_.segment();
  sample_.mode = segment.duration > 0.0 ? segment.mode : motion_.mode_id();
  sample_.within = std::clamp(due_.since(segment.start) * motion_.system().period(), 0.0, segment.duration);
  motion_.sample(sample_.within, sample_.state);
}

}  // namespace slapstick
