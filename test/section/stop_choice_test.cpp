/// Sections of some stops only, and of compliant ones: closed forms, and the event list of the same motion.
#include "slapstick/section/stop_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "section/run_impacts.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

std::vector<SectionPoint> points(const System& system, const State& start, const StopChoice& stops, double periods) {
  std::vector<SectionPoint> found;
  ImpactSection section(Motion(system, start), stops);
  run_impacts(section, Instant{}.plus(periods), nullptr, [&](const SectionPoint& point) {
    found.push_back(point);
    return true;
  });
  return found;
}

/// A free mass between two elastic walls at -1 and 1.
Model corridor() {
  Model model;
  model.name = "corridor";
  model.coordinates = {{"x", 1.0}};
  model.stops = {{"right", 0, ground, 1.0, 1.0}, {"left", ground, 0, 1.0, 1.0}};
  return model;
}

/// Pressed by a unit force against a damped pad, shaken: on the way out it lets go and pushes again beyond its gap.
Model pad(double damping, double amplitude, double omega) {
  Model model;
  model.name = "pad";
  model.coordinates = {{"x", 1.0}};
  model.forces = {{0, 0, 1.0, 0.0}, {0, 1, amplitude, 0.0}};
  model.compliant_stops = {{"pad", 0, ground, 0.0, 1.0, damping, false}};
  model.omega = omega;
  return model;
}

/// A contact of every kind, on two coordinates.
Model everything() {
  Model model;
  model.name = "everything";
  model.coordinates = {{"x1", 1.0}, {"x2", 2.0}};
  model.springs = {{0, ground, 1.0}, {1, ground, 2.0}, {0, 1, 0.5}};
  model.dampers = {{0, ground, 0.05}, {1, ground, 0.05}};
  model.forces = {{0, 1, 1.0, 0.0}, {1, 2, 0.7, 1.0}};
  model.frictions = {{"rub", 0, 1, 0.0, 0.02, 0.02}};
  model.stops = {{"wall", 0, ground, 0.5, 0.7}, {"meet", 1, 0, 0.6, 0.8}};
  model.compliant_stops = {{"buffer", 1, ground, 0.2, 20.0, 0.3, false}};
  model.omega = 1.3;
  return model;
}

TEST(StopChoice, TheFlightOfOneWallIsThereAndBack) {
  const System system(corridor());
  for (const auto& [name, first] : {std::pair("right", 0.5), std::pair("left", 1.5)}) {
    const auto one = points(system, {0.0, 2.0}, {system.model(), {name}}, 20.0);
    ASSERT_EQ(one.size(), 10U) << name;
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_NEAR(one[i].time.seconds(1.0), first + 2.0 * static_cast<double>(i), 1e-13) << name;
      EXPECT_EQ(system.contact_name(one[i].contact), name);
      if (i > 0) {
        EXPECT_NEAR(one[i].flight, 2.0, 1e-13) << "the other wall ends no flight";
      }
    }
  }
  const auto both = points(system, {0.0, 2.0}, {}, 20.0);
  ASSERT_EQ(both.size(), 20U);
  for (std::size_t i = 1; i < both.size(); ++i)
    EXPECT_NEAR(both[i].flight, 1.0, 1e-13) << "of both, every crossing is a flight";
}

/// A drop on an undamped pad of stiffness k: flights in the air last 2 w, those in the pad 2 (pi - atan(w
/// sqrt(k))) / sqrt(k), w = sqrt(2 h).
TEST(StopChoice, EngagementsOfADroppedMassAreAFallAndAHalfSwingApart) {
  for (const double k : {10.0, 1e3, 1e5}) {
    Model model = pad(0.0, 0.0, 0.0);
    model.forces.resize(1);
    model.compliant_stops[0].stiffness = k;
    const System system(model);
    const double w = std::sqrt(2.0 * 0.7), rate = std::sqrt(k);
    const double flight = 2.0 * w + 2.0 * (std::numbers::pi - std::atan(w * rate)) / rate;
    const auto found = points(system, {-0.7, 0.0}, {}, 40.0);
    EXPECT_EQ(found.size(), 1 + static_cast<std::size_t>((40.0 - w) / flight)) << k;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].w, w, 1e-12);
      EXPECT_NEAR(found[i].state[0], 0.0, 1e-13) << "at the gap";
      EXPECT_NEAR(found[i].state[1], w, 1e-12) << "just before";
      if (i > 0) {
        EXPECT_NEAR(found[i].flight, flight, 1e-11) << k;
      }
    }
  }
}

TEST(StopChoice, APushBeyondTheGapIsNoPoint) {
  const System system(pad(2.0, 2.0, 3.0));
  Motion motion(system, {-1.0, 0.0});
  std::vector<Instant> entries;
  int pushes = 0;
  while (motion.advance({90, 0.0}) == Outcome::event) {
    const Event& event = motion.event();
    if (event.kind != EventKind::engage) continue;
    const bool at_gap = std::abs(motion.before()[0]) < 1e-12;
    EXPECT_EQ(at_gap, event.w > 0.0) << "it pushes again on its way out";
    pushes += !at_gap;
    if (at_gap) entries.push_back(event.time);
  }
  ASSERT_GT(pushes, 10);
  const auto found = points(system, {-1.0, 0.0}, {}, 90.0);
  ASSERT_EQ(found.size(), entries.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].time, entries[i]);
}

/// One stop's points are those of all stops that are its own: the same bits, and flights that add up.
TEST(StopChoice, TheSectionOfAllStopsIsTheUnionOfTheirOwn) {
  const System system(everything());
  const State start{-0.2, 0.0, -0.1, 0.0};
  const auto all = points(system, start, {}, 300.0);
  std::size_t total = 0;
  for (const int contact : stop_contacts(system.model())) {
    const std::string& name = stop_name(system.model(), contact);
    EXPECT_EQ(system.contact_name(contact), name);
    const auto own = points(system, start, {system.model(), {name}}, 300.0);
    EXPECT_GT(own.size(), 50U) << name;
    total += own.size();
    std::size_t i = 0;
    for (const auto& point : all) {
      if (point.contact != contact) continue;
      ASSERT_LT(i, own.size());
      EXPECT_EQ(point.time, own[i].time);
      EXPECT_EQ(point.w, own[i].w);
      EXPECT_EQ(point.state, own[i].state);
      EXPECT_EQ(own[i].contact, contact);
      ++i;
    }
    EXPECT_EQ(i, own.size()) << name;
  }
  EXPECT_EQ(total, all.size());
  const auto two = points(system, start, {system.model(), {"buffer", "wall"}}, 300.0);
  const auto meets = std::ranges::count_if(all, [](const auto& point) { return point.contact == 1; });
  EXPECT_EQ(two.size() + static_cast<std::size_t>(meets), all.size());
}

/// A ball that a slow force throws from floor to roof and back; it chatters to rest on both.
TEST(StopChoice, AChatterEndsFlightsOfItsOwnStopOnly) {
  Model model;
  model.name = "room";
  model.coordinates = {{"x", 1.0}};
  model.forces = {{0, 1, 3.0, 0.0}};
  model.stops = {{"floor", ground, 0, 0.0, 0.5}, {"roof", 0, ground, 2.0, 0.5}};
  model.omega = 0.3;
  const System system(model);
  ImpactSection roof(Motion(system, {1.0, 0.0}), {model, {"roof"}});
  SectionPoint point;
  Instant last, limit;  // of the roof's: point, and chatter
  roof.watch([&](const Motion& motion) {
    if (motion.event().kind == EventKind::chatter && motion.event().contact == 1) limit = motion.event().time;
  });
  int after_floor = 0;
  ASSERT_TRUE(roof.next({20, 0.0}, point));
  for (last = point.time; roof.next({20, 0.0}, point); last = point.time) {
    EXPECT_EQ(point.contact, 1);
    EXPECT_EQ(point.flight, point.time.since(std::max(last, limit)));
    after_floor += roof.between().chatters > 1;  // the roof's own, and the floor's
  }
  EXPECT_GT(after_floor, 10);
}

TEST(StopChoice, AnUnknownNameIsAnsweredWithThoseThereAre) {
  const auto message = [](const Model& model, const std::string& name) -> std::string {
    try {
      (void)StopChoice(model, {name});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(everything(), "wal"), "model 'everything' has no stop 'wal'; the model has wall, meet, buffer");
  EXPECT_EQ(message(everything(), "rub"), "model 'everything' has no stop 'rub'; the model has wall, meet, buffer");
  EXPECT_EQ(message(everything(), ""), "model 'everything' has no stop ''; the model has wall, meet, buffer");
  EXPECT_EQ(message(everything(), "buffer"), "");
  Model none = corridor();
  none.stops.clear();
  EXPECT_EQ(message(none, "x"), "model 'corridor' has no stop 'x', nor any other");
}

}  // namespace
}  // namespace slapstick
