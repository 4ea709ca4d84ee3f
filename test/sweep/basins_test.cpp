/// Basins: two starts are of one colour exactly if their motions come to one attractor; the boundary's numbers.
#include "slapstick/sweep/basins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <sstream>

#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::sweep {
namespace {

/// A plane without mechanics.
Basins plane(int columns, int rows, const std::function<std::int32_t(int ix, int iy)>& basin) {
  Basins basins;
  basins.x = {0.0, 1.0, columns};
  basins.y = {0.0, 1.0, rows};
  for (int iy = 0; iy < rows; ++iy)
    for (int ix = 0; ix < columns; ++ix) basins.of.push_back(basin(ix, iy));
  return basins;
}

TEST(BasinBoundary, AStraightLineHasTheExponentOne) {
  const Uncertainty found = uncertainty(plane(160, 160, [](int ix, int) { return ix < 71 ? 0 : 1; }));
  EXPECT_EQ(found.distances, (std::vector<int>{1, 2, 4, 8, 16}));
  EXPECT_NEAR(found.exponent, 1.0, 1e-12);
  EXPECT_NEAR(found.error, 0.0, 1e-12);
}

/// The gaps of Cantor's set, each of a basin by the toss of a coin: a boundary of dimension ln 2 / ln 3 across.
TEST(BasinBoundary, ACantorSetHasItsExponent) {
  constexpr int size = 2187;  // 3^7
  std::vector<std::int32_t> basin(size, -1);
  std::mt19937 coin(1);
  const auto cut = [&](const auto& self, int from, int width) -> void {
    if (width == 1) {
      basin[static_cast<std::size_t>(from)] = static_cast<std::int32_t>(coin() % 2);
      return;
    }
    const auto third = width / 3;
    std::fill_n(basin.begin() + from + third, third, static_cast<std::int32_t>(coin() % 2));
    self(self, from, third);
    self(self, from + 2 * third, third);
  };
  cut(cut, 0, size);
  const Uncertainty found =
      uncertainty(plane(size, 512, [&](int ix, int) { return basin[static_cast<std::size_t>(ix)]; }));
  ASSERT_EQ(found.distances.size(), 7U);
  EXPECT_NEAR(found.exponent, 1.0 - std::log(2.0) / std::log(3.0), 0.06);
}

/// One line has one exponent wherever it is, or none where it is too near the rim; so has its mirror image.
TEST(BasinBoundary, AnExponentDoesNotDependOnWhereTheLineIs) {
  for (const int place : {1, 3, 7, 8, 20, 32, 55, 56, 57, 61, 63}) {
    const Uncertainty found = uncertainty(plane(64, 64, [&](int ix, int) { return ix < place ? 0 : 1; }));
    if (place >= 8 && place <= 56)
      EXPECT_NEAR(found.exponent, 1.0, 1e-12) << place;
    else
      EXPECT_TRUE(std::isnan(found.exponent)) << place;
  }
}

TEST(BasinBoundary, NoBoundaryHasNoExponent) {
  const Basins one = plane(40, 40, [](int, int) { return 0; });
  // Stripes of one start have no pairs that differ two starts apart.
  EXPECT_TRUE(std::isnan(uncertainty(plane(64, 64, [](int ix, int) { return ix % 2; })).exponent));
  EXPECT_TRUE(std::isnan(uncertainty(one).exponent));
  EXPECT_TRUE(std::isnan(basin_entropy(one).boundary));
  EXPECT_EQ(basin_entropy(one).whole, 0.0);
}

/// Boxes of halves have ln 2. A box with a start that belongs to no basin does not count.
TEST(BasinBoundary, TheEntropyIsThatOfTheShares) {
  const Basins halves = plane(8, 4, [](int ix, int iy) { return ix >= 4 && iy < 2 ? 1 : 0; });
  const BasinEntropy found = basin_entropy(halves, 4);
  EXPECT_EQ(found.boxes, 2);
  EXPECT_EQ(found.on_boundary, 1);
  EXPECT_DOUBLE_EQ(found.boundary, std::log(2.0));
  EXPECT_DOUBLE_EQ(found.whole, 0.5 * std::log(2.0));
  const Basins holed = plane(8, 4, [](int ix, int iy) { return ix == 0 && iy == 0 ? Basins::inadmissible : ix % 2; });
  EXPECT_EQ(basin_entropy(holed, 4).boxes, 1);
  EXPECT_THROW(static_cast<void>(basin_entropy(halves, 1)), InputError);
}

State start_of(const ModelDefinition& definition, const Overrides& values = {}) { return definition.start(values); }

MapProblem paper(int columns, int rows) {
  static const ModelDefinition definition = load_model("vibro-impact");
  const Overrides values{{"omega", 2.82}};
  return starts_over(definition.build(values), start_of(definition, values), {0, {-0.6, 0.02, columns}},
                     {1, {-1.2, 1.2, rows}});
}

TEST(Basins, SameForAnyNumberOfThreads) {
  MapProblem problem = paper(14, 12);
  problem.threads = 1;
  const Basins one = run_basins(problem);
  problem.threads = 3;
  const Basins three = run_basins(problem);
  EXPECT_EQ(one.of, three.of);
  ASSERT_EQ(one.basins.size(), three.basins.size());
  for (std::size_t i = 0; i < one.basins.size(); ++i)
    EXPECT_EQ(one.basins[i].attractor.state, three.basins[i].attractor.state);
}

/// The paper's system has two attractors at omega = 2.82: each start is what `classify` says of it alone.
TEST(Basins, AreWhatClassifySaysOfEachStart) {
  const MapProblem problem = paper(14, 12);
  const Basins found = run_basins(problem);
  std::set<std::string> labels;
  for (const Basin& basin : found.basins) labels.insert(basin.attractor.label);
  EXPECT_EQ(labels, (std::set<std::string>{"1-1-I", "4-3-II"}));
  EXPECT_EQ(found.basins.size(), 2U);
  const System system(problem.model_at(0.0, 0.0));
  for (std::int32_t pixel = 0; pixel < 14 * 12; pixel += 5) {
    const std::int32_t of = found.of[static_cast<std::size_t>(pixel)];
    const State start = problem.start_at(problem.x_at(pixel), problem.y_at(pixel));
    if (start[0] > 0.0) {  // beyond the stop
      EXPECT_EQ(of, Basins::inadmissible) << pixel;
    } else if (of >= 0) {
      EXPECT_EQ(classify(system, start).label, found.basins[static_cast<std::size_t>(of)].attractor.label) << pixel;
    }
  }
  EXPECT_LE(found.count(Basins::undecided), 1);
  EXPECT_EQ(found.count(Basins::inadmissible), 12);
}

/// @param length, time  the units are so much smaller
ModelDefinition two_wells(double length = 1.0, double time = 1.0) {
  std::ostringstream text;
  text.precision(17);
  text << "name = \"two-wells\"\n[[coordinate]]\nname = \"x\"\nmass = 1\n"
       << "[[spring]]\nbetween = [\"x\", \"ground\"]\ncharacteristic = [";
  for (const auto& [x, force] : {std::pair{-2.0, -1.0}, {-1.0, 0.0}, {-0.5, 0.5}, {0.5, -0.5}, {1.0, 0.0}, {2.0, 1.0}})
    text << "[" << x * length << ", " << force * length / (time * time) << "], ";
  text << "]\n[[damper]]\nbetween = [\"x\", \"ground\"]\ncoefficient = " << 0.2 / time << "\n";
  return ModelDefinition::parse(text.str(), "two-wells.toml");
}

Basins of_two_wells(double length, double time) {
  const ModelDefinition definition = two_wells(length, time);
  return run_basins(starts_over(definition.build(), start_of(definition), {0, {-2.0 * length, 2.0 * length, 9}},
                                {1, {-1.5 * length / time, 1.5 * length / time, 8}}));
}

/// Powers of two change no bit of a motion, and so no basin.
TEST(Basins, AreTheSameInAnyUnits) {
  const Basins found = of_two_wells(1.0, 1.0);
  EXPECT_EQ(found.basins.size(), 2U);
  for (const int length : {-40, 40})
    for (const int time : {-6, 6})
      EXPECT_EQ(of_two_wells(std::ldexp(1.0, length), std::ldexp(1.0, time)).of, found.of) << length << " " << time;
}

/// A machine that is its own mirror image rests at 1 and -1: the basins are mirror images of one another, and the start
/// between them is in neither.
TEST(Basins, OfAMirroredStartIsTheMirroredOne) {
  const ModelDefinition definition = two_wells();
  const int size = 21;
  const MapProblem problem =
      starts_over(definition.build(), start_of(definition), {0, {-2.0, 2.0, size}}, {1, {-1.5, 1.5, size}});
  const Basins found = run_basins(problem);
  ASSERT_EQ(found.basins.size(), 2U);
  const auto rest = [&](std::size_t i) { return found.basins[i].attractor.state[0]; };
  EXPECT_NEAR(std::abs(rest(0)), 1.0, 1e-12);
  EXPECT_NEAR(rest(0) + rest(1), 0.0, 1e-12);
  const auto middle = static_cast<std::size_t>(size * size / 2);
  EXPECT_EQ(found.of[middle], Basins::undecided);
  for (std::size_t i = 0; i < middle; ++i) EXPECT_EQ(found.of[i] + found.of[found.of.size() - 1 - i], 1) << i;
  EXPECT_EQ(found.basins[0].starts, found.basins[1].starts);
}

/// The wells at 1 and -1, beside a coordinate of another size: an angle beside a play, or a weight that rests far off.
Basins of_wells_beside(double size, bool driven) {
  std::ostringstream text;
  text << R"(name = "beside"
omega = 1.3
[[coordinate]]
name = "x"
mass = 1
[[coordinate]]
name = "far"
mass = 1
[[spring]]
between = ["x", "ground"]
characteristic = [[-2, -1], [-1, 0], [-0.5, 0.5], [0.5, -0.5], [1, 0], [2, 1]]
[[damper]]
between = ["x", "ground"]
coefficient = 0.2
[[spring]]
between = ["far", "ground"]
stiffness = 1
[[damper]]
between = ["far", "ground"]
coefficient = 0.5
[[force]]
on = "far"
harmonic = )"
       << (driven ? 1 : 0) << "\namplitude = " << size << "\n";
  const ModelDefinition definition = ModelDefinition::parse(text.str(), "beside.toml");
  return run_basins(starts_over(definition.build(), start_of(definition), {0, {-2.0, 2.0, 6}}, {1, {-1.0, 1.0, 6}}));
}

TEST(Basins, AreNotMergedBesideALargeCoordinate) {
  for (const double size : {1.0, 3e6, 1e7})
    for (const bool driven : {false, true}) {
      const Basins found = of_wells_beside(size, driven);
      ASSERT_EQ(found.basins.size(), 2U) << size << " " << driven;
      EXPECT_EQ(found.basins[0].starts, 18);
    }
}

/// What rounding leaves of a small motion far from zero is no attractor of its own.
TEST(Basins, AreNotSplitWhereAMotionIsSmallAgainstItsOffset) {
  for (const double amplitude : {1e-12, 1e-10, 1e-7, 1e-3}) {
    std::ostringstream text;
    text << R"(name = "offset"
omega = 1.3
[[coordinate]]
name = "x"
mass = 1
[[spring]]
between = ["x", "ground"]
characteristic = [[998, -1], [999, 0], [999.5, 0.5], [1000.5, -0.5], [1001, 0], [1002, 1]]
[[damper]]
between = ["x", "ground"]
coefficient = 0.2
[[force]]
on = "x"
amplitude = )"
         << amplitude << "\n";
    const ModelDefinition definition = ModelDefinition::parse(text.str(), "offset.toml");
    const Basins found =
        run_basins(starts_over(definition.build(), start_of(definition), {0, {998.0, 1002.0, 6}}, {1, {-2.0, 2.0, 6}}));
    ASSERT_EQ(found.basins.size(), 2U) << amplitude;
    EXPECT_EQ(found.basins[0].starts, 18) << amplitude;
  }
}

/// A wide plane leaves places of rest apart; a start that is too large for the arithmetic is no stop's doing.
TEST(Basins, OfAWidePlaneAreThoseOfANarrowOne) {
  const ModelDefinition definition = two_wells();
  const Model model = definition.build();
  const Basins wide = run_basins(starts_over(model, start_of(definition), {0, {-3e6, 3e6, 8}}, {1, {-1.0, 1.0, 2}}));
  EXPECT_EQ(wide.basins.size(), 2U);
  const Basins large =
      run_basins(starts_over(model, start_of(definition), {0, {-1e155, 1e155, 3}}, {1, {1.0, 2.0, 2}}));
  EXPECT_EQ(large.count(Basins::failed), 4);
  EXPECT_EQ(large.failures.size(), 4U);
}

/// Wilson's interval for 10 of 100: 0.0552 to 0.1744, as tables have it.
TEST(Basins, SharesHaveTheirInterval) {
  const ModelDefinition definition = two_wells();
  const MapProblem problem =
      starts_over(definition.build(), start_of(definition), {0, {-1.1, 0.9, 10}}, {1, {-0.01, 0.01, 10}});
  BasinBuilder builder(problem);
  for (std::int32_t i = 0; i < 100; ++i) {
    Pixel pixel;
    pixel.number = i;
    pixel.found = {{.pixel = i, .attractor = Attractor::equilibrium}};
    pixel.carried = {i < 10 ? 1.0 : -1.0, 0.0};
    builder.add(pixel);
  }
  const Basins found = builder.take();
  ASSERT_EQ(found.basins.size(), 2U);
  EXPECT_DOUBLE_EQ(found.basins[1].share, 0.1);
  EXPECT_NEAR(found.basins[1].share_from, 0.0552, 5e-5);
  EXPECT_NEAR(found.basins[1].share_to, 0.1744, 5e-5);
}

/// A free cycle has no phase: the states that different starts leave behind are all on one and the same.
TEST(Basins, AFreeCycleIsOneWhereverItsMotionsStand) {
  const ModelDefinition definition = load_model("falling-friction");
  const Basins found =
      run_basins(starts_over(definition.build(), start_of(definition), {0, {-2.0, 3.0, 9}}, {1, {-2.0, 2.0, 9}}));
  ASSERT_EQ(found.basins.size(), 1U);
  EXPECT_EQ(found.basins[0].attractor.label, "free-0-II");
  EXPECT_EQ(found.basins[0].starts, 81);
}

/// What friction holds at rest anywhere in an interval is one basin, not one for each start.
TEST(Basins, AContinuumOfStatesOfRestIsOne) {
  const ModelDefinition definition = ModelDefinition::parse(R"(
name = "rest"
[[coordinate]]
name = "x"
mass = 1
[[spring]]
between = ["x", "ground"]
stiffness = 1
[[friction]]
name = "floor"
between = ["x", "ground"]
static = 0.3
kinetic = 0.2
)",
                                                            "rest.toml");
  const Basins found =
      run_basins(starts_over(definition.build(), start_of(definition), {0, {-2.0, 2.0, 7}}, {1, {-1.0, 1.0, 7}}));
  ASSERT_EQ(found.basins.size(), 1U);
  EXPECT_EQ(found.basins[0].starts, 49);
}

TEST(Basins, RefuseAxesThatAreNone) {
  const ModelDefinition definition = two_wells();
  const Model model = definition.build();
  const State start = start_of(definition);
  EXPECT_THROW(static_cast<void>(starts_over(model, start, {0, {}}, {0, {}})), InputError);
  EXPECT_THROW(static_cast<void>(starts_over(model, start, {0, {}}, {2, {}})), InputError);
  MapProblem random = starts_over(model, start, {0, {}}, {1, {}});
  random.start = MapStart::random;
  EXPECT_THROW(static_cast<void>(run_basins(random)), InputError);
}

}  // namespace
}  // namespace slapstick::sweep
