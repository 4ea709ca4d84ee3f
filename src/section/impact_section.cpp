/// Walks a motion from impact to impact, and sums the times between.
#include "slapstick/section/impact_section.hpp"

#include <algorithm>

#include "flow/compiled_system.hpp"

namespace slapstick {
namespace {

bool slips(const Motion& motion, ModeId mode) {
  const auto& frictions = motion.system().compiled().mode(mode).states().frictions;
  return std::any_of(frictions.begin(), frictions.end(),
                     [](mode::FrictionState state) { return state != mode::FrictionState::stick; });
}

}  // namespace

bool ImpactSection::next(Instant end, SectionPoint& point) {
  if (point_given_) {
    between_ = {};
    point_given_ = false;
  }
  for (;;) {
    const bool sliding =
        slips(motion_, motion_.mode_id());  // no event comes before `advance` returns: one mode all the way
    const Outcome outcome = motion_.advance(end);
    const Instant now = outcome == Outcome::event ? motion_.event().time : motion_.time();
    if (sliding) sliding_ += now.since(seen_);
    seen_ = now;
    if (outcome == Outcome::reached_end) return false;
    if (watcher_) watcher_(motion_);
    const Event& event = motion_.event();
    if (!stops_.is_point(event)) {
      note(event);
      continue;
    }
    point.time = event.time;
    point.w = event.w;
    point.flight = has_last_ ? event.time.since(last_) : std::numeric_limits<double>::quiet_NaN();
    point.sliding = has_last_ ? sliding_ : std::numeric_limits<double>::quiet_NaN();
    point.phase = event.time.fraction;
    point.contact = event.contact;
    point.state.assign(motion_.before().begin(), motion_.before().end());
    begin_flight();
    point_given_ = true;
    return true;
  }
}

void ImpactSection::note(const Event& event) {
  switch (event.kind) {
    case EventKind::impact:
      break;
    case EventKind::stick:
      ++between_.sticks;
      break;
    case EventKind::slip_plus:
    case EventKind::slip_minus:
      ++between_.reversals;
      break;
    case EventKind::release:
      ++between_.releases;
      break;
    case EventKind::graze:
      ++between_.grazes;
      break;
    case EventKind::engage:
    case EventKind::disengage:
    case EventKind::separate:
    case EventKind::corner:
    case EventKind::unload:
    case EventKind::load:
    case EventKind::knot:
      break;
    case EventKind::chatter:
      ++between_.chatters;
      if (stops_.holds(event.contact)) begin_flight();
      break;
  }
}

void ImpactSection::begin_flight() {
  last_ = motion_.event().time;
  has_last_ = true;
  sliding_ = 0.0;
}

}  // namespace slapstick
