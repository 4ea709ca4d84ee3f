/// Samples a motion, window by window.
#include "motion_job.hpp"

namespace slapstick::web {

MotionJob::MotionJob(const Choice& choice, const MotionWish& wish)
    : wish_(wish),
      system_(choice.model()),
      reader_(system_, quantities_of(choice, wish.of)),
      transient_(Motion(system_, choice.start_at())),
      begin_{wish.transient, 0.0} {
  width_ = static_cast<int>(2 + 2 * system_.model().coordinates.size() + reader_.of().size());
  event_width_ = static_cast<int>(4 + 2 * system_.model().coordinates.size());
}

void MotionJob::open_window(Motion motion) {
  const State state = motion.state();
  const ModeId mode = motion.mode_id();
  add_row(0.0, state, mode, reader_.now(motion));
  window_.emplace(std::move(motion), wish_.samples, begin_);
}

void MotionJob::go_on() {
  if (!window_ || !failure().empty()) return;
  begin_ = {begin_.period + wish_.periods, 0.0};
  Motion motion = window_->motion();
  open_window(std::move(motion));
  done_ = false;
}

bool MotionJob::work(const Deadline& deadline) {
  if (transient_) {
    if (!run_until(*transient_, begin_, deadline, [] {})) return false;
    open_window(std::move(*transient_));
    transient_.reset();
  }
  const Instant end{begin_.period + wish_.periods, 0.0};
  for (int items = 1;; ++items) {
    const SampledMotion::Item item = window_->next(end);
    if (item == SampledMotion::Item::end) return true;
    if (item == SampledMotion::Item::event) {
      add_event(window_->motion());
    } else if (const auto& sample = window_->sample(); sample.time > begin_) {
      add_row(sample.time.since(begin_), sample.state, sample.mode, reader_.within(window_->motion(), sample.within));
    }
    if (items % 64 == 0 && deadline.passed()) return false;
  }
}

void MotionJob::add_row(double time, const State& state, ModeId mode, const std::vector<double>& of) {
  rows_.push_back(time);
  rows_.insert(rows_.end(), state.begin(), state.end());
  rows_.push_back(at_rest(mode));
  rows_.insert(rows_.end(), of.begin(), of.end());
}

double MotionJob::at_rest(ModeId mode) {
  if (const auto known = at_rest_.find(mode); known != at_rest_.end()) return known->second;
  const mode::ContactStates states = system_.states(mode);
  double bit = 1.0, bits = 0.0;
  const auto add = [&](bool rests) {
    if (rests) bits += bit;
    bit *= 2.0;
  };
  for (const auto state : states.stops) add(state == mode::StopState::closed);
  for (const auto state : states.frictions) add(state == mode::FrictionState::stick);
  for (const auto state : states.compliant)
    add(state == mode::CompliantState::on || state == mode::CompliantState::bounded);
  at_rest_[mode] = bits;
  return bits;
}

void MotionJob::add_event(const Motion& motion) {
  const Event& event = motion.event();
  const double time = event.time.since(begin_);
  const State before(motion.before().begin(), motion.before().end());
  events_.insert(events_.end(), {time, static_cast<double>(event.kind), static_cast<double>(event.contact), event.w});
  events_.insert(events_.end(), before.begin(), before.end());
  add_row(time, before, motion.segment().mode, reader_.before(motion));
  add_row(time, motion.state(), motion.mode_id(), reader_.now(motion));
}

}  // namespace slapstick::web
