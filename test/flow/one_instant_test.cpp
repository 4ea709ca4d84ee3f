/// Several events at one instant: each has the state just before it, and not that before the first of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "oracle/models.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick {
namespace {

struct Step {
  Event event;
  State before;
};

/// The events of the first instant that has any.
std::vector<Step> first_instant(const Model& model, const State& start) {
  const System system(model);
  Motion motion(system, start);
  std::vector<Step> steps;
  while (motion.advance({1, 0.0}) == Outcome::event &&
         (steps.empty() || motion.event().time == steps.front().event.time))
    steps.push_back({motion.event(), {motion.before().begin(), motion.before().end()}});
  return steps;
}

/// Equal balls in a row that touch.
Model row(int count, double restitution, ImpactLaw law) {
  Model m;
  for (int i = 0; i < count; ++i) m.coordinates.push_back({"x" + std::to_string(i), 1.0});
  for (int i = 0; i + 1 < count; ++i) m.stops.push_back({"s" + std::to_string(i), i, i + 1, 0.0, restitution});
  m.impact_law = law;
  return m;
}

double closing(const Model& model, const Step& step) {
  const Stop& stop = model.stops[step.event.contact];
  return step.before[2 * stop.a + 1] - step.before[2 * stop.b + 1];
}

/// Equal balls exchange their velocities, so all numbers are exact: the blow runs through the row.
TEST(OneInstant, BlowThatRunsThroughARowFindsTheNextBallAtItsSpeed) {
  const Model model = row(4, 1.0, ImpactLaw::sequence);
  for (const double first : {0.0, -0.5}) {  // at the start, and after a flight
    const std::vector<Step> steps = first_instant(model, {first, 1.0, 0, 0, 0, 0, 0, 0});
    ASSERT_GE(steps.size(), 4U) << first;
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(steps[i].event.contact, i);
      EXPECT_EQ(steps[i].event.kind, EventKind::impact);
      for (int ball = 0; ball < 4; ++ball)
        EXPECT_EQ(steps[i].before[2 * ball + 1], ball == i ? 1.0 : 0.0) << first << " " << i;
    }
    EXPECT_EQ(steps[3].event.kind, EventKind::stick);  // of balls that touch and stay
    EXPECT_EQ(steps[3].before[7], 1.0);
  }
}

TEST(OneInstant, SpeedOfEveryImpactOfACradleIsThatOfItsState) {
  const Model model = row(12, 1.0, ImpactLaw::sequence);
  State start(24, 0.0);
  for (int i = 0; i < 6; ++i) start[2 * i] = -0.5, start[2 * i + 1] = 1.0;
  const std::vector<Step> steps = first_instant(model, start);
  EXPECT_EQ(steps.size(), 36U);  // six balls pass six others
  for (const Step& step : steps) EXPECT_EQ(closing(model, step), step.event.w);
}

TEST(OneInstant, ImpactsTogetherAreOneBlowAndShareTheStateBefore) {
  Model model;  // a heavy ball falls between two others
  model.coordinates = {{"left", 1.0}, {"centre", 2.0}, {"right", 1.0}};
  model.stops = {{"l", 1, 0, 0.5, 0.5}, {"r", 1, 2, 0.5, 0.5}};
  model.impact_law = ImpactLaw::moreau;
  const std::vector<Step> steps = first_instant(model, {0, 0, 0, 1.0, 0, 0});
  ASSERT_EQ(steps.size(), 2U);
  for (const Step& step : steps) EXPECT_EQ(closing(model, step), step.event.w);
  EXPECT_EQ(steps[0].before, steps[1].before);
}

TEST(OneInstant, RestAfterAPlasticImpactBeginsAtRest) {
  const std::vector<Step> steps = first_instant(oracle::ball(0.0), {0.125, 0.0});
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].event.kind, EventKind::impact);
  EXPECT_NEAR(steps[0].before[1], -0.5, 1e-15);
  EXPECT_EQ(steps[1].event.kind, EventKind::stick);
  EXPECT_EQ(steps[1].before, (State{0.0, 0.0}));
}

/// Momentum is kept, and plastic bodies that touch end with one velocity: the one ball's, shared by all.
TEST(OneInstant, ARowOfPlasticBallsEndsTogetherWhateverItsLength) {
  for (const double r : {0.0, 0.3}) {
    for (int count = 2; count <= 8; ++count) {
      const Model model = row(count, r, ImpactLaw::sequence);
      State start(2 * static_cast<std::size_t>(count), 0.0);
      start[0] = -1.0, start[1] = 1.0;
      Motion motion(System(model), start);
      while (motion.advance({2, 0.0}) == Outcome::event) {
      }
      const State end = motion.state();
      double momentum = 0.0;
      for (int i = 0; i < count; ++i) momentum += end[2 * i + 1];
      EXPECT_NEAR(momentum, 1.0, 1e-12) << r << " " << count;
      for (int i = 0; i + 1 < count; ++i) {
        EXPECT_LE(end[2 * i + 1], end[2 * i + 3] + 1e-12)
            << "ball " << i << " of " << count << " approaches, r = " << r;
        const double together = r == 0.0 ? 1.0 / count : end[2 * i + 1];
        EXPECT_NEAR(end[2 * i + 1], together, 1e-12) << i << " of " << count;
      }
    }
  }
}

/// A stack falls on a floor, lies there, and has kept nothing: at rest the floor bears the weight of all.
TEST(OneInstant, AStackThatFallsComesToRest) {
  for (const double r : {0.0, 0.3, 0.5}) {
    for (const int count : {2, 3, 4}) {
      Model model = row(count, r, ImpactLaw::sequence);  // ball i + 1 lies on ball i
      model.stops.insert(model.stops.begin(), Stop{"floor", ground, 0, 0.0, r});
      for (int i = 0; i < count; ++i) model.forces.push_back({i, 0, -1.0});
      State start;
      for (int i = 0; i < count; ++i) start.insert(start.end(), {0.5, 0.0});
      Motion motion(System(model), start);
      while (motion.advance({40, 0.0}) == Outcome::event) {
      }
      const State end = motion.state();
      for (int i = 0; i < count; ++i) {
        EXPECT_NEAR(end[2 * i], 0.0, 1e-12) << r << " " << count;
        EXPECT_NEAR(end[2 * i + 1], 0.0, 1e-12) << r << " " << count;
      }
    }
  }
}

TEST(OneInstant, ACopyAmongTheEventsGoesOnWithTheirStates) {
  const Model model = row(3, 1.0, ImpactLaw::sequence);
  const System system(model);
  Motion motion(system, {-0.5, 1.0, 0, 0, 0, 0});
  ASSERT_EQ(motion.advance({1, 0.0}), Outcome::event);
  Motion copy = motion;
  EXPECT_EQ(copy.before()[1], 1.0);
  ASSERT_EQ(copy.advance({1, 0.0}), Outcome::event);
  EXPECT_EQ(copy.before()[3], 1.0);
  EXPECT_EQ(motion.before()[1], 1.0);
  EXPECT_EQ(motion.before()[3], 0.0);
}

/// Two equal bodies side by side, with the same force.
Model twins() {
  Model model;
  model.coordinates = {{"left", 1.0}, {"right", 1.0}};
  model.springs = {{0, ground, 1.0}, {1, ground, 1.0}};
  model.forces = {{0, 1, 1.0}, {1, 1, 1.0}};
  model.omega = 1.3;
  return model;
}

Model with_stops(Model model) {
  model.stops = {{"l", 0, ground, 0.3, 0.6}, {"r", 1, ground, 0.3, 0.6}};
  return model;
}

Model with_buffers(Model model) {
  model.compliant_stops = {{"l", 0, ground, 0.3, 40.0, 2.0}, {"r", 1, ground, 0.3, 40.0, 2.0}};
  return model;
}

std::vector<Event> events_of(const Model& model, const State& start, int periods) {
  Motion motion(System(model), start);
  std::vector<Event> events;
  while (motion.advance({periods, 0.0}) == Outcome::event) events.push_back(motion.event());
  return events;
}

/// Every event of one twin has its like of the other at the same instant, with the same speed within rounding: of
/// forces and corners the event's own condition alone is made exact.
void expect_pairs(const std::vector<Event>& events, EventKind kind, int first, std::size_t least) {
  std::vector<Event> left, right;
  for (const Event& event : events)
    if (event.kind == kind) (event.contact == first ? left : right).push_back(event);
  ASSERT_EQ(left.size(), right.size()) << name(kind);
  EXPECT_GE(left.size(), least) << name(kind);
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(right[i].contact, first + 1);
    EXPECT_EQ(left[i].time, right[i].time) << name(kind) << " " << i;
    EXPECT_NEAR(left[i].w, right[i].w, 1e-12) << name(kind) << " " << i;
  }
}

TEST(OneInstant, TwoEqualStopsHaveARowEachRigidOrNot) {
  const State start = {-0.2, 0.1, -0.2, 0.1};
  expect_pairs(events_of(with_stops(twins()), start, 20), EventKind::impact, 0, 20);
  const std::vector<Event> soft = events_of(with_buffers(twins()), start, 20);
  for (const EventKind kind : {EventKind::engage, EventKind::disengage, EventKind::separate})
    expect_pairs(soft, kind, 0, 15);
}

TEST(OneInstant, TwoEqualFrictionContactsLetGoTogetherInTwoRows) {
  Model model = twins();
  model.omega = 0.3;
  model.frictions = {{"l", 0, ground, 0.0, 0.5, 0.4}, {"r", 1, ground, 0.0, 0.5, 0.4}};
  const std::vector<Event> events = events_of(model, {0, 0, 0, 0}, 20);
  expect_pairs(events, EventKind::release, 0, 1);
  expect_pairs(events, EventKind::stick, 0, 1);
}

/// Equal bodies in a row with springs between them, each on a spring and a pad, under one force.
Model row_of_pads(int count) {
  Model m;
  m.omega = 1.3;
  for (int i = 0; i < count; ++i) {
    m.coordinates.push_back({"x" + std::to_string(i), 1.0});
    m.springs.push_back({i, ground, 1.0});
    m.dampers.push_back({i, ground, 0.1});
    m.forces.push_back({i, 1, 1.0, 0.0});
    m.frictions.push_back({"pad" + std::to_string(i), i, ground, 0.0, 0.3, 0.3});
    if (i > 0) m.springs.push_back({i - 1, i, 0.3});
  }
  return m;
}

/// All pads let go and hold at one instant: 3^24 combinations, of which a few for each pad are asked. A force acts on
/// all bodies: with twenty of them and more the bound of a window's rest was infinite, however short the window.
TEST(OneInstant, ManyEqualPadsActAsOne) {
  const auto events = [](const System& system) {
    std::vector<Event> all;
    Motion motion(system, State(2 * static_cast<std::size_t>(system.model().size()), 0.0));
    while (motion.advance({10, 0.0}) == Outcome::event) all.push_back(motion.event());
    return all;
  };
  const System one(row_of_pads(1));
  const std::vector<Event> of_one = events(one);
  ASSERT_GE(of_one.size(), 20U);
  for (const int count : {12, 24}) {
    const System many(row_of_pads(count));
    EXPECT_LT(many.windows_per_period(), 2.0 * one.windows_per_period()) << count;
    const std::vector<Event> all = events(many);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(count) * of_one.size()) << count;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Event& same = of_one[i / static_cast<std::size_t>(count)];
      EXPECT_EQ(all[i].kind, same.kind) << i;
      EXPECT_NEAR(all[i].time.since(same.time), 0.0, 1e-12) << i;
    }
  }
}

/// A disc between pads, which are bodies on springs: as many as wanted of a share each.
Model disc_and_pads(int count) {
  Model m;
  m.omega = 0.9;
  const double share = 1.0 / count;
  m.coordinates = {{"disc", 2.0}};
  m.springs = {{0, ground, 1.0}};
  m.dampers = {{0, ground, 0.1}};
  m.forces = {{0, 1, 2.3, 0.0}};
  for (int i = 1; i <= count; ++i) {
    m.coordinates.push_back({"pad" + std::to_string(i), 0.2 * share});
    m.springs.push_back({i, ground, 1.5 * share});
    m.dampers.push_back({i, ground, 0.05 * share});
    m.frictions.push_back({"f" + std::to_string(i), i, 0, 0.0, 0.9 * share, 0.7 * share});
  }
  return m;
}

/// All act on the disc, and let go at one instant: 3^16 combinations, which were asked one after the other.
TEST(OneInstant, ManyPadsOnOneDiscActAsOne) {
  const std::vector<Event> of_one = events_of(disc_and_pads(1), State(4, 0.0), 10);
  ASSERT_GT(of_one.size(), 30U);
  for (const std::size_t count : {4, 16}) {
    const std::vector<Event> all = events_of(disc_and_pads(static_cast<int>(count)), State(2 * count + 2, 0.0), 10);
    ASSERT_EQ(all.size(), count * of_one.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(all[i].kind, of_one[i / count].kind) << i;
      EXPECT_NEAR(all[i].time.since(of_one[i / count].time), 0.0, 1e-12) << i;
    }
  }
}

TEST(OneInstant, TwoEqualSpringsPassTheirCornersInTwoRows) {
  Model model = twins();
  for (const int i : {0, 1})
    model.characteristics.push_back(
        {i == 0 ? "l" : "r", i, ground, Characteristic::Over::displacement, {{0.2, 0.2}}, 1.0, 4.0});
  expect_pairs(events_of(model, {-0.1, 0, -0.1, 0}, 20), EventKind::corner, 0, 20);
}

/// An impact takes the body out of a buffer: the buffer's force would pull, so it lets go at that instant.
TEST(OneInstant, ABufferThatAnImpactUnloadsLetsGoInARowOfItsOwn) {
  Model model;
  model.coordinates = {{"x", 1.0}};
  model.compliant_stops = {{"buffer", 0, ground, 0.0, 1.0, 5.0}};
  model.stops = {{"wall", 0, ground, 0.5, 0.9}};
  const std::vector<Event> events = events_of(model, {-0.1, 6.0}, 1);
  ASSERT_GE(events.size(), 4U);
  EXPECT_EQ(events[0].kind, EventKind::engage);
  EXPECT_EQ(events[1].kind, EventKind::impact);
  EXPECT_EQ(events[2].kind, EventKind::disengage);
  EXPECT_EQ(events[2].time, events[1].time);
  EXPECT_NEAR(events[2].w, -0.9 * events[1].w, 1e-14);
  EXPECT_EQ(events[3].kind, EventKind::separate);
}

/// A weak damper far from the origin: where its force ends is known to the rounding of the displacement, and the speed
/// that would make the force zero there is another one.
TEST(OneInstant, AStopWithAWeakDamperLetsGoOnce) {
  Model model;
  model.coordinates.push_back({"x", 1.0});
  model.springs.push_back({0, ground, 0.001});
  model.compliant_stops.push_back({"buffer", 0, ground, 500.0, 10.0, 1e-3});
  for (int k = 0; k < 300; ++k) {
    Motion motion(System(model), {499.9, 1.0 + 0.01 * k});
    std::string kinds;
    while (motion.advance({3, 0.0}) == Outcome::event) kinds += std::string(name(motion.event().kind)) + " ";
    EXPECT_EQ(kinds, "engage disengage separate ") << k;
  }
}

/// Bodies at rest at their walls, which a load lets go for a short flight.
Model hopping(int bodies, double load) {
  Model model;
  model.omega = 1.0;
  for (int i = 0; i < bodies; ++i) {
    model.coordinates.push_back({"x" + std::to_string(i), 1.0});
    model.forces.push_back({i, 0, 1.0, 0.0});
    model.forces.push_back({i, 1, load, 0.0});
    model.stops.push_back({"wall" + std::to_string(i), i, ground, 0.0, 0.3});
  }
  return model;
}

/// In a flight of rounding size one of the gaps passes its zero before the other's is found: no mode would fit.
TEST(OneInstant, BodiesThatHopTogetherComeBackTogether) {
  for (int k = 0; k < 60; ++k) {
    const double load = 1.0 + std::pow(10.0, -8.0 + 0.1 * k);
    const std::vector<Event> one = events_of(hopping(1, load), State(2, 0.0), 3),
                             two = events_of(hopping(2, load), State(4, 0.0), 3);
    const auto of = [](const std::vector<Event>& events, int wall) {
      return std::count_if(events.begin(), events.end(), [&](const Event& event) {
        return event.kind == EventKind::release && event.contact == wall;
      });
    };
    EXPECT_EQ(of(two, 0), of(one, 0)) << load;
    EXPECT_EQ(of(two, 1), of(one, 0)) << load;
  }
}

}  // namespace
}  // namespace slapstick
