/// Models with parts that do not touch each other: what their structure makes zero is zero, and not a rounding that
/// asks for events or for ever shorter windows.
#include <gtest/gtest.h>

#include <random>

#include "base/dense.hpp"
#include "flow/compiled_system.hpp"
#include "flow/oracle_runs.hpp"
#include "mode/mode.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

/// Bodies on springs of their own, of which the first two may be joined; the last one is driven, rubs on the floor, and
/// is a stop for another.
Model random_groups(std::mt19937_64& random, int n) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Model m;
  for (int i = 0; i < n; ++i) {
    m.coordinates.push_back({"x" + std::to_string(i + 1), uniform(0.3, 3)});
    m.springs.push_back({i, ground, uniform(0.3, 5)});
    if (uniform(0, 1) < 0.5) m.dampers.push_back({i, ground, uniform(0, 1)});
  }
  if (n > 2) m.springs.push_back({1, 0, uniform(0.1, 1)});
  m.omega = uniform(0.3, 3);
  m.forces = {{n - 1, 1, uniform(0.5, 2), uniform(0, 6)}};
  m.stops = {{"stop", n > 2 ? 1 : 0, n - 1, uniform(0, 0.5), 0.5}};
  m.frictions = {{"floor", n - 1, ground, 0.0, 0.5, 0.3}};
  return m;
}

/// Windows per unit of the fastest time scale (the inverse of the largest eigenvalue), in the mode that needs most of
/// them.
double windows_per_time_scale(const Model& model) {
  const System system(model);
  double most = 0.0;
  for (ModeId id = 0; id < system.mode_count(); ++id) {
    const mode::Mode& mode = system.compiled().mode(id);
    const double fastest = dense::eigenvalues(mode.system()).cwiseAbs().maxCoeff();
    most = std::max(most, 1.0 / (fastest * mode.window()));
  }
  return most;
}

TEST(Windows, OfUncoupledPartsFollowTheFastestTimeScale) {
  // With 24 terms the series of exp(lambda s) reaches 2^-55 of its largest at lambda s of about 2.
  double worst = 0.0;
  for (int n = 2; n <= 4; ++n) {
    for (std::uint64_t k = 0; k < 40; ++k) {
      std::mt19937_64 random(1000 * static_cast<std::uint64_t>(n) + k);
      const Model model = random_groups(random, n);
      const double windows = windows_per_time_scale(model);
      EXPECT_LE(windows, 1.0) << n << " bodies, model " << k;
      worst = std::max(worst, windows);
    }
  }
  std::printf("at most %.2f windows per unit of the fastest time scale\n", worst);
}

TEST(Windows, DoNotShrinkOverACancellationThatRoundingLeavesAlive) {
  Model m;  // only the stop joins the third body to the others
  m.coordinates = {{"x1", 0.45889161317197841}, {"x2", 0.58361499153201424}, {"x3", 2.4897323854943174}};
  m.springs = {{0, ground, 7.2641652883884289},
               {0, ground, 0.56455685068777561},
               {1, 0, 0.12789157890004291},
               {2, ground, 1.0388477214780489}};
  m.dampers = {{0, ground, 0.93520974818113922}};
  m.omega = 1.9106629771698251;
  m.forces = {{2, 2, 1.8040515572916755, 4.7849296736909137}};
  m.stops = {{"stop", 1, 2, -0.31870955003299062, 1.0}};
  m.frictions = {{"floor", 2, ground, 0.0, 0.68882661157393832, 0.28518057747017883}};
  EXPECT_LE(windows_per_time_scale(m), 1.0);
}

TEST(Windows, AreNoLongerThanAsked) {
  Model m;
  m.coordinates = {{"x", 1.0}};
  m.springs = {{0, ground, 1.0}};
  const double natural = System(m).compiled().mode(0).window();  // the period is 1
  for (const double longest : {1e300, 4.0, 0.5, 1e-3, 1e-6}) {
    const double window = System(m, {longest}).compiled().mode(0).window();
    EXPECT_LE(window, longest);
    EXPECT_GE(window, std::min(natural, longest) * (1 - 0x1p-23));
  }
  for (const double longest : {0.0, -1.0, 1e-9, std::nan("")})
    EXPECT_THROW(System(m, {longest}), InputError) << longest;
}

/// Engine and oracle have the same events; those that are no impacts are `expected`.
void expect_the_oracles_events(const Model& model, const State& state, double time, const std::string& expected) {
  const System system(model);
  Motion motion(system, state);
  const auto engine = testing::engine_events(motion, time, 2000);
  oracle::Oracle exact(model, state);
  const testing::Comparison c = testing::compare(engine, testing::oracle_events(exact, time));
  EXPECT_EQ(c.mismatch, "");
  EXPECT_LE(c.worst, 1e-13);
  std::string kinds;
  for (const testing::Seen& event : engine)
    if (event.kind != "impact") kinds += event.kind + " ";
  EXPECT_EQ(kinds, expected);
}

TEST(HoldingForce, ThatTheStructureMakesZeroNeitherHoldsNorReleases) {
  // the third body touches nothing but the second, which comes to rest on the belt: nothing presses them together then
  Model m;
  m.coordinates = {{"x1", 0.015722146605169445}, {"x2", 0.014169454800815226}, {"x3", 0.05139944145985513}};
  m.springs = {{0, ground, 0.75426315252364817}};
  m.dampers = {{1, 0, 0.012494393648860192}};
  m.forces = {{0, 2, 0.64915647850704783, 1.1163856994708654}, {0, 0, 0.36582364913968313, 0.0}};
  m.stops = {{"stop", 2, 1, -0.40400704450347036, 0.5}};
  m.frictions = {{"belt", 1, ground, -0.27062981282965193, 0.45078558688637771, 0.25997160282329784}};
  m.omega = 0.3717427473512725;
  const State start = {-0.27534698954679182, -0.1316151996544811,  -0.37253584389294303,
                       0.67079429092203346,  -0.77654288839641339, 0.6771826386403057};
  expect_the_oracles_events(m, start, 1.0, "chatter stick ");
  const System system(m);
  Motion motion(system, start);
  const auto events = testing::run(motion, 1.0);
  ASSERT_FALSE(events.empty());
  EXPECT_NEAR(events.back().time.seconds(system.period()), 0.36126370325488, 1e-14);
}

TEST(HoldingForce, OfABodyThatOnlyRidesAlongIsZeroForEver) {
  std::mt19937_64 random(4);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int k = 0; k < 100; ++k) {
    Model m;  // carried by the belt at speed w; the rider touches the carried body and is joined to nothing
    const double w = uniform(-0.5, 0.5);
    m.coordinates = {{"motor", uniform(0.01, 1)}, {"carried", uniform(0.01, 1)}, {"rider", uniform(0.01, 1)}};
    m.springs = {{0, ground, uniform(0.5, 2)}};
    m.dampers = {{1, 0, uniform(0.001, 0.01)}};
    m.forces = {{0, 1, uniform(0.1, 0.5), uniform(0, 6)}};
    m.omega = uniform(0.3, 1);
    m.stops = {{"touch", 2, 1, 0.0, 0.5}};
    m.frictions = {{"belt", 1, ground, w, 1.0, 0.5}};
    const System system(m);
    Motion motion(system, {uniform(-0.1, 0.1), uniform(-0.1, 0.1), 0.25, w, 0.25, w});
    const auto events = testing::run(motion, 20.0, 100);
    EXPECT_EQ(testing::kinds(events), "") << k;
    EXPECT_NEAR(motion.state()[4], 0.25 + 20.0 * w, 1e-13) << k;
  }
}

}  // namespace
}  // namespace slapstick
