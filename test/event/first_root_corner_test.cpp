/// Guards made so that the root kernel takes its rarest turns: `./dev coverage` lists those that no other test takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "event/first_root.hpp"
#include "event/guard_polynomials.hpp"
#include "oracle/real.hpp"

namespace slapstick::event {
namespace {

using testing::Taylor;

Taylor polynomial(std::initializer_list<double> coefficients) {
  Taylor a{};
  std::copy(coefficients.begin(), coefficients.end(), a.begin());
  return a;
}

/// The polynomial of degree 7 with these Bernstein coefficients; exact for integers.
Taylor from_bernstein(std::array<double, 8> b) {
  Taylor a{};
  double choose = 1.0;  // C(7, n) times the n-th difference
  for (int n = 0; n < 8; ++n) {
    a[n] = choose * b[0];
    for (int j = 0; j + 1 < 8 - n; ++j) b[j] = b[j + 1] - b[j];
    choose *= static_cast<double>(7 - n) / (n + 1);
  }
  return a;
}

/// (r - x)^k.
Taylor power(double r, int k) {
  Taylor a = polynomial({1.0});
  for (int m = 0; m < k; ++m)
    for (int n = k; n >= 0; --n) a[n] = r * a[n] - (n > 0 ? a[n - 1] : 0.0);
  return a;
}

TEST(FirstRootCorner, AWalkThroughNoiseThatWouldNotEndBeginsANewWindow) {
  GuardWindow guard = testing::window(polynomial({1e-15}));
  guard.hull.bounds[noise_0] = 1e-13;
  guard.hull.bounds[curvature_noise] = 1.0;  // steps of sqrt(4e-13)
  long evaluations = 0;
  const Root root = first_root(guard, 1.0, evaluations);
  EXPECT_EQ(root.kind, RootKind::restart);
  EXPECT_NEAR(root.x, 65'536 * std::sqrt(4e-13), 1e-5);
  EXPECT_LE(evaluations, 65'600);
}

TEST(FirstRootCorner,
     AMinimumOfFourthOrderIsFoundAsWellAsItsSlopeSays) {  // Newton's steps on (x - r)^3 win a third each
  for (const double r : {0.25, 0.375, 0.5, 0.625, 0.75}) {
    const Taylor a = polynomial({std::pow(r, 4), -4 * std::pow(r, 3), 6 * r * r, -4 * r, 1.0});
    long evaluations = 0;
    const Root root = first_root(testing::window(a), 1.0, evaluations);
    EXPECT_EQ(root.kind, RootKind::graze) << r;
    EXPECT_NEAR(root.x, r, 1e-3) << r;  // the band of noise is (25 u)^(1/4) wide
  }
}

TEST(FirstRootCorner, AMinimumThatIsRoundingAllAroundEndsTheSearchForIt) {
  // The band is |x - r| < 9^(-1/4) r; the slope 4 (x - r)^3 is nothing but rounding over a millionth of that, where
  // bisection never settles.
  for (const double r : {0.125, 0.25, 0.5}) {
    const Taylor a = power(r, 4);
    long evaluations = 0;
    const Root root = first_root(testing::window(a, 0, a[0] / 9 / (25 * unit_roundoff)), 1.0, evaluations);
    EXPECT_EQ(root.kind, RootKind::graze) << r;
    EXPECT_NEAR(root.x, r, std::cbrt(8 * unit_roundoff) * 2 * r);
    EXPECT_LE(evaluations, 100) << r;
  }
}

TEST(FirstRootCorner, ATerraceThrowsHalleysStepOutOfTheWindowAndTheZeroIsFoundAllTheSame) {
  // Falling steps of 7, 1, 1, 1, 14, 1, 1: on the terrace the slope is small and its change too.
  for (const auto& b : {std::array<double, 8>{15, 8, 7, 6, 5, -9, -10, -11}, {9, 6, 5, 4, 3, -3, -18, -19}}) {
    const Taylor a = from_bernstein(b);
    long evaluations = 0;
    const Root root = first_root(testing::window(a), 1.0, evaluations);
    const auto exact = testing::Reference<oracle::Real>(a, oracle::Real("1e-44")).first();
    ASSERT_TRUE(exact);
    EXPECT_EQ(root.kind, RootKind::crossing);
    EXPECT_FALSE(root.falls) << "Halley's iteration has settled: the guard is not the one wanted";
    EXPECT_NEAR(root.x, exact->convert_to<double>(), 1e-14);
  }
}

TEST(HullCorner, ThreadsThatMeetInTheFirstCallHaveOneTable) {  // each test is a process of its own under ctest
  constexpr int count = 8;
  const Taylor a = from_bernstein({8, 7, 6, 5, 4, 3, 2, 1});
  std::atomic<int> ready{0};
  std::array<Hull, count> hulls;
  std::vector<std::thread> threads;
  for (Hull& hull : hulls)
    threads.emplace_back([&a, &hull, &ready] {
      for (++ready; ready < count;) {  // all begin at once
      }
      hull = enclose(a.data(), a.data(), 8, unit_roundoff);
    });
  for (std::thread& thread : threads) thread.join();
  for (const Hull& hull : hulls)
    for (int j = 0; j < 8; ++j) EXPECT_NEAR(hull.bernstein[j], 8.0 - j, 1e-13);
}

/// g'' is a small Chebyshev polynomial, whose coefficients are not small.
TEST(FirstRootCorner, CoefficientsThatCancelAreBoundedByTheHullInstead) {
  const double chebyshev[] = {1, -72, 840, -3584, 6912, -6144, 2048}, eps = 1e-14;
  Taylor a = polynomial({1.0, 0.0});
  for (int n = 2; n < 9; ++n) a[n] = eps * chebyshev[n - 2] / (n * (n - 1));
  long evaluations = 0;
  const Root root = first_root(testing::window(a), 1.0, evaluations);
  EXPECT_EQ(root.kind, RootKind::none);
  EXPECT_EQ(root.x, 1.0);
  EXPECT_EQ(evaluations, 0) << "one step is enough with the hull's curvature";
}

}  // namespace
}  // namespace slapstick::event
