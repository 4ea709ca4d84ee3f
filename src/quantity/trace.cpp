/// Hands the pieces of a Motion to a tracer.
#include <map>

#include "flow/engine.hpp"
#include "quantity/tracer.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::quantity {
namespace {

class Follower {
 public:
  Follower(Motion& motion, Tracer& tracer)
      : motion_(motion), tracer_(tracer), origin_(motion.time()), segments_(motion.counters().segments) {}

  /// After a call of advance.
  void look(bool event) {
    const bool flown = motion_.counters().segments != segments_ || (event && struck_at_start());
    first_ = false;
    if (flown) piece();
    if (!event) return;
    if (flown && motion_.event().kind == EventKind::knot) pulses();
    if (flown) tracer_.arrive(motion_.engine().extended_before().data());
    const Event& last = motion_.event();
    if (last.kind == EventKind::impact) tracer_.impact(last.contact, last.w);
    if (last.kind == EventKind::chatter)
      tracer_.begin_flight(last.contact, Number{last.time.since(origin_) * motion_.system().period(), 0.0});
  }

 private:
  /// A start in contact and approaching: its impact comes after a piece of no length.
  [[nodiscard]] bool struck_at_start() const {
    const Motion::Segment segment = motion_.segment();
    return first_ && motion_.engine().is_first_event() && segment.duration == 0.0 && segment.start == origin_ &&
           motion_.event().time == origin_;
  }

  /// The impacts that a chatter's limit stands for come before its segment, others after theirs.
  void piece() {
    segments_ = motion_.counters().segments;
    const Motion::Segment segment = motion_.segment();
    const flow::CompiledSystem& system = motion_.system().compiled();
    auto& outline = outlines_[segment.mode];
    if (outline == nullptr) outline = system.outline(segment.mode);
    if (const std::uint32_t stops = motion_.engine().chattered(); stops != 0) tracer_.chatter(stops);
    tracer_.piece(outline, system.mode(segment.mode).window(), motion_.engine().extended_at_start().data(),
                  segment.start.since(origin_) * system.period(), segment.duration);
    for (const Motion::Strike& strike : motion_.strikes()) tracer_.strike(strike.stops);
  }

  void pulses() {
    const auto& signals = motion_.system().compiled().frame().signals;
    for (std::size_t k = 0; k < signals.size(); ++k)
      if (const double area = signals[k].pulse(motion_.time()); area != 0.0)
        tracer_.pulse(static_cast<int>(k), {area, 0.0});
  }

  Motion& motion_;
  Tracer& tracer_;
  Instant origin_;
  long segments_;
  bool first_ = true;
  std::map<ModeId, std::shared_ptr<const mode::Outline>> outlines_;
};

}  // namespace

bool trace(Motion& motion, Instant end, Tracer& tracer, const std::atomic<bool>* stop,
           const std::function<void(double periods)>& progress) {
  Follower follower(motion, tracer);
  Instant stage = motion.time();
  do {
    stage = next_stage(motion.system(), stage, end);
    while (motion.advance(stage) == Outcome::event) {
      follower.look(true);
      if (stopped(stop)) return false;
    }
    follower.look(false);
    if (progress) progress(motion.time().since({}));
    if (stopped(stop)) return false;
  } while (stage < end);
  tracer.finish(motion.engine().extended().data(), *motion.system().compiled().outline(motion.mode_id()));
  return true;
}

}  // namespace slapstick::quantity
