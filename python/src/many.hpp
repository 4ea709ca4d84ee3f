#pragma once
/// Independent work on all cores, keyed by index.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "watch.hpp"

namespace slapstick::python {

/// Calls use(0) .. use(count - 1), each once, on so many threads (0: all cores), until the watch ends it.
/// @throws the first exception of `use`, after all threads have ended
template <class Use>
void for_each_index(std::size_t count, int threads, Watch& watch, const Use& use) {
  const std::size_t cores = threads > 0 ? static_cast<std::size_t>(threads) : std::thread::hardware_concurrency();
  std::atomic<std::size_t> next{0}, done{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !watch.cancel()->load(); i = next++) {
      try {
        use(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
      watch.note(static_cast<double>(++done));
    }
  };
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < std::min(std::max<std::size_t>(cores, 1), count); ++k) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace slapstick::python
