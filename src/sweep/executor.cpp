/// Runs chains of cells on a pool of workers.
#include "sweep/executor.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include "base/floating_point.hpp"
#include "slapstick/base/error.hpp"
#include "sweep/fork_join.hpp"

namespace slapstick::sweep {
namespace {

struct Task {
  Cell cell;
  Starts start;
};

/// The cells that may begin, and which of them is next.
class Queue {
 public:
  Queue(const Chains& chains, const std::atomic<bool>* cancel) : chains_(chains), cancel_(cancel) {}

  /// Waits while a cell that runs may still hand on. @returns nothing when no cell is left, or none shall begin
  std::optional<Task> next() {
    std::unique_lock lock(mutex_);
    for (;;) {
      if (ended_ || (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed))) return std::nullopt;
      if (!ready_.empty()) return take();
      if (fresh_ < chains_.chains) return begin({{fresh_++, 0}, {}});
      if (may_hand_on_ == 0) return std::nullopt;
      changed_.wait(lock);
    }
  }

  /// The next cell of a chain may begin.
  void hand_on(const Cell& of, Starts start) {
    if (of.step + 1 == chains_.length) return;
    const std::scoped_lock lock(mutex_);
    --may_hand_on_;
    ready_.push_back({{of.chain, of.step + 1}, std::move(start)});
    changed_.notify_one();
  }

  void note_end() {
    const std::scoped_lock lock(mutex_);
    ++run_;
    changed_.notify_all();  // the last of a chain: who waits may go
  }

  /// No further cell begins.
  void end(std::exception_ptr why) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = std::move(why);
    ended_ = true;
    changed_.notify_all();
  }

  /// After all workers. @returns whether every cell was run
  bool finish() {
    if (failure_) std::rethrow_exception(failure_);
    return run_ == static_cast<long>(chains_.chains) * chains_.length;
  }

 private:
  Task take() {
    const auto lowest = std::min_element(ready_.begin(), ready_.end(),
                                         [](const Task& a, const Task& b) { return a.cell.chain < b.cell.chain; });
    Task task = std::move(*lowest);
    *lowest = std::move(ready_.back());
    ready_.pop_back();
    return begin(std::move(task));
  }

  Task begin(Task task) {
    if (task.cell.step + 1 < chains_.length) ++may_hand_on_;
    return task;
  }

  const Chains chains_;
  const std::atomic<bool>* cancel_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Task> ready_;  // as many as cells run, at most
  int fresh_ = 0;            // the first chain that has not begun
  int may_hand_on_ = 0;      // cells that run, are not the last of their chain and have not handed on
  long run_ = 0;
  bool ended_ = false;
  std::exception_ptr failure_;
};

void run_cell(Queue& queue, const Body& body, const Task& task) {
  bool handed = false;
  body(task.cell, task.start, [&](Starts next) {
    if (!std::exchange(handed, true)) queue.hand_on(task.cell, std::move(next));
  });
  if (!handed) queue.hand_on(task.cell, task.start);
  queue.note_end();
}

void work(Queue& queue, const Body& body) {
  const IeeeArithmetic ieee;
  try {
    while (const std::optional<Task> task = queue.next()) run_cell(queue, body, *task);
  } catch (...) {
    queue.end(std::current_exception());
  }
  fork_join::leave();
}

}  // namespace

bool run_chains(const Chains& chains, int threads, const Body& body, const std::atomic<bool>* cancel) {
  if (chains.chains < 0 || chains.length < 1 || threads < 0)
    throw InputError("run_chains: chains and threads must not be negative, and a chain has a cell");
  std::optional<tbb::global_control> more_than_there_are_cores;
  if (threads > 0)
    more_than_there_are_cores.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  Queue queue(chains, cancel);
  arena.execute([&] {
    const long cells = static_cast<long>(chains.chains) * chains.length;
    tbb::task_group workers;
    for (long k = std::min<long>(cells, arena.max_concurrency()); k > 0; --k) {
      auto task = workers.defer([&] {
        fork_join::enter();
        work(queue, body);
      });
      fork_join::fork();
      workers.run(std::move(task));
    }
    workers.wait();
  });
  fork_join::join();
  return queue.finish();
}

}  // namespace slapstick::sweep
