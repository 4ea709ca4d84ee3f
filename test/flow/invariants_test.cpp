/// What holds for every motion: bits, memory, balances, bounds, mirror images. K numbers are those of shared/reliability.md.
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

TEST(Impact, KeepsMomentumAndLosesTheKnownEnergy) {  // K40
  const System system(oracle::vibro_impact(2.2));
  Motion motion(system, start);
  int impacts = 0;
  while (impacts < 200 && motion.advance({1000, 0.0}) == Outcome::event) {
    if (motion.event().kind != EventKind::impact) continue;
    ++impacts;
    const auto b = motion.before();
    const State a = motion.state();
    const double before = b[1] + 10 * b[3], after = a[1] + 10 * a[3], size = std::abs(b[1]) + std::abs(10 * b[3]);
    EXPECT_NEAR(after, before, 2 * 0x1p-52 * size);
    const double w = motion.event().w;
    EXPECT_EQ(motion.extended()[0], 0.0) << "the gap is zero";
    EXPECT_EQ(motion.extended()[2], -0.8 * w) << "w+ = -r w-";
    const double lost = 0.5 * (b[1] * b[1] + 10 * b[3] * b[3] - a[1] * a[1] - 10 * a[3] * a[3]);
    EXPECT_NEAR(lost, 0.5 * (10.0 / 11) * (1 - 0.8 * 0.8) * w * w, 1e-15 * (1 + b[1] * b[1] + 10 * b[3] * b[3]));
  }
  EXPECT_EQ(impacts, 200);
}

/// Gauss-Legendre nodes and weights of order eight on [-1, 1].
constexpr double node[4] = {0.18343464249564981, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
constexpr double weight[4] = {0.36268378337836198, 0.31370664587788729, 0.22238103445337448, 0.10122853629037626};

TEST(Segment, WorkOfTheForcesIsTheChangeOfEnergy) {  // K40
  for (const double omega : frequencies) {
    const System system(oracle::vibro_impact(omega));
    Motion motion(system, start);
    State x(4);
    for (int n = 0; n < 60 && motion.advance({100, 0.0}) == Outcome::event; ++n) {
      const Motion::Segment segment = motion.segment();
      if (segment.duration == 0.0) continue;
      const int sign = static_cast<int>(system.mode(segment.mode).states().frictions[0]);
      const auto energy = [&](double s) {
        motion.sample(s, x);
        const double y = x[0] - x[2];
        return 0.5 * (x[1] * x[1] + 10 * x[3] * x[3] + y * y + 5 * x[2] * x[2]);
      };
      const auto power = [&](double s) {
        motion.sample(s, x);
        const double t = 2 * 3.14159265358979323846 * segment.start.fraction + omega * s, w = x[1] - x[3];
        return std::sin(t) * x[1] - 0.2 * w * w - x[3] * x[3] - sign * 0.15 * w;
      };
      const int pieces = 1 + static_cast<int>(segment.duration * 4 * (1 + omega));
      const double half = 0.5 * segment.duration / pieces;
      double work = 0.0;
      for (int i = 0; i < pieces; ++i) {
        for (int k = 0; k < 4; ++k)
          work += half * weight[k] * (power((2 * i + 1 + node[k]) * half) + power((2 * i + 1 - node[k]) * half));
      }
      EXPECT_NEAR(energy(segment.duration) - energy(0.0), work, 1e-13) << omega << " segment " << n;
    }
  }
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

/// The model with every coordinate turned round: x -> -x.
Model mirrored(Model m) {
  for (Force& force : m.forces) force.amplitude = -force.amplitude;
  for (Stop& stop : m.stops) std::swap(stop.a, stop.b);
  for (FrictionContact& contact : m.frictions) contact.belt_speed = -contact.belt_speed;
  return m;
}

TEST(Mirror, HasMirroredBits) {  // K39
  for (const double omega : frequencies) {
    const System system(oracle::vibro_impact(omega)), image(mirrored(oracle::vibro_impact(omega)));
    Motion motion(system, start), mirror(image, {0.5, -0.0, -0.0, -0.0});
    for (int i = 0; i < 300; ++i) {
      ASSERT_EQ(motion.advance({200, 0.0}), mirror.advance({200, 0.0}));
      ASSERT_EQ(motion.event().time, mirror.event().time) << omega << " event " << i;
      const State a = motion.state(), b = mirror.state();
      for (int k = 0; k < 4; ++k) ASSERT_EQ(a[k], -b[k]) << omega << " event " << i;
    }
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

TEST(Event, IsNeverBeforeTheOneBefore) {
  for (const double omega : frequencies) {
    const System system(oracle::vibro_impact(omega));
    Motion motion(system, start);
    Instant last{};
    int at_once = 0;
    while (motion.advance({60, 0.0}) == Outcome::event) {
      ASSERT_GE(motion.event().time, last);
      at_once = motion.event().time == last ? at_once + 1 : 0;
      EXPECT_LE(at_once, 4) << "K7: transitions at one instant";
      last = motion.event().time;
    }
  }
}

}  // namespace
}  // namespace slapstick
