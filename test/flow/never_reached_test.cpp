/// A contact that is never reached takes no digit from the motion, wherever it stands in the file.
#include <gtest/gtest.h>

#include <cmath>

#include "base/text.hpp"
#include "mode/numbering.hpp"
#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::testing {
namespace {

const std::string mass_on_spring =
    "name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\n[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n";
const std::string far_away[] = {"1e3", "1e6", "1e9", "1e12"};

std::string named_by(std::string kind, const std::string& number) {
  for (const char c : number) kind += c == '.' ? '_' : c;
  return "name = '" + kind + "'\n";
}

std::string stop_at(const std::string& clearance, const std::string& more = "") {
  return "[[stop]]\n" + named_by("stop_", clearance) + "between = ['x', 'ground']\nclearance = " + clearance +
         "\nrestitution = 0.5\n" + more;
}

std::string pad_on(const std::string& belt, double friction) {
  return "[[friction]]\n" + named_by("pad_", belt) + "between = ['x', 'ground']\nstatic = " + std::to_string(friction) +
         "\nbelt_speed = " + belt + "\n";
}

Model model_with(const std::string& parts) { return ModelDefinition::parse(mass_on_spring + parts, "f.toml").build(); }

/// x = -cos t until it hits the stop at 0.3.
void first_impact_is_exact(const std::string& parts) {
  const System system(model_with(parts));
  Motion motion(system, {-1.0, 0.0});
  const std::vector<Event> events = run(motion, 10.0, 1);
  ASSERT_EQ(kinds(events), "impact") << parts;
  EXPECT_NEAR(seconds(events[0], motion), std::acos(-0.3), 4e-15) << parts;
  EXPECT_NEAR(events[0].w, std::sqrt(1.0 - 0.09), 4e-16) << parts;
}

TEST(NeverReached, AStopCostsNoDigitWhereverItIsListed) {
  for (const std::string& far : far_away) {
    first_impact_is_exact(stop_at(far) + stop_at("0.3"));
    first_impact_is_exact(stop_at("0.3") + stop_at(far));
    first_impact_is_exact(stop_at("0.3", "two_sided = true\nclearance_lower = " + far + "\n"));
    first_impact_is_exact(pad_on("0", 0.0) + stop_at(far) + stop_at("0.3"));
  }
}

/// The only stop of its pair; a constant force says how large motions are: x = 1 - 2 cos t all along.
TEST(NeverReached, AStopAloneOnItsPairCostsNoDigitButTenBits) {
  constexpr double ten_bits = 4.0 * 0x1p10 * 0x1p-53;  // what a stop that is not far yet may cost (mode/numbering.cpp)
  for (const std::string& far : far_away) {
    const System system(model_with("[[force]]\non = 'x'\nharmonic = 0\namplitude = 1\n" + stop_at(far)));
    Motion motion(system, {-1.0, 0.0});
    EXPECT_TRUE(run(motion, 10.0).empty());
    EXPECT_NEAR(motion.state()[0], 1.0 - 2.0 * std::cos(10.0), ten_bits) << far;
    EXPECT_NEAR(motion.state()[1], 2.0 * std::sin(10.0), ten_bits) << far;
  }
}

/// Against a belt that is far too fast to stick to friction is a constant force f: x = f + (x_0 - f) cos t.
TEST(NeverReached, AFastBeltIsAConstantForce) {
  for (const std::string& belt : far_away) {
    const System system(model_with(pad_on(belt, 0.125)));
    Motion motion(system, {1.0, 0.0});
    EXPECT_TRUE(run(motion, 10.0).empty());
    EXPECT_NEAR(motion.state()[0], 0.125 + 0.875 * std::cos(10.0), 1e-14) << belt;
    EXPECT_NEAR(motion.state()[1], -0.875 * std::sin(10.0), 1e-14) << belt;
  }
}

/// A belt and a stop on one pair: neither is numbered by the other, so that both are met exactly.
TEST(NeverReached, AFastBeltCostsTheImpactsAtAStopNoDigit) {
  for (const std::string& belt : far_away) {
    const System system(model_with(pad_on(belt, 0.125) + stop_at("0.3")));
    Motion motion(system, {-1.0, 0.0});  // about 0.125
    const std::vector<Event> events = run(motion, 10.0, 1);
    ASSERT_EQ(kinds(events), "impact");
    EXPECT_NEAR(seconds(events[0], motion), std::acos(-0.175 / 1.125), 4e-15) << belt;
    EXPECT_NEAR(events[0].w, std::sqrt(1.125 * 1.125 - 0.175 * 0.175), 4e-16) << belt;
  }
}

/// x = -3e6 cos t: what is far is hit where it is reached after all, with a rounding of the motion's own size.
TEST(NeverReached, AFarStopThatIsReachedAfterAllIsHit) {
  const System system(model_with(pad_on("0", 0.125) + stop_at("1e6")));
  EXPECT_EQ(system.compiled().frame().d, 2);
  Motion motion(system, {-3e6, 0.0});
  const std::vector<Event> events = run(motion, 10.0, 1);
  ASSERT_EQ(kinds(events), "impact");
  const double f = 0.125, A = 3e6 - f;  // x = -f - A cos t: friction is against the motion
  EXPECT_NEAR(seconds(events[0], motion), std::acos(-(1e6 + f) / A), 4e-15);
  EXPECT_EQ(motion.state()[0], 1e6);
}

/// A mass comes to rest at a stop and sticks there. A stop that is a thousand times as far, and first in the file, must
/// not carry the displacement: the rest at the nearer one would not be found again by a state.
TEST(NeverReached, ARestAtAStopIsFoundAgainBesideAFarOne) {
  const std::string mass =
      "name = 'm'\nomega = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n"
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 0.5\n"
      "[[force]]\non = 'x'\namplitude = 1\n"
      "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 2\nkinetic = 0\n";
  const auto stop = [](const std::string& name, const std::string& clearance) {
    return "[[stop]]\nname = '" + name + "'\nbetween = ['x', 'ground']\nclearance = " + clearance +
           "\nrestitution = 0\n";
  };
  for (const std::string& far : {std::string(), stop("far", "1150.9979070572376")}) {
    const System system(ModelDefinition::parse(mass + far + stop("near", "0.3"), "m").build());
    const Classification found = classify(system, {0.0, 1.0}, {.transient_periods = 100});
    EXPECT_EQ(found.attractor, Attractor::periodic) << far;
    EXPECT_EQ(found.state[0], 0.3) << far;
  }
}

/// One mass rests at its stop, another swings about any place beyond the buffer: one of a family.
/// What looks for members moves the first mass by rounding, and must not put it behind its stop.
TEST(NeverReached, AMemberOfAFamilyMayRestAtAStop) {
  for (const double length : {1.0, 0.5788534805276381, 0.3, 7.0}) {
    const auto scaled = [&](const std::string& key, double value) {
      return key + " = " + shown(length * value) + "\n";
    };
    const std::string text =
        "name = 'm'\nomega = 1\n[[coordinate]]\nname = 'x'\nmass = 0.4\n[[coordinate]]\nname = 'y'\nmass = 1\n"
        "[[base]]\nname = 'floor'\n[[base.harmonics]]\n" +
        scaled("amplitude", 1.0) + "[[damper]]\nbetween = ['y', 'floor']\ncoefficient = 1\n[[force]]\non = 'x'\n" +
        scaled("amplitude", 0.5) +
        "harmonic = 0\n[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nrestitution = 0\n" +
        scaled("clearance", -0.0443152808) +
        "[[compliant_stop]]\nname = 'buffer'\nbetween = ['y', 'x']\nclearance = 0\nstiffness = 1\n"
        "damping = 0\nlaw = 'lets_go'\n[start]\n" +
        scaled("x", -0.75) + scaled("y", -1.7);
    const ModelDefinition definition = ModelDefinition::parse(text, "m");
    const System system(definition.build());
    const Classification found = classify(system, definition.start(), {.transient_periods = 100});
    EXPECT_EQ(found.attractor, Attractor::family) << length;
  }
}

/// W of the basis belongs to the first contact of each pair, its shift to the nearest one, where the first is far
/// beside that: a parameter that makes it so moves no row.
TEST(Numbering, TheBasisKeepsItsRowsWhereAnotherContactBecomesTheNearest) {
  Model model = model_with(stop_at("0.5") + stop_at("2", "two_sided = true\n") + pad_on("0", 1.0));
  const mode::Frame before(model);
  model.stops[0].clearance = 4096.0;
  const mode::Frame after(model);
  EXPECT_EQ(before.W.topRows(1), after.W.topRows(1));
  EXPECT_EQ(before.shift[0], 0.5);
  EXPECT_EQ(std::abs(after.shift[0]), 2.0);
  for (const mode::Frame& frame : {before, after})
    for (std::size_t i = 0; i < frame.stops.size(); ++i)
      EXPECT_EQ(frame.stops[i].sign * frame.W(frame.stops[i].own, 0), model.stops[i].a == ground ? -1.0 : 1.0) << i;
}

TEST(Numbering, NearContactsNeedNoNumberMore) {
  EXPECT_EQ(mode::Frame(model_with(stop_at("0.3") + pad_on("0", 1.0))).d, 1);
  EXPECT_EQ(mode::Frame(model_with(stop_at("0.3", "two_sided = true\n") + pad_on("0", 1.0))).d, 2);
  EXPECT_EQ(mode::Frame(model_with(pad_on("0.5", 1.0))).d, 1);
  EXPECT_EQ(mode::Frame(model_with(stop_at("5") + pad_on("0.5", 1.0))).d, 2);
}

}  // namespace
}  // namespace slapstick::testing
