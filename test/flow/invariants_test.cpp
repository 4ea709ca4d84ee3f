/// What holds for every motion: bits and memory. Balances, bounds and mirror images are in ../property, and in
/// ../catalogue (K38 to K40).
#include <gtest/gtest.h>

#include <algorithm>

#include "event/first_root.hpp"
#include "flow/runs.hpp"
#include "oracle/models.hpp"

extern long allocations;  // count_allocations.cpp

namespace slapstick {
namespace {

const State start{-0.5, 0, 0, 0};
const double frequencies[] = {0.552, 1.5, 2.2, 4.801, 4.9};

TEST(Motion, AllocatesNothingOnceItsModesAreMet) {
  for (const double omega : frequencies) {
    const System system(oracle::vibro_impact(omega));
    Motion motion(system, start), scout = motion;
    while (scout.advance({50, 0.0}) == Outcome::event) {
    }
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

}  // namespace
}  // namespace slapstick
