/// Records a run; carries it on by an engine.
#include "batch/recorder.hpp"

#include <algorithm>
#include <cmath>

#include "slapstick/flow/stage.hpp"

namespace slapstick::batch {
Instant Recorder::next() const {
  const int points = std::max(plan_->points, 1);
  const int periods = plan_->transient_periods + (passed_ == 0 ? 0 : plan_->periods - points + passed_ - 1);
  return {begin_.period + periods, begin_.fraction};
}

bool Recorder::look(const mode::Frame& frame, const double* p, const double* u, double growth) {
  const int points = std::max(plan_->points, 1);
  if (passed_ == 0) {
    impacts = speeds = 0.0;
    growth_before_ = growth;
  }
  if (passed_ >= 2 && watch) {
    if (watch(p, u, static_cast<long>(impacts - impacts_before_))) passed_ = points + 1;
  } else if (passed_ >= 2) {
    run.end.resize(2 * static_cast<std::size_t>(frame.n));
    frame.leave(p, u, run.end.data());
    if (plan_->points > 0) {
      run.points.insert(run.points.end(), run.end.begin(), run.end.end());
      run.point_impacts.push_back(static_cast<long>(impacts - impacts_before_));
    }
  }
  impacts_before_ = impacts;
  if (++passed_ < points + 2) return false;
  run.impacts = static_cast<long>(impacts);
  run.speeds = speeds;
  if (plan_->exponent) run.exponent = std::isfinite(growth) ? (growth - growth_before_) / plan_->periods : -INFINITY;
  run.done = true;
  return true;
}

bool follow(flow::Engine& engine, Recorder& recorder, EngineTangent* tangent, const std::atomic<bool>* cancel,
            bool to_the_end) {
  constexpr std::int64_t periods_between_looks = 1000;
  const mode::Frame& frame = engine.system().frame();
  for (;;) {
    if (stopped(cancel)) return true;
    const Instant look = {engine.time().period + periods_between_looks, 0.0}, end = std::min(recorder.next(), look);
    const Outcome outcome = engine.advance(end);
    if (tangent != nullptr) tangent->follow(engine, outcome);
    if (outcome == Outcome::reached_end) {
      if (end < recorder.next()) continue;
      if (tangent != nullptr && !recorder.recording() && !std::isfinite(tangent->growth())) tangent->begin(engine);
      const double growth = tangent != nullptr ? tangent->growth() : 0.0;
      if (recorder.look(frame, engine.extended().data(), engine.extended().data() + frame.d, growth)) return true;
      continue;
    }
    const Event& event = engine.event();
    ++recorder.run.motion_events;
    if (event.kind == EventKind::impact) recorder.count(event.w);
    if (recorder.wants_events()) recorder.run.events.push_back(event);
    if (!to_the_end && !engine.has_more_events() && !engine.may_chatter()) return false;
  }
}

}  // namespace slapstick::batch
