#pragma once
/// Many trajectories at once: every start, every parameter value is a run, and up to eight runs share the registers
/// of a core.
///
///     sweep::BatchProblem problem;
///     problem.count = starts.size();
///     problem.model_at = [&](std::size_t) { return model; };
///     problem.start_at = [&](std::size_t i) { return starts[i]; };
///     problem.plan = {.transient_periods = 200, .periods = 100, .points = 10};
///     const sweep::Batch batch = sweep::run_batch(problem);       // batch.runs[i].impacts, .points, .end
///
/// With `.exponent = true` in the plan a tangent vector follows each run, for less than the cost of a second run.
///
/// Lanes run models of up to four coordinates and four contacts: stops with a constant restitution above zero,
/// friction contacts, compliant stops that are not bounded; harmonic forces; contacts that do not depend on each
/// other. What a lane cannot decide for certain (a tie, a graze, a complete chatter) a Motion decides, event by
/// event. Any other model runs on a Motion from its start, by the same call.
///
/// The bits of a run depend on its model and start alone: not on the number of lanes, on what runs beside it, on the
/// order, on threads or on the processor. These bits are not those of a Motion: both kernels round differently, so that
/// a chaotic motion parts from a Motion's after some periods. Source: docs/developers/performance.md;
/// docs/developers/proofs.md, section 11, for what is proven.
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "slapstick/batch/run.hpp"

namespace slapstick::sweep {

struct BatchProblem {
  std::size_t count = 0;
  std::function<Model(std::size_t)> model_at;  ///< of a run; called from several threads at once
  std::function<State(std::size_t)> start_at;  ///< likewise, 2 n numbers; the start's instant is phase 0 of period 0
  BatchPlan plan;
  int threads = 0;  ///< 0: all
  int lanes = 0;    ///< 1, 4 or 8; 0: as many as the processor has
  /// If set, it is given each run as soon as it ends, from any of the threads, in no order; `Batch::runs` stays
  /// empty then.
  std::function<void(std::size_t, BatchRun&&)> take;
  const std::atomic<bool>* cancel = nullptr;  ///< set it and the batch returns soon with the runs that are done
};

struct Batch {
  std::vector<BatchRun> runs;
  std::string kernel;    ///< that of the lanes: "scalar", "sse4", "avx2", "avx512"
  int lanes = 1;         ///< its width
  long steps = 0;        ///< work: steps of all lanes together ..
  long lane_steps = 0;   ///< .. of lanes that had a run ..
  long halved = 0;       ///< .. and those of them that had to be made again with half the window
  bool complete = true;  ///< false if cancelled
};

/// Runs the batch. A run that fails says why and ends no other.
/// @throws InputError for a meaningless problem, naming the field
/// Cost: some tenths of a microsecond a period and run for the paper's system; some microseconds for each run's
/// model.
[[nodiscard]] Batch run_batch(const BatchProblem& problem);

}  // namespace slapstick::sweep
