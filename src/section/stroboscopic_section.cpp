/// Walks a motion from period to period at one phase.
#include "slapstick/section/stroboscopic_section.hpp"

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {

StroboscopicSection::StroboscopicSection(Motion motion, double phase) : motion_(std::move(motion)), phase_(phase) {
  if (!motion_.system().model().forced())
    throw InputError("model " + in_quotes(motion_.system().model().name) +
                     " has no harmonic forcing, so it has no stroboscopic section");
  if (!(phase >= 0.0 && phase < 1.0))
    throw InputError("phase = " + shown(phase) + " is outside [0, 1) (a fraction of a forcing period)");
}

bool StroboscopicSection::next(StroboscopicPoint& point, const std::atomic<bool>* stop) {
  const Instant now = motion_.time();
  const Instant end{now.fraction < phase_ ? now.period : now.period + 1, phase_};
  if (!run_to(motion_, end, stop, [] {})) return false;
  point.time = end;
  point.mode = motion_.mode_id();
  point.state.resize(2 * static_cast<std::size_t>(motion_.system().model().size()));
  motion_.state(point.state);
  return true;
}

}  // namespace slapstick
