/// The public face of a trajectory; flow/engine.hpp does the work.
#include "slapstick/flow/motion.hpp"

#include "flow/engine.hpp"

namespace slapstick {

std::string_view name(EventKind kind) {
  constexpr std::string_view names[event_kinds] = {"impact", "slip+",   "slip-",  "stick",     "release",
                                                   "graze",  "chatter", "engage", "disengage", "separate",
                                                   "corner", "unload",  "load",   "knot"};
  return names[static_cast<int>(kind)];
}

Motion::Motion(const System& system, const State& state, Instant start, MotionOptions options)
    : system_(system), engine_(std::make_unique<flow::Engine>(system.compiled(), state, start, options)) {}

Motion::Motion(const Motion& other) : system_(other.system_), engine_(std::make_unique<flow::Engine>(*other.engine_)) {}
Motion::Motion(Motion&& other) noexcept = default;
Motion& Motion::operator=(Motion&& other) noexcept = default;
Motion::~Motion() = default;

/// Motions of one compiled model have states of one size: theirs are copied in place, without allocation.
Motion& Motion::operator=(const Motion& other) {
  if (this == &other) return *this;
  if (engine_ != nullptr && &system_.compiled() == &other.system_.compiled())
    *engine_ = *other.engine_;
  else
    *this = Motion(other);
  return *this;
}

Outcome Motion::advance(Instant end) { return engine_->advance(end); }
const Event& Motion::event() const { return engine_->event(); }
std::span<const double> Motion::before() const { return engine_->before(); }
Instant Motion::time() const { return engine_->time(); }
ModeId Motion::mode_id() const { return engine_->mode_id(); }
const Counters& Motion::counters() const { return engine_->counters(); }
Motion::Segment Motion::segment() const { return engine_->segment(); }
void Motion::sample(double s, std::span<double> out) const { engine_->sample(s, out); }
std::span<const Motion::Strike> Motion::strikes() const { return engine_->strikes(); }
void Motion::state(std::span<double> out) const { engine_->state(out); }

State Motion::state() const {
  State out(2 * static_cast<std::size_t>(system_.model().size()));
  engine_->state(out);
  return out;
}

}  // namespace slapstick
