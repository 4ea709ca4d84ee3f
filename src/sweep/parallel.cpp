/// Runs a loop over an index on all cores.
#include "slapstick/sweep/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "slapstick/base/error.hpp"
#include "base/floating_point.hpp"
#include "sweep/fork_join.hpp"

namespace slapstick::sweep {

bool for_each_index(int count, int threads, const std::function<void(int)>& body, const std::atomic<bool>* cancel) {
  if (count < 0 || threads < 0) throw InputError("for_each_index: count and threads must not be negative");
  std::optional<tbb::global_control> more_than_there_are_cores;
  if (threads > 0)
    more_than_there_are_cores.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  std::atomic<int> next{0}, called{0};
  // Each worker takes the lowest index that is left: a loop over long and short work ends evenly, and begins in order.
  const auto worker = [&] {
    fork_join::enter();
    const IeeeArithmetic ieee;
    try {
      while (cancel == nullptr || !cancel->load(std::memory_order_relaxed)) {
        const int i = next.fetch_add(1, std::memory_order_relaxed);
        if (i >= count) break;
        body(i);
        called.fetch_add(1, std::memory_order_relaxed);
      }
    } catch (...) {
      next.store(count, std::memory_order_relaxed);  // the others stop after what they do
      fork_join::leave();
      throw;
    }
    fork_join::leave();
  };
  arena.execute([&] {
    tbb::task_group workers;
    for (int k = std::min(count, arena.max_concurrency()); k > 0; --k) {
      auto task = workers.defer(worker);
      fork_join::fork();
      workers.run(std::move(task));
    }
    workers.wait();
  });
  fork_join::join();
  return called.load() == count;
}

}  // namespace slapstick::sweep
