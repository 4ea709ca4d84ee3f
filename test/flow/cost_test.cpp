/// What a motion and a new parameter value cost, in counts: they are the same on every machine, and no other program
/// can disturb them as it can a time. Times and ratios are the benchmark's (bench/, docs/explanation/performance.md).
#include <gtest/gtest.h>

#include "flow/runs.hpp"
#include "oracle/models.hpp"

extern long allocations;  // count_allocations.cpp

namespace slapstick {
namespace {

const State start{-0.5, 0, 0, 0};

/// Per forcing period, after 50 periods: what 2000 periods take at most. The counts of 2026-11-25 and half a per cent.
struct Cost {
  double omega, windows, evaluations;
};
constexpr Cost most[] = {{2.2, 4.02, 6.03}, {1.5, 6.04, 15.08}, {4.9, 4.81, 8.38}, {0.552, 45.3, 142.8}};

TEST(Cost, OfAPeriodIsNoMoreWindowsAndEvaluationsThanItWas) {
  constexpr int settled = 50, periods = 2000;
  for (const Cost& cost : most) {
    const System system(oracle::vibro_impact(cost.omega));
    Motion motion(system, start);
    const auto run = [&](std::int64_t end) {
      while (motion.advance({end, 0.0}) == Outcome::event) {
      }
      return motion.counters();
    };
    const Counters from = run(settled), to = run(settled + periods);
    const double windows = static_cast<double>(to.windows - from.windows) / periods;
    const double evaluations = static_cast<double>(to.evaluations - from.evaluations) / periods;
    std::printf("omega %g: %.4f windows, %.4f evaluations a period\n", cost.omega, windows, evaluations);
    EXPECT_LE(windows, cost.windows) << cost.omega;
    EXPECT_LE(evaluations, cost.evaluations) << cost.omega;
  }
}

/// The modes that a System has built.
int built(const System& system) {
  int count = 0;
  for (ModeId id = 0; id < system.mode_count(); ++id) count += system.compiled().known_mode(id) != nullptr;
  return count;
}

TEST(Cost, OfANewParameterValueIsOneModeAndThoseThatAreMet) {
  const System system(oracle::vibro_impact(2.2));
  EXPECT_EQ(built(system), 1);
  Motion motion(system, start);
  while (motion.advance({50, 0.0}) == Outcome::event) {
  }
  EXPECT_EQ(built(system), 3);  // the stop never closes there
}

TEST(Cost, OfAModeIsFewAllocationsWhateverItsSize) {
  const auto of_a_mode = [](int coordinates) {
    Model model;
    model.omega = 1.3;
    for (int i = 0; i < coordinates; ++i) {
      model.coordinates.push_back({"x" + std::to_string(i), 1.0});
      model.springs.push_back({i, i - 1, 4.0});
    }
    model.forces.push_back({0, 1, 1.0, 0.0});
    model.frictions.push_back({"pad", 0, ground, 0.0, 0.2, 0.15});
    const mode::Frame frame(model);
    mode::ContactStates slip;
    slip.frictions.push_back(mode::FrictionState::slip_plus);
    const mode::Mode once(model, frame, slip);
    const long before = allocations;
    const mode::Mode again(model, frame, slip);
    return allocations - before;
  };
  const long small = of_a_mode(2), large = of_a_mode(10);
  std::printf("allocations by operator new of a mode: %ld with 2 coordinates, %ld with 10\n", small, large);
  EXPECT_LE(small, 20);
  EXPECT_LE(large, small + 2);
}

}  // namespace
}  // namespace slapstick
