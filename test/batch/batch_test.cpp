/// Batches: the events of a Motion, the same bits for all widths and neighbours, cuts that change nothing, doubt that
/// goes to a Motion.
#include "slapstick/sweep/batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <ctime>
#include <numbers>
#include <random>
#include <thread>

#include "batch/same_events.hpp"
#include "model/twins.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

using sweep::Batch;
using sweep::BatchProblem;
using sweep::run_batch;

struct Pixel {
  Model model;
  State start;
};

BatchProblem problem_of(const std::vector<Pixel>& pixels, const BatchPlan& plan) {
  BatchProblem problem;
  problem.count = pixels.size();
  problem.model_at = [&pixels](std::size_t i) { return pixels[i].model; };
  problem.start_at = [&pixels](std::size_t i) { return pixels[i].start; };
  problem.plan = plan;
  return problem;
}

/// The paper's system at random frequencies and frictions.
std::vector<Pixel> pixels(std::size_t count, double least_omega, double most_omega) {
  static const ModelDefinition definition = load_model("vibro-impact");
  std::mt19937_64 random(25);
  const auto between = [&](double a, double b) { return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Pixel> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double omega = between(least_omega, most_omega), friction = between(0.05, 0.3);
    all.push_back({definition.build({{"omega", omega}, {"friction", friction}}), {-0.5, 0.0, between(-0.1, 0.1), 0.0}});
  }
  return all;
}

bool same_bits(const BatchRun& a, const BatchRun& b) {
  const auto same = [](const std::vector<double>& x, const std::vector<double>& y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), 8 * x.size()) == 0);
  };
  if (a.events.size() != b.events.size() || a.impacts != b.impacts || a.point_impacts != b.point_impacts) return false;
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    const Event &x = a.events[i], &y = b.events[i];
    if (x.kind != y.kind || x.contact != y.contact || x.time != y.time || x.w != y.w) return false;
  }
  return same({a.speeds}, {b.speeds}) && same(a.end, b.end) && same(a.points, b.points);
}

/// Where a Motion does not depend on its own windows, to a thousandth of the tolerance, a batch has the same events.
void expect_the_events_of_a_motion(const std::vector<Pixel>& all, int periods, std::size_t most_unstable) {
  constexpr double tolerance = 1e-9;
  const Batch batch = run_batch(problem_of(all, {.periods = periods, .events = true}));
  std::size_t unstable = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(batch.runs[i].failure, "");
    const std::vector<Event> expected = events_of(all[i].model, all[i].start, periods), &found = batch.runs[i].events;
    const std::size_t agreed = agreeing(expected, found, tolerance);
    if (agreed == expected.size() && agreed == found.size()) continue;
    const bool stable =
        agreeing(expected, events_of(all[i].model, all[i].start, periods, 0.03), 1e-3 * tolerance) == expected.size() &&
        agreeing(expected, events_of(all[i].model, all[i].start, periods, 0.11), 1e-3 * tolerance) == expected.size();
    EXPECT_FALSE(stable) << "run " << i << " of " << all[i].model.name << ", event " << agreed << ": "
                         << (agreed < expected.size() ? text_of(expected[agreed]) : "none") << " | "
                         << (agreed < found.size() ? text_of(found[agreed]) : "none");
    ++unstable;
  }
  EXPECT_LE(unstable, most_unstable);
}

TEST(Batch, HasTheEventsOfAMotion) { expect_the_events_of_a_motion(pixels(120, 1.0, 6.0), 60, 12); }

TEST(Batch, HasTheEventsOfAMotionThatChatters) { expect_the_events_of_a_motion(pixels(24, 0.4, 1.0), 20, 4); }

TEST(Batch, HasTheEventsOfTheBuiltInModelsThatLanesCanRun) {
  std::size_t in_lanes = 0;
  for (const std::string& name : builtin_models()) {
    const ModelDefinition definition = load_model(name);
    const std::vector<Pixel> one = {{definition.build(), definition.start()}};
    const Batch batch = run_batch(problem_of(one, {}));
    if (!batch.runs[0].in_lanes) continue;
    ++in_lanes;
    expect_the_events_of_a_motion(one, 40, 0);
  }
  EXPECT_GE(in_lanes, 10U);
}

TEST(Batch, HasTheSameBitsForEveryWidthOrderAndNumberOfThreads) {
  const std::vector<Pixel> all = pixels(50, 0.5, 6.0);
  const BatchPlan plan{.transient_periods = 5, .periods = 25, .points = 7, .events = true};
  const Batch reference = run_batch([&] {
    BatchProblem problem = problem_of(all, plan);
    problem.lanes = 1;
    problem.threads = 1;
    return problem;
  }());
  for (const int lanes : {1, 4, 8})
    for (const int threads : {1, 3})
      for (const std::size_t step : {1U, 7U}) {
        BatchProblem problem = problem_of(all, plan);
        problem.lanes = lanes;
        problem.threads = threads;
        problem.model_at = [&](std::size_t i) { return all[i * step % all.size()].model; };
        problem.start_at = [&](std::size_t i) { return all[i * step % all.size()].start; };
        const Batch batch = run_batch(problem);
        for (std::size_t i = 0; i < all.size(); ++i)
          ASSERT_TRUE(same_bits(batch.runs[i], reference.runs[i * step % all.size()])) << lanes << " lanes, run " << i;
      }
}

/// A damped compliant stop has one slot open and two engaged: runs that end and begin at different instants leave lanes
/// with the words of either.
TEST(Batch, LanesThatGainAndLoseSlotsLeaveTheirNeighboursAlone) {
  const ModelDefinition bilinear = load_model("bilinear-oscillator");
  std::mt19937_64 random(27);
  const auto between = [&](double a, double b) { return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Pixel> all;
  for (int i = 0; i < 200; ++i) {
    const Model model = bilinear.build(
        {{"omega", between(0.3, 5.0)}, {"clearance", between(0.1, 1.5)}, {"contact_damping", between(0.1, 2.0)}});
    all.push_back({model, {between(-1.0, 0.0), between(-1.0, 1.0)}});
  }
  BatchProblem problem = problem_of(all, {.periods = 3, .events = true});
  problem.threads = 1;
  problem.lanes = 1;
  const Batch alone = run_batch(problem);
  problem.lanes = 8;
  const Batch together = run_batch(problem);
  long events = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_TRUE(same_bits(alone.runs[i], together.runs[i])) << "run " << i;
    EXPECT_EQ(alone.runs[i].lane_events, together.runs[i].lane_events) << "run " << i;
    events += alone.runs[i].lane_events;
  }
  EXPECT_GT(events, 400);
}

TEST(Batch, CutsChangeNothing) {
  const std::vector<Pixel> all = pixels(16, 0.6, 6.0);
  const Batch whole = run_batch(problem_of(all, {.periods = 40})),
              cut = run_batch(problem_of(all, {.periods = 40, .points = 40})),
              late = run_batch(problem_of(all, {.transient_periods = 39, .periods = 1}));
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(whole.runs[i].end, cut.runs[i].end);
    EXPECT_EQ(whole.runs[i].end, late.runs[i].end);
    EXPECT_EQ(whole.runs[i].speeds, cut.runs[i].speeds);
    long sum = 0;
    for (const long impacts : cut.runs[i].point_impacts) sum += impacts;
    EXPECT_EQ(sum, whole.runs[i].impacts);
    EXPECT_EQ(cut.runs[i].point_impacts.back(), late.runs[i].impacts);
  }
}

TEST(Batch, PointsAreTheStatesOfAMotion) {
  const std::vector<Pixel> all = pixels(30, 1.0, 6.0);
  const Batch batch = run_batch(problem_of(all, {.transient_periods = 2, .periods = 8, .points = 4}));
  for (std::size_t i = 0; i < all.size(); ++i) {
    Motion motion(System(all[i].model), all[i].start);
    for (int k = 0; k < 4; ++k) {
      while (motion.advance({7 + k, 0.0}) == Outcome::event) {
      }
      const State state = motion.state();
      for (std::size_t j = 0; j < 4; ++j)
        EXPECT_NEAR(batch.runs[i].points[4 * static_cast<std::size_t>(k) + j], state[j], 1e-10) << i;
    }
    EXPECT_TRUE(std::equal(batch.runs[i].end.begin(), batch.runs[i].end.end(), batch.runs[i].points.end() - 4));
  }
}

/// A ball of restitution r that falls from a height h: impact k at sqrt(2 h / g) (1 + 2 (r + r^2 + .. + r^k)), at speed
/// r^k sqrt(2 g h).
TEST(Batch, ABallFallsByTheClosedForm) {
  const ModelDefinition definition = load_model("bouncing-ball");
  const Model model = definition.build();
  const double g = -model.forces.at(0).amplitude / model.coordinates.at(0).mass, h = 0.7,
               r = model.stops.at(0).restitution;
  const std::vector<Pixel> one = {{model, {h, 0.0}}};
  const Batch batch = run_batch(problem_of(one, {.periods = 4, .events = true}));
  ASSERT_TRUE(batch.runs[0].in_lanes);
  double time = std::sqrt(2.0 * h / g), speed = std::sqrt(2.0 * g * h);
  for (int k = 0; k < 12; ++k) {
    const Event& event = batch.runs[0].events.at(static_cast<std::size_t>(k));
    EXPECT_EQ(event.kind, EventKind::impact);
    EXPECT_NEAR(event.time.seconds(model.forcing_period()), time, 1e-13);
    EXPECT_NEAR(event.w, speed, 1e-13);
    speed *= r;
    time += 2.0 * speed / g;
  }
}

/// A start that touches its stop at rest, and one that hits it at once: no lane is asked.
TEST(Batch, AStartInContactIsAMotions) {
  const ModelDefinition definition = load_model("vibro-impact");
  const Model model = definition.build({{"omega", 2.2}});
  const std::vector<Pixel> all = {
      {model, {0.0, 0.0, 0.0, 0.0}}, {model, {0.1, 0.3, 0.1, 0.0}}, {model, {-0.5, 0.0, 0.0, 0.0}}};
  expect_the_events_of_a_motion(all, 20, 0);
  const Batch batch = run_batch(problem_of(all, {.periods = 20}));
  EXPECT_GE(batch.runs[0].motion_events, 1);
  EXPECT_GE(batch.runs[1].motion_events, 1);
  EXPECT_EQ(batch.runs[2].motion_events, 0);
}

/// A pair is pressed together, and two friction contacts hold its lower body. Where they let go the pair stays closed:
/// a mode in which the bodies would pass through each other has no gap among its slots, and takes load off the
/// friction.
TEST(Batch, ABodyThatIsLetGoPassesThroughNoOther) {
  Model model;
  model.name = "pressed";
  model.coordinates = {{"upper", 0.25}, {"lower", 1.0}};
  model.springs = {{1, ground, 1.0}};
  model.forces = {{0, 0, -0.75}, {1, 1, 2.0}};
  model.stops = {{"stop", 1, 0, 0.0, 0.5}};
  model.frictions = {
      {"within", 1, 0, 0.0, 0.15, 0.15}, {"first", 1, ground, 0.0, 0.75, 0.7}, {"second", 1, ground, 0.0, 0.3, 0.3}};
  model.omega = 0.5;
  const std::vector<Pixel> one = {{model, {0.0, 0.0, 0.0, 0.0}}};
  expect_the_events_of_a_motion(one, 10, 0);
  const Batch batch = run_batch(problem_of(one, {.periods = 10, .events = true}));
  ASSERT_TRUE(batch.runs[0].in_lanes);
  for (const Event& event : batch.runs[0].events)
    EXPECT_FALSE(event.kind == EventKind::release && event.contact < 2) << text_of(event);
}

/// A tie is a motion's to decide, and both stops have their rows.
TEST(Batch, TellsOfBothBuffersThatAreMetAtOnce) {
  Model model = test::twins();
  model.compliant_stops = {{"l", 0, ground, 0.3, 40.0, 2.0}, {"r", 1, ground, 0.3, 40.0, 2.0}};
  const std::vector<Pixel> one = {{model, {-0.2, 0.1, -0.2, 0.1}}};
  expect_the_events_of_a_motion(one, 20, 0);
  const Batch batch = run_batch(problem_of(one, {.periods = 20, .events = true}));
  ASSERT_TRUE(batch.runs[0].in_lanes);
  int left = 0, right = 0;
  for (const Event& event : batch.runs[0].events)
    if (event.kind == EventKind::engage) ++(event.contact == 0 ? left : right);
  EXPECT_GE(left, 15);
  EXPECT_EQ(left, right);
}

TEST(Batch, AModelThatNoLaneCanRunHasTheBitsOfAMotion) {
  for (const std::string name : {"two-sided-rattle", "falling-friction", "spool"}) {
    const ModelDefinition definition = load_model(name);
    const std::vector<Pixel> one = {{definition.build(), definition.start()}};
    const Batch batch = run_batch(problem_of(one, {.periods = 30, .events = true}));
    EXPECT_FALSE(batch.runs[0].in_lanes);
    const std::vector<Event> expected = events_of(one[0].model, one[0].start, 30);
    EXPECT_EQ(agreeing(expected, batch.runs[0].events, 0.0), expected.size()) << name;
    EXPECT_EQ(batch.runs[0].motion_events, static_cast<long>(expected.size()));
  }
}

TEST(Batch, ModelsOfSeveralShapesShareABatch) {
  std::vector<Pixel> all;
  for (const std::string name :
       {"vibro-impact", "bouncing-ball", "two-sided-rattle", "coulomb-oscillator", "vibro-impact", "bouncing-ball"}) {
    const ModelDefinition definition = load_model(name);
    all.push_back({definition.build(), definition.start()});
  }
  const Batch together = run_batch(problem_of(all, {.periods = 10}));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<Pixel> one = {all[i]};
    const Batch alone = run_batch(problem_of(one, {.periods = 10}));
    EXPECT_TRUE(same_bits(alone.runs[0], together.runs[i])) << i;
    EXPECT_TRUE(together.runs[i].done);
  }
}

TEST(Batch, ARunThatFailsSaysWhyAndEndsNoOther) {
  std::vector<Pixel> all = pixels(9, 1.0, 6.0);
  all[4].start = {1.0, 0.0, 0.0, 0.0};  // beyond the stop
  const Batch batch = run_batch(problem_of(all, {.periods = 3}));
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(batch.runs[i].done, i != 4);
  EXPECT_NE(batch.runs[4].failure.find("stop"), std::string::npos);
}

TEST(Batch, AMeaninglessProblemIsRefusedByName) {
  const std::vector<Pixel> all = pixels(1, 1.0, 6.0);
  const auto why = [&](const BatchPlan& plan, int lanes) {
    BatchProblem problem = problem_of(all, plan);
    problem.lanes = lanes;
    try {
      (void)run_batch(problem);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(why({.transient_periods = -1}, 0).find("transient_periods = -1"), std::string::npos);
  EXPECT_NE(why({.periods = 0}, 0).find("periods = 0"), std::string::npos);
  EXPECT_NE(why({.periods = 3, .points = 4}, 0).find("points = 4"), std::string::npos);
  EXPECT_NE(why({}, 3).find("1, 4 or 8"), std::string::npos);
}

/// Sets it once the process has worked for some time: of the processor, which another program may have.
void cancel_at_work(std::atomic<bool>& cancel) {
  const std::clock_t begin = std::clock();
  while (std::clock() - begin < CLOCKS_PER_SEC / 10) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  cancel = true;
}

TEST(Batch, StopsWhenItIsCancelled) {
  const std::vector<Pixel> all = pixels(40, 1.0, 6.0);
  std::atomic<bool> cancel{true};
  BatchProblem problem = problem_of(all, {.periods = 1000});
  problem.cancel = &cancel;
  const Batch none = run_batch(problem);
  EXPECT_FALSE(none.complete);
  for (const BatchRun& run : none.runs) EXPECT_FALSE(run.done);
  // Periodic runs that meet nothing to stop at for hours.
  cancel = false;
  const std::vector<Pixel> long_runs = pixels(8, 2.1, 2.3);
  BatchProblem hours = problem_of(long_runs, {.periods = 1'000'000'000});
  hours.cancel = &cancel;
  std::atomic<int> started{0};
  hours.start_at = [&](std::size_t i) {
    ++started;
    return long_runs[i].start;
  };
  std::thread later([&] {
    while (started == 0) std::this_thread::yield();
    cancel_at_work(cancel);
  });
  const Batch stopped = run_batch(hours);
  later.join();
  EXPECT_FALSE(stopped.complete);
  for (const BatchRun& run : stopped.runs) EXPECT_FALSE(run.done);
}

/// Work is a part of the interface: a change is noticed. 2.2: an impact and a reversal a period, a window each.
TEST(Batch, TakesAWindowForEachEvent) {
  const Model model = load_model("vibro-impact").build({{"omega", 2.2}});
  const std::vector<Pixel> all(8, {model, {-0.5, 0.0, 0.0, 0.0}});
  const Batch batch = run_batch(problem_of(all, {.transient_periods = 100, .periods = 400}));
  EXPECT_LE(batch.lane_steps, 8 * 500 * 2 + 8 * 60);
  EXPECT_LE(batch.halved, 8 * 4);
  for (const BatchRun& run : batch.runs) EXPECT_EQ(run.motion_events, 0);
}

}  // namespace
}  // namespace slapstick
