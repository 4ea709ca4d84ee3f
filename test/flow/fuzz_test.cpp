/// Random models against the oracle: the same kinds of events in the same order, at the same times.
/// SLAPSTICK_CAMPAIGN=N compares N times as many models.
#include <gtest/gtest.h>

#include <algorithm>

#include "flow/oracle_runs.hpp"
#include "property/property.hpp"

namespace slapstick {
namespace {

using testing::Seen;

/// Leaves out everything from the first graze on: there the answer may depend on a rounding.
void until_graze(std::vector<Seen>& events) {
  events.erase(std::ranges::find(events, std::string("graze"), &Seen::kind), events.end());
}

/// Leaves out everything from a chatter on that the engine cannot prove: a coupled friction pair that comes to rest in
/// each of its flights (oracle_system_test: ThirdBody). Such bounces are run one by one until their times no longer
/// differ; those of a chatter that is proven are summed long before. True if there was one.
bool until_unproven_chatter(std::vector<Seen>& events) {
  for (std::size_t i = 1; i < events.size(); ++i) {
    if (events[i].kind == "chatter" || events[i].time - events[i - 1].time > 1e-13) continue;
    events.resize(i > 8 ? i - 8 : 0);
    return true;
  }
  return false;
}

TEST(Fuzz, RandomModelsHaveTheOraclesEvents) {
  const test::Shape shape{.most_coordinates = 3,
                          .most_stops = 1,
                          .most_frictions = 1,
                          .most_compliant = 0,
                          .most_restitution = 1.0,
                          .least_gap = 1e-3,
                          .at_rest = false};
  long compared = 0, events = 0, flagged = 0, unproven = 0;
  double worst = 0.0;
  test::expect_of_all(shape, 200, [&](const test::Machine& machine) -> std::string {
    const System system(machine.model);
    const double time = 3 * system.period();
    Motion motion(system, machine.start);
    std::vector<Seen> engine = testing::engine_events(motion, time, 400);
    oracle::Oracle oracle(machine.model, machine.start);
    std::vector<Seen> exact =
        testing::oracle_events(oracle, engine.size() < 400 ? time : engine.back().time * (1 + 1e-12));
    const std::size_t before = engine.size();
    until_graze(engine);
    unproven += until_unproven_chatter(engine) ? 1 : 0;
    const bool cut = engine.size() < before;
    flagged += cut ? 1 : 0;
    const testing::Comparison c = testing::compare(engine, exact);
    worst = std::max(worst, c.worst / time);
    events += static_cast<long>(c.events);
    ++compared;
    const bool rest_is_missing = (cut || before >= 400) && c.mismatch.starts_with("missing");
    if (!c.mismatch.empty() && !rest_is_missing) return c.mismatch;
    return c.worst <= 1e-9 * time ? "" : "an event is late by " + std::to_string(c.worst / time) + " of the time";
  });
  std::printf(
      "%ld models, %ld events, %ld cut short (%ld by a chatter without proof), largest error %.1e of the time\n",
      compared, events, flagged, unproven, worst);
  EXPECT_LE(flagged, compared / 20);
  EXPECT_LE(unproven, compared / 50);
}

}  // namespace
}  // namespace slapstick
