#pragma once
/// Long calls: the GIL released, Ctrl-C heard within a tenth of a second, progress shown.
///
///     Watch watch(progress);
///     watch.run([&] { for (..) if (!watch.go_on(done)) return; });  // work that looks up by itself
///     watch.run_aside([&] { run_diagram(problem with watch.cancel()); });  // work that does not
///
/// The handlers of signals run on Python's main thread alone, with the GIL. `run` computes on the caller's thread and
/// takes the GIL for a moment, twenty times a second: a short call pays for no thread. `run_aside` computes on a thread
/// of its own, while the caller's sleeps and wakes up as often.
/// Any exception of a handler ends the work; a KeyboardInterrupt is kept back if there is a result to keep (`finish`).
/// Threads: a Watch belongs to one call; `note` may be called from any thread.
#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace slapstick::python {

namespace nb = nanobind;

class Watch {
 public:
  /// @param progress  called with how much is done; or None
  explicit Watch(nb::object progress) : progress_(std::move(progress)), next_(Clock::now() + pause) {}

  /// What a function of the library is given to be stopped by.
  [[nodiscard]] const std::atomic<bool>* cancel() const { return &cancel_; }

  /// From within `run`, often. Cost: a look at the clock every 16 times. @returns false: the work shall end
  bool go_on(double done) {
    done_.store(done, std::memory_order_relaxed);
    if (++calls_ % 16 != 0 || Clock::now() < next_) return !cancel_.load(std::memory_order_relaxed);
    return look();
  }
  /// The same at every call: for work that takes its time between two of them.
  bool go_on_now(double done) {
    done_.store(done, std::memory_order_relaxed);
    return Clock::now() < next_ ? !cancel_.load(std::memory_order_relaxed) : look();
  }
  /// From within `run_aside`, by any thread.
  void note(double done) { done_.store(done, std::memory_order_relaxed); }

  template <class Work>
  void run(const Work& work) {
    const nb::gil_scoped_release release;
    work();
  }

  template <class Work>
  void run_aside(const Work& work) {
    std::exception_ptr failure;
    std::thread worker([&] {
      try {
        work();
      } catch (...) {
        failure = std::current_exception();
      }
      const std::scoped_lock lock(mutex_);
      ended_ = true;
      wake_.notify_one();
    });
    {
      const nb::gil_scoped_release release;
      while (!wait()) look();
      worker.join();
    }
    if (failure && !error_) std::rethrow_exception(failure);
  }

  /// After the work, with the GIL. @returns false if Ctrl-C ended it and something is complete
  /// @throws what a handler raised, except for a KeyboardInterrupt where the result is kept
  bool finish(bool keeps_result) {
    if (!error_) return true;
    if (keeps_result && error_->matches(PyExc_KeyboardInterrupt)) return false;
    throw nb::python_error(std::move(*error_));
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds pause{50};

  bool wait() {
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, pause, [&] { return ended_; });
  }

  /// Lets handlers run and shows progress. @returns false: the work shall end
  bool look() {
    if (cancel_) return false;
    const nb::gil_scoped_acquire acquire;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      if (!progress_.is_none()) progress_(done_.load(std::memory_order_relaxed));
    } catch (nb::python_error& error) {
      error_.emplace(std::move(error));
      cancel_ = true;
    }
    next_ = Clock::now() + pause;
    return !cancel_;
  }

  nb::object progress_;
  Clock::time_point next_;
  unsigned calls_ = 0;
  std::atomic<double> done_{0.0};
  std::atomic<bool> cancel_{false};
  std::optional<nb::python_error> error_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
};

}  // namespace slapstick::python
