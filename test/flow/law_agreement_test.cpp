/// The engine against 50 digits over 20 periods, where every law of force is in play.
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/laws.hpp"
#include "property/machine.hpp"
#include "runs.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::testing {
namespace {

constexpr int periods = 20;

/// By how much states differ, in units of the largest number of the second.
double distance(const oracle::Vector& a, const oracle::Vector& b) {
  oracle::Real size = 1, far = 0;
  for (std::size_t i = 0; i < a.size(); ++i) size = std::max(size, abs(b[i])), far = std::max(far, abs(a[i] - b[i]));
  return (far / size).convert_to<double>();
}

struct Agreement {
  int periods = 0;     ///< before a rounding has become visible
  long changes = 0;    ///< of contact states, by the oracle
  double worst = 0.0;  ///< error over what rounding may become: 1e-15 times the motion's own sensitivity
};

/// The sensitivity is that of the oracle itself, from a start that is 1e-25 off.
Agreement agree(const Model& model, const State& start) {
  const System system(model);
  Motion motion(system, start);
  oracle::Vector exact = oracle::to_real(start), near = exact;
  for (oracle::Real& x : near) x += oracle::Real("1e-25");
  oracle::LawOracle reference(model, exact), neighbour(model, near);
  Agreement found;
  double sensitivity = 1.0;
  for (int k = 1; k <= periods; ++k) {
    run(motion, motion.system().period());
    const auto changes = static_cast<long>(reference.run(k * reference.period()).size());
    neighbour.run(k * neighbour.period());
    sensitivity = std::max(sensitivity, distance(neighbour.state(), reference.state()) * 1e25);
    if (sensitivity > 1e8) break;
    found.changes += changes;
    ++found.periods;
    found.worst =
        std::max(found.worst, distance(oracle::to_real(motion.state()), reference.state()) / (1e-15 * sensitivity));
  }
  return found;
}

TEST(LawAgreement, OfTheModelsOfTheOrbits) {
  for (const char* file : {"pressed-pair.toml", "every-stop.toml"}) {
    const ModelDefinition definition = load_model(std::string(SLAPSTICK_ORBIT_MODELS) + file);
    const Agreement found = agree(definition.build(), definition.start());
    EXPECT_EQ(found.periods, periods) << file;
    EXPECT_GT(found.changes, 80) << file;
    EXPECT_LT(found.worst, 100.0) << file;
  }
}

TEST(LawAgreement, OfTheLibrary) {
  for (const char* name : {"pressed-block", "drill-string", "falling-friction", "mode-coupling-brake"}) {
    const ModelDefinition definition = load_model(name);
    const Agreement found = agree(definition.build(), definition.start());
    EXPECT_GE(found.periods, 10) << name;
    EXPECT_LT(found.worst, 200.0) << name;
  }
}

/// A stop of two stiffnesses, and a block that is measured from the belt that is shaken under it.
TEST(LawAgreement, OfStopsOfTwoStiffnessesAndOfBeltsThatAreShaken) {
  const std::string mass = "name = 'm'\nomega = 1.3\n[[coordinate]]\nname = 'x'\nmass = 1\n",
                    spring =
                        "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n[[damper]]\nbetween = ['x', "
                        "'ground']\ncoefficient = 0.1\n";
  const std::string models[] = {
      mass + spring +
          "[[force]]\non = 'x'\namplitude = 2\n[[compliant_stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance "
          "= 0.4\n"
          "stiffness = 30\nunloading_stiffness = 18\n",
      mass +
          "base = 'belt'\n[[base]]\nname = 'belt'\nharmonics = [{ amplitude = 0.6 }, { amplitude = 0.1, harmonic = 3, "
          "phase = 1 }]\n" +
          spring +
          "[[friction]]\nname = 'dry'\nbetween = ['x', 'belt']\nstatic = 0.5\nkinetic = 0.3\nbelt_speed = 0.4\n"
          "[[compliant_stop]]\nname = 'wall'\nbetween = ['x', 'belt']\nclearance = 0.2\nstiffness = 20\ndamping = "
          "3\nlaw = 'bounded'\n"};
  for (const std::string& text : models) {
    const Agreement found = agree(ModelDefinition::parse(text, "f.toml").build(), {0.1, 0.3});
    EXPECT_EQ(found.periods, periods) << text;
    EXPECT_GT(found.changes, 60) << text;
    EXPECT_LT(found.worst, 200.0) << text;
  }
}

/// Machines of ten seeds, and of as many more as a campaign asks for.
class LawOfRandomMachines : public ::testing::TestWithParam<int> {};

/// Rigid stops are left out: where they come to rest the reference ends.
TEST_P(LawOfRandomMachines, IsThatOfTheReference) {
  const test::Shape shape{
      .most_coordinates = 3, .most_stops = 0, .most_frictions = 1, .most_compliant = 2, .laws = true};
  const auto seeds = 10 * static_cast<std::uint64_t>(campaign()),
             before = static_cast<std::uint64_t>(GetParam()) * seeds;
  long all = 0, changes = 0;
  double worst = 0.0;
  for (std::uint64_t seed = before + 1; seed <= before + seeds; ++seed) {
    const test::Machine machine = test::random_machine(seed, shape);
    const Agreement found = agree(machine.model, machine.start);
    all += found.periods, changes += found.changes;
    worst = std::max(worst, found.worst);
    EXPECT_LT(found.worst, 1000.0) << seed << machine;
  }
  std::printf("%ld periods, %ld changes; the worst error is %.1f roundings times the motion's sensitivity\n", all,
              changes, worst);
  EXPECT_GT(all, 100);
  EXPECT_GT(changes, 500);
}
INSTANTIATE_TEST_SUITE_P(Tens, LawOfRandomMachines, ::testing::Range(0, 4));

}  // namespace
}  // namespace slapstick::testing
