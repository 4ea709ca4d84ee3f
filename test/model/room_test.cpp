/// Stops that no position obeys are refused, and only those.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "slapstick/base/error.hpp"
#include "slapstick/model/model.hpp"

namespace slapstick {
namespace {

std::string refusal(const Model& model) {
  try {
    validate(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

Model bodies(int count) {
  Model m;
  for (int i = 0; i < count; ++i) m.coordinates.push_back({"x" + std::to_string(i), 1.0});
  return m;
}

/// Two bodies between two walls: left wall, gap between them, right wall.
Model between_walls(double left, double middle, double right) {
  Model m = bodies(2);
  m.stops = {{"left", ground, 0, left, 0.5}, {"middle", 0, 1, middle, 0.5}, {"right", 1, ground, right, 0.5}};
  return m;
}

TEST(Room, LoopsOfStopsThatCannotAllBeObeyedAreNamed) {
  EXPECT_EQ(
      refusal(between_walls(1.0, -2.5, 1.0)),
      "stop 'right': clearance = 1 leaves no room in the loop of stops 'left', 'middle', 'right': their clearances "
      "add up to -0.5, which must not be negative");
  EXPECT_EQ(refusal(between_walls(1.0, -2.0, 1.0)), "accepted");  // just fits in
  EXPECT_EQ(refusal(between_walls(0.0, 0.0, 0.0)), "accepted");
  EXPECT_NE(refusal(between_walls(0.0, 0.0, -1e-300)), "accepted");
}

TEST(Room, ClearancesThatAddUpButForRoundingAreEnough) {
  EXPECT_EQ(refusal(between_walls(0.1, 0.2, -0.3)), "accepted");
  EXPECT_EQ(refusal(between_walls(-0.1, -0.2, 0.3)), "accepted");  // the sum in doubles is below zero
  EXPECT_NE(refusal(between_walls(-0.1, -0.2, 0.3 - 1e-14)), "accepted");
}

TEST(Room, OfALoopFarAwayIsNotJudgedByItsDistance) {
  Model m = between_walls(-0.1, -0.2, 0.3);
  for (Stop& stop : m.stops)
    for (int* end : {&stop.a, &stop.b})
      if (*end == ground) *end = 2;  // the loop's wall is a body ..
  m.coordinates.push_back({"wall", 1.0});
  m.stops.push_back({"far", 2, ground, -1e12, 0.5});  // .. far from the ground
  EXPECT_EQ(refusal(m), "accepted");
  m.stops[2].clearance = 0.25;
  EXPECT_EQ(refusal(m).rfind(
                "stop 'right': clearance = 0.25 leaves no room in the loop of stops 'left', 'middle', 'right'", 0),
            0U);
}

TEST(Room, IsThereIfAndOnlyIfSomePositionObeysAllStops) {
  std::mt19937_64 random(8);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int loops = 0;
  for (int k = 0; k < 2000; ++k) {
    const int n = std::uniform_int_distribution<int>(3, 9)(random);
    Model m = bodies(n);
    std::vector<double> x(static_cast<std::size_t>(n));
    for (double& place : x) place = uniform(-1, 1);
    const auto at = [&](int end) { return end == ground ? 0.0 : x[static_cast<std::size_t>(end)]; };
    std::vector<int> around(static_cast<std::size_t>(n));  // a loop through some bodies and the ground, and other stops
    for (int i = 0; i < n; ++i) around[static_cast<std::size_t>(i)] = i;
    std::shuffle(around.begin(), around.end(), random);
    around.resize(static_cast<std::size_t>(std::uniform_int_distribution<int>(2, n)(random)));
    around.push_back(ground);
    double slack = 0.0;
    for (std::size_t i = 0; i < around.size(); ++i) {
      const int a = around[i], b = around[(i + 1) % around.size()];
      const double more = uniform(0.001, 0.1);
      slack += more;
      m.stops.push_back({"s" + std::to_string(i), a, b, at(a) - at(b) + more, 0.5});
    }
    for (int i = 0; i < n; ++i) {
      const int a = std::uniform_int_distribution<int>(0, n - 1)(random), b = (a + 1 + i % (n - 1)) % n;
      m.stops.push_back({"t" + std::to_string(i), a, b, at(a) - at(b) + uniform(0.001, 1.0), 0.5});
    }
    std::shuffle(m.stops.begin(), m.stops.end(), random);
    ASSERT_EQ(refusal(m), "accepted") << k;
    Stop& tight = *std::find_if(m.stops.begin(), m.stops.end(), [](const Stop& stop) { return stop.name == "s1"; });
    tight.clearance -= slack + 1e-12;
    const std::string message = refusal(m);
    EXPECT_NE(message.find("'s1'"), std::string::npos) << k << ": " << message;
    loops += message.find("loop") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(loops, 1000);
}

}  // namespace
}  // namespace slapstick
