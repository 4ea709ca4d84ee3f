/// Sums over exponentials: the grid against the definition, and the transform against its own.
#include "quantity/line_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace slapstick::test {
namespace {

using Complex = std::complex<double>;

/// By the definition, with the phase reduced in each term.
Complex defined(const std::vector<double>& c, const std::vector<double>& turns, std::size_t k) {
  Complex sum;
  for (std::size_t j = 0; j < c.size(); ++j) {
    const double turn = turns[j] * static_cast<double>(k), angle = 2.0 * std::numbers::pi * (turn - std::round(turn));
    sum += c[j] * Complex(std::cos(angle), -std::sin(angle));
  }
  return sum;
}

/// Terms at random instants, at the ends of the grid and on its points; few lines are summed directly, many by the
/// grid.
TEST(LineSums, AreTheirDefinitionForFewAndForManyLines) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const std::size_t count : {1U, 12U, 13U, 300U, 1025U}) {
    std::vector<double> c, turns;
    double size = 0.0;
    for (int j = 0; j < 500; ++j) {
      turns.push_back(j == 0 ? 0.0 : j == 1 ? 1.0 - 0x1p-40 : j == 2 ? 0.25 : j == 3 ? 1.0 / 8192.0 : uniform(random));
      c.push_back(uniform(random) - 0.3);
      size += std::abs(c.back());
    }
    quantity::LineSums sums(3.0, count);
    for (std::size_t j = 0; j < c.size(); ++j) sums.add(c[j], 3.0 * (turns[j] + static_cast<double>(j % 5) - 2.0));
    const auto found = sums.take();
    ASSERT_EQ(found.size(), count);
    for (std::size_t k = 0; k < count; k += count < 60 ? 1 : 7)
      // an instant of five periods is known to eps of it, and a line k turns k times
      EXPECT_LT(std::abs(found[k] - defined(c, turns, k)), (2e-14 + 1.5e-15 * static_cast<double>(k)) * size)
          << count << " " << k;
  }
}

TEST(LineSums, BeginAnewAfterTheyAreTaken) {
  for (const std::size_t count : {10U, 100U}) {
    quantity::LineSums sums(1.0, count);
    sums.add(1.0, 0.3);
    (void)sums.take();
    sums.add(2.0, 0.0);
    for (const Complex& one : sums.take()) EXPECT_LT(std::abs(one - 2.0), 1e-13);
  }
}

/// Two transforms in a row are the reversed numbers times N.
TEST(LineSums, TheTransformTurnedTwiceIsTheSequenceReversed) {
  std::vector<Complex> x;
  for (int k = 0; k < 64; ++k) x.emplace_back(std::cos(1.7 * k), k % 3);
  const auto before = x;
  quantity::fourier_transform(x);
  quantity::fourier_transform(x);
  for (std::size_t k = 0; k < 64; ++k) EXPECT_LT(std::abs(x[k] - 64.0 * before[(64 - k) % 64]), 1e-11);
}

}  // namespace
}  // namespace slapstick::test
