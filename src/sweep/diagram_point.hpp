#pragma once
/// What happens at one value of a diagram: transient, then recording. No threads here.
#include <memory>
#include <optional>

#include "slapstick/section/impact_section.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "sweep/executor.hpp"

namespace slapstick::sweep {

/// A motion after its transient; the System lives as long as the motion needs it.
struct Settled {
  std::shared_ptr<const System> system;
  ImpactSection section;
};

/// Builds the model at `point.parameter`, starts at `carried` if that is given and fits, else at the problem's start
/// (then with a note if a state was carried), and runs the transient.
/// @returns nothing after a failure, which is written into `point`, or when cancelled
std::optional<Settled> settle(const DiagramProblem& problem, const Carried& carried, DiagramPoint& point);

/// The transients of points that begin at the problem's own start, in the lanes of a batch, up to the last few
/// periods: these show the impact before the first that is recorded. Points that no lane can run, or that fail
/// there, are left as they are.
void run_in_lanes(const DiagramProblem& problem, std::span<const DiagramPoint> points, std::span<Carried> begun);

/// Where the next value of a chain may start.
Carried carry_on(const Settled& settled);

/// Records impacts until there are enough or `most_periods` have passed, and marks the point done (unless cancelled).
void record(const DiagramProblem& problem, Settled settled, DiagramPoint& point);

/// Moves x_a of each stop by rounding errors (at most 4 units in the last place of its terms) so that
/// x_a - x_b <= clearance. A state in contact that went through the user's coordinates may lie outside by that much.
void undo_rounding(const Model& model, State& state);

[[nodiscard]] inline bool cancelled(const DiagramProblem& problem) {
  return problem.cancel != nullptr && problem.cancel->load(std::memory_order_relaxed);
}

}  // namespace slapstick::sweep
