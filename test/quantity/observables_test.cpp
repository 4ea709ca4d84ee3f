/// Observables that name quantities: they are those quantities, in the mode of the instant.
#include "slapstick/quantity/observables.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "settled.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::test {
namespace {

std::string with(const std::string& observables) {
  return load_model("vibro-impact").to_toml({{"omega", 0.552}}) + observables;
}

std::string refused(const std::string& expression) {
  try {
    (void)ModelDefinition::parse(with("[[observable]]\nname = \"o\"\nvalue = \"" + expression + "\"\n"), "m.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Through stick, a closed stop and chatter: the expression of quantities is that of their values.
TEST(Observables, OfQuantitiesAreThoseOfTheirValues) {
  const ModelDefinition definition = ModelDefinition::parse(
      with("[[observable]]\nname = \"lost\"\nvalue = \"F_friction * w_friction - power_friction\"\n"
           "[[observable]]\nname = \"balance\"\nvalue = \"F_stop + 2 * a1 + omega * x1\"\n"),
      "m.toml");
  const System system(definition.build());
  const auto all = quantities(definition);
  Observables observables(system, definition.observer());
  Reader reader(system, {find_quantity(all, "F_stop"), find_quantity(all, "a1"), find_quantity(all, "x1")});
  SampledMotion sampled(Motion(system, definition.start()), 50);
  long samples = 0, pressed = 0;
  for (auto item = sampled.next({6, 0.0}); item != SampledMotion::Item::end; item = sampled.next({6, 0.0})) {
    if (item != SampledMotion::Item::sample) continue;
    const auto values = observables.within(sampled.motion(), sampled.sample());
    const auto& read = reader.within(sampled.motion(), sampled.sample().within);
    EXPECT_NEAR(values[0], 0.0, 1e-15);
    EXPECT_DOUBLE_EQ(values[1], read[0] + 2.0 * read[1] + 0.552 * read[2]);
    ++samples;
    pressed += read[0] > 0.0 ? 1 : 0;
  }
  EXPECT_GT(samples, 290);
  EXPECT_GT(pressed, 5);
}

/// A mass on a spring under a harmonic, two tones and a signal.
const std::string driven =
    "name = 'm'\nomega = 1.3\n[[coordinate]]\nname = 'x'\nmass = 2\n"
    "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 4\n"
    "[[force]]\non = 'x'\namplitude = 1\nphase = 0.3\n"
    "[[force]]\non = 'x'\namplitude = 0.5\nfrequency = 1.41421356\n"
    "[[force]]\non = 'x'\namplitude = 0.7\nfrequency = 0.37\nphase = 1\n"
    "[[signal]]\nname = 's'\npoints = [[0.5, 0], [3, 1], [9, -1], [10, 0.5]]\n"
    "[[force]]\non = 'x'\nsignal = 's'\namplitude = 2\n"
    "[[observable]]\nname = 'twice'\nvalue = '2 * a'\n";
const std::string wall = "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\nrestitution = 0.6\n";

double drive_at(double t) {
  const double knots[] = {0.5, 3, 9, 10}, values[] = {0, 1, -1, 0.5};
  double signal = t < knots[0] ? values[0] : values[3];
  for (int i = 0; i < 3; ++i)
    if (t >= knots[i] && t < knots[i + 1])
      signal = values[i] + (values[i + 1] - values[i]) * (t - knots[i]) / (knots[i + 1] - knots[i]);
  return std::sin(1.3 * t + 0.3) + 0.5 * std::sin(1.41421356 * t) + 0.7 * std::sin(0.37 * t + 1.0) + 2.0 * signal;
}

/// 2 a = F(t) - 4 x - F_wall at every sample, just before every event and behind it, for columns and for observables.
TEST(Observables, KnowTonesAndSignals) {
  const ModelDefinition definition = ModelDefinition::parse(driven + wall, "m.toml");
  const System system(definition.build());
  const auto all = quantities(definition);
  Observables observables(system, definition.observer());
  Reader reader(system, {find_quantity(all, "a"), find_quantity(all, "F_wall")});
  SampledMotion sampled(Motion(system, definition.start()), 20);
  const auto expect = [&](const std::vector<double>& read, double t, double x) {
    EXPECT_NEAR(read[0], (drive_at(t) - 4.0 * x - read[1]) / 2.0, 1e-12) << t;
  };
  long samples = 0, events = 0;
  for (auto item = sampled.next({6, 0.0}); item != SampledMotion::Item::end; item = sampled.next({6, 0.0})) {
    const Motion& motion = sampled.motion();
    if (item == SampledMotion::Item::sample) {
      const auto& sample = sampled.sample();
      const std::vector<double>& read = reader.within(motion, sample.within);
      expect(read, sample.time.seconds(system.period()), sample.state[0]);
      EXPECT_EQ(observables.within(motion, sample)[0], 2.0 * read[0]);
      ++samples;
    } else {
      const double t = motion.event().time.seconds(system.period());
      expect(reader.before(motion), t, motion.before()[0]);
      expect(reader.now(motion), t, motion.state()[0]);
      ++events;
    }
  }
  EXPECT_GT(samples, 110);
  EXPECT_GT(events, 10);
}

/// A damper on a base whose speed jumps from 0.1 to 2: the force before the knot is that of the speed before.
TEST(Observables, AtAKnotAreThoseOfTheSideThatIsAskedFor) {
  const ModelDefinition definition = ModelDefinition::parse(
      "name = 'm'\n[[signal]]\nname = 's'\npoints = [[0, 0], [1, 0.1], [3, 4.1]]\n[[coordinate]]\nname = 'x'\nmass = "
      "1\n"
      "[[base]]\nname = 'b'\nsignal = 's'\n[[damper]]\nbetween = ['x', 'b']\ncoefficient = 0.5\n",
      "m.toml");
  const System system(definition.build());
  Reader reader(system, {find_quantity(quantities(definition), "a")});
  Motion motion(system, definition.start());
  ASSERT_EQ(motion.advance({2, 0.0}), Outcome::event);
  ASSERT_EQ(motion.event().kind, EventKind::knot);
  const double v = 0.1 * (1.0 - std::exp(-0.5));
  EXPECT_NEAR(reader.within(motion, motion.segment().duration)[0], 0.5 * (0.1 - v), 1e-15);
  EXPECT_NEAR(reader.before(motion)[0], 0.5 * (0.1 - v), 1e-15);
  EXPECT_NEAR(reader.now(motion)[0], 0.5 * (2.0 - v), 1e-15);
}

/// What `measure` finds as the greatest acceleration and its instant is what a column shows there.
TEST(Observables, ShowTheExtremesThatAreMeasured) {
  const ModelDefinition definition = ModelDefinition::parse(driven, "m.toml");
  const System system(definition.build());
  const std::vector<Quantity> of = {find_quantity(quantities(definition), "a")};
  const Measured found = measure(Motion(system, definition.start()), {6, 0.0}, of);
  Motion motion(system, definition.start());
  const Instant at = Instant{}.plus(found.of[0].greatest_at / system.period());
  while (motion.advance(at) == Outcome::event) {
  }
  EXPECT_NEAR(Reader(system, of).now(motion)[0], found.of[0].greatest, 1e-11);
}

TEST(Observables, UnknownQuantitiesAreAnsweredWithTheNearestAndTheLine) {
  EXPECT_NE(refused("F_stpo").find("F_stop"), std::string::npos) << refused("F_stpo");
  EXPECT_EQ(refused("F_stpo").find("m.toml:"), 0U) << refused("F_stpo");
  EXPECT_NE(refused("2 * impulse").find("at impacts"), std::string::npos) << refused("2 * impulse");
  EXPECT_NE(refused("stiffnes").find("unknown name"), std::string::npos) << refused("stiffnes");
}

TEST(Observables, NeedTheQuantitiesThatTheyName) {
  const ModelDefinition definition =
      ModelDefinition::parse(with("[[observable]]\nname = \"o\"\nvalue = \"F_stop\"\n"), "m.toml");
  Observer observer = definition.observer();
  ASSERT_EQ(observer.quantities().size(), 1U);
  EXPECT_THROW((void)observer.read(0.0, {0, 0, 0, 0}), InputError);
  EXPECT_EQ(observer.read(0.0, {0, 0, 0, 0}, {2.5})[0], 2.5);
}

}  // namespace
}  // namespace slapstick::test
