/// A drive of a size that the file writes as 0 is no drive; one whose size is a parameter stays one at the value 0.
#include <gtest/gtest.h>

#include <exception>

#include "io/same_model.hpp"
#include "slapstick/io/observer.hpp"

namespace slapstick {
namespace {

const std::string head =
    "name = 'm'\nomega = 2\n[parameters]\np = 0\n[[coordinate]]\nname = 'x'\nmass = 1\n"
    "[[spring]]\nname = 'k'\nbetween = ['x', 'ground']\nstiffness = 1\n";
const std::string quiet = "[[signal]]\nname = 'quiet'\npoints = [[0, 0], [1, 0.0], [2, 0]]\n";
const std::string road = "[[signal]]\nname = 'road'\npoints = [[0, 0], [1, 1]]\n";

std::string force(const std::string& keys) { return "[[force]]\non = 'x'\n" + keys + "\n"; }
std::string shaken(const std::string& base, const std::string& stiffness = "10") {
  return "[[base]]\nname = 'shaker'\n" + base +
         "\n[[spring]]\nname = 'k2'\nbetween = ['x', 'shaker']\nstiffness = " + stiffness + "\n";
}
Model built(const std::string& more) { return ModelDefinition::parse(head + more, "f.toml").build(); }

TEST(SilentDrive, a_size_of_zero_makes_no_model_forced_or_aperiodic) {
  const Model free = built("");
  for (const std::string& more :
       {force("amplitude = 0"), force("amplitude = -0.0\nharmonic = 2"), force("amplitude = '2 - 2'"),
        force("amplitude = 0\nfrequency = 1.7"), force("amplitude = 0\nharmonic = 0"),
        force("band = { from = 1, to = 3, rms = 0 }"), road + force("amplitude = 0\nsignal = 'road'"),
        quiet + force("amplitude = 1\nsignal = 'quiet'"),
        road + force("amplitude = 0\nsignal = 'road'") + force("amplitude = 0")}) {
    const Model model = built(more);
    EXPECT_TRUE(!model.forced() && model.periodic()) << more;
    EXPECT_EQ(model.signals.size(), 0U) << more;
    expect_same(model, free);
  }
  for (const std::string& more : {shaken("harmonics = [{ amplitude = 0 }, { amplitude = 0, frequency = 3 }]"),
                                  shaken("harmonics = [{ amplitude = 1 }]", "0"),
                                  shaken("band = { from = 1, to = 3, rms = 0 }"), quiet + shaken("signal = 'quiet'")}) {
    const Model model = built(more);
    EXPECT_EQ(model.forces.size(), 0U) << more;
    EXPECT_TRUE(model.springs.back().motion.none()) << more;
  }
}

/// A branch over the size must not change what kind of model it is.
TEST(SilentDrive, a_parameter_of_value_zero_keeps_the_structure) {
  for (const std::string& more :
       {force("amplitude = 'p'"), force("amplitude = 'p'\nfrequency = 1.7"),
        road + force("amplitude = '3 * p'\nsignal = 'road'"), shaken("harmonics = [{ amplitude = 'p' }]"),
        shaken("harmonics = [{ amplitude = 1 }]", "'p'")}) {
    const auto definition = ModelDefinition::parse(head + more, "f.toml");
    const Model at_zero = definition.build(), beside = definition.build({{"p", 0.5}}), rate = definition.rate("p");
    EXPECT_EQ(at_zero.forces.size(), 1U) << more;
    EXPECT_EQ(at_zero.forces.size(), beside.forces.size()) << more;
    EXPECT_EQ(at_zero.forces.size(), rate.forces.size()) << more;
    EXPECT_EQ(at_zero.forced(), beside.forced()) << more;
    EXPECT_EQ(at_zero.periodic(), beside.periodic()) << more;
  }
}

/// Forces and signals have other numbers than in the file: who refers to them must follow, in the derivative too.
TEST(SilentDrive, what_stays_keeps_its_springs_and_signals) {
  const std::string both = quiet + road + "[[signal]]\nname = 'idle'\npoints = [[0, 0], [1, 5]]\n";
  const auto definition =
      ModelDefinition::parse(head + both + force("amplitude = 0") + force("amplitude = 2\nsignal = 'road'") +
                                 force("amplitude = 1\nsignal = 'quiet'") +
                                 shaken("harmonics = [{ amplitude = 0 }, { amplitude = 'p + 1' }, { amplitude = 0, "
                                        "harmonic = 3 }, { amplitude = 3, harmonic = 2 }]"),
                             "f.toml");
  for (const Model& model : {definition.build(), definition.rate("p")}) {
    ASSERT_EQ(model.signals.size(), 1U);
    EXPECT_EQ(model.signals[0].name, "road");
    ASSERT_EQ(model.forces.size(), 3U);
    EXPECT_EQ(model.forces[0].signal, 0);
    EXPECT_EQ(model.springs[0].motion.count, 0);
    EXPECT_EQ(model.springs[1].motion.first, 1);
    EXPECT_EQ(model.springs[1].motion.count, 2);
  }
  EXPECT_EQ(definition.build().forces[1].amplitude, 10.0);
  EXPECT_EQ(definition.rate("p").forces[1].amplitude, 10.0);
  EXPECT_EQ(definition.build().forces[2].harmonic, 2);
}

/// An entry of a matrix that is 0 at one value of a parameter is a force there too: the derivative has it.
TEST(SilentDrive, an_entry_of_a_matrix_that_passes_zero_has_a_force) {
  const std::string text =
      "name = 'm'\nomega = 2\n[parameters]\np = 0\n[[base]]\nname = 'b'\nharmonics = [{ amplitude = 1 }]\n"
      "[[coordinate]]\nname = 'x'\nmass = 1\nbase = 'b'\n[matrix]\nstiffness = [['p']]\n";
  const auto definition = ModelDefinition::parse(text, "f.toml");
  EXPECT_EQ(definition.build().forces.size(), definition.rate("p").forces.size());
  EXPECT_EQ(definition.rate("p").forces.back().amplitude, -1.0);
}

/// What is left out is looked at all the same.
TEST(SilentDrive, what_is_wrong_with_it_is_told) {
  const auto told = [](const std::string& more, const std::string& what) {
    std::string message = "accepted";
    try {
      (void)built(more);
    } catch (const std::exception& error) {
      message = error.what();
    }
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  told(force("amplitude = 0\nharmonic = 1.5"), "harmonic = 1.5 is not a whole number");
  told(force("amplitude = 0\nfrequency = -1"), "frequency = -1 is not positive");
  told(force("amplitude = 0\nsignal = 'rod'"), "signal");
  told("[[signal]]\nname = 'idle'\nfile = 'absent.csv'\n", "absent.csv");
  told("[[signal]]\nname = 'idle'\npoints = [[0, 0], [0, 1]]\n", "all points are at one time");
  told("[[signal]]\nname = 'idle'\npoints = [[0, 0], [1, 1], [0.5, 1]]\n", "is below 1 of the point before");
}

/// Without its harmonic the clock counts units of time: a piece that a faster clock resolves is too steep for it.
TEST(SilentDrive, steep_pieces_are_measured_by_the_clock_that_is_left) {
  const std::string steep = road + "[[signal]]\nname = 'step'\npoints = [[0, 0], [1e-10, 1]]\n" +
                            force("amplitude = 0\nsignal = 'road'") + force("amplitude = 1\nsignal = 'step'");
  const std::string fast = "name = 'm'\nomega = 1e6\n[[coordinate]]\nname = 'x'\nmass = 1\n" + steep;
  EXPECT_NO_THROW((void)ModelDefinition::parse(fast + force("amplitude = 1"), "f.toml").build());
  try {
    (void)ModelDefinition::parse(fast + force("amplitude = 0"), "f.toml").build();
    ADD_FAILURE() << "accepted";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("f.toml:9: signal 'step'"), std::string::npos) << error.what();
  }
}

/// An observable may name a base that moves nothing by its size, and follows its signal by its points.
TEST(SilentDrive, an_observed_base_keeps_its_signal) {
  const auto definition = ModelDefinition::parse(
      head + road + shaken("signal = 'road'", "0") + "[[observable]]\nname = 'o'\nvalue = 'shaker'\n", "f.toml");
  EXPECT_EQ(definition.build().signals.size(), 1U);
  EXPECT_TRUE(definition.build().periodic());
  EXPECT_EQ(definition.observer().read(0.25, {0, 0}, {}).at(0), 0.25);
}

}  // namespace
}  // namespace slapstick
