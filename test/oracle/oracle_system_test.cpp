/// The reference solution on the paper's oscillator and on systems with two coordinates: laws of conservation, the
/// closed stop, an independent integration, and single segments.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "oracle/models.hpp"
#include "oracle/oracle.hpp"

namespace slapstick::oracle {
namespace {

const Real fine("1e-40");

void expect_near(const Real& value, const Real& expected, const Real& tolerance = fine) {
  EXPECT_LE(abs(value - expected), tolerance) << value.str(45) << " instead of " << expected.str(45);
}

TEST(Linear, SteadyStateRepeats) {  // x = |G| sin(omega t + arg G), G = 1 / (1 - omega^2 + i c omega)
  const double omega = 2.5, c = 0.25;
  const Real re = 1 - Real(omega) * Real(omega), im = Real(c) * Real(omega), size2 = re * re + im * im;
  // G = (re - i im) / size2; x = (re sin - im cos) / size2
  Oracle oracle(oscillator_with_stop(100.0, 0.5, 1.0, omega, c), Vector{-im / size2, re * Real(omega) / size2},
                Real(0));
  EXPECT_TRUE(oracle.run(20 * oracle.period()).empty());
  expect_near(oracle.state()[0], -im / size2);
  expect_near(oracle.state()[1], re * Real(omega) / size2);
}

TEST(Linear, ResonanceGrowsLinearly) {  // K27: x = (sin t - t cos t) / 2
  Oracle oracle(oscillator_with_stop(1000.0, 0.5, 1.0, 1.0), {0.0, 0.0});
  const Real t(50);
  oracle.run(t);
  expect_near(oracle.state()[0], (sin(t) - t * cos(t)) / 2);
  expect_near(oracle.state()[1], t * sin(t) / 2);
}

TEST(Impact, KeepsMomentumAndLosesTheKnownEnergy) {  // K40
  Oracle oracle(vibro_impact(2.2), {-0.5, 0.0, 0.0, 0.0});
  int impacts = 0;
  while (const auto event = oracle.next(8 * oracle.period())) {
    if (event->kind != "impact") continue;
    ++impacts;
    const Vector& b = event->before;
    const Vector a = oracle.state();
    const Real r(0.8), reduced = Real(10) / 11;
    expect_near(a[1] + 10 * a[3], b[1] + 10 * b[3]);
    expect_near(b[1] - b[3], event->w);
    const Real lost = (b[1] * b[1] + 10 * b[3] * b[3] - a[1] * a[1] - 10 * a[3] * a[3]) / 2;
    expect_near(lost, reduced * (1 - r * r) * event->w * event->w / 2);
  }
  EXPECT_GT(impacts, 6);
}

using Point = std::array<double, 4>;

// Equation (2) of the paper as printed, for slip with sign s.
Point slip_equation(const Point& q, double t, double omega, double s) {
  const auto [x1, v1, x2, v2] = q;
  const double xi = 0.1, mu_m = 10, mu_k = 5, mu_c = 5, f_k = 0.15;
  return {v1, -2 * xi * (v1 - v2) - (x1 - x2) + std::sin(omega * t) - s * f_k, v2,
          (2 * xi * v1 - 2 * xi * (1 + mu_c) * v2 + x1 - (1 + mu_k) * x2 + s * f_k) / mu_m};
}

Point runge_kutta(Point q, double t, double h, double omega, double s) {
  const auto plus = [](Point p, const Point& k, double c) {
    for (std::size_t i = 0; i < 4; ++i) p[i] += c * k[i];
    return p;
  };
  const Point k1 = slip_equation(q, t, omega, s), k2 = slip_equation(plus(q, k1, h / 2), t + h / 2, omega, s),
              k3 = slip_equation(plus(q, k2, h / 2), t + h / 2, omega, s),
              k4 = slip_equation(plus(q, k3, h), t + h, omega, s);
  for (std::size_t i = 0; i < 4; ++i) q[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return q;
}

TEST(Slip, AgreesWithRungeKuttaOnThePrintedEquation) {
  for (const double omega : {0.552, 1.5, 2.2, 4.9}) {
    Oracle oracle(vibro_impact(omega), {-0.5, 0.0, 0.0, 0.0});
    Point q{-0.5, 0, 0, 0};
    double t = 0;
    for (int n = 0; n < 4; ++n) {
      const double sign = oracle.slip_sign();
      const auto event = oracle.next(Real(20));
      ASSERT_TRUE(event);
      if (sign == 0) break;
      const double end = event->time.convert_to<double>(), h = (end - t) / 4000;
      for (int i = 0; i < 4000; ++i) q = runge_kutta(q, t + i * h, h, omega, sign);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(q[i], event->before[i].convert_to<double>(), 1e-11);
      const Vector after = oracle.state();
      for (std::size_t i = 0; i < 4; ++i) q[i] = after[i].convert_to<double>();
      t = end;
    }
  }
}

TEST(ClosedStop, HoldsWhileTheForceGrowsAndLetsGoAtMinusStaticFriction) {  // K10, K11
  const double omega = 0.552;
  Oracle oracle(vibro_impact(omega), {0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(oracle.sticking() && oracle.closed());
  Real largest = 0;
  std::optional<OracleEvent> event;
  for (Real t("0.1"); !event; t += Real("0.1")) {
    event = oracle.next(t);
    if (!event) largest = std::max<Real>(largest, oracle.holding_force());
    if (!event) expect_near(oracle.stop_force(), std::max<Real>(Real(0), Real(oracle.holding_force() - Real(0.15))));
    ASSERT_LT(t, 20);
  }
  EXPECT_GT(largest, Real(0.15));
  EXPECT_EQ(event->kind, "release");
  EXPECT_EQ(event->contact, "stop");
  EXPECT_EQ(oracle.slip_sign(), -1);
  // Equation (6) with x1 = x2: f0 = (mu_m sin(omega t) + 2 xi mu_c v2 + mu_k x2) / (1 + mu_m).
  const Vector& q = event->before;
  expect_near(q[0], q[2]);
  expect_near((10 * sin(Real(omega) * event->time) + Real(2 * 0.1 * 5) * q[3] + 5 * q[2]) / 11, -Real(0.15));
}

TEST(ClosedStop, ChatterEndsInStickOnTheStop) {
  Oracle oracle(vibro_impact(0.552), {-0.5, 0.0, 0.0, 0.0});
  std::optional<OracleEvent> event;
  Real previous = -1, interval = 0, ratio = 0;
  while ((event = oracle.next(Real(10))) && event->kind != "chatter") {
    if (event->kind != "impact") continue;
    if (interval > 0) ratio = (event->time - previous) / interval;
    interval = event->time - previous, previous = event->time;
  }
  ASSERT_TRUE(event);
  EXPECT_TRUE(oracle.sticking() && oracle.closed());
  // Impact speeds scale by r sqrt((R - F)/(R + F)), R = 1.1 f0, F = 1.1 f_k.
  const Real f0 = oracle.holding_force(), f_k(0.15);
  expect_near(ratio, Real(0.8) * sqrt((f0 - f_k) / (f0 + f_k)), Real("1e-18"));
  expect_near(oracle.state()[1], oracle.state()[3]);
}

/// Two blocks stuck on each other by friction, pressed against a wall that stops the first one only.
Model third_body() {
  Model m;
  m.coordinates = {{"x1", 1.0}, {"x2", 2.0}};
  m.forces = {{0, 0, 1.0, 0.0}};
  m.frictions = {{"blocks", 0, 1, 0.0, 0.75, 0.75}};
  m.stops = {{"wall", 0, ground, 1.0, 0.5}};
  return m;
}

TEST(ThirdBody, ImpactSlipsTheStuckPairAndTheChatterClosesTheStop) {  // K9, wall variant
  Oracle oracle(third_body(), {0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(oracle.sticking());
  auto event = oracle.next(Real(10));  // x = t^2 / 6 = 1
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, "impact");
  expect_near(event->time, sqrt(Real(6)));
  EXPECT_EQ(oracle.slip_sign(), -1);
  // The bounces of block 1 end while block 2 still slides on, braked by 0.75 / 2.
  std::string kinds;
  while ((event = oracle.next(Real(20)))) kinds += event->kind + " ";
  EXPECT_NE(kinds.find("chatter"), std::string::npos) << kinds;
  EXPECT_TRUE(oracle.closed() && oracle.sticking()) << kinds;
  expect_near(oracle.state()[1], Real(0));
  expect_near(oracle.state()[3], Real(0));
}

TEST(ThirdBody, ChatterWithAStickPhaseInEachFlightHasAGeometricLimit) {
  Model m = third_body();
  const double f = 5, light = 0.0078125;
  m.coordinates[1].mass = light;
  m.frictions[0].static_friction = m.frictions[0].kinetic_friction = f;
  Oracle oracle(m, {1.0, 1.0, 1.0, 1.0});
  std::optional<OracleEvent> event;
  int impacts = 0;
  while ((event = oracle.next(Real(10))) && event->kind != "chatter") impacts += event->kind == "impact";
  ASSERT_TRUE(event);
  EXPECT_GT(impacts, 30);
  EXPECT_TRUE(oracle.closed() && oracle.sticking());
  // Per unit of impact speed: slip until w = 0, then both fly on together under a = 1 / (1 + light) back to the wall.
  const Real r(0.5), slip = (1 + r) / (1 + Real(f) + Real(f) / Real(light)), a = 1 / (1 + Real(light));
  const Real x = -r * slip + (1 + Real(f)) * slip * slip / 2, v = -r + (1 + Real(f)) * slip,
             q = sqrt(v * v - 2 * a * x);
  expect_near(event->time, (slip + (q - v) / a) / (1 - q));
}

TEST(Orientation, OfAContactIsAConvention) {
  Model turned = vibro_impact(1.5);
  std::swap(turned.frictions[0].a, turned.frictions[0].b);
  const std::vector<double> start{-0.5, 0.0, 0.0, 0.0};
  const std::vector<OracleEvent> expected = Oracle(vibro_impact(1.5), start).run(Real(30)),
                                 found = Oracle(turned, start).run(Real(30));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    expect_near(found[i].time, expected[i].time);
    EXPECT_EQ(found[i].kind, expected[i].kind == "slip+"   ? "slip-"
                             : expected[i].kind == "slip-" ? "slip+"
                                                           : expected[i].kind);
  }
}

TEST(Belt, StickMovesWithTheBelt) {  // x'' + x = friction; on the belt x = v t until x = f_s
  Model m = friction_oscillator(0.5, 0.25);
  m.frictions[0].belt_speed = 0.125;
  Oracle oracle(m, {0.0, 0.125});
  EXPECT_TRUE(oracle.sticking());
  const auto release = oracle.next(Real(10));
  ASSERT_TRUE(release);
  EXPECT_EQ(release->kind, "release");
  expect_near(release->time, Real(4));
  EXPECT_EQ(oracle.slip_sign(), -1);
  const auto stick = oracle.next(Real(30));  // x = f_k + a cos s + v sin s: x' = v again at tan(s/2) = -a/v
  ASSERT_TRUE(stick);
  EXPECT_EQ(stick->kind, "stick");
  expect_near(stick->time - 4, 2 * (pi() - atan(Real(0.25) / Real(0.125))));
}

TEST(Segment, FromAGivenModeFindsTheSameEventAsTheWholeRun) {
  Oracle oracle(vibro_impact(1.5), {-0.5, 0.0, 0.0, 0.0});
  for (int n = 0; n < 12; ++n) {
    const bool touching = oracle.gap() == 0 && !oracle.closed();
    const SegmentStart start{oracle.state(), oracle.time() / oracle.period(), oracle.mode(), touching,
                             !touching && !oracle.sticking()};
    const Real begin = oracle.time();
    const auto expected = oracle.next(Real(40)), found = first_event(vibro_impact(1.5), start, Real(40));
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(found->kind, expected->kind);
    expect_near(found->time, expected->time - begin);
  }
}

TEST(Segment, DoesNotDependOnTheStepsTaken) {  // K4
  Oracle whole(vibro_impact(4.9), {-0.5, 0.0, 0.0, 0.0}), pieces(vibro_impact(4.9), {-0.5, 0.0, 0.0, 0.0});
  const std::vector<OracleEvent> expected = whole.run(Real(12));
  std::vector<OracleEvent> found;
  for (int i = 1; i <= 120; ++i)
    for (const OracleEvent& e : pieces.run(Real(i) / 10)) found.push_back(e);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_near(found[i].time, expected[i].time);
}

}  // namespace
}  // namespace slapstick::oracle
