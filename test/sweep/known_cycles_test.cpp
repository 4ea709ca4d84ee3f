/// Known cycles: a motion is taken for one of a cycle exactly if it comes to it, and knowing them changes no answer.
#include "sweep/known_cycles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/sweep/basins.hpp"

namespace slapstick::sweep {
namespace {

/// A forced mass on a spring with much damping, whose two multipliers are real: x'' + 2 D x' + x = sin(w t).
class OneCycle : public testing::Test {
 protected:
  static constexpr double damping = 1.25;  // rates 0.5 and 2
  static Model model() {
    Model model;
    model.name = "damped";
    model.coordinates = {{"x", 1.0}};
    model.springs = {{0, ground, 1.0}};
    model.dampers = {{0, ground, 2.0 * damping}};
    model.omega = 2.0 * std::numbers::pi;  // a period of 1
    model.forces = {{0, 1, 1.0, 0.0}};
    return model;
  }
  OneCycle() {
    const Classification cycle = classify(system_, {0.0, 0.0});
    Finding found;
    found.attractor = cycle.attractor;
    found.n = cycle.n;
    cycles_.add(found, cycle.state);
    point_ = flow::contact_state(Motion(system_, cycle.state));
    scale_ = std::abs(point_[0]);  // the speed there is far more than half of it
  }

  /// The slow direction is (1, -0.5) in displacement and velocity.
  [[nodiscard]] Eigen::VectorXd beside(double away) const {
    Eigen::VectorXd x = point_;
    x[0] += away * scale_;
    x[1] -= 0.5 * away * scale_;
    return x;
  }
  /// How many points of distance away * factor^k a watch wants; 0: more than 300.
  [[nodiscard]] int points(double away, double factor) const {
    KnownCycles::Watch watch(cycles_);
    for (int k = 0; k < 300; ++k, away *= factor)
      if (watch.see(beside(away)) != nullptr) return k + 1;
    return 0;
  }

  System system_{model()};
  ClassifyOptions options_;
  KnownCycles cycles_{system_, options_};
  Eigen::VectorXd point_;
  double scale_ = 1.0;
};

TEST_F(OneCycle, IsKnownOnce) {
  ASSERT_EQ(cycles_.size(), 1U);
  Finding found;
  found.attractor = Attractor::periodic;
  found.n = 1;
  cycles_.add(found, classify(system_, {1.0, -1.0}).state);
  EXPECT_EQ(cycles_.size(), 1U);
}

/// exp(-1/2) a point: 14 points make a thousandfold, stages are of two points.
TEST_F(OneCycle, DrawsWhatFallsAThousandfoldAtItsRate) { EXPECT_EQ(points(0.04, std::exp(-0.5)), 15); }

TEST_F(OneCycle, DrawsNothingThatFallsFarSlowerThanItsRate) {
  EXPECT_EQ(points(0.04, std::exp(-0.05)), 0);  // a tenth of the rate, a thousandfold at last
  EXPECT_EQ(points(0.04, 1.0), 0);              // a curve round it
  EXPECT_EQ(points(0.04, -1.0), 0);
}

/// What comes near and leaves has not been drawn, however often it returns.
TEST_F(OneCycle, DrawsNothingThatOnlyPasses) {
  KnownCycles::Watch watch(cycles_);
  for (int round = 0; round < 50; ++round) {
    double away = 0.04;
    for (int k = 0; k < 10; ++k, away *= std::exp(-0.5)) EXPECT_EQ(watch.see(beside(away)), nullptr);
    for (; away < 1.0; away *= 2.0) EXPECT_EQ(watch.see(beside(away)), nullptr);
  }
}

/// A motion that hesitates, as beside the boundary of the basin, is drawn later; meanwhile others may be asked.
TEST_F(OneCycle, DrawsAMotionThatHesitates) {
  KnownCycles::Watch watch(cycles_);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(watch.see(beside(0.04)), nullptr);
  EXPECT_FALSE(watch.beside());
  int wanted = 0;
  for (double away = 0.04; watch.see(beside(away)) == nullptr && wanted < 100; away *= std::exp(-0.5)) ++wanted;
  EXPECT_LE(wanted, 17);
}

/// A state that is on the cycle to rounding falls no further.
TEST_F(OneCycle, DrawsWhatIsOnIt) {
  EXPECT_GT(points(1e-15, 1.0), 0);
  EXPECT_LE(points(1e-15, 1.0), 4);
}

/// A free machine has no phase, and a continuum no rate: neither is noted.
TEST(KnownCycles, AreOfDrivenMachinesAlone) {
  const ModelDefinition belt = load_model("belt");
  const System system(belt.build());
  const ClassifyOptions options;
  KnownCycles cycles(system, options);
  Finding found;
  found.attractor = Attractor::periodic;
  found.n = 1;
  cycles.add(found, classify(system, belt.start({})).state);
  EXPECT_EQ(cycles.size(), 0U);
}

MapProblem plane(const char* name, const Overrides& values, const StartAxis& x, const StartAxis& y) {
  const ModelDefinition definition = load_model(name);
  return starts_over(definition.build(values), definition.start(values), x, y);
}

std::vector<std::string> labels(const Basins& basins) {
  std::vector<std::string> labels;
  for (const std::int32_t of : basins.of)
    labels.push_back(of < 0 ? std::to_string(of) : basins.basins[static_cast<std::size_t>(of)].attractor.label);
  return labels;
}

/// A forced arm, and beside it a pin with two wells, whose distance is a hundred thousandth of the arm's swing.
MapProblem pin_beside_an_arm() {
  Model model;
  model.name = "arm-and-pin";
  constexpr double small = 1e-5;
  model.coordinates = {{"arm", 1.0}, {"pin", 1.0}};
  model.springs = {{0, ground, 4.0}, {1, ground, -1.0}};
  model.dampers = {{0, ground, 0.05}, {1, ground, 0.4}};
  model.compliant_stops = {{"plus", 1, ground, small, 3.0}, {"minus", ground, 1, small, 3.0}};
  model.omega = 1.0;
  model.forces = {{0, 1, 3.0, 1.0}, {1, 1, 0.1 * small, 0.0}};
  return starts_over(model, {0.0, 0.0, 0.0, 0.0}, {2, {-3.0 * small, 3.0 * small, 12}}, {1, {-2.0, 2.0, 12}});
}

/// Two cycles that differ in a small number alone, as an angle beside lengths, are two.
TEST(KnownCycles, OfASmallNumberAreTold) { EXPECT_EQ(run_basins(pin_beside_an_arm()).basins.size(), 2U); }

/// The cycles that a first look finds are a short cut: without them each start comes to the same attractor.
TEST(KnownCycles, ChangeNoBasin) {
  const StartAxis x{0, {-0.6, 0.02, 20}}, y{1, {-1.2, 1.2, 17}};
  for (MapProblem problem :
       {plane("vibro-impact", {{"omega", 2.82}}, x, y), plane("vibro-impact", {{"omega", 3.0}}, x, y),
        plane("impact-oscillator", {{"omega", 0.85}}, {0, {-1.0, 1.0, 15}}, {1, {-1.0, 1.0, 15}}),
        plane("bilinear-oscillator", {}, {0, {-3.0, 3.0, 15}}, {1, {-3.0, 3.0, 15}}),
        plane("coulomb-oscillator", {}, {0, {-1.0, 1.0, 15}}, {1, {-1.0, 1.0, 15}}),
        plane("two-sided-rattle", {}, {0, {-0.9, 0.9, 12}}, {1, {-2.0, 2.0, 12}}),  // no lane takes this
        plane("bump-stop", {}, {0, {-0.5, 0.5, 10}}, {1, {-1.0, 1.0, 10}}), pin_beside_an_arm()}) {
    ASSERT_TRUE(problem.one_model);
    const Basins with = run_basins(problem);
    problem.one_model = false;
    const Basins without = run_basins(problem);
    EXPECT_EQ(with.of, without.of);
    EXPECT_EQ(labels(with), labels(without));
  }
}

/// In how many states the motions of a plane end.
std::size_t states(MapProblem problem, bool one_model) {
  std::set<State> states;
  problem.one_model = one_model;
  problem.finished = [&](std::span<const Pixel> pixels) {
    for (const Pixel& pixel : pixels) states.insert(pixel.carried);
  };
  EXPECT_TRUE(run_tiles(problem));
  return states.size();
}

/// A motion that is seen to come to a known cycle has that cycle's state; one that is asked alone has its own.
TEST(KnownCycles, AreUsedInLanesAndOutside) {
  for (const MapProblem& problem :
       {plane("vibro-impact", {{"omega", 2.82}}, {0, {-0.6, 0.0, 16}}, {1, {-1.2, 1.2, 16}}),
        plane("two-sided-rattle", {}, {0, {-0.4, 0.4, 16}}, {1, {-2.0, 2.0, 16}})}) {
    EXPECT_LE(states(problem, true), 80U);  // 64 of the first look, and a few that hesitated
    EXPECT_GT(states(problem, false), 128U);
  }
}

/// What a run before has computed, pixels of the first look among it, changes no bit of the others.
TEST(KnownCycles, DoNotDependOnWhatAStoreHas) {
  MapProblem problem = plane("vibro-impact", {{"omega", 2.82}}, {0, {-0.6, 0.02, 20}}, {1, {-1.2, 1.2, 17}});
  std::map<std::int32_t, Pixel> all, again;
  problem.finished = [&](std::span<const Pixel> pixels) {
    for (const Pixel& pixel : pixels) all[pixel.number] = pixel;
  };
  ASSERT_TRUE(run_tiles(problem));
  problem.known = [&](std::int32_t pixel, Direction) { return pixel % 3 == 0; };
  EXPECT_THROW(run_tiles(problem), InputError);  // what they are is not given
  problem.finding_of = [&](std::int32_t pixel, Direction) { return all.at(pixel).found.front(); };
  problem.carried_of = [&](std::int32_t pixel, Direction) { return all.at(pixel).carried; };
  long last = 0, to_do = 0;
  problem.progress = [&](long done, long total) { last = done, to_do = total; };
  problem.finished = [&](std::span<const Pixel> pixels) {
    for (const Pixel& pixel : pixels) again[pixel.number] = pixel;
  };
  ASSERT_TRUE(run_tiles(problem));
  EXPECT_EQ(last, 20 * 17);
  EXPECT_EQ(to_do, 20 * 17);
  EXPECT_EQ(again.size(), all.size() - (20 * 17 + 2) / 3);
  for (const auto& [number, pixel] : again) {
    EXPECT_EQ(pixel.carried, all.at(number).carried) << number;
    EXPECT_EQ(pixel.found.front().label(), all.at(number).found.front().label()) << number;
  }
}

TEST(KnownCycles, NeedAllPixelsOfAPlane) {
  MapProblem problem = plane("vibro-impact", {}, {0, {-0.6, 0.02, 4}}, {1, {-1.2, 1.2, 4}});
  problem.shards = 2;
  EXPECT_THROW(run_tiles(problem), InputError);
  problem.shards = 1;
  problem.start = MapStart::carry;
  EXPECT_THROW(run_tiles(problem), InputError);
  problem.start = MapStart::reset;
  problem.keep_states = false;
  EXPECT_THROW(run_tiles(problem), InputError);
}

}  // namespace
}  // namespace slapstick::sweep
