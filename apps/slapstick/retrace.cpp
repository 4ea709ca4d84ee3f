/// Flies the last part of a run that was ended early once more.
#include "retrace.hpp"

#include <utility>

namespace slapstick::app {

void Retrace::mark(const Motion& motion) {
  using namespace std::chrono_literals;
  constexpr int calls_per_look = 4;  // at the clock, which is not free
  const bool far = motion.time().since(newer_.time()) >= periods_;
  const bool looks = ++calls_ % calls_per_look == 0;
  if (!far && !(looks && Clock::now() - marked_ >= 250ms)) return;
  std::swap(older_, newer_);
  newer_ = motion;
  marked_ = Clock::now();
}

}  // namespace slapstick::app
