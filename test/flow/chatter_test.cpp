/// Chatter with friction, beside other events, and at random. What has a closed form or known digits is in ../catalogue
/// (K18 to K24, K36).
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "flow/chatter.hpp"
#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "flow/oracle_runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

using testing::run;

TEST(Chatter, RandomRestitutionSpeedAndPhaseEndAsInTheOracle) {
  std::mt19937_64 random(9);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (long k = 0; k < 40 * testing::campaign(); ++k) {
    Model model = oracle::cosine_ball(uniform(0.1, 0.9));
    const double v = std::pow(10.0, uniform(-6, 0)), phase = uniform(0, 1);
    const System system(model);
    Motion motion(system, {0.0, v}, Instant{0, phase});
    oracle::Oracle exact(model, {0.0, v}, phase);
    const auto engine = testing::engine_events(motion, 6.0), expected = testing::oracle_events(exact, 6.0);
    const testing::Comparison c = testing::compare(engine, expected);
    EXPECT_EQ(c.mismatch, "") << k << ": r " << model.stops[0].restitution << " v " << v << " phase " << phase;
    EXPECT_LE(c.worst, 1e-11) << k;
  }
}

TEST(Chatter, BesideASteadilySlidingBeltIsSummed) {  // once bounced on down to 1e-323
  Model m = oracle::ball(0.3);
  m.frictions = {{"belt", ground, 0, 0.25, 0.5, 0.5}};
  const System system(m);
  Motion motion(system, {0.0, 1.0});
  const auto events = run(motion, 10.0);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(std::ranges::count(events, EventKind::chatter, &Event::kind), 1);
  EXPECT_LT(events.size(), 60u);
}

TEST(Chatter, IsEndedByFrictionAloneAtAStopWithoutLoss) {  // r = 1 once bounced on without end
  for (const double r : {1.0, 0.8}) {
    for (const double f : {0.05, 0.25, 0.6}) {
      Model m = oracle::ball(r);
      m.frictions = {{"wall", ground, 0, 0.0, f, f}};
      const System system(m);
      Motion motion(system, {0.0, 1.0});
      const auto events = run(motion, 100.0, 2000);
      // A flight of speed v rises for v / (1 + f), falls for v / sqrt(1 - f^2), and ends with speed v
      // sqrt((1 - f) / (1 + f)).
      const double kept = r * std::sqrt((1 - f) / (1 + f));
      const double end = (1 / (1 + f) + 1 / std::sqrt(1 - f * f)) / (1 - kept);
      ASSERT_EQ(name(events.back().kind), "chatter") << r << " " << f << ", after " << events.size() << " events";
      EXPECT_NEAR(events.back().time.seconds(1.0), end, 2e-15 * end) << r << " " << f;
      EXPECT_EQ(system.mode_name(motion.mode_id()), "stick|closed");
    }
  }
}

/// The events of a ball that falls from rest at height 1/2.
std::vector<Event> dropped(const Model& model, double time = 20.0) {
  const System system(model);
  State start(2 * model.coordinates.size(), 0.0);
  start[0] = 0.5;
  Motion motion(system, start);
  return run(motion, time, 2000);
}

void expect_same_limit(const Model& one, const Model& other) {
  const auto a = dropped(one), b = dropped(other);
  ASSERT_EQ(testing::kinds(a), testing::kinds(b));
  ASSERT_EQ(std::ranges::count(a, EventKind::chatter, &Event::kind), 1);
  EXPECT_LE(a.size(), 300u);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i].time.seconds(1.0), b[i].time.seconds(1.0), 4e-15 * (1.0 + a[i].time.seconds(1.0))) << i;
}

/// f_k N of a load N that stays as it is, here of a body at rest, is a friction of that size.
/// Once no limit was proven where friction had a load.
TEST(Chatter, UnderALoadThatStaysIsThatOfItsProduct) {
  for (const double r : {0.5, 1.0}) {
    Model fixed = oracle::ball(r);
    fixed.coordinates.push_back({"y", 1.0});
    Model loaded = fixed;
    fixed.frictions = {{"wall", ground, 0, 0.0, 0.25, 0.125}};
    loaded.frictions = {{"wall", ground, 0, 0.0, 0.5, 0.25, NormalForce{0.5, {{1, 0.25, 0.0}}, -1}}};
    expect_same_limit(fixed, loaded);
  }
}

/// A compliant stop that is pressed all the while is a spring, a damper and a constant force.
TEST(Chatter, WithACompliantStopThatIsAlwaysPressedIsThatOfItsSpring) {
  Model spring = oracle::ball(0.5), pressed = spring;
  spring.springs = {{ground, 0, 0.25}};
  spring.dampers = {{ground, 0, 0.125}};
  spring.forces.push_back({0, 0, -0.5, 0.0});
  pressed.compliant_stops = {{"clip", 0, ground, -2.0, 0.25, 0.125, true}};
  expect_same_limit(spring, pressed);
}

/// A body that is held at its own stop is ground. Once the changes that reach it were bounded before the ball's own had
/// been added up: where nothing else moves the body no limit was proven, and impacts followed down to 1e-29.
TEST(Chatter, BesideABodyThatIsHeldAtItsStopIsThatBesideGround) {
  Model held = oracle::ball(0.5);
  held.coordinates.push_back({"y", 1.0});
  held.stops.push_back({"rest", ground, 1, 0.0, 0.0});
  held.characteristics.push_back({"clamp", 1, ground, Characteristic::Over::displacement, {{-1.0, 8.0}, {1.0, 8.0}}});
  Model on_ground = held;
  held.dampers = {{0, 1, 0.25}};
  on_ground.dampers = {{0, ground, 0.25}};
  const auto a = dropped(held), b = dropped(on_ground);
  ASSERT_EQ(a.back().kind, EventKind::chatter);
  ASSERT_EQ(b.back().kind, EventKind::chatter);
  EXPECT_NEAR(a.back().time.seconds(1.0), b.back().time.seconds(1.0), 1e-14);
  EXPECT_LE(a.size(), b.size() + 3);
}

/// A load that is not positive carries no friction, and that of a compliant stop is its spring's.
TEST(Chatter, UnderTheLoadOfACompliantStopIsThatOfALoadByItsSpring) {
  Model by_terms = oracle::ball(0.5);
  by_terms.compliant_stops = {{"clip", 0, ground, -2.0, 0.25, 0.0, true}};
  by_terms.frictions = {{"wall", ground, 0, 0.0, 0.25, 0.25, NormalForce{0.5, {{0, 0.25, 0.0}}, -1}}};
  Model by_stop = by_terms;
  by_stop.frictions[0].normal = NormalForce{0.0, {}, 0};
  expect_same_limit(by_terms, by_stop);
  Model without = by_terms, unloaded = by_terms;
  without.frictions.clear();
  unloaded.frictions[0].normal = NormalForce{-4.0, {{0, 0.25, 0.0}}, -1};
  const auto a = dropped(without), b = dropped(unloaded);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.back().time, b.back().time);
}

/// A compliant stop whose gap is the rigid one's never acts: the ball's own closed form.
TEST(Chatter, BesideACompliantStopThatBeginsWhereTheRigidOneDoesIsSummed) {
  Model model = oracle::ball(0.5);
  model.compliant_stops = {{"layer", ground, 0, 0.0, 3.0, 0.0}};
  const auto events = dropped(model);
  const auto limit = std::ranges::find(events, EventKind::chatter, &Event::kind);
  ASSERT_NE(limit, events.end());
  EXPECT_NEAR(limit->time.seconds(1.0), 1.0 + 2.0 * 0.5 / 0.5, 8e-15);
  EXPECT_LT(events.size(), 60u);
}

/// A load that goes to zero with the gap may end within the chatter: its limit is proven, and counted as shaken, since
/// the events of the load are not told.
TEST(Chatter, UnderALoadThatGoesToZeroWithTheGapIsSummedAndCounted) {
  Model model = oracle::ball(0.5);
  model.frictions = {{"wall", ground, 0, 0.0, 0.25, 0.25, NormalForce{0.0, {{0, 0.5, 0.0}}, -1}}};
  const System system(model);
  Motion motion(system, {0.5, 0.0});
  const auto events = run(motion, 20.0, 2000);
  EXPECT_EQ(std::ranges::count(events, EventKind::chatter, &Event::kind), 1);
  EXPECT_LT(events.size(), 120u);
  EXPECT_EQ(motion.counters().shaken, 1);
  EXPECT_EQ(motion.counters().pile_ups, 0);
}

TEST(Chatter, WithoutLossOnAReboundingPairThatRubsEndsAsInTheOracle) {
  Model m;
  m.coordinates = {{"x1", 0.69127120414392818}, {"x2", 2.2463262910838058}};
  m.springs = {{0, ground, 1.5644099254959678}, {1, 0, 2.2134253966583457}};
  m.dampers = {{0, ground, 0.45738100272794752}, {1, 0, 0.11813985095386832}};
  m.forces = {{1, 1, 1.3041751757999147, 2.6195333890426085}};
  m.stops = {{"stop", ground, 0, 0.20254659370344275, 1.0}};
  m.frictions = {{"rub", ground, 0, 0.0, 0.25238042518403231, 0.25238042518403231}};
  m.omega = 0.8816783179022365;
  const State start = {-0.10547434006685796, -0.065593031373747501, 0.20240955243934411, -0.074076682475659128};
  const System system(m);
  Motion motion(system, start);
  oracle::Oracle exact(m, start);
  const testing::Comparison c =
      testing::compare(testing::engine_events(motion, 7.0, 400), testing::oracle_events(exact, 7.0));
  EXPECT_EQ(c.mismatch, "");
  EXPECT_LE(c.worst, 1e-12);
}

/// Leaves out what happens within 1e-9 before each chatter's limit: bounces of 1e-13 that no double tells apart.
std::vector<testing::Seen> without_tails(const std::vector<testing::Seen>& all) {
  std::vector<testing::Seen> kept;
  for (const testing::Seen& event : all) {
    if (event.kind == "chatter")
      std::erase_if(kept, [&](const testing::Seen& e) { return event.time - e.time < 1e-9; });
    kept.push_back(event);
  }
  return kept;
}

TEST(Chatter, OfABallThatRubsOnASecondBodyTakesLittleWork) {  // their friction may rest in each flight
  for (const double r : {0.3, 0.5, 0.8}) {
    for (const double f : {0.05, 0.2, 0.6}) {
      Model m = oracle::ball(r);
      m.coordinates.push_back({"y", 1.0});
      m.springs = {{1, ground, 1.0}};
      m.frictions = {{"rub", 0, 1, 0.0, f, f}};
      const System system(m);
      Motion motion(system, {0.5, 0.0, 0.0, 0.0});
      oracle::Oracle exact(m, {0.5, 0.0, 0.0, 0.0});
      const auto engine = testing::engine_events(motion, 12.0, 2000);
      EXPECT_LE(engine.size(), 300u) << r << " " << f;
      EXPECT_LE(motion.counters().evaluations, 2000) << r << " " << f;
      const testing::Comparison c =
          testing::compare(without_tails(engine), without_tails(testing::oracle_events(exact, 12.0)));
      EXPECT_EQ(c.mismatch, "") << r << " " << f;
      EXPECT_LE(c.worst, 1e-14 * 12) << r << " " << f;
    }
  }
}

/// A ball that comes to rest at t = 4 exactly, and beside it a body on a rough plate that nothing joins to the ball.
Model ball_and_a_body_elsewhere(double static_friction, double kinetic_friction) {
  Model m = oracle::ball(0.5);
  m.coordinates.push_back({"y", 1.0});
  m.frictions = {{"plate", 1, ground, 0.0, static_friction, kinetic_friction}};
  return m;
}

/// What happens besides impacts up to t = 6, which must be what the oracle sees: one event at `due`, and the chatter at
/// 4.
void expect_event_beside_the_chatter(const Model& model, const State& start, const char* kind, double due) {
  const System system(model);
  Motion motion(system, start);
  auto engine = testing::engine_events(motion, 6.0, 200);
  oracle::Oracle exact(model, start);
  const testing::Comparison c = testing::compare(engine, testing::oracle_events(exact, 6.0));
  EXPECT_EQ(c.mismatch, "") << due - 4;
  EXPECT_LE(c.worst, 4e-15) << due - 4;
  std::erase_if(engine, [](const testing::Seen& event) { return event.kind == "impact"; });
  ASSERT_EQ(engine.size(), 2u) << due - 4;
  const bool before = due < 4.0;
  EXPECT_EQ(engine[before ? 0 : 1].kind, kind) << due - 4;
  EXPECT_NEAR(engine[before ? 0 : 1].time, due, 4e-15);
  EXPECT_EQ(engine[before ? 1 : 0].kind, "chatter") << due - 4;
  EXPECT_NEAR(engine[before ? 1 : 0].time, 4.0, 4e-15);
}

constexpr double around_the_limit[] = {2e-8, 5e-9, 1e-9, -1e-9, -2e-8};

TEST(ChatterTail, SeesASliderElsewhereComeToRest) {
  for (const double d : around_the_limit)
    expect_event_beside_the_chatter(ball_and_a_body_elsewhere(0.25, 0.25), {0.0, 1.0, 0.0, 0.25 * (4 - d)}, "stick",
                                    4 - d);
}

TEST(ChatterTail, SeesAStuckBodyElsewhereReleased) {
  for (const double d : around_the_limit) {
    Model m = ball_and_a_body_elsewhere(0.5, 0.2);
    m.omega = std::asin(0.5) / (4 - d);
    m.forces.push_back({1, 1, 1.0, 0.0});
    expect_event_beside_the_chatter(m, {0.0, 1.0, 0.0, 0.0}, "release", 4 - d);
  }
}

/// A mass pressed onto its stop with R = 1 - x / 10, which may fall by some 0.1 within the chatter: static friction of
/// 0.999 might then hold it off the stop, a little less might not. At this tolerance the difference is far from
/// rounding.
TEST(Chatter, IsNotProvenWhereStaticFrictionMightHoldThePairOff) {
  const auto proven = [](double static_friction) {
    Model m;
    m.coordinates = {{"x", 1.0}};
    m.springs = {{0, ground, 0.1}};
    m.forces = {{0, 0, 1.0, 0.0}};
    m.stops = {{"stop", 0, ground, 0.0, 0.3}};
    m.frictions = {{"friction", 0, ground, 0.0, static_friction, 0.0}};
    const System system(m);
    const Motion motion(system, {0.0, -0.1});
    std::vector<double> scratch(4 * static_cast<std::size_t>(system.compiled().frame().size()));
    return flow::prove_chatter(system.compiled(), system.compiled().mode(motion.mode_id()), std::vector{0},
                               motion.engine().extended().data(), 1.0, scratch)
        .proven;
  };
  EXPECT_TRUE(proven(0.1));
  EXPECT_FALSE(proven(0.999));
}

}  // namespace
}  // namespace slapstick
