/// Batches of random machines: the events of a Motion wherever these are stable.
#include <gtest/gtest.h>

#include <iostream>

#include "batch/same_events.hpp"
#include "property/machine.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

struct Count {
  std::size_t in_lanes = 0, compared = 0, unstable = 0;
  long lane_events = 0, motion_events = 0;
};

/// @returns false if a Motion itself fails
bool events_at(const test::Machine& machine, int periods, double cap, std::vector<Event>& events) {
  try {
    events = events_of(machine.model, machine.start, periods, cap);
    return true;
  } catch (const NumericalError&) {
    return false;
  }
}

/// A run whose events differ must be of a motion whose own events depend on its window caps; such runs are counted.
void compare(const test::Machine& machine, const BatchRun& run, int periods, Count& count) {
  constexpr double tolerance = 1e-9;
  std::vector<Event> expected, narrow, narrower;
  if (!events_at(machine, periods, INFINITY, expected)) return;
  ++count.compared;
  const std::size_t agreed = agreeing(expected, run.events, tolerance);
  if (agreed == expected.size() && agreed == run.events.size()) return;
  ++count.unstable;
  if (!events_at(machine, periods, 0.03, narrow) || !events_at(machine, periods, 0.11, narrower)) return;
  const bool stable = agreeing(expected, narrow, 1e-3 * tolerance) == expected.size() &&
                      agreeing(expected, narrower, 1e-3 * tolerance) == expected.size();
  EXPECT_FALSE(stable) << "event " << agreed << ": " << (agreed < expected.size() ? text_of(expected[agreed]) : "none")
                       << " | " << (agreed < run.events.size() ? text_of(run.events[agreed]) : "none") << " "
                       << run.failure << "\n"
                       << machine;
}

TEST(BatchMachines, HaveTheEventsOfAMotion) {
  constexpr int periods = 12;
  const test::Shape shape{.most_coordinates = 4, .loops = false};
  std::vector<test::Machine> machines;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) machines.push_back(test::random_machine(seed, shape));
  sweep::BatchProblem problem;
  problem.count = machines.size();
  problem.model_at = [&](std::size_t i) { return machines[i].model; };
  problem.start_at = [&](std::size_t i) { return machines[i].start; };
  problem.plan = {.periods = periods, .events = true};
  const sweep::Batch batch = run_batch(problem);
  Count count;
  for (std::size_t i = 0; i < machines.size(); ++i) {
    const BatchRun& run = batch.runs[i];
    if (!run.in_lanes) continue;
    ++count.in_lanes;
    count.lane_events += run.lane_events;
    count.motion_events += run.motion_events;
    compare(machines[i], run, periods, count);
  }
  RecordProperty("in_lanes", static_cast<int>(count.in_lanes));
  std::cout << count.in_lanes << " in lanes, " << count.compared << " compared, " << count.unstable << " not stable, "
            << count.motion_events << " events by motions, " << count.lane_events << " in lanes\n";
  EXPECT_GE(count.in_lanes, machines.size() / 4);
  EXPECT_EQ(count.compared, count.in_lanes);
  EXPECT_LE(count.unstable, count.compared / 10);
  EXPECT_GT(count.lane_events, count.motion_events);
}

}  // namespace
}  // namespace slapstick
