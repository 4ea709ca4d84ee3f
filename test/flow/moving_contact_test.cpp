/// Coordinates measured from a [[base]]: contacts that move with it, against closed forms and against the same machine
/// in coordinates that stand still.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/refusal.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;

const std::string table =
    "name = 'm'\nomega = 'omega'\n[parameters]\nomega = 1\nacceleration = 1.2\nphase = 0\nrestitution = 0.5\n"
    "[[base]]\nname = 'table'\nharmonics = [{ amplitude = 'acceleration / omega^2', phase = 'phase' }]\n"
    "[[coordinate]]\nname = 'x'\nmass = 1\nbase = 'table'\n[[force]]\non = 'x'\nharmonic = 0\namplitude = -1\n";
const std::string top =
    "[[stop]]\nname = 'top'\nbetween = ['table', 'x']\nclearance = 0\nrestitution = 'restitution'\n";

Motion run(const Model& model, const State& start, double time) {
  Motion motion(System(model), start);
  const Instant end = Instant{}.plus(time / model.forcing_period());
  while (motion.advance(end) == Outcome::event) {
  }
  return motion;
}

TEST(MovingContact, a_moving_table_is_the_shaken_table_seen_from_the_table) {
  const auto moving = ModelDefinition::parse(table + top, "f.toml"), shaken = load_model("shaken-table");
  for (const double acceleration : {0.9, 1.2, 3.0, 5.0}) {
    const Overrides values = {{"acceleration", acceleration}, {"phase", 0.7}, {"omega", 1.25}};
    Motion a(System(moving.build(values)), {0.3, 1.0}), b(System(shaken.build(values)), {0.3, 1.0});
    const Instant end{12, 0.0};
    while (a.advance(end) == Outcome::event) {
      ASSERT_EQ(b.advance(end), Outcome::event);
      ASSERT_EQ(a.event().kind, b.event().kind);
      EXPECT_NEAR(a.event().time.since(b.event().time), 0.0, 1e-11);
      EXPECT_NEAR(a.event().w, b.event().w, 1e-10);
    }
    EXPECT_GE(a.counters().events, 5);
    EXPECT_EQ(b.advance(end), Outcome::reached_end);
  }
}

TEST(MovingContact, a_flight_is_a_parabola_and_an_impact_uses_the_tables_velocity) {
  const auto definition = ModelDefinition::parse(table + top, "f.toml");
  const Overrides values = {{"omega", 2}, {"acceleration", 4}};  // table = sin 2 t, its velocity 2 cos 2 t
  Motion motion(System(definition.build(values)), {1.0, 2.0});   // at height 1, with velocity 4
  ASSERT_EQ(motion.advance({5, 0.0}), Outcome::event);
  const double t = motion.event().time.seconds(pi), before = 4 - t, moves = 2 * std::cos(2 * t);
  EXPECT_NEAR(1 + 4 * t - t * t / 2, std::sin(2 * t), 1e-13);
  EXPECT_NEAR(motion.before()[1], before - moves, 1e-13);
  EXPECT_NEAR(motion.state()[1] + moves, moves - 0.5 * (before - moves), 1e-13);
}

/// The mass is carried along while static >= m a w^2 sin w t.
TEST(MovingContact, a_shaken_belt_lets_go_where_its_acceleration_exceeds_friction) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 1.5\n[[base]]\nname = 'belt'\nharmonics = [{ amplitude = 2 }]\n[[coordinate]]\nname = 'x'\n"
      "mass = 3\nbase = 'belt'\n[[friction]]\nname = 'f'\nbetween = ['x', 'belt']\nstatic = 9\nkinetic = 5\n"
      "belt_speed = 0.7\n",
      "f.toml");
  const Model model = definition.build();
  Motion motion(System(model), {0.0, 0.7});
  ASSERT_EQ(motion.advance({1, 0.0}), Outcome::event);
  const double t = motion.event().time.seconds(model.forcing_period());
  EXPECT_EQ(motion.event().kind, EventKind::release);
  EXPECT_NEAR(t, std::asin(9 / (3 * 2 * 1.5 * 1.5)) / 1.5, 1e-14);
  (void)motion.advance(Instant{}.plus((t + 0.2) / model.forcing_period()));
  const double belt = 0.7 + 2 * 1.5 * std::cos(1.5 * (t + 0.2));
  EXPECT_NEAR(motion.state()[1] - 0.7 + belt, 0.7 + 3 * std::cos(1.5 * t) - 0.2 * 5 / 3,
              1e-13);  // decelerates by f_k / m
}

/// Full matrices, springs and dampers to the ground, to the base and between coordinates: x1 + base is the x1 that is
/// measured from the ground.
TEST(MovingContact, inertia_and_links_are_those_of_the_coordinates_that_stand_still) {
  const auto text = [](bool moving) {
    std::string all =
        "name = 'm'\nomega = 1.3\n[parameters]\na = 0.4\n[[base]]\nname = 'b'\nharmonics = [{ amplitude = 'a', phase = "
        "0.3 }, { amplitude = 0.1, harmonic = 3 }, { amplitude = 0.2, harmonic = 0 }]\n"
        "[matrix]\nmass = [[1, 0.3], [0.3, 0.5]]\ndamping = [[0.2, 0.1], [0.1, 0.3]]\nstiffness = [[2, 0.4], [0.4, "
        "1]]\n"
        "[[coordinate]]\nname = 'x1'\nmass = 0.7\n";
    if (moving) all += "base = 'b'\n";
    all += "[[coordinate]]\nname = 'x2'\nmass = 1.1\n";
    for (const std::string ends : {"'x1', 'ground'", "'b', 'x1'", "'x1', 'x2'", "'x2', 'b'"})
      all += "[[spring]]\nbetween = [" + ends + "]\nstiffness = 1.7\n[[damper]]\nbetween = [" + ends +
             "]\ncoefficient = 0.6\n";
    return ModelDefinition::parse(all, "f.toml");
  };
  const Model still = text(false).build(), moving = text(true).build();
  const auto base = [](double t) { return 0.4 * std::sin(1.3 * t + 0.3) + 0.1 * std::sin(3.9 * t) + 0.2; };
  const auto speed = [](double t) { return 0.52 * std::cos(1.3 * t + 0.3) + 0.39 * std::cos(3.9 * t); };
  const State start = {0.5, -0.2, 0.1, 0.3};
  for (const double t : {0.4, 2.0, 7.7, 31.0}) {
    const State a = run(still, start, t).state();
    const State b = run(moving, {0.5 - base(0), -0.2 - speed(0), 0.1, 0.3}, t).state();
    EXPECT_NEAR(a[0], b[0] + base(t), 1e-12);
    EXPECT_NEAR(a[1], b[1] + speed(t), 1e-12);
    EXPECT_NEAR(a[2], b[2], 1e-12);
    EXPECT_NEAR(a[3], b[3], 1e-12);
  }
}

TEST(MovingContact, rates_are_those_of_differences) {
  const auto definition = ModelDefinition::parse(table + top, "f.toml");
  for (const std::string name : {"omega", "acceleration", "phase"}) {
    const double at = definition.values().at(name), h = 1e-6;
    const Model rate = definition.rate(name), up = definition.build({{name, at + h}}),
                down = definition.build({{name, at - h}});
    ASSERT_EQ(rate.forces.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(rate.forces[i].amplitude, (up.forces[i].amplitude - down.forces[i].amplitude) / (2 * h), 1e-8);
      EXPECT_NEAR(rate.forces[i].phase, (up.forces[i].phase - down.forces[i].phase) / (2 * h), 1e-8);
    }
  }
}

TEST(MovingContact, what_is_written_reads_back) {
  const auto definition = ModelDefinition::parse(table + top, "f.toml");
  const auto again = ModelDefinition::parse(definition.to_toml(), "g.toml");
  EXPECT_EQ(again.to_toml(), definition.to_toml());
  EXPECT_EQ(again.build().forces.size(), 2U);
  EXPECT_EQ(
      refusal(table + "[[stop]]\nname = 's'\nbetween = ['x', 'ground']\nclearance = 0\nrestitution = 1\n"),
      "f.toml:21: stop 's': between: its sides move with 'table' and with the ground: the gap or the sliding would "
      "depend on time. Measure the coordinates from the base: base = \"table\" in [[coordinate]]");
  EXPECT_EQ(refusal("name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\nbase = 'b'\n"),
            "f.toml:2: coordinate 'x': base: unknown base 'b'");
}

}  // namespace
}  // namespace slapstick
