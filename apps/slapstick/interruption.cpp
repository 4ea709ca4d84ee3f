/// Catches signals, and ends what does not answer them.
#include "interruption.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>

#include "io/atomic_file.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

std::atomic<bool> requested{false}, answered{false};
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr long tick_ms = 300;
constexpr int last_tick = 6;  ///< 1.8 s
constexpr long enough_ms = 1000, idle_ms = 3;

// Of the handler of the timer alone: no other runs beside it.
int ticks = 0;
long used_at_signal = 0, used_before = 0;

/// Time that all threads of the process have had from the processors.
long used() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

void set_timer(long ms) {
  itimerval every{};
  every.it_interval.tv_usec = every.it_value.tv_usec = ms * 1000;
  ::setitimer(ITIMER_REAL, &every, nullptr);
}

[[noreturn]] void end_at_once() {
  remove_temporary_files();
  ::_exit(interrupted);
}

extern "C" void on_signal(int) {
  if (requested.exchange(true)) end_at_once();
  used_at_signal = used_before = used();
  set_timer(tick_ms);
}

extern "C" void on_tick(int) {
  if (answered) return set_timer(0);
  const long now = used(), since_tick = now - used_before;
  used_before = now;
  if (++ticks < last_tick || (now - used_at_signal < enough_ms && since_tick > idle_ms)) return;
  constexpr char text[] =
      "slapstick: ended in the middle of a computation that does not look up; its results are not written\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, sizeof text - 1);
  end_at_once();
}

}  // namespace

const std::atomic<bool>& stop_requested() { return requested; }

void catch_signals() {
  struct sigaction action {};
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) sigaddset(&action.sa_mask, signal);  // one handler at a time
  const auto set = [&](int signal, void (*handler)(int)) {
    action.sa_handler = handler;
    ::sigaction(signal, &action, nullptr);
  };
  set(SIGALRM, on_tick);
  set(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction present {};
    if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_IGN) continue;
    set(signal, on_signal);
  }
}

void answer_signal() {
  if (requested) answered = true;
}

}  // namespace slapstick::app
