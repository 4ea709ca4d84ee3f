#pragma once
/// Work in batches, on any number of threads: batch k depends on the seed and k only, and tallies are added in the
/// order of k, so that a report does not depend on the threads.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "campaign.hpp"
#include "progress.hpp"

namespace campaign {

template <class Tally>
class Batches {
 public:
  Batches(const Options& options, long size, const char* unit)
      : options_(options),
        size_(size),
        count_((options.count + size - 1) / size),
        progress_(unit, static_cast<double>(options.count), options.progress) {}

  /// work(k, n) -> Tally: n things of batch k. Tally::add(const Tally&). What a batch throws ends the run.
  template <class Work>
  Tally run(Work work) {
    std::vector<std::thread> threads;
    for (int i = 1; i < options_.threads; ++i) threads.emplace_back([&] { labour(work); });
    labour(work);
    for (std::thread& thread : threads) thread.join();
    if (error_) std::rethrow_exception(error_);
    for (const auto& [k, tally] : waiting_) all_.add(tally);
    return std::move(all_);
  }

  [[nodiscard]] long done() const { return done_; }

 private:
  template <class Work>
  void labour(Work& work) {
    for (;;) {
      const long k = next_++;
      if (k >= count_ || options_.stopped() || error_) return;
      const long n = std::min(size_, options_.count - k * size_);
      try {
        Tally tally = work(k, n);
        const std::scoped_lock lock(mutex_);
        waiting_.emplace(k, std::move(tally));
        done_ += n;
        add_what_is_due();
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        error_ = std::current_exception();
      }
    }
  }

  void add_what_is_due() {
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == due_; first = waiting_.begin()) {
      all_.add(first->second);
      waiting_.erase(first);
      ++due_;
    }
    const auto now = std::chrono::steady_clock::now();
    if (::isatty(STDERR_FILENO) == 0 && now < show_) return;
    show_ = now + std::chrono::seconds(10);
    progress_.update(static_cast<double>(done_));
  }

  const Options& options_;
  long size_, count_;
  slapstick::app::Progress progress_;
  std::chrono::steady_clock::time_point show_{};
  std::mutex mutex_;
  std::atomic<long> next_{0};
  long due_ = 0, done_ = 0;
  std::map<long, Tally> waiting_;
  std::exception_ptr error_;
  Tally all_;
};

}  // namespace campaign
