/// Guards made so that the root kernel takes its rarest turns: `./dev coverage` lists those that no other test takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "event/guard_polynomials.hpp"
#include "slapstick/event/first_root.hpp"

namespace slapstick::event {
namespace {

using testing::Taylor;

Taylor polynomial(std::initializer_list<double> coefficients) {
  Taylor a{};
  std::copy(coefficients.begin(), coefficients.end(), a.begin());
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

TEST(
    FirstRootCorner,
    CoefficientsThatCancelAreBoundedByTheHullInstead) {  // g'' is a small Chebyshev polynomial: its coefficients are not
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
