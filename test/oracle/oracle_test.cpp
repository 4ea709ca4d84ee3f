/// The reference solution against closed forms. Case numbers K are those of test/catalogue/catalogue.json.
#include "oracle/oracle.hpp"

#include <gtest/gtest.h>

#include "oracle/models.hpp"

namespace slapstick::oracle {
namespace {

const Real fine("1e-40");

void expect_near(const Real& value, const Real& expected, const Real& tolerance = fine) {
  EXPECT_LE(abs(value - expected), tolerance) << value.str(45) << " instead of " << expected.str(45);
}

Real power_of_two(int exponent) { return ldexp(Real(1), exponent); }

TEST(Ball, BouncesInAGeometricSeriesAndRestsAtItsLimit) {  // K18
  Oracle oracle(ball(0.5), {0.0, 1.0});
  const std::vector<OracleEvent> events = oracle.run(Real(10));
  ASSERT_GT(events.size(), 60u);
  for (std::size_t n = 0; n + 1 < events.size(); ++n) {
    EXPECT_EQ(events[n].kind, "impact");
    expect_near(events[n].time, 4 - power_of_two(1 - static_cast<int>(n)));
    expect_near(events[n].w, power_of_two(-static_cast<int>(n)));
  }
  EXPECT_EQ(events.back().kind, "chatter");
  expect_near(events.back().time, Real(4));
  EXPECT_TRUE(oracle.closed());
  expect_near(oracle.stop_force(), Real(1));
  expect_near(oracle.state()[0], Real(0));
  EXPECT_EQ(oracle.time(), Real(10));
}

TEST(Ball, KeepsItsHeightWithoutLoss) {  // K23
  Oracle oracle(ball(1.0), {0.0, 1.0});
  const std::vector<OracleEvent> events = oracle.run(Real(41));
  ASSERT_EQ(events.size(), 20u);
  for (std::size_t n = 0; n < events.size(); ++n) expect_near(events[n].time, Real(2 * (static_cast<int>(n) + 1)));
}

TEST(Ball, StaysDownWithoutRestitution) {  // K22
  Oracle oracle(ball(0.0), {0.0, 1.0});
  const std::vector<OracleEvent> events = oracle.run(Real(10));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "impact");
  EXPECT_TRUE(oracle.closed());
}

TEST(CosineBall, ChattersToRestAndIsReleasedWhenTheForceTurns) {  // K19
  const double measured[2] = {0.40725, 1.18689};
  for (const int i : {0, 1}) {
    Oracle oracle(cosine_ball(i == 0 ? 0.5 : 0.8), {0.0, 0.1}, 0.25);
    const Real start = pi() / 2;
    std::vector<OracleEvent> events = oracle.run(start + 2);
    ASSERT_GT(events.size(), 2u);
    EXPECT_EQ(events.back().kind, "release");
    expect_near(events.back().time - start, pi() / 2);
    EXPECT_EQ(events[events.size() - 2].kind, "chatter");
    expect_near(events[events.size() - 2].time - start, Real(measured[i]), Real(1e-5));
  }
}

TEST(CosineBall, LeavesAfterAFiniteBurst) {  // K20: 11 impacts, then the force lifts the ball
  Oracle oracle(cosine_ball(0.85), {0.0, 0.1}, 0.25);
  const std::vector<OracleEvent> events = oracle.run(pi() / 2 + 3);
  EXPECT_EQ(events.size(), 11u);
  for (const OracleEvent& e : events) EXPECT_EQ(e.kind, "impact");
}

TEST(CosineBall, ImpactsFollowTheLocalClosedForm) {  // v s - 2 cos t sin^2(s/2) + sin t (s - sin s) = 0
  Oracle oracle(cosine_ball(0.5), {0.0, 0.1}, 0.25);
  Real t = oracle.time(), v = Real(0.1);
  for (int n = 0; n < 20; ++n) {
    const auto event = oracle.next(t + 1);
    ASSERT_TRUE(event);
    const Real s = event->time - t, local = t - pi() / 2;
    expect_near(v * s - 2 * cos(local) * pow(sin(s / 2), 2) + sin(local) * (s - sin(s)), Real(0));
    expect_near(event->w, sin(local + s) - sin(local) - v);
    t = event->time, v = oracle.state()[1];
  }
}

TEST(Graze, ReportsOneTouchWithoutImpulse) {  // K1
  Oracle oracle(oscillator_with_stop(1.0), {0.0, 1.0});
  const std::vector<OracleEvent> events = oracle.run(Real(6));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "graze");
  expect_near(events[0].time, pi() / 2);
  EXPECT_FALSE(oracle.closed());
  expect_near(oracle.state()[0], sin(Real(6)));
}

TEST(Graze, DecidesHitAndMissNearby) {  // K2, K3
  for (const double delta : {1e-2, 1e-5, 1e-10, 1.0 / (1LL << 52)}) {
    const double low = 1 - delta;
    Oracle hit(oscillator_with_stop(low), {0.0, 1.0});
    const auto event = hit.next(Real(2));
    ASSERT_TRUE(event);
    EXPECT_EQ(event->kind, "impact");
    expect_near(event->time, asin(Real(low)), Real("1e-38"));
    expect_near(event->w, sqrt(1 - Real(low) * Real(low)), Real("1e-38"));
    EXPECT_FALSE(Oracle(oscillator_with_stop(1 + delta), {0.0, 1.0}).next(Real(6)));
  }
}

TEST(Coulomb, AmplitudeFallsByTwiceTheFrictionPerHalfPeriod) {  // K14
  Oracle oracle(friction_oscillator(0.1, 0.1), {1.0, 0.0});
  const std::vector<OracleEvent> events = oracle.run(Real(100));
  ASSERT_EQ(events.size(), 5u);
  for (int n = 1; n <= 5; ++n) {
    const OracleEvent& e = events[static_cast<std::size_t>(n - 1)];
    EXPECT_EQ(e.kind, n == 5 ? "stick" : n % 2 == 1 ? "slip+" : "slip-");
    expect_near(e.time, n * pi());
    expect_near(e.before[0], (n % 2 == 1 ? -1 : 1) * (1 - 2 * n * Real(0.1)));
  }
}

TEST(Coulomb, SticksAtEquality) {  // K13
  Oracle equal(friction_oscillator(0.125, 0.125), {1.125, 0.0});
  const std::vector<OracleEvent> events = equal.run(Real(100));
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events.back().kind, "stick");
  expect_near(events.back().time, 4 * pi());
  expect_near(equal.state()[0], Real(0.125));
  expect_near(equal.holding_force(), Real(-0.125));
  Oracle beyond(friction_oscillator(0.125, 0.125), {1.125 + 1.0 / (1LL << 40), 0.0});
  EXPECT_EQ(beyond.run(Real(100)).size(), 5u);
}

TEST(Coulomb, ReleaseFollowsTheClosedForm) {  // K15: f0 = A sin(t/2) - x reaches f_s at x = 0
  const Real f_s(0.2), f_k(0.1), A(0.5), omega(0.5);
  Oracle oracle(friction_oscillator(0.2, 0.1, 0.5, 0.5), {0.0, 0.0});
  EXPECT_TRUE(oracle.sticking());
  const auto release = oracle.next(Real(10));
  ASSERT_TRUE(release);
  EXPECT_EQ(release->kind, "release");
  const Real t0 = asin(f_s / A) / omega;
  expect_near(release->time, t0);
  EXPECT_EQ(oracle.slip_sign(), 1);
  // x'' + x = A sin(omega t) - f_k from rest at x = 0.
  const Real p = A / (1 - omega * omega), c = f_k - p * sin(omega * t0), d = -p * omega * cos(omega * t0);
  const auto v = [&](const Real& t) { return p * omega * cos(omega * t) - c * sin(t - t0) + d * cos(t - t0); };
  const auto reversal = oracle.next(Real(10));
  ASSERT_TRUE(reversal);
  const Real t = reversal->time;
  expect_near(v(t), Real(0));
  expect_near(reversal->before[0], -f_k + p * sin(omega * t) + c * cos(t - t0) + d * sin(t - t0));
}

TEST(Coulomb, ATangentialHoldingForceReleasesNothing) {  // K12
  Oracle tangent(friction_oscillator(0.125, 0.125, 0.125), {0.0, 0.0});
  EXPECT_TRUE(tangent.run(Real(60)).empty());
  const double above = 0.125 + 1.0 / (1LL << 55);
  Oracle crossing(friction_oscillator(0.125, 0.125, above), {0.0, 0.0});
  const auto event = crossing.next(Real(10));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, "release");
  expect_near(event->time, asin(Real(0.125) / Real(above)), Real("1e-35"));
}

Model friction_and_stop(double clearance) {
  Model m = friction_oscillator(0.125, 0.125);
  m.stops = {{"wall", 0, ground, clearance, 0.5}};
  return m;
}

TEST(ContactAndReversal, AtOnceAreOneEventWithoutImpulse) {  // K5
  Oracle oracle(friction_and_stop(0.75), {-1.0, 0.0});
  std::vector<OracleEvent> events = oracle.run(Real(7));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, "graze");
  expect_near(events[0].time, pi());
  EXPECT_EQ(events[1].kind, "slip+");
  expect_near(events[1].time, 2 * pi());
  expect_near(events[1].before[0], Real(-0.5));
  for (const int side : {-1, 1}) {
    Oracle nearby(friction_and_stop(0.75 * (1 + side * std::ldexp(1.0, -50))), {-1.0, 0.0});
    events = nearby.run(Real(7));
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].kind, side < 0 ? "impact" : "slip-");
    expect_near(events[1].before[0], Real(-0.5), Real(1e-7));
  }
}

TEST(Start, IsDecidedByTheFirstNonZeroDerivative) {  // K6: x'' + x = A sin t on a wall at b
  struct Case {
    double b, v, amplitude;
    bool closed;
    std::size_t at_once;
  };
  for (const Case& c : {Case{1, -1, 0, false, 0}, Case{1, 1, 0, false, 1}, Case{1, 0, 0, false, 0},
                        Case{-1, 0, 0, true, 0}, Case{0, 0, -1, false, 0}, Case{0, 0, 1, true, 0}}) {
    Oracle oracle(oscillator_with_stop(c.b, 0.5, c.amplitude), {c.b, c.v});
    const std::size_t at_once = oracle.run(Real(1e-6)).size();
    EXPECT_EQ(at_once, c.at_once);
    EXPECT_EQ(oracle.closed(), c.closed) << c.b << " " << c.v << " " << c.amplitude;
  }
}

}  // namespace
}  // namespace slapstick::oracle
