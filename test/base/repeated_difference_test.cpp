/// Subtractions that are done many at once must be those done one by one, rounding by rounding.
#include "base/repeated_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace slapstick {
namespace {

struct Left {
  double s;
  std::int64_t count;
  bool operator==(const Left& other) const { return s == other.s && count == other.count; }
};

Left one_by_one(double s, double h) {
  std::int64_t count = 0;
  for (; s > h; s -= h) ++count;
  return {s, count};
}

Left at_once(double s, double h) {
  const std::int64_t count = subtract_repeatedly(s, h);
  return {s, count};
}

void expect_same(double s, double h) {
  const Left found = at_once(s, h), expected = one_by_one(s, h);
  EXPECT_TRUE(found == expected) << s << " by " << h << ": " << found.s << " after " << found.count << ", not "
                                 << expected.s << " after " << expected.count;
}

TEST(RepeatedDifference, OfNumbersWithoutCommonBitsRoundsAsOneByOne) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> digits(0.5, 1.0), magnitude(-1.0, 13.0);
  for (int i = 0; i < 3000; ++i) {
    const double h = digits(random);
    expect_same(h * std::exp2(magnitude(random)), h);
  }
}

/// h is an odd multiple of half an ulp of s: every difference in that binade is a tie.
TEST(RepeatedDifference, ThatIsATieRoundsToEvenAsOneByOne) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    const int scale = 5 + i % 8;
    const double half_ulp = std::ldexp(1.0, scale - 53);
    const double h = half_ulp * static_cast<double>(random() >> (12 + i % 14) | 1),
                 s = std::ldexp(1.0, scale) + 2 * half_ulp * static_cast<double>(random() >> 12);
    if (s / h < 1e5) expect_same(s, h);
  }
}

TEST(RepeatedDifference, ThatEndsBesideAPowerOfTwoTakesTheFinerUlpBelow) {
  for (const double h : {0.3, 0.7, 1.0, 1.1, std::sqrt(2.0)}) {
    for (int k = 1; k < 3000; ++k) {
      const double s = 1024.0 + k * h;
      for (const double near : {std::nextafter(s, 0.0), s, std::nextafter(s, 1e9)}) expect_same(near, h);
    }
  }
}

TEST(RepeatedDifference, OfSoManyThatOneByOneWouldTakeDaysIsDoneAtOnce) {
  double s = 0x1p50;
  EXPECT_EQ(subtract_repeatedly(s, 1.0), (std::int64_t{1} << 50) - 1);
  EXPECT_EQ(s, 1.0);
  s = 0.25;
  EXPECT_EQ(subtract_repeatedly(s, 0.25), 0);
  EXPECT_EQ(s, 0.25);
}

}  // namespace
}  // namespace slapstick
