/// Shows progress on standard error.
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace slapstick::app {

using namespace std::chrono_literals;

Progress::Progress(std::string what, double total, bool forced)
    : what_(std::move(what)),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) == 1),
      shown_(terminal_ || forced),
      begin_(Clock::now()) {
  next_ = begin_ + 200ms;
}

Progress::~Progress() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::update(double amount) {
  if (!shown_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? 200ms : 1000ms);
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const double rate = amount / seconds;
  const double left = rate > 0.0 ? std::min((total_ - amount) / rate, 1e8) : 1e8;
  const auto whole = static_cast<long>(left);
  std::fprintf(stderr, "%s%.0f/%.0f %s (%.0f %%), %.3g/s, %ld:%02ld left%s", terminal_ ? "\r\033[K" : "", amount,
               total_, what_.c_str(), 100.0 * amount / total_, rate, whole / 60, whole % 60, terminal_ ? "" : "\n");
  std::fflush(stderr);
}

}  // namespace slapstick::app
