/// Exponents of a batch's lanes: closed forms, the tangents of a Motion, the same bits for all widths, and a motion
/// that does not change for being asked.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>
#include <numbers>
#include <random>

#include "batch/same_events.hpp"
#include "property/machine.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/tangent.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;
using Runs = std::vector<test::Machine>;

std::vector<BatchRun> run(const Runs& all, const BatchPlan& plan, int lanes = 0, int threads = 1) {
  sweep::BatchProblem problem;
  problem.count = all.size();
  problem.model_at = [&](std::size_t i) { return all[i].model; };
  problem.start_at = [&](std::size_t i) { return all[i].start; };
  problem.plan = plan;
  problem.lanes = lanes;
  problem.threads = threads;
  return run_batch(problem).runs;
}

BatchRun run_one(const Model& model, const State& start, const BatchPlan& plan) {
  return run({{model, start}}, plan).front();
}

Runs paper(std::size_t count, double least_omega, double most_omega) {
  static const ModelDefinition definition = load_model("vibro-impact");
  std::mt19937_64 random(125);
  const auto between = [&](double a, double b) { return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53; };
  Runs all;
  for (std::size_t i = 0; i < count; ++i) {
    const double omega = between(least_omega, most_omega), friction = between(0.05, 0.3);
    all.push_back({definition.build({{"omega", omega}, {"friction", friction}}), {-0.5, 0.0, between(-0.1, 0.1), 0.0}});
  }
  return all;
}

/// The definition of BatchRun::exponent, by a TangentMotion that is normalised at every period.
double exponent_of_tangents(const test::Machine& machine, int transient, int periods) {
  const auto size = static_cast<Eigen::Index>(machine.start.size());
  Eigen::MatrixXd delta(size, 1);
  for (Eigen::Index i = 0; i < size; ++i) delta(i, 0) = 1.0 / (1.0 + static_cast<double>(i));
  TangentMotion motion(System(machine.model), machine.start, delta);
  double growth = 0.0;
  for (int k = 0; k < transient + periods; ++k) {
    if (k == transient) growth = 0.0;
    const double before = motion.tangents().norm();
    while (motion.advance({k + 1, 0.0}) == Outcome::event) {
    }
    const double after = motion.tangents().norm();
    growth += std::log(after / before);
    if (after > 0.0) motion.set_tangents(motion.tangents() / after);
  }
  return growth / periods;
}

/// x'' + 2 D x' + x = cos(omega t) far from its stop: D = 2 has the real exponents -2 +- sqrt(3); below 1 the tangent
/// turns by half a turn in a period at omega = 2 sqrt(1 - D^2) and shrinks by exp(-D T).
TEST(BatchExponent, IsThatOfALinearOscillator) {
  const ModelDefinition definition = load_model("impact-oscillator");
  for (const double omega : {0.7, 2.0, 9.0}) {
    const BatchRun found = run_one(definition.build({{"damping_ratio", 2.0}, {"omega", omega}, {"clearance", 50.0}}),
                                   {0.1, 0.0}, {.transient_periods = 30, .periods = 40, .exponent = true});
    ASSERT_TRUE(found.in_lanes);
    const double T = 2.0 * pi / omega;
    EXPECT_NEAR(found.exponent, (std::sqrt(3.0) - 2.0) * T, 1e-13 * T);
  }
  const double D = 0.1, omega = 2.0 * std::sqrt(1.0 - D * D);
  const BatchRun found = run_one(definition.build({{"damping_ratio", D}, {"omega", omega}, {"clearance", 50.0}}),
                                 {0.1, 0.0}, {.periods = 100, .exponent = true});
  EXPECT_NEAR(found.exponent, -D * 2.0 * pi / omega, 1e-13);
}

/// One bounce a period on a shaken table: the multipliers are the roots of mu^2 - s mu + r^2 with
/// s = 1 + r^2 - (1 + r)^2 a sin(phi), where the table is at phase phi at the impact, cos(phi) = pi (1 - r) / (a
/// (1 + r)).
TEST(BatchExponent, IsTheLogarithmOfTheLargestMultiplierOfABouncingCycle) {
  const double a = 1.49, r = 0.5, phi = std::acos(pi * (1.0 - r) / (a * (1.0 + r))),
               s = 1.0 + r * r - (1.0 + r) * (1.0 + r) * a * std::sin(phi);
  const double largest = 0.5 * (std::abs(s) + std::sqrt(s * s - 4.0 * r * r));
  const double later = 1.0, V = pi;  // the start is `later` after an impact, that leaves at g T / 2
  const State start = {a * std::sin(phi) + V * later - 0.5 * later * later - a * std::sin(phi + later),
                       V - later - a * std::cos(phi + later)};
  const Model model = load_model("shaken-table").build({{"acceleration", a}, {"phase", phi + later}});
  const BatchRun found = run_one(model, start, {.transient_periods = 200, .periods = 300, .exponent = true});
  ASSERT_TRUE(found.in_lanes);
  EXPECT_EQ(found.impacts, 300);
  EXPECT_EQ(found.motion_events, 0);
  EXPECT_NEAR(found.exponent, std::log(largest), 1e-11);
}

/// A ball whose chatter is complete rests on its floor: both of its directions are lost.
TEST(BatchExponent, IsMinusInfinityWhereEveryDirectionIsLost) {
  const BatchRun found = run_one(load_model("bouncing-ball").build(), {0.7, 0.0}, {.periods = 60, .exponent = true});
  ASSERT_TRUE(found.in_lanes);
  EXPECT_EQ(found.exponent, -INFINITY);
}

/// Stable motions forget their errors; a chaotic one parts from the Motion's, and its exponent with it.
void expect_the_exponents_of_tangents(const Runs& all, int transient, int periods, double bound,
                                      std::size_t least_compared) {
  const std::vector<BatchRun> found = run(all, {.transient_periods = transient, .periods = periods, .exponent = true});
  std::size_t compared = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!found[i].done || !found[i].in_lanes) continue;
    double expected = 0.0;
    try {
      expected = exponent_of_tangents(all[i], transient, periods);
    } catch (const NumericalError&) {
      continue;
    }
    if (!(expected < -0.01)) continue;
    ++compared;
    if (!std::isfinite(expected)) {
      EXPECT_EQ(found[i].exponent, expected) << "run " << i;
      continue;
    }
    worst = std::max(worst, std::abs(found[i].exponent - expected));
    EXPECT_NEAR(found[i].exponent, expected, bound)
        << "run " << i << " of " << all[i].model.name << ", seed " << all[i].seed;
  }
  testing::Test::RecordProperty("worst", std::to_string(worst));
  std::cout << compared << " compared, worst " << worst << "\n";
  EXPECT_GE(compared, least_compared);
}

TEST(BatchExponent, IsThatOfAMotionsTangents) {
  expect_the_exponents_of_tangents(paper(60, 1.0, 6.0), 150, 50, 1e-9, 20);
}

TEST(BatchExponent, IsThatOfAMotionsTangentsThroughChatter) {
  expect_the_exponents_of_tangents(paper(16, 0.4, 1.0), 20, 10, 1e-9, 5);
}

/// No start sticks: of such a start a lane leaves out what is held, a TangentMotion keeps the momentum.
TEST(BatchExponent, IsThatOfAMotionsTangentsForRandomMachines) {
  const test::Shape shape{.most_coordinates = 4, .loops = false, .at_rest = false};
  Runs all;
  for (std::uint64_t seed = 1; seed <= 240; ++seed) all.push_back(test::random_machine(seed, shape));
  expect_the_exponents_of_tangents(all, 4, 12, 1e-9, 20);
}

TEST(BatchExponent, OfAModelThatNoLaneCanRunIsThatOfAMotionsTangents) {
  const ModelDefinition definition = load_model("two-sided-rattle");
  const test::Machine one{definition.build(), definition.start()};
  const BatchRun found = run_one(one.model, one.start, {.transient_periods = 10, .periods = 20, .exponent = true});
  EXPECT_FALSE(found.in_lanes);
  EXPECT_NEAR(found.exponent, exponent_of_tangents(one, 10, 20), 1e-12);
}

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(BatchExponent, HasTheSameBitsForEveryWidthOrderAndNumberOfThreads) {
  const Runs all = paper(40, 0.5, 6.0), reversed(all.rbegin(), all.rend());
  const BatchPlan plan{.transient_periods = 5, .periods = 25, .exponent = true};
  const std::vector<BatchRun> reference = run(all, plan, 1);
  for (const int lanes : {4, 8})
    for (const int threads : {1, 3}) {
      const std::vector<BatchRun> found = run(reversed, plan, lanes, threads);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const BatchRun &one = found[all.size() - 1 - i], &other = reference[i];
        ASSERT_TRUE(same(one.exponent, other.exponent))
            << lanes << " lanes, run " << i << ": " << one.exponent << ", " << other.exponent;
        ASSERT_EQ(one.end, other.end);
      }
    }
}

TEST(BatchExponent, IsAskedForWithoutChangingTheMotion) {
  const Runs all = paper(40, 0.5, 6.0);
  const std::vector<BatchRun> plain = run(all, {.transient_periods = 5, .periods = 25}),
                              asked = run(all, {.transient_periods = 5, .periods = 25, .exponent = true});
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(plain[i].end, asked[i].end);
    EXPECT_TRUE(same(plain[i].speeds, asked[i].speeds));
    EXPECT_EQ(plain[i].exponent, 0.0);
  }
}

}  // namespace
}  // namespace slapstick
