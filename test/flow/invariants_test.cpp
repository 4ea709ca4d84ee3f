/// What holds for every motion: bits, memory, bounds, conventions. Balances and mirror images are in ../catalogue (K38 to K40).
#include <gtest/gtest.h>

#include <algorithm>

#include "flow/runs.hpp"
#include "oracle/models.hpp"

extern long allocations;  // count_allocations.cpp

namespace slapstick {
namespace {

const State start{-0.5, 0, 0, 0};
const double frequencies[] = {0.552, 1.5, 2.2, 4.801, 4.9};

TEST(Motion, AllocatesNothingWhileItMoves) {
  for (const double omega : frequencies) {
    const System system(oracle::vibro_impact(omega));
    Motion motion(system, start);
    State out(4);
    const long before = allocations;
    long events = 0;
    while (motion.advance({50, 0.0}) == Outcome::event) {
      ++events;
      motion.state(out);
      motion.sample(0.5 * motion.segment().duration, out);
      static_cast<void>(motion.before());
    }
    EXPECT_EQ(allocations, before) << omega;
    EXPECT_GT(events, 40);
  }
}

TEST(Motion, HasTheSameBitsEveryTime) {
  for (const double omega : frequencies) {
    const System one(oracle::vibro_impact(omega)), other(oracle::vibro_impact(omega));
    Motion a(one, start), b(other, start);
    for (int i = 0; i < 300; ++i) {
      ASSERT_EQ(a.advance({200, 0.0}), b.advance({200, 0.0}));
      ASSERT_EQ(a.event().time, b.event().time);
      ASSERT_EQ(a.event().w, b.event().w);
      ASSERT_EQ(a.state(), b.state());
    }
  }
}

TEST(Compiler, DoesNotContractAProductAndASum) {
  volatile double a = 1 + 0x1p-30, b = 1 - 0x1p-30, c = -1.0;
  EXPECT_EQ(a * b + c, 0.0);  // fused it would be -2^-60
  event::Coefficients p{};
  p[0][0] = c, p[1][0] = a;
  EXPECT_EQ(event::value(p, event::Powers(1.0)), a - 1.0);
}

TEST(Gap, IsNeverPenetratedAndStickIsWithinItsForce) {
  for (const double omega : frequencies) {
    const System system(oracle::vibro_impact(omega));
    Motion motion(system, start);
    State x(4);
    double deepest = 0.0, strongest = 0.0;
    while (motion.advance({40, 0.0}) == Outcome::event) {
      const Motion::Segment segment = motion.segment();
      const mode::ContactStates& states = system.mode(segment.mode).states();
      for (int i = 0; i <= 16; ++i) {
        const double s = segment.duration * i / 16;
        motion.sample(s, x);
        const double y = x[0] - x[2], phase = 2 * 3.14159265358979323846 * segment.start.fraction + omega * s;
        deepest = std::max(deepest, y);
        if (states.frictions[0] != mode::FrictionState::stick) continue;
        EXPECT_EQ(x[1], x[3]);
        const double f0 = (10 * std::sin(phase) + x[3] + 5 * x[2]) / 11 - y;  // equation (6)
        const bool closed = states.stops[0] == mode::StopState::closed;
        strongest = std::max(strongest, closed ? -f0 : std::abs(f0));
      }
    }
    EXPECT_LE(deepest, 2e-15) << omega;
    EXPECT_LE(strongest, 0.15 + 2e-15) << omega;
  }
}

TEST(Mirror, OrientationOfAFrictionContactIsAConvention) {
  Model turned = oracle::vibro_impact(1.5);
  std::swap(turned.frictions[0].a, turned.frictions[0].b);
  const System system(oracle::vibro_impact(1.5)), other(turned);
  Motion a(system, start), b(other, start);
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(a.advance({200, 0.0}), b.advance({200, 0.0}));
    ASSERT_EQ(a.event().time, b.event().time);
    ASSERT_EQ(a.state(), b.state());
    const std::string_view kind = name(a.event().kind);
    ASSERT_EQ(name(b.event().kind), kind == "slip+" ? "slip-" : kind == "slip-" ? "slip+" : kind);
  }
}

}  // namespace
}  // namespace slapstick
