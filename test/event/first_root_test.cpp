/// The root kernel on guards whose zeros are known: one test per danger.
#include "event/first_root.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "event/guard_polynomials.hpp"
#include "oracle/real.hpp"

namespace slapstick::event {
namespace {

using oracle::Real;
using testing::Taylor;

Taylor polynomial(std::initializer_list<double> coefficients) {
  Taylor a{};
  std::copy(coefficients.begin(), coefficients.end(), a.begin());
  return a;
}

double size(const Taylor& a) {
  double sum = 0.0;
  for (const double c : a) sum += std::abs(c);
  return sum;
}

Root find(const Taylor& a, int order = 0, double x_end = 1.0) {
  long evaluations = 0;
  return first_root(testing::window(a, order), x_end, evaluations);
}

/// (x - r)^2 + depth.
Taylor valley(double r, double depth) { return polynomial({r * r + depth, -2 * r, 1.0}); }

TEST(FirstRoot, OfAFallingLineIsExact) {
  for (const double r : {0.125, 0.5, 0.875}) {
    const Root root = find(polynomial({r, -1.0}));
    EXPECT_EQ(root.kind, RootKind::crossing);
    EXPECT_EQ(root.x, r);
  }
}

TEST(FirstRoot, OfTwoIsTheFirst) {  // a scan that only looks for a change of sign between the ends sees nothing
  for (int k = 1; k < 22; ++k) {
    const double half = std::ldexp(1.0, -k);
    const Root root = find(valley(0.5, -half * half));
    EXPECT_EQ(root.kind, RootKind::crossing) << k;
    EXPECT_NEAR(root.x, 0.5 - half, 1e-15 / half) << k;
  }
}

TEST(FirstRoot, ExactTouchIsAGrazeWhereverItLies) {
  for (int i = 1; i < 64; ++i) {
    const double r = i / 64.0;
    const Root root = find(valley(r, 0.0));
    EXPECT_EQ(root.kind, RootKind::graze) << r;
    EXPECT_NEAR(root.x, r, 1e-12);
  }
}

TEST(FirstRoot, DepthDecidesHitMissOrGraze) {
  for (int k = 2; k < 60; ++k) {
    const double depth = std::ldexp(1.0, -k), noise = 25 * unit_roundoff * 2 * size(valley(0.5, 0.0));
    const RootKind hit = find(valley(0.5, -depth)).kind, miss = find(valley(0.5, depth)).kind;
    if (depth > noise) {
      EXPECT_EQ(hit, RootKind::crossing) << k;
      EXPECT_EQ(miss, RootKind::none) << k;
    } else if (depth < noise / 16) {
      EXPECT_EQ(hit, RootKind::graze) << k;
      EXPECT_EQ(miss, RootKind::graze) << k;
    }
    EXPECT_NE(hit, RootKind::none) << k;  // below the noise a graze, never a miss
  }
}

TEST(FirstRoot, TripleZeroIsFoundOnceAndNotLate) {
  for (const double r : {0.125, 0.3, 0.5, 0.75}) {
    const Root root = find(polynomial({r * r * r, -3 * r * r, 3 * r, -1.0}));
    EXPECT_NE(root.kind, RootKind::none);
    EXPECT_NEAR(root.x, r, 1e-4);  // the noise's cube root
    EXPECT_LE(root.x, r + 1e-4);
  }
}

TEST(FirstRoot, StartThatIsAZeroIsNotFoundAgain) {
  for (int order = 1; order <= 5; ++order) {
    for (const double r : {1e-12, 1e-6, 0.125, 0.75, 2.0}) {  // x^p (r - x)
      Taylor a{};
      a[order] = r;
      a[order + 1] = -1.0;
      const Root root = find(a, order);
      EXPECT_EQ(root.kind, r <= 1.0 ? RootKind::crossing : RootKind::none) << order << " " << r;
      EXPECT_NEAR(root.x, std::min(r, 1.0), 4 * 0x1p-52 * r) << order;
    }
  }
}

TEST(FirstRoot, AfterAStartThatIsAZeroNearGrazesKeepTheirNoise) {  // order 2 and 3 were once searched without any
  for (int order = 1; order <= 4; ++order) {
    for (const double depth : {1e-17, -1e-17, 3e-17, -3e-17}) {
      const Taylor g = valley(0.5, depth);
      Taylor a{};
      for (int n = 0; n < 3; ++n) a[n + order] = g[n];
      EXPECT_EQ(find(a, order).kind, RootKind::graze) << order << " " << depth;
    }
  }
}

TEST(FirstRoot,
     TinyLeadingCoefficientIsNoGrazeAtTheStart) {  // a release just where the force turns: a_2 = 1e-16, a_3 = 1
  for (int order = 1; order <= 4; ++order) {
    for (const double leading : {1e-14, 1e-16, 1e-30}) {
      Taylor a{};
      a[order] = leading;
      a[order + 1] = 1.0;
      const Root root = find(a, order);
      EXPECT_EQ(root.kind, RootKind::none) << order << " " << leading << " " << root.x;
    }
  }
}

TEST(FirstRoot, FallingGuardWithoutAZeroAfterAStartThatIsOne) {  // the quotient has one Bernstein coefficient less
  for (int order = 1; order <= 3; ++order) {
    Taylor a{};
    a[order] = 1.0;
    a[order + 1] = -1.0 + 0x1p-20;
    EXPECT_EQ(find(a, order).kind, RootKind::none) << order;
    a[order + 1] = -1.0 - 0x1p-20;
    EXPECT_EQ(find(a, order).kind, RootKind::crossing) << order;
  }
}

TEST(FirstRoot, ZeroBeyondTheEndIsNotReported) {
  const Taylor a = polynomial({0.5, -1.0});
  EXPECT_EQ(find(a, 0, 0.25).kind, RootKind::none);
  EXPECT_EQ(find(a, 0, 0.5 - 0x1p-40).kind, RootKind::none);
  EXPECT_EQ(find(a, 0, 0.5 + 0x1p-40).kind, RootKind::crossing);
  EXPECT_EQ(find(valley(0.5, 0.0), 0, 0.25).kind, RootKind::none);
  EXPECT_EQ(find(valley(0.5, -1e-10), 0, 0.499).kind, RootKind::none);
  EXPECT_EQ(find(valley(0.5, -1e-10), 0, 0.499995).kind, RootKind::crossing);
}

TEST(FirstRoot, ZeroAtTheEndItselfIsReported) {  // half-open (0, x_end]
  EXPECT_EQ(find(polynomial({0.5, -1.0}), 0, 0.5).kind, RootKind::crossing);
  const Root last = find(polynomial({1.0, -1.0}));  // at the window's own end: left to a window that has it inside
  EXPECT_EQ(last.kind, RootKind::restart);
  EXPECT_GT(last.x, 0.5);
  EXPECT_LT(last.x, 1.0);
}

TEST(FirstRoot, GuardThatCreepsAlongItsNoiseIsNotRestartedByTinySteps) {  // a window would never end
  int restarts = 0, lingering = 0;
  for (int k = 1; k <= 7; ++k) {
    for (const double floor : {2.0, 4.0, 7.0}) {
      for (const double start : {9.0, 12.0, 30.0, 100.0}) {
        // In units of the noise: (start - floor) (1 - x)^k + floor, positive all over the window.
        Taylor a{};
        double binomial = 1.0;
        for (int n = 0; n <= k; ++n) {
          a[n] = (start - floor) * (n % 2 == 0 ? binomial : -binomial);
          binomial *= static_cast<double>(k - n) / (n + 1);
        }
        a[0] += floor;
        long evaluations = 0;
        const Root root = first_root(testing::window(a, 0, 1.0 / (25 * unit_roundoff)), 1.0, evaluations);
        EXPECT_TRUE(root.kind == RootKind::none || root.kind == RootKind::restart) << k << " " << floor << " " << start;
        const bool restart = root.kind == RootKind::restart;
        EXPECT_TRUE(!restart || root.x >= 0.25) << root.x << " for " << k << " " << floor << " " << start;
        restarts += restart ? 1 : 0;
        lingering += root.lingers ? 1 : 0;
      }
    }
  }
  EXPECT_GE(restarts, 10);
  EXPECT_GE(lingering, 10);
}

TEST(FirstRoot, SimpleZerosAndMissesAreCheap) {
  long evaluations = 0, cases = 0;
  for (int i = 1; i < 100; ++i, ++cases) {
    const double r = 0.01 * i;
    const Taylor a = polynomial({r * (2 - r), -2 * (1 - r) - r * (2 - r), 1.0 + 0.5 * (1 - r), -0.5});
    first_root(testing::window(a), 1.0, evaluations);
  }
  EXPECT_LE(evaluations, 8 * cases);
}

TEST(Excluded, NeedsEveryCoefficientAboveTheError) {
  Hull hull = testing::window(polynomial({1.0})).hull;
  hull.bounds[hull_error] = 0.25;
  EXPECT_TRUE(excluded(hull));
  for (int j = 0; j < 8; ++j) {
    Hull low = hull;
    low.bernstein[j] = 0.25;
    EXPECT_FALSE(excluded(low)) << j;
    low.bernstein[j] = NAN;
    EXPECT_FALSE(excluded(low)) << j;
  }
}

/// Values and two derivatives of a polynomial given by Bernstein coefficients of degree 7, by de Casteljau's scheme.
std::array<Real, 3> casteljau(const Lane8& bernstein, const Real& x) {
  std::vector<Real> b;
  for (int j = 0; j < 8; ++j) b.emplace_back(bernstein[j]);
  std::array<Real, 3> out;
  for (int degree_left = 7; degree_left > 0; --degree_left) {
    if (degree_left == 2) out[2] = 42 * (b[2] - 2 * b[1] + b[0]);
    if (degree_left == 1) out[1] = 7 * (b[1] - b[0]);
    for (int j = 0; j < degree_left; ++j) b[j] += x * (b[j + 1] - b[j]);
  }
  out[0] = b[0];
  return out;
}

TEST(Hull, EnclosesValueSlopeAndCurvatureAndIsSharp) {
  testing::RandomGuards random(9);
  double worst[3] = {};
  for (int i = 0; i < 2000; ++i) {
    const Taylor a = random.damped_sinusoids();
    const Hull hull = testing::window(a).hull;
    for (const double x : {0.0, random.uniform(0, 1), random.uniform(0, 1), 1.0}) {
      const auto near = casteljau(hull.bernstein, Real(x));
      Real exact[3] = {0, 0, 0};
      for (int n = terms - 1; n >= 0; --n) {
        exact[2] = exact[2] * x + 2 * exact[1];
        exact[1] = exact[1] * x + exact[0];
        exact[0] = exact[0] * x + Real(a[n]);
      }
      for (int k = 0; k < 3; ++k)
        worst[k] = std::max(worst[k], abs(near[k] - exact[k]).convert_to<double>() / hull.bounds[k]);
    }
    EXPECT_LT(hull.bounds[hull_error], 3e-5 * size(a));
  }
  for (const double ratio : worst) {
    EXPECT_LE(ratio, 1.0);
    EXPECT_GE(ratio, 0.2) << "the bound is empty";
  }
}

TEST(Hull, OfAPolynomialOfDegreeSevenHasNoErrorButRounding) {
  Taylor a{};
  for (int n = 0; n < 8; ++n) a[n] = n % 2 == 0 ? 1.0 : -2.0;
  EXPECT_LT(testing::window(a).hull.bounds[hull_error], 1e-12);
}

TEST(Value, RoundingStaysWithinItsBoundAndTheBoundIsNotEmpty) {
  testing::RandomGuards random(7);
  double largest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Taylor a = random.damped_sinusoids();
    const double x = i % 5 == 0 ? 1.0 : random.uniform(0, 1);
    Coefficients c;
    double scale = 0.0, power = 1.0;
    for (int n = 0; n < terms; ++n, power *= x) c[n / 8][n % 8] = a[n], scale += std::abs(a[n]) * power;
    const double error = abs(Real(value(c, Powers(x))) - testing::evaluate<Real>(a, Real(x))).convert_to<double>();
    largest = std::max(largest, error / (8 * unit_roundoff * scale));
  }
  EXPECT_LE(largest, 1.0);
  EXPECT_GE(largest, 0.05);
}

}  // namespace
}  // namespace slapstick::event
