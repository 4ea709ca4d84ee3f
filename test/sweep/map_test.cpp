/// Maps: a pixel is what `classify` says of it alone; threads, shards and interruptions change no bit.
#include "slapstick/sweep/map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick::sweep {
namespace {

const ModelDefinition& paper() {
  static const ModelDefinition definition = load_model("vibro-impact");
  return definition;
}

/// The paper's system over the frequency and the friction.
MapProblem chart(int nx, int ny, double from = 1.0, double to = 6.0) {
  MapProblem problem;
  problem.model_at = [](double x, double y) { return paper().build({{"omega", x}, {"friction", y}}); };
  problem.start_at = [](double x, double y) { return paper().start({{"omega", x}, {"friction", y}}); };
  problem.x = {from, to, nx};
  problem.y = {0.05, 0.3, ny};
  problem.of = {find_quantity(quantities(paper()), "x1")};
  problem.statistics = {"rms"};
  return problem;
}

/// Equal bits, NaN included.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool same(const Finding& a, const Finding& b) {
  return a.pixel == b.pixel && a.direction == b.direction && a.attractor == b.attractor && a.doubt == b.doubt &&
         a.chatter == b.chatter && a.sticking == b.sticking && a.failed == b.failed && a.n == b.n && a.p == b.p &&
         a.starts == b.starts && same(a.exponent, b.exponent) && same(a.multiplier.real(), b.multiplier.real()) &&
         same(a.multiplier.imag(), b.multiplier.imag());
}

void expect_same(const Map& a, const Map& b) {
  ASSERT_EQ(a.findings.size(), b.findings.size());
  for (std::size_t i = 0; i < a.findings.size(); ++i) {
    ASSERT_TRUE(same(a.findings[i], b.findings[i])) << i;
    for (std::size_t k = 0; k < a.width; ++k)
      ASSERT_TRUE(same(a.values_of(a.findings[i])[k], b.values_of(b.findings[i])[k])) << i;
  }
  EXPECT_EQ(a.failures, b.failures);
}

std::vector<MapProblem> every_start() {
  std::vector<MapProblem> all{chart(9, 7), chart(9, 11), chart(4, 3)};
  all[1].start = MapStart::carry;
  all[1].direction = Direction::both;
  all[2].start = MapStart::random;
  all[2].starts = 4;
  return all;
}

TEST(Map, SameBitsForAnyNumberOfThreads) {
  for (MapProblem& problem : every_start()) {
    problem.threads = 1;
    const Map one = run_map(problem);
    EXPECT_TRUE(one.complete);
    for (const int threads : {2, 5}) {
      problem.threads = threads;
      expect_same(run_map(problem), one);
    }
  }
}

TEST(Map, ShardsTogetherAreTheWhole) {
  for (MapProblem& problem : every_start()) {
    const Map whole = run_map(problem);
    for (const int shards : {2, 3, 7}) {
      MapBuilder together(problem);
      problem.shards = shards;
      problem.finished = [&](std::span<const Pixel> pixels) {
        for (const Pixel& pixel : pixels) together.add(pixel);
      };
      for (problem.shard = shards - 1; problem.shard >= 0; --problem.shard) EXPECT_TRUE(run_tiles(problem));
      problem.shard = 0, problem.shards = 1, problem.finished = {};
      expect_same(together.take(true), whole);
    }
  }
}

/// Any pixels may be known already, also in the middle of a row that the state is carried along.
TEST(Map, ResumeHasTheBitsOfAnUndisturbedRun) {
  std::mt19937 random(7);
  for (MapProblem& problem : every_start()) {
    std::map<std::pair<std::int32_t, Direction>, Pixel> all;
    problem.finished = [&](std::span<const Pixel> pixels) {
      for (const Pixel& pixel : pixels) all[{pixel.number, pixel.direction}] = pixel;
    };
    const Map whole = run_map(problem);
    std::set<std::pair<std::int32_t, Direction>> known;
    for (const auto& [place, pixel] : all)
      if (random() % 3 != 0) known.insert(place);
    MapBuilder resumed(problem);
    long computed = 0;
    problem.known = [&](std::int32_t number, Direction direction) { return known.count({number, direction}) != 0; };
    problem.carried_of = [&](std::int32_t number, Direction direction) { return all.at({number, direction}).carried; };
    problem.finished = [&](std::span<const Pixel> pixels) {
      for (const Pixel& pixel : pixels) resumed.add(pixel), ++computed;
    };
    EXPECT_TRUE(run_tiles(problem));
    EXPECT_EQ(computed + static_cast<long>(known.size()), static_cast<long>(all.size()));
    for (const auto& place : known) resumed.add(all.at(place));
    expect_same(resumed.take(true), whole);
  }
}

/// Lanes round otherwise than a Motion, and Newton's method begins at another point: it ends within 1e-11 of the cycle.
TEST(Map, PixelIsWhatClassifySaysOfItAlone) {
  for (const Level level : {Level::quick, Level::full}) {
    MapProblem problem = chart(4, 3, 1.3, 2.9);
    problem.level = level;
    const Map map = run_map(problem);
    ASSERT_EQ(map.findings.size(), 12U);
    for (const Finding& found : map.findings) {
      const double x = map.x_of(found), y = map.y_of(found);
      const System system(problem.model_at(x, y));
      const Classification alone = level == Level::quick ? classify_quickly(system, problem.start_at(x, y), 300)
                                                         : classify(system, problem.start_at(x, y));
      EXPECT_EQ(found.label(), alone.label);
      const bool same_bits = level == Level::full;
      if (alone.n > 0 && same_bits) {
        EXPECT_EQ(found.exponent, alone.exponent);
      }
      if (alone.n > 0) {
        EXPECT_NEAR(found.exponent, alone.exponent, 1e-8);
      }
      const Motion motion(system, alone.state);
      const Instant end{alone.n > 0 ? alone.n : 100, 0.0};
      const double rms = statistic(measure(motion, end, problem.of).of[0], "rms");
      if (same_bits) {
        EXPECT_EQ(map.values_of(found)[0], rms);
      }
      if (alone.n > 0) {
        EXPECT_NEAR(map.values_of(found)[0], rms, 1e-9 * rms);
      }
    }
  }
}

TEST(Map, QuickAndFullAgreeWhereBothDecide) {
  MapProblem problem = chart(16, 8);
  problem.of = {}, problem.statistics = {};
  const Map quick = run_map(problem);
  problem.level = Level::full;
  const Map full = run_map(problem);
  int decided = 0;
  for (std::size_t i = 0; i < quick.findings.size(); ++i) {
    const Finding &a = quick.findings[i], &b = full.findings[i];
    if (a.attractor == Attractor::undecided || b.attractor == Attractor::undecided) continue;
    ++decided;
    EXPECT_EQ(a.label(), b.label()) << "omega = " << quick.x_of(a) << ", friction = " << quick.y_of(a);
    EXPECT_NEAR(a.exponent, b.exponent, 1e-6);
  }
  EXPECT_GT(decided, 100);
}

/// At omega = 4.9 a cycle of 2 impacts in 5 periods coexists with one of 12 in 26, which is gone at 4.92: the 200 and
/// 231 impacts in 500 periods of test/sweep/diagram_test.cpp.
MapProblem two_attractors() {
  MapProblem problem = chart(6, 2, 4.9, 4.95);
  problem.y = {0.15, 0.15, 1};
  problem.start_at = [](double, double) { return State{-0.5, 0.5, 0.0, 0.0}; };
  problem.of = {}, problem.statistics = {};
  problem.level = Level::full;
  problem.classify.most_periods = 2000;
  return problem;
}

TEST(Map, CarriedUpAndDownFindsBothAttractors) {
  MapProblem problem = two_attractors();
  problem.start = MapStart::carry;
  problem.direction = Direction::both;
  const Map map = run_map(problem);
  ASSERT_EQ(map.findings.size(), 12U);
  EXPECT_EQ(map.findings[0].label(), "26-12-II");
  EXPECT_EQ(map.findings[6].label(), "5-2-II");
  EXPECT_EQ(map.findings[6].pixel, 0);
}

TEST(Map, RandomStartsFindEveryAttractorOfAPixel) {
  MapProblem problem = two_attractors();
  problem.x = {4.9, 4.9, 1};
  problem.start = MapStart::random;
  problem.starts = 12;
  const Map map = run_map(problem);
  std::set<std::string> labels;
  int starts = 0;
  for (const Finding& found : map.findings) labels.insert(found.label()), starts += found.starts;
  EXPECT_EQ(labels, (std::set<std::string>{"26-12-II", "5-2-II"}));
  EXPECT_EQ(map.findings.size(), 2U) << "one attractor counts as two";
  EXPECT_EQ(starts, 12);
  EXPECT_GE(map.findings[0].starts, map.findings[1].starts);
}

/// What a filled pixel takes over.
auto common(const Finding& of) { return std::tuple(of.failed, of.attractor, of.n, of.p, of.chatter, of.sticking); }

/// The paper's system at high friction: broad classes, no region smaller than a coarse cell.
MapProblem broad() {
  MapProblem problem = chart(49, 33, 1.3, 2.6);
  problem.y = {0.1, 0.2, 33};
  return problem;
}

TEST(Map, RefinedMapIsTheWholeOne) {
  MapProblem problem = broad();
  const Map whole = run_map(problem);
  problem.refine = 8;
  for (const int threads : {1, 3}) {
    problem.threads = threads;
    const Map map = run_map(problem);
    ASSERT_TRUE(map.complete);
    ASSERT_EQ(map.rows(), whole.findings.size());
    EXPECT_LT(map.findings.size(), whole.findings.size() / 2);
    std::size_t computed = 0;
    for (std::size_t i = 0; i < map.rows(); ++i) {
      const Finding found = map.row(i);
      EXPECT_EQ(common(found), common(whole.findings[i])) << i;
      if (!found.filled) ++computed;
      if (!found.filled) {
        EXPECT_TRUE(same(found, whole.findings[i])) << i;
      }
      EXPECT_EQ(std::isnan(map.values_of(found)[0]), found.filled);
      if (found.filled) {
        EXPECT_TRUE(std::isnan(found.exponent) && std::isnan(found.multiplier.real()));
      }
    }
    EXPECT_EQ(computed, map.findings.size());
  }
}

TEST(Map, RefinedMapResumesWithTheSamePixels) {
  MapProblem problem = broad();
  problem.refine = 8;
  const Map whole = run_map(problem);
  std::map<std::int32_t, Pixel> known;
  std::atomic<bool> cancel{false};
  problem.cancel = &cancel;
  problem.finished = [&](std::span<const Pixel> pixels) {
    for (const Pixel& pixel : pixels) known[pixel.number] = pixel;
    cancel = known.size() > 150;
  };
  EXPECT_FALSE(run_tiles(problem));
  cancel = false;
  const std::map<std::int32_t, Pixel> before = known;
  problem.known = [&](std::int32_t number, Direction) { return before.count(number) != 0; };
  problem.finding_of = [&](std::int32_t number, Direction) { return before.at(number).found.front(); };
  problem.finished = [&](std::span<const Pixel> pixels) {
    for (const Pixel& pixel : pixels) EXPECT_TRUE(known.emplace(pixel.number, pixel).second) << "computed twice";
  };
  EXPECT_TRUE(run_tiles(problem));
  MapBuilder together(problem);
  for (const auto& [number, pixel] : known) together.add(pixel);
  const Map map = together.take(true);
  expect_same(map, whole);
  EXPECT_EQ(map.stands_for, whole.stands_for);
}

/// Half of a refined map has no filled pixels: they may still turn out to be others.
TEST(Map, IncompleteRefinedMapFillsNothing) {
  MapProblem problem = broad();
  problem.refine = 8;
  std::atomic<bool> cancel{false};
  problem.cancel = &cancel;
  problem.progress = [&](long, long) { cancel = true; };
  const Map map = run_map(problem);
  EXPECT_FALSE(map.complete);
  EXPECT_EQ(map.rows(), map.findings.size());
  EXPECT_FALSE(map.row(0).filled);
}

TEST(Map, FailureStaysAtItsPixelWithItsReason) {
  for (const MapStart start : {MapStart::reset, MapStart::carry}) {
    MapProblem problem = chart(5, 3);
    problem.start = start;
    const auto model_at = problem.model_at;
    problem.model_at = [&](double x, double y) {
      if (x == 3.5) throw NumericalError("no model here");
      return model_at(x, y);
    };
    const Map map = run_map(problem);
    EXPECT_TRUE(map.complete);
    ASSERT_EQ(map.findings.size(), 15U);
    EXPECT_EQ(map.failures.size(), 3U);
    for (const Finding& found : map.findings) {
      EXPECT_EQ(found.failed, found.pixel % 5 == 2);
      if (found.failed) {
        EXPECT_EQ(found.label(), "failed");
      }
    }
    EXPECT_EQ(map.failures.at({0, 7}), "no model here");
  }
}

TEST(Map, CancelledMapKeepsWhatIsFinished) {
  std::atomic<bool> cancel{false};
  MapProblem problem = chart(40, 20);
  problem.cancel = &cancel;
  long known = 0;
  problem.progress = [&](long done, long total) {
    EXPECT_EQ(total, 800);
    known = done;
    cancel = true;
  };
  const Map map = run_map(problem);
  EXPECT_FALSE(map.complete);
  EXPECT_EQ(static_cast<long>(map.findings.size()), known);
  EXPECT_LT(known, 800);
  EXPECT_GE(known, 1);
}

TEST(Map, RefusesAMeaninglessProblem) {
  const auto refuses = [](const auto& change) {
    MapProblem problem = chart(3, 3);
    change(problem);
    EXPECT_THROW(static_cast<void>(run_map(problem)), InputError);
  };
  refuses([](MapProblem& p) { p.x.to = p.x.from; });
  refuses([](MapProblem& p) { p.y.count = 0; });
  refuses([](MapProblem& p) { p.x.from = NAN; });
  refuses([](MapProblem& p) { p.periods = 2; });
  refuses([](MapProblem& p) { p.statistics = {"rsm"}; });
  refuses([](MapProblem& p) { p.statistics = {}; });
  refuses([](MapProblem& p) { p.shard = 1; });
  refuses([](MapProblem& p) { p.direction = Direction::down; });
  refuses([](MapProblem& p) { p.start = MapStart::random, p.starts = 1; });
  refuses([](MapProblem& p) { p.model_at = {}; });
  refuses([](MapProblem& p) { p.refine = 1; });
  refuses([](MapProblem& p) { p.refine = 4, p.start = MapStart::carry; });
  refuses([](MapProblem& p) { p.refine = 4, p.start = MapStart::random; });
  refuses([](MapProblem& p) { p.refine = 4, p.shards = 2; });
  refuses([](MapProblem& p) { p.refine = 4, p.known = [](std::int32_t, Direction) { return true; }; });
}

}  // namespace
}  // namespace slapstick::sweep
