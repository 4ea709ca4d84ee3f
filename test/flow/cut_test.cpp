/// Where a run is cut makes no difference: advance(end) at places made to be hard, also at an event, and on. Random
/// ones are in ../property.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Leaves out the bounces just before a chatter's limit: a cut among them spends one proof, and one bounce more is
/// listed.
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
  // Up to a chatter inside which a cut fell every bit is the same.
  bool same_bits = true;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (expected[i].kind == EventKind::chatter && found[i].time != expected[i].time) same_bits = false;
    if (same_bits) {
      EXPECT_EQ(found[i].time, expected[i].time) << what << " event " << i;
      EXPECT_EQ(found[i].w, expected[i].w) << what << " event " << i;
    }
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

/// A touch once became an impact of the speed that the cut's rounding gave it.
TEST(Cut, JustBeforeAnExactTouchLeavesItATouch) {
  const System system(oracle::oscillator_with_stop(1.0));  // x = sin t against a wall at 1
  for (int k = 4; k <= 52; ++k) {
    const double touch = 0.25 / system.period() * 2 * std::numbers::pi;
    const std::vector<Instant> cuts = {Instant{}.plus(touch - std::ldexp(1.0, -k)), Instant{}.plus(touch),
                                       Instant{}.plus(touch + std::ldexp(1.0, -k))};
    EXPECT_EQ(testing::kinds(run_with_cuts(system, {0.0, 1.0}, cuts, Instant{}.plus(6.0 / system.period()))), "graze")
        << k;
  }
}

TEST(Cut, StateAtACutIsTheStateOnTheWay) {
  const System system(oracle::vibro_impact(1.5));
  Motion whole(system, {-0.5, 0, 0, 0}), cut = whole;
  State on_the_way(4);
  for (int i = 0; i < 200; ++i) {
    const Instant start = whole.segment().start;
    if (whole.advance({100, 0.0}) != Outcome::event) break;
    const Motion::Segment segment = whole.segment();
    const double s = 0.37 * segment.duration;
    whole.sample(s, on_the_way);
    ASSERT_EQ(cut.advance(segment.start.plus(s / system.period())),
              segment.duration > 0.0 ? Outcome::reached_end : Outcome::event)
        << start.period;
    for (int j = 0; j < 4 && segment.duration > 0.0; ++j) EXPECT_NEAR(cut.state()[j], on_the_way[j], 2e-15) << i;
    while (cut.time() < whole.time() && cut.advance({100, 0.0}) != Outcome::event) {
    }
    EXPECT_EQ(cut.state(), whole.state()) << i;
  }
}

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
