/// Refinement of pictures whose kinds are known at every pixel: what is filled in must be right wherever refinement.hpp
/// promises it, and few pixels may be computed.
#include "sweep/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace slapstick::sweep {
namespace {

struct Picture {
  int columns, rows;
  std::vector<int> kinds;
  [[nodiscard]] int size() const { return columns * rows; }
};

Picture drawn(int columns, int rows, const std::function<int(int, int)>& kind_at) {
  Picture picture{columns, rows, {}};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) picture.kinds.push_back(kind_at(x, y));
  return picture;
}

struct Refined {
  std::vector<bool> computed;
  std::vector<std::int32_t> sources;
  [[nodiscard]] long count() const { return std::count(computed.begin(), computed.end(), true); }
};

Refined refined(const Picture& picture, int cell) {
  Refinement refinement(picture.columns, picture.rows, cell);
  Refined result{std::vector<bool>(picture.kinds.size()), {}};
  for (auto wanted = refinement.wanted(); !wanted.empty(); wanted = refinement.wanted()) {
    for (const std::int32_t pixel : wanted) {
      EXPECT_FALSE(result.computed[pixel]) << "wanted twice";
      result.computed[pixel] = true;
      refinement.set(pixel, picture.kinds[pixel]);
    }
  }
  result.sources = refinement.sources();
  return result;
}

std::vector<int> neighbours(const Picture& picture, int pixel) {
  std::vector<int> all;
  const int x = pixel % picture.columns, y = pixel / picture.columns;
  if (x > 0) all.push_back(pixel - 1);
  if (x + 1 < picture.columns) all.push_back(pixel + 1);
  if (y > 0) all.push_back(pixel - picture.columns);
  if (y + 1 < picture.rows) all.push_back(pixel + picture.columns);
  return all;
}

/// Pixels whose region has a computed pixel: spread from these inside of their kinds.
std::vector<bool> reached(const Picture& picture, const std::vector<bool>& computed) {
  std::vector<bool> reached = computed;
  std::vector<int> front;
  for (int pixel = 0; pixel < picture.size(); ++pixel)
    if (computed[pixel]) front.push_back(pixel);
  while (!front.empty()) {
    const int pixel = front.back();
    front.pop_back();
    for (const int next : neighbours(picture, pixel)) {
      if (reached[next] || picture.kinds[next] != picture.kinds[pixel]) continue;
      reached[next] = true;
      front.push_back(next);
    }
  }
  return reached;
}

/// @returns how many filled pixels are wrong
int expect_the_promise(const Picture& picture, int cell) {
  const Refined result = refined(picture, cell);
  const std::vector<bool> known = reached(picture, result.computed);
  int wrong = 0;
  for (int pixel = 0; pixel < picture.size(); ++pixel) {
    const int source = result.sources[pixel];
    EXPECT_TRUE(result.computed[source]);
    if (result.computed[pixel]) {
      EXPECT_EQ(source, pixel);
    }
    if (known[pixel]) {
      EXPECT_EQ(picture.kinds[source], picture.kinds[pixel]) << pixel;
    }
    wrong += picture.kinds[source] != picture.kinds[pixel] ? 1 : 0;
    for (const int next : neighbours(picture, pixel)) {
      const bool boundary = picture.kinds[source] != picture.kinds[result.sources[next]];
      EXPECT_TRUE(!boundary || (result.computed[pixel] && result.computed[next]))
          << "a boundary that is only filled in";
    }
  }
  return wrong;
}

/// Regions of many forms: the signs of sums of waves.
Picture waves(int columns, int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-0.4, 0.4);
  double a[6];
  for (double& one : a) one = number(random);
  return drawn(columns, rows, [&](int x, int y) {
    const double u = std::sin(a[0] * x + a[1] * y) + std::sin(a[2] * x * 0.5 + a[3] * y + 1.0);
    return (u > 0.3 ? 1 : 0) + (std::cos(a[4] * x - a[5] * y) > 0.5 ? 2 : 0);
  });
}

TEST(Refinement, IsWrongOnlyWhereNoPixelOfARegionIsComputed) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const int columns = 1 + static_cast<int>(seed * 37 % 90), rows = 1 + static_cast<int>(seed * 53 % 71);
    for (const int cell : {2, 3, 8, 16, 200}) expect_the_promise(waves(columns, rows, seed), cell);
  }
}

/// Noise is where nothing can be spared.
TEST(Refinement, NoiseIsComputedWhereItIsMet) {
  std::mt19937 random(3);
  const Picture picture = drawn(65, 65, [&](int x, int) { return x < 33 ? 7 : static_cast<int>(random() % 3); });
  EXPECT_EQ(expect_the_promise(picture, 8), 0);
  const Refined result = refined(picture, 8);
  long left = 0;
  for (int pixel = 0; pixel < picture.size(); ++pixel) left += pixel % 65 < 24 && result.computed[pixel] ? 1 : 0;
  EXPECT_EQ(left, 3 * 9) << "only the coarse grid where all is alike";
}

/// A thin region that one pixel of the coarse grid meets is followed to its end.
TEST(Refinement, AThinRegionIsFollowedFromWhereItIsMet) {
  const auto line = [](int x, int y) { return x > 0 && x < 128 && std::abs(y - 16 - (x - 16) * 3 / 7) < 1 ? 1 : 0; };
  const Picture picture = drawn(129, 129, line);
  EXPECT_EQ(expect_the_promise(picture, 16), 0);
}

/// Not seen, and it is said so: an island between the pixels of the coarse grid.
TEST(Refinement, AnIslandBetweenCoarsePixelsIsMissed) {
  const Picture picture = drawn(33, 33, [](int x, int y) { return std::hypot(x - 8.0, y - 8.0) < 4.0 ? 1 : 0; });
  EXPECT_EQ(expect_the_promise(picture, 4), 0);
  EXPECT_GT(expect_the_promise(picture, 16), 0);
}

/// The price of an edge: pixels computed grow with the length of boundaries, not with the area.
TEST(Refinement, CostsItsEdges) {
  const auto disc = [](int size) {
    return drawn(size, size,
                 [size](int x, int y) { return std::hypot(x - 0.5 * size, y - 0.5 * size) < 0.3 * size ? 1 : 0; });
  };
  const long coarse = refined(disc(513), 16).count(), fine = refined(disc(1025), 16).count();
  const auto nodes = [](long size) { return (size / 16 + 1) * (size / 16 + 1); };
  const double ratio = static_cast<double>(fine - nodes(1025)) / static_cast<double>(coarse - nodes(513));
  EXPECT_NEAR(ratio, 2.0, 0.1);
  EXPECT_LT(static_cast<double>(fine), 0.02 * 1025 * 1025);
}

}  // namespace
}  // namespace slapstick::sweep
