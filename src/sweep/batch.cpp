/// Runs a batch on all threads, each with lanes of its own.
#include "slapstick/sweep/batch.hpp"

#include <algorithm>
#include <mutex>
#include <thread>

#include "batch/runner.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/sweep/parallel.hpp"

namespace slapstick::sweep {
namespace {

void check(const BatchProblem& problem) {
  const BatchPlan& plan = problem.plan;
  if (!problem.model_at || !problem.start_at) throw InputError("a batch needs model_at and start_at");
  if (plan.transient_periods < 0)
    throw InputError("transient_periods = " + std::to_string(plan.transient_periods) + " is negative");
  if (plan.periods < 1) throw InputError("periods = " + std::to_string(plan.periods) + " is not at least 1");
  if (plan.points < 0 || plan.points > plan.periods)
    throw InputError("points = " + std::to_string(plan.points) +
                     " is not between 0 and periods = " + std::to_string(plan.periods));
  if (problem.threads < 0) throw InputError("threads = " + std::to_string(problem.threads) + " is negative");
}

}  // namespace

Batch run_batch(const BatchProblem& problem) {
  check(problem);
  const batch::Kernel& kernel = batch::kernel(problem.lanes);
  Batch batch{{}, kernel.name, kernel.width};
  if (!problem.take) batch.runs.resize(problem.count);
  std::atomic<std::size_t> next{0};
  std::mutex adding;
  batch::Queue queue;
  queue.next = [&]() -> std::optional<std::size_t> {
    const std::size_t index = next.fetch_add(1, std::memory_order_relaxed);
    return index < problem.count ? std::optional(index) : std::nullopt;
  };
  queue.model_at = problem.model_at;
  queue.start_at = [&](std::size_t i, const Model&) { return problem.start_at(i); };
  queue.take = problem.take;
  if (!queue.take) queue.take = [&](std::size_t i, BatchRun run) { batch.runs[i] = std::move(run); };
  queue.plan = problem.plan;
  queue.cancel = problem.cancel;
  const auto cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
  const int threads = problem.threads > 0 ? problem.threads : cores;
  for_each_index(threads, threads, [&](int) {
    batch::Runner runner(queue, kernel);
    runner.run();
    const std::scoped_lock lock(adding);
    batch.steps += runner.work().steps;
    batch.lane_steps += runner.work().lane_steps;
    batch.halved += runner.work().halved;
  });
  batch.complete = problem.cancel == nullptr || !problem.cancel->load(std::memory_order_relaxed);
  return batch;
}

}  // namespace slapstick::sweep
