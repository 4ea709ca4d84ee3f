#include "section/creep_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace slapstick {
namespace {

/// The verdict on points (0.5, value(k)).
template <class Value>
std::optional<CreepWatch::Creep> verdict(long long points, const Value& value) {
  CreepWatch watch(points, 2);
  for (long long k = 0; k < points; ++k) watch.add(std::array<double, 2>{0.5, value(static_cast<double>(k))});
  return watch.verdict();
}

TEST(creep_watch, a_slow_approach_is_named_with_its_ratio) {
  const auto found = verdict(1001, [](double k) { return 3.0 - std::pow(0.998, k); });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->number, 1u);
  EXPECT_NEAR(found->ratio, std::pow(0.998, 250), 1e-12);
}

TEST(creep_watch, a_cycle_whose_points_creep_in_lines_of_their_own_is_not_missed) {
  for (const int n : {2, 3, 5, 8}) {
    EXPECT_TRUE(verdict(1000, [n](double k) {
      const double place = std::fmod(k, n);
      return place + (place - 0.5) * std::pow(0.998, k);
    })) << n;
  }
}

TEST(creep_watch, points_that_have_arrived_are_no_creep) {
  EXPECT_FALSE(verdict(1000, [](double k) { return 3.0 - std::pow(0.9, k); }));
  EXPECT_FALSE(verdict(1000, [](double) { return 3.0; }));
  EXPECT_FALSE(verdict(1000, [](double k) { return 3.0 + 1e-9 * std::pow(0.998, k); }));
}

TEST(creep_watch, a_motion_that_advances_steadily_is_no_creep) {
  EXPECT_FALSE(verdict(1000, [](double k) { return 0.25 * k; }));
}

TEST(creep_watch, rotations_and_chaos_are_no_creep) {
  for (int i = 1; i < 1000; ++i) {
    const double rotation = 2.0 * std::numbers::pi * (std::numbers::phi - 1.0) * i;
    EXPECT_FALSE(verdict(1000, [&](double k) { return std::cos(rotation * k); })) << i;
  }
  double x = 0.3;
  EXPECT_FALSE(verdict(1000, [&](double) { return x = 4.0 * x * (1.0 - x); }));
}

TEST(creep_watch, too_few_points_give_no_verdict) {
  EXPECT_FALSE(verdict(63, [](double k) { return std::pow(0.99, k); }));
  CreepWatch watch(1000, 1);
  for (int k = 0; k < 500; ++k) watch.add(std::array<double, 1>{std::pow(0.998, k)});
  EXPECT_FALSE(watch.verdict());
}

}  // namespace
}  // namespace slapstick
