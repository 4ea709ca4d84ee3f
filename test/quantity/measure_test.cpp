/// Statistics: against closed forms, and by two routes.
#include "slapstick/quantity/measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "settled.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/section/sampled_motion.hpp"

namespace slapstick::test {
namespace {

/// x'' + 2 zeta x' + x = cos(omega t), free of contact: x = A cos(omega t - lag). The orbit's state is known to the
/// rounding of terms of size 1, the force over the stiffness.
TEST(Measure, OfALinearOscillatorAreThoseOfACosine) {
  for (const double omega : {0.05, 1.0, 6.0}) {
    const SettledCycle cycle(load_model("impact-oscillator"), {{"clearance", 100.0}, {"omega", omega}});
    const double zeta = 0.1, A = 1.0 / std::hypot(1.0 - omega * omega, 2.0 * zeta * omega);
    const Measured found =
        measure(*cycle.problem, cycle.solution.orbit,
                {cycle.named("x"), cycle.named("a"), cycle.named("kinetic_energy"), cycle.named("power_in")});
    EXPECT_NEAR(found.of[0].rms, A / std::numbers::sqrt2, 1e-12 * A) << omega;
    EXPECT_NEAR(found.of[0].crest(), std::numbers::sqrt2, 1e-12 * std::max(1.0, 1.0 / A)) << omega;
    EXPECT_NEAR(found.of[0].mean, 0.0, 1e-12 * std::max(1.0, A)) << omega;
    EXPECT_NEAR(found.of[1].greatest, A * omega * omega, 1e-11 * A * std::max(1.0, omega * omega)) << omega;
    EXPECT_NEAR(found.of[2].mean, 0.25 * A * A * omega * omega, 1e-11 * A * A * std::max(1.0, omega * omega)) << omega;
    EXPECT_NEAR(found.of[3].mean, zeta * omega * omega * A * A, 1e-11) << omega;
    const double lag = std::atan2(2.0 * zeta * omega, 1.0 - omega * omega) / omega;
    EXPECT_NEAR(std::remainder(found.of[0].greatest_at - lag, found.duration), 0.0, 1e-6 * found.duration) << omega;
  }
}

/// The certified simulator from phase 0, and the legs of the orbit's equations.
TEST(Measure, OfACycleIsTheSameByTheMotionAndByTheLegs) {
  for (const char* name : {"vibro-impact", "two-sided-rattle", "stick-slip-impact", "gear-pair", "impact-absorber",
                           "belt", "falling-friction"}) {
    const SettledCycle cycle(load_model(name));
    std::vector<Quantity> of;
    for (const Quantity& one : cycle.all)
      if (!one.at_impacts() && (cycle.solution.drift.empty() || one.kind != Quantity::Kind::displacement))
        of.push_back(one);
    const Measured legs = measure(*cycle.problem, cycle.solution.orbit, of),
                   motion = measure(cycle.motion(), cycle.end(), of);
    for (std::size_t k = 0; k < of.size(); ++k) {
      const double size = std::max(legs.of[k].rms, 1e-3);
      EXPECT_NEAR(motion.of[k].mean, legs.of[k].mean, 1e-8 * size) << name << " " << of[k].name;
      EXPECT_NEAR(motion.of[k].rms, legs.of[k].rms, 1e-8 * size) << name << " " << of[k].name;
      EXPECT_NEAR(motion.of[k].greatest, legs.of[k].greatest, 1e-7 * size) << name << " " << of[k].name;
      EXPECT_NEAR(motion.of[k].least, legs.of[k].least, 1e-7 * size) << name << " " << of[k].name;
      EXPECT_NEAR(motion.of[k].impulse, legs.of[k].impulse, 1e-7 * size) << name << " " << of[k].name;
    }
    for (std::size_t stop = 0; stop < legs.stops.size(); ++stop)
      EXPECT_TRUE(cycle.solution.chatter || motion.stops[stop].w.impulses == legs.stops[stop].w.impulses) << name;
  }
}

/// Means of dense samples come nearer with the square of their distance, to the same number.
TEST(Measure, SamplesConvergeToIt) {
  const SettledCycle cycle(load_model("vibro-impact"), {{"omega", 2.9}});
  const Measured exact = measure(cycle.motion(), cycle.end(), {cycle.named("x1"), cycle.named("v2")});
  const auto error = [&](int samples) {
    SampledMotion sampled(cycle.motion(), samples);
    double square = 0.0;
    long count = 0;
    for (auto item = sampled.next(cycle.end()); item != SampledMotion::Item::end; item = sampled.next(cycle.end()))
      if (item == SampledMotion::Item::sample) square += sampled.sample().state[0] * sampled.sample().state[0], ++count;
    return std::abs(std::sqrt(square / static_cast<double>(count)) - exact.of[0].rms);
  };
  EXPECT_LT(error(20000), 1e-4 * exact.of[0].rms);
}

/// A ball dropped from h with g: flights of 2 v / g, the n-th impact at speed r^n sqrt(2 g h).
TEST(Measure, CountsTheImpactsOfABallOneByOne) {
  const ModelDefinition ball = load_model("bouncing-ball");
  const auto all = quantities(ball);
  const System system(ball.build());
  const double v = std::sqrt(2.0 * 9.81), first = v / 9.81;
  const Measured found =
      measure(Motion(system, ball.start()), Instant{}.plus(first * (1.0 + 2.0 * 0.8) + 0.1),
              {find_quantity(all, "w"), find_quantity(all, "flight"), find_quantity(all, "F_floor")});
  ASSERT_EQ(found.of[0].impulses, 2);
  EXPECT_NEAR(found.of[0].greatest, v, 1e-13 * v);
  EXPECT_NEAR(found.of[0].least, 0.8 * v, 1e-13 * v);
  EXPECT_NEAR(found.of[0].quantile(0.5), 0.8 * v, 1e-13 * v);
  ASSERT_EQ(found.of[1].impulses, 1);  // the first impact ends no flight
  EXPECT_NEAR(found.of[1].mean, 2.0 * 0.8 * v / 9.81, 1e-12);
  EXPECT_NEAR(found.of[2].impulse, 1.8 * (v + 0.8 * v), 1e-12 * v);
  EXPECT_EQ(found.of[2].greatest, 0.0);
}

/// After its complete chatter the ball lies there: the press is its weight, and all its momentum and energy went into
/// the floor.
TEST(Measure, AChatterTakesAllMomentumAndEnergy) {
  const ModelDefinition ball = load_model("bouncing-ball");
  const auto all = quantities(ball);
  const System system(ball.build());
  const double T = 10.0, g = 9.81;
  const Measured found = measure(Motion(system, ball.start()), Instant{}.plus(T),
                                 {find_quantity(all, "F_floor"), find_quantity(all, "power_floor")});
  EXPECT_NEAR(found.of[0].mean, g, 1e-12 * g);  // momentum: 0 at both ends
  EXPECT_NEAR(found.of[0].greatest, g, 1e-12 * g);
  EXPECT_NEAR(found.of[1].mean * T, g, 1e-9 * g);  // energy: m g h
}

/// A drop from h in four scales of length and time: impulses of m sqrt(2 g h) (1 + r) / (1 - r), however early the tail
/// of the chatter is summed. With friction f on the pair a flight that rises at -(g + f) and falls at g - f shrinks the
/// speed by r sqrt((g - f) / (g + f)).
TEST(Measure, AChatterSummedEarlyHasTheImpulsesOfAllItsImpacts) {
  for (const double h : {1e-13, 1e-10, 1e-5, 1.0})
    for (const double f : {0.0, 4.0}) {
      Model model;
      model.coordinates = {{"z", 2.0}};
      model.forces = {{0, 0, -2.0 * 9.81, 0.0}};
      model.stops = {{"floor", ground, 0, 0.0, 0.5}};
      if (f > 0.0) model.frictions = {{"pad", 0, ground, 0.0, 2.0 * f, 2.0 * f}};
      const auto all = quantities(model);
      const System system(model);
      const double v = std::sqrt(2.0 * (9.81 - f) * h), rho = 0.5 * std::sqrt((9.81 - f) / (9.81 + f)),
                   T = 20.0 * v / 9.81;
      const double sum = 2.0 * v * 1.5 / (1.0 - rho);
      const Measured found = measure(Motion(system, {h, 0.0}), Instant{}.plus(T / system.period()),
                                     {find_quantity(all, "F_floor"), find_quantity(all, "a_z"),
                                      find_quantity(all, "impulse"), find_quantity(all, "energy_lost")});
      EXPECT_NEAR(found.of[0].impulse, sum, 1e-6 * sum) << h << " " << f;
      EXPECT_NEAR(2.0 * found.of[1].impulse, found.of[0].impulse, 1e-14 * sum) << h << " " << f;  // m dv of all blows
      EXPECT_NEAR(found.of[1].mean * T, 0.0, 1e-13 * v);                                          // from rest to rest
      const auto& values = found.of[2].values;  // sorted: r^n of the first, down to where the tail begins
      ASSERT_FALSE(values.empty());
      EXPECT_NEAR(values.back(), 3.0 * v, 1e-9 * v);
      EXPECT_NEAR(values.front(), 3.0 * v * std::pow(rho, static_cast<double>(values.size() - 1)), 1e-9 * v);
      EXPECT_NEAR(found.of[3].greatest, 2.0 * 0.375 * v * v, 1e-9 * v * v);
      if (f > 0.0) continue;
      EXPECT_NEAR(found.of[0].mean, 2.0 * 9.81, 1e-9 * 20.0) << h;  // momentum: from rest to rest
    }
}

/// A start in contact that approaches is struck at once: the mean of the acceleration is the change of velocity all the
/// same.
TEST(Measure, AnImpactAtTheFirstInstantCounts) {
  const ModelDefinition definition = load_model("impact-oscillator");
  const System system(definition.build());
  const Stop& stop = system.model().stops[0];
  const double side = stop.a == ground ? -1.0 : 1.0;
  const Motion start(system, {side * stop.clearance, side}, {});
  const Instant end{0, 0.125};
  Motion motion = start;
  while (motion.advance(end) == Outcome::event) {
  }
  const Measured found = measure(start, end, {find_quantity(quantities(system.model()), "a")});
  EXPECT_EQ(found.stops[0].w.impulses, 1);
  EXPECT_NEAR(found.of[0].mean * found.duration, motion.state()[1] - side, 1e-13);
  EXPECT_NEAR(std::abs(found.of[0].impulse), 1.0 + stop.restitution, 1e-13);
}

TEST(Measure, RefusesAnEndThatIsNotLater) {
  const ModelDefinition ball = load_model("bouncing-ball");
  const System system(ball.build());
  EXPECT_THROW(static_cast<void>(measure(Motion(system, ball.start()), Instant{}, {})), InputError);
}

}  // namespace
}  // namespace slapstick::test
