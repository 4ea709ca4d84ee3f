/// Where a run is cut makes no difference: advance(end) anywhere, also at an event, and on.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "flow/runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

/// The events up to `end` with stops at the given instants.
std::vector<Event> run_with_cuts(const System& system, const State& start, const std::vector<Instant>& cuts,
                                 Instant end) {
  Motion motion(system, start);
  std::vector<Event> events;
  for (const Instant& cut : cuts)
    while (motion.advance(cut) == Outcome::event) events.push_back(motion.event());
  while (motion.advance(end) == Outcome::event) events.push_back(motion.event());
  return events;
}

/// Leaves out the bounces just before a chatter's limit: a cut among them spends one proof, and one bounce more is listed.
std::vector<Event> without_last_bounces(std::vector<Event> events) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].kind != EventKind::chatter) continue;
    std::size_t first = i;
    while (first > 0 && events[i].time.since(events[first - 1].time) < 1e-6) --first;
    events.erase(events.begin() + static_cast<long>(first), events.begin() + static_cast<long>(i));
    i = first;
  }
  return events;
}

void expect_same(const System& system, const std::vector<Event>& all_found, const std::vector<Event>& all_expected,
                 const std::string& what) {
  const std::vector<Event> found = without_last_bounces(all_found), expected = without_last_bounces(all_expected);
  ASSERT_EQ(testing::kinds(found), testing::kinds(expected)) << what;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].time.since(expected[i].time) * system.period(), 0.0, 1e-12) << what << " event " << i;
    EXPECT_EQ(found[i].contact, expected[i].contact) << what << " event " << i;
  }
}

class Cut : public ::testing::TestWithParam<double> {
 protected:
  System system{oracle::vibro_impact(GetParam())};
  State start{-0.5, 0, 0, 0};
  Instant end{6, 0.25};
  std::vector<Event> whole = run_with_cuts(system, start, {}, end);
};

TEST_P(Cut, IntoEqualStepsGivesTheSameEvents) {
  for (const int steps : {7, 64, 1000}) {
    std::vector<Instant> cuts;
    for (int i = 1; i < 6 * steps; ++i) cuts.push_back(Instant{}.plus(static_cast<double>(i) / steps));
    expect_same(system, run_with_cuts(system, start, cuts, end), whole, std::to_string(steps) + " steps");
  }
}

TEST_P(Cut, AtRandomGivesTheSameEvents) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 30; ++k) {
    std::vector<Instant> cuts;
    for (int i = 0; i < 20; ++i) cuts.push_back(Instant{}.plus(std::uniform_real_distribution<double>(0, 6)(random)));
    std::ranges::sort(cuts);
    expect_same(system, run_with_cuts(system, start, cuts, end), whole, "cut " + std::to_string(k));
  }
}

TEST_P(Cut, ExactlyAtAnEventOrAnUlpBesideItGivesTheSameEvents) {
  for (const double shift : {0.0, -0x1p-53, 0x1p-52, -1e-12, 1e-12}) {
    for (std::size_t i = 0; i < whole.size(); i += whole.size() / 40 + 1) {
      const Instant cut = whole[i].time.plus(shift);
      expect_same(system, run_with_cuts(system, start, {cut}, end), whole,
                  "cut " + std::to_string(shift) + " beside event " + std::to_string(i));
    }
  }
}

TEST_P(Cut, AtTheSameInstantTwiceGivesTheSameEvents) {
  const Instant cut{2, 0.375};
  expect_same(system, run_with_cuts(system, start, {cut, cut, cut, Instant{1, 0.5}}, end), whole, "twice");
}

TEST_P(Cut, EventExactlyAtTheEndIsReported) {
  for (std::size_t i = 0; i < whole.size(); i += whole.size() / 40 + 1) {
    const std::vector<Event> events = run_with_cuts(system, start, {}, whole[i].time.plus(1e-13));
    ASSERT_GE(events.size(), i + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Omega, Cut, ::testing::Values(0.552, 1.5, 2.2, 4.9));

TEST(Cut, InsideAStickOnABeltAndBetweenStickAndRelease) {
  Model m = oracle::friction_oscillator(1.5, 1.0);
  m.frictions[0].belt_speed = 0.5;
  const System system(m);
  const Instant end{60, 0.0};  // no forcing: a period is one time unit
  const auto whole = run_with_cuts(system, {0, 0}, {}, end);
  std::vector<Instant> cuts;
  for (int i = 1; i < 600; ++i) cuts.push_back(Instant{}.plus(0.1 * i));
  expect_same(system, run_with_cuts(system, {0, 0}, cuts, end), whole, "belt");
  for (const Event& event : whole)
    expect_same(system, run_with_cuts(system, {0, 0}, {event.time}, end), whole, "belt, at " + testing::kinds({event}));
}

}  // namespace
}  // namespace slapstick
