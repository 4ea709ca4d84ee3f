/// Laws of stops, dampers that act in an interval, and friction laid as a polyline, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/tangent.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::testing {
namespace {

ModelDefinition one_mass(const std::string& parts) {
  return ModelDefinition::parse("name = 'm'\nomega = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n" + parts, "f.toml");
}

std::string bumper(const std::string& more) {
  return "[[compliant_stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0\nstiffness = 100\n" + more + "\n";
}

/// delta'' = -2 k delta until c delta' = k delta, then a damped spring until its force is zero, then free.
struct BoundedImpact {
  explicit BoundedImpact(double k, double c, double v) {
    const double w = std::sqrt(2.0 * k);
    first = std::atan(c * w / k) / w;
    const double depth = v / w * std::sin(w * first), speed = v * std::cos(w * first), a = c / 2.0;
    const double turn = std::sqrt(k - a * a);
    const double by_sine = k * (speed + a * depth) - c * (k * depth + a * speed);
    second = std::atan2(-(k * depth + c * speed) * turn, by_sine) / turn;
    if (second < 0.0) second += std::numbers::pi / turn;
    const double decay = std::exp(-a * second), cosine = std::cos(turn * second), sine = std::sin(turn * second);
    let_go = decay * (depth * cosine + (speed + a * depth) / turn * sine);
    rebound = decay * (speed * cosine - (k * depth + a * speed) / turn * sine);
  }
  double first, second, let_go, rebound;
};

TEST(ContactLaw, ABoundedDampingForceSetsInWithoutAJump) {
  const System system(one_mass(bumper("damping = 6\nlaw = 'bounded'")).build());
  const BoundedImpact impact(100.0, 6.0, 2.0);
  Motion motion(system, {-1.0, 2.0});
  const std::vector<Event> events = run(motion, 2.0);
  ASSERT_EQ(kinds(events), "engage corner disengage separate");
  EXPECT_NEAR(seconds(events[1], motion), 0.5 + impact.first, 1e-15);
  EXPECT_NEAR(seconds(events[2], motion), 0.5 + impact.first + impact.second, 1e-14);
  EXPECT_NEAR(seconds(events[3], motion), 0.5 + impact.first + impact.second - impact.let_go / impact.rebound, 1e-14);
  EXPECT_NEAR(motion.state()[1], impact.rebound, 1e-14);
}

ModelDefinition two_masses(const std::string& parts) {
  return ModelDefinition::parse(
      "name = 'm'\n[[coordinate]]\nname = 'x1'\nmass = 2\n[[coordinate]]\nname = 'x2'\nmass = 3\n" + parts, "f.toml");
}

/// Two blocks: the reduced mass 6/5 meets the bumper, whatever the speed of either, and the centre goes on.
TEST(ContactLaw, ABoundedBumperBetweenTwoBlocksSeesTheReducedMass) {
  const double m = 1.2;
  const System system(two_masses("[[compliant_stop]]\nname = 'bumper'\nbetween = ['x1', 'x2']\nclearance = 0\n"
                                 "stiffness = 100\ndamping = 6\nlaw = 'bounded'\n")
                          .build());
  for (const double v : {1e-6, 1.0, 1e4}) {
    const BoundedImpact impact(100.0 / m, 6.0 / m, v);
    Motion motion(system, {-0.5 * v, 2.0 * v, 0.0, v});
    const std::vector<Event> events = run(motion, 2.0);
    ASSERT_EQ(kinds(events), "engage corner disengage separate");
    EXPECT_NEAR(seconds(events[2], motion), 0.5 + impact.first + impact.second, 1e-14);
    EXPECT_NEAR(motion.state()[1], 1.4 * v + 0.6 * impact.rebound, 1e-14 * v);
    EXPECT_NEAR(motion.state()[3], 1.4 * v - 0.4 * impact.rebound, 1e-14 * v);
  }
}

/// Damping above the critical one: two real exponents after the corner; the force is zero with the acceleration.
TEST(ContactLaw, ABoundedStopThatCreepsOut) {
  const double k = 100.0, c = 30.0, v = 2.0, w = std::sqrt(2.0 * k), first = std::atan(c * w / k) / w;
  const double depth = v / w * std::sin(w * first), speed = v * std::cos(w * first);
  const double slow = -15.0 + std::sqrt(125.0), fast = -15.0 - std::sqrt(125.0);
  const double A = (speed - fast * depth) / (slow - fast), B = depth - A;
  const double second = std::log(-B * fast * fast / (A * slow * slow)) / (slow - fast);
  const System system(one_mass(bumper("damping = 30\nlaw = 'bounded'")).build());
  Motion motion(system, {-1.0, v});
  const std::vector<Event> events = run(motion, 2.0);
  ASSERT_EQ(kinds(events), "engage corner disengage separate");
  EXPECT_NEAR(seconds(events[1], motion), 0.5 + first, 1e-15);
  EXPECT_NEAR(seconds(events[2], motion), 0.5 + first + second, 1e-14);
  EXPECT_NEAR(motion.state()[1], A * slow * std::exp(slow * second) + B * fast * std::exp(fast * second), 1e-14);
}

/// Let go at rest in the stop: tan(w t) = w / a, v = -delta sqrt(k) exp(-a t), a = c / 2, w^2 = k - a^2.
TEST(ContactLaw, ABoundedStopThatThrowsAMassIsADampedSpring) {
  const System system(one_mass(bumper("damping = 6\nlaw = 'bounded'")).build());
  const double turn = std::sqrt(91.0), time = std::atan(turn / 3.0) / turn;
  Motion motion(system, {0.5, 0.0});
  const std::vector<Event> events = run(motion, 2.0);
  ASSERT_EQ(kinds(events), "disengage separate");
  EXPECT_NEAR(seconds(events[0], motion), time, 1e-15);
  EXPECT_NEAR(motion.state()[1], -5.0 * std::exp(-3.0 * time), 1e-14);
}

/// A load of 10 pushes a mass into a stop of 100 on the way in and 60 on the way out: it turns at 2 * 10 / 100, goes
/// out, turns at 2 * 10 / 60 - 0.2 and stays, because 60 * 2 / 15 < 10 < 100 * 2 / 15.
TEST(ContactLaw, AMassComesToRestBetweenTwoStiffnesses) {
  const System system(
      one_mass(bumper("unloading_stiffness = 60") + "[[force]]\non = 'x'\namplitude = 10\nharmonic = 0\n").build());
  Motion motion(system, {0.0, 0.0});
  const std::vector<Event> events = run(motion, 5.0);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().kind, EventKind::stick);
  EXPECT_NEAR(seconds(events.back(), motion), std::numbers::pi * (0.1 + 1.0 / std::sqrt(60.0)), 1e-14);
  EXPECT_NEAR(motion.state()[0], 2.0 / 15.0, 1e-15);
  EXPECT_EQ(motion.state()[1], 0.0);
}

/// The force never jumps and never pulls, and the energy falls.
TEST(ContactLaw, ABoundedStopIsGentlerThanOneThatOnlyLetsGo) {
  double speeds[3];
  int k = 0;
  for (const char* law : {"lets_go", "bounded", "pulls"}) {
    const System system(one_mass(bumper("damping = 6\nlaw = '" + std::string(law) + "'")).build());
    Motion motion(system, {-1.0, 2.0});
    run(motion, 2.0);
    speeds[k++] = -motion.state()[1];
  }
  EXPECT_LT(speeds[2], speeds[0]);
  EXPECT_LT(speeds[0], speeds[1]);
  EXPECT_LT(speeds[1], 2.0);
}

TEST(ContactLaw, TheWordsMeanWhatTheFlagMeant) {
  for (const auto& [flag, law] : {std::pair("pulls = false", "lets_go"), std::pair("pulls = true", "pulls")}) {
    const System first(one_mass(bumper("damping = 6\n" + std::string(flag))).build());
    const System second(one_mass(bumper("damping = 6\nlaw = '" + std::string(law) + "'")).build());
    Motion a(first, {-1.0, 2.0}), b(second, {-1.0, 2.0});
    run(a, 2.0), run(b, 2.0);
    EXPECT_EQ(a.state(), b.state());
  }
}

std::string ball(const std::string& law) {
  return "[[force]]\non = 'x'\namplitude = -10\nharmonic = 0\n[[stop]]\nname = 'floor'\nbetween = ['ground', 'x']\n"
         "clearance = 0\n" +
         law + "\n";
}

/// Each bounce by the restitution of its own speed; below the lowest corner the bounces end at a geometric limit.
TEST(ContactLaw, RestitutionFallsWithTheSpeed) {
  const System system(one_mass(ball("restitution_over_speed = [[1, 0.9], [3, 0.5], [5, 0.4]]")).build());
  Motion motion(system, {0.8, 0.0});  // 4 at the floor
  double v = 4.0, t = 0.4;
  const std::vector<Event> events = run(motion, 20.0);
  for (std::size_t i = 0; v > 0.95; ++i) {
    ASSERT_EQ(events[i].kind, EventKind::impact);
    EXPECT_NEAR(events[i].w, v, 1e-14);
    EXPECT_NEAR(seconds(events[i], motion), t, 1e-14);
    v *= v > 3.0 ? 0.5 - 0.05 * (v - 3.0) : v > 1.0 ? 0.9 - 0.2 * (v - 1.0) : 0.9;
    t += v / 5.0;
  }
  t += v / 5.0 * 0.9 / (1.0 - 0.9);
  const auto chatter = std::find_if(events.begin(), events.end(), [](auto& e) { return e.kind == EventKind::chatter; });
  ASSERT_NE(chatter, events.end());
  EXPECT_NEAR(seconds(*chatter, motion), t, 1e-13);
}

/// A wall at the spring's rest: impacts are pi apart, each at r(v) v of the one before.
TEST(ContactLaw, RestitutionAtAWallWhereASpringIsAtRest) {
  const System system(
      one_mass(
          "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\n"
          "clearance = 0\nrestitution_over_speed = [[0.5, 0.9], [2, 0.3]]\n")
          .build());
  Motion motion(system, {-3.0, 0.0});
  double v = 3.0;
  const std::vector<Event> events = run(motion, 10.0 * std::numbers::pi);
  ASSERT_EQ(events.size(), 10U);
  for (std::size_t n = 0; n < events.size(); ++n) {
    EXPECT_NEAR(seconds(events[n], motion), (static_cast<double>(n) + 0.5) * std::numbers::pi, 1e-14);
    EXPECT_NEAR(events[n].w, v, 4e-15) << n;
    v *= v > 2.0 ? 0.3 : v > 0.5 ? 0.9 - 0.4 * (v - 0.5) : 0.9;
  }
}

/// Momentum is kept, and the relative speed u becomes r(u) u.
TEST(ContactLaw, RestitutionOfTwoBlocksIsThatOfTheirRelativeSpeed) {
  const System system(two_masses("[[stop]]\nname = 'gap'\nbetween = ['x1', 'x2']\nclearance = 0\n"
                                 "restitution_over_speed = [[1, 0.8], [2, 0.6], [4, 0.5]]\n")
                          .build());
  for (const auto& [u, r] : {std::pair(0.5, 0.8), std::pair(1.5, 0.7), std::pair(3.0, 0.55), std::pair(9.0, 0.5)}) {
    Motion motion(system, {-1.0, 7.0 + u, 0.0, 7.0});
    ASSERT_EQ(kinds(run(motion, 2.5)), "impact");
    EXPECT_NEAR(motion.state()[1], 7.0 + 0.4 * u - 0.6 * r * u, 4e-15);
    EXPECT_NEAR(motion.state()[3], 7.0 + 0.4 * u + 0.4 * r * u, 4e-15);
  }
}

/// d v+ / d v- = -(r + r' v): two neighbours after a bounce.
TEST(ContactLaw, ATangentSeesTheSlopeOfTheRestitution) {
  const Model model = one_mass(
                          "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[force]]\non = 'x'\namplitude = 1\n"
                          "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\n"
                          "restitution_over_speed = [[0.2, 0.9], [3, 0.3]]\n")
                          .build();
  const System system(model);
  const State start = {0.0, 1.5};
  const double time = 1.0, step = 1e-6;
  const auto end = [&](const State& from) {
    Motion motion(system, from);
    run(motion, time);
    return motion.state();
  };
  TangentMotion motion(system, start, Eigen::MatrixXd::Identity(2, 2));
  while (motion.advance(Instant{}.plus(time / model.forcing_period())) == Outcome::event) {
  }
  for (int j = 0; j < 2; ++j) {
    State above = start, below = start;
    above[j] += step, below[j] -= step;
    const State a = end(above), b = end(below);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(motion.tangents()(i, j), (a[i] - b[i]) / (2.0 * step), 1e-8) << i << j;
  }
}

/// v = v0 - c x in the interval, whatever the time: a mass that passes, and one that stays there.
TEST(ContactLaw, ADamperThatActsInAnInterval) {
  const System system(
      one_mass("[[damper]]\nname = 'grease'\nbetween = ['x', 'ground']\ncoefficient = 2\nwithin = [1, 2]\n").build());
  Motion passes(system, {0.0, 5.0});
  const std::vector<Event> events = run(passes, 3.0);
  ASSERT_EQ(kinds(events), "corner corner");
  EXPECT_NEAR(seconds(events[1], passes), 0.2 + std::log(5.0 / 3.0) / 2.0, 1e-15);
  EXPECT_NEAR(passes.state()[1], 3.0, 1e-14);
  Motion stays(system, {0.0, 1.0});
  EXPECT_EQ(kinds(run(stays, 50.0)), "corner");
  EXPECT_NEAR(stays.state()[0], 1.5, 1e-14);
}

/// The multipliers' product is exp(-integral of the damping): an edge shears, and changes no area.
TEST(ContactLaw, AnEdgeOfAZoneShearsTangents) {
  const ModelDefinition model = one_mass(
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 4\n[[force]]\non = 'x'\namplitude = 3\n"
      "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.9\nwithin = [-0.3, 0.5]\ncoefficient_outside = 0.1\n");
  const System system(model.build());
  const Classification found = classify(system, {0.5, 0.0});
  ASSERT_EQ(found.attractor, Attractor::periodic);
  Motion motion(system, found.state);
  double within = 0.0, last = 0.0;
  bool inside = found.state[0] > -0.3 && found.state[0] < 0.5;
  const double period = 2.0 * std::numbers::pi * found.n;
  for (const Event& event : run(motion, period)) {
    ASSERT_EQ(event.kind, EventKind::corner);
    const double now = seconds(event, motion);
    within += inside ? now - last : 0.0;
    inside = !inside;
    last = now;
  }
  within += inside ? period - last : 0.0;
  ASSERT_EQ(found.multipliers.size(), 2U);
  const double product = std::real(found.multipliers[0] * found.multipliers[1]);
  EXPECT_NEAR(std::log(product), -0.9 * within - 0.1 * (period - within), 1e-9);
}

std::string falling(int corners) {
  return "[[friction]]\nname = 'f'\nbetween = ['x', 'ground']\nstribeck = { static = 3, kinetic = 1, speed = 0.5, "
         "corners = " +
         std::to_string(corners) + " }\n";
}

/// Error of the laid polyline: the least that K corners allow is about (f_s - f_k) / (1 + sqrt 2 K)^2.
TEST(ContactLaw, AStribeckLawIsLaidWithItsStatedError) {
  for (const int corners : {1, 2, 5, 20, 40}) {
    const Model model = one_mass(falling(corners)).build();
    ASSERT_EQ(model.characteristics.size(), 1U);
    EXPECT_EQ(model.frictions[0].static_friction, 3.0);
    const auto& points = model.characteristics[0].corners;
    ASSERT_EQ(points.size(), 2U * corners);
    double worst = 0.0;
    std::size_t i = corners;  // the first corner above 0
    double v0 = 0.0, f0 = 0.0;
    for (; i < points.size(); ++i) {
      for (int k = 0; k <= 200; ++k) {
        const double v = v0 + (points[i].at - v0) * k / 200.0, chord = f0 + (points[i].force - f0) * k / 200.0;
        worst = std::max(worst, std::abs(3.0 + chord - (1.0 + 2.0 * std::exp(-v / 0.5))));
      }
      v0 = points[i].at, f0 = points[i].force;
    }
    worst = std::max(worst, 3.0 + f0 - 1.0);  // far out
    const double stated = 2.0 / std::pow(1.0 + std::sqrt(2.0) * corners, 2);
    EXPECT_LT(worst, 1.03 * stated) << corners;
    EXPECT_GT(worst, 0.97 * stated) << corners;
  }
}

/// v' = -(1 + 2 exp(-2 v)) from 2: T = (ln(exp(4) + 2) - ln 3) / 2; chords lie above the law, so that the mass stops
/// early.
TEST(ContactLaw, AMassThatAStribeckLawStopsDoesSoInTime) {
  const double time = 0.5 * (std::log(std::exp(4.0) + 2.0) - std::log(3.0));
  for (const int corners : {10, 20, 40, 80}) {
    const System system(one_mass(falling(corners)).build());
    Motion motion(system, {0.0, 2.0});
    const std::vector<Event> events = run(motion, 3.0);
    ASSERT_EQ(events.back().kind, EventKind::stick);
    const double early = time - seconds(events.back(), motion),
                 stated = 2.0 / std::pow(1.0 + std::sqrt(2.0) * corners, 2);
    EXPECT_GT(early, 0.0);
    EXPECT_LT(early, 1.03 * stated * time) << corners;
    EXPECT_GT(early, 0.1 * stated * time) << corners;
  }
}

/// Steady sliding at 0.25 grows by (4 exp(-1/2) - c) / 2, from the tangents' area; a polyline has the slope of
/// somewhere in the piece.
TEST(ContactLaw, TheSlopeOfAStribeckLawIsThatOfItsPiece) {
  const double law = 4.0 * std::exp(-0.5);
  for (const int corners : {5, 20, 80}) {
    const Model model = one_mass(falling(corners) +
                                 "belt_speed = 0.25\n[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n"
                                 "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.5\n")
                            .build();
    const auto& points = model.characteristics[0].corners;  // below the belt's speed in falling order of the speed
    std::size_t i = 0;
    while (points[i + 1].at < 0.0) ++i;
    const double slope = (points[i + 1].force - points[i].force) / (points[i + 1].at - points[i].at);
    const double friction = 3.0 - points[i].force + slope * points[i].at;
    const System system(model);
    TangentMotion motion(system, {friction, 0.0}, Eigen::MatrixXd::Identity(2, 2));
    while (motion.advance(after(motion.motion(), 0.1)) == Outcome::event) {
    }
    const Eigen::MatrixXd tangents = motion.tangents();
    const double grows = std::log(tangents(0, 0) * tangents(1, 1) - tangents(0, 1) * tangents(1, 0)) / 0.1;
    EXPECT_NEAR(grows + 0.5, law, 1.0 / (corners * std::exp(-0.25)) * law) << corners;
    EXPECT_NEAR(grows, -slope - 0.5, 1e-12);
  }
}

TEST(ContactLaw, ADamperFeedsEnergyOnlyWhereItsWordIsGiven) {
  const std::string damper = "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = -0.5\n";
  EXPECT_THROW((void)one_mass(damper), InputError);
  EXPECT_THROW((void)one_mass(damper + "within = [0, 1]\n"), InputError);
  const System system(one_mass(damper + "feeds = true\n").build());
  Motion motion(system, {0.0, 1.0});
  run(motion, 2.0);
  EXPECT_NEAR(motion.state()[1], std::exp(1.0), 1e-14);
}

}  // namespace
}  // namespace slapstick::testing
