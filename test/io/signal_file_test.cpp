/// Signals from CSV files, bands and frequencies of a model file: what is refused, with which line, and what is
/// printed reads back.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/refusal.hpp"
#include "io/same_model.hpp"

namespace slapstick {
namespace {

const std::string head = "name = 'm'\nomega = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n";

class SignalFile : public ::testing::Test {
 protected:
  SignalFile() : folder_(std::filesystem::temp_directory_path() / ("signal_file_test_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~SignalFile() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] std::string model(const std::string& more = "") const {
    return head + "[[signal]]\nname = 'road'\nfile = 'road.csv'\n" + more +
           "[[force]]\non = 'x'\nsignal = 'road'\namplitude = 2\n";
  }
  [[nodiscard]] ModelDefinition read(const std::string& text) const {
    return ModelDefinition::parse(text, (folder_ / "m.toml").string());
  }
  [[nodiscard]] std::string message(const std::string& text) const {
    try {
      (void)read(text).build();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

TEST_F(SignalFile, a_column_by_its_heading_and_the_second_one_without) {
  write("road.csv", "t,left,right\n0,1,10\n0.5,2,20\n1.25,3,30\n");
  const Model left = read(model()).build(), right = read(model("column = 'right'\nrepeats = false\n")).build();
  ASSERT_EQ(left.signals.size(), 1U);
  EXPECT_EQ(left.signals[0].knots[2].time, 1.25);
  EXPECT_EQ(left.signals[0].knots[2].value, 3.0);
  EXPECT_EQ(right.signals[0].knots[1].value, 20.0);
  EXPECT_EQ(left.forces[0].signal, 0);
  EXPECT_EQ(left.forces[0].amplitude, 2.0);
}

TEST_F(SignalFile, what_is_printed_reads_back) {
  std::string text = "0 0\n";
  for (int i = 1; i < 90; ++i) text += std::to_string(0.1 * i) + " " + std::to_string(i % 7) + "\n";
  write("road.csv", text);
  const auto few = read(model());
  EXPECT_EQ(few.to_toml().find("file ="), std::string::npos);
  EXPECT_EQ(ModelDefinition::parse(few.to_toml(), "f.toml").build().signals[0].knots.size(), 90U);
  for (int i = 90; i < 900; ++i) text += std::to_string(0.1 * i) + " " + std::to_string(i % 7) + "\n";
  write("road.csv", text);
  const auto many = read(model());
  const Model again = ModelDefinition::parse(many.to_toml(), "elsewhere/f.toml").build();
  ASSERT_EQ(again.signals[0].knots.size(), 900U);
  EXPECT_EQ(again.signals[0].knots[899].value, many.build().signals[0].knots[899].value);
}

/// A step of the whole range needs 2^-26 of the clock's period, 1.5e-8; a part of it that part.
TEST_F(SignalFile, a_step_that_is_steeper_than_the_clock_resolves_is_named_with_its_row) {
  const auto said = [&](const std::string& rows) {
    write("road.csv", rows);
    return message(model());
  };
  const std::string steep = said("t,z\n0,1\n1,2\n1.00000001,0\n");
  EXPECT_NE(steep.find("m.toml:6: signal 'road': file: "), std::string::npos) << steep;
  EXPECT_NE(steep.find("road.csv:4: time 1.00000001 is only"), std::string::npos) << steep;
  EXPECT_EQ(said("t,z\n0,1\n1,2\n1.0000001,0\n"), "accepted");
  EXPECT_EQ(said("t,z\n0,1\n1,2\n1.00000001,1.98\n2,0\n"), "accepted");
  const std::string written = message(
      "name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\n[[signal]]\nname = 's'\npoints = [[0, 0], [1e-8, 1]]\n");
  EXPECT_NE(written.find("m.toml:"), std::string::npos) << written;
  EXPECT_NE(written.find("signal 's': point 2: time 1e-08 is only 1e-08 after"), std::string::npos) << written;
}

TEST_F(SignalFile, a_bad_row_is_named_with_its_file) {
  const auto said = [&](const std::string& rows) {
    write("road.csv", rows);
    return message(model());
  };
  EXPECT_NE(said("t,z\n0,1\n1,2\n0.5,3\n").find("road.csv:4: time 0.5 is below the 1 of the row before"),
            std::string::npos);
  EXPECT_NE(said("t,z\n0,1\n1,2\n1,3\n1,4\n").find("road.csv:5: there are three rows at time 1"), std::string::npos);
  EXPECT_NE(said("0,1\n1,nan\n").find("road.csv:2: 'nan' is not a finite number"), std::string::npos);
  EXPECT_NE(said("0,1\n1,\n").find("road.csv:2: a number is missing"), std::string::npos);
  EXPECT_NE(said("0,1\n1\n").find("road.csv:2: the row has 1 field"), std::string::npos);
  EXPECT_NE(said("0,1\n").find("has only one row"), std::string::npos);
  EXPECT_NE(said("0\n1\n").find("has no column of values beside the time"), std::string::npos);
  write("road.csv", "t,z\n0,1\n1,2\n");
  EXPECT_NE(message(model("column = 'y'\n")).find("m.toml:9: signal 'road': column: file 'road.csv' has no column 'y'"),
            std::string::npos)
      << message(model("column = 'y'\n"));
  std::filesystem::remove(folder_ / "road.csv");
  EXPECT_NE(message(model()).find("m.toml:8: signal 'road': file: "), std::string::npos) << message(model());
}

std::string signal(const std::string& text) {
  return "[[signal]]\nname = 's'\n" + text + "[[force]]\non = 'x'\nsignal = 's'\namplitude = 1\n";
}

/// A period must hold whole rounds, and a number that the shape does not have would be a promise without effect.
TEST(PeriodicSignalRefusal, names_key_and_line) {
  const auto says = [](const std::string& text, const std::string& what) {
    const std::string told = refusal(text);
    EXPECT_NE(told.find(what), std::string::npos) << told;
  };
  says(head + signal("points = [[0, 1], [0.4, 1]]\nrepeats = true\nin_periods = true\n"), "a whole number of rounds");
  says(head + signal("points = [[0, 1], [1, 1]]\nin_periods = true\n"), "belongs to a 'repeats'");
  says("name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\n" + signal("shape = 'square'\n"), "the file has no 'omega'");
  says(head + signal("shape = 'sine'\n"), "f.toml:8: signal 's': shape");
  says(head + signal("shape = 'sawtooth'\nduty = 0.2\n"), "duty: a sawtooth has none");
  says(head + signal("shape = 'square'\nduty = 1.2\n"), "f.toml:9: signal 's': duty = 1.2 is not between 0 and 1");
  says(head + signal("shape = 'trapezoid'\nrise = 0.6\n"), "rise = 0.6 is not between 0 and 0.5");
  says(head + signal("shape = 'square'\nrepeats = true\n"), "repeats");
}

/// Rounds that fit a period three times, given by decimal numbers, are three rounds of exactly one period.
TEST(PeriodicSignal, has_rounds_that_fill_a_period) {
  const Model model = ModelDefinition::parse(head + signal("points = [[0.1, 1], [0.2, 3], [0.433333333333333, 1]]\n"
                                                           "repeats = true\nin_periods = true\n"),
                                             "f.toml")
                          .build();
  const auto& knots = model.signals[0].knots;
  ASSERT_EQ(knots.size(), 7U);
  EXPECT_EQ(knots.back().time - knots.front().time, 1.0);
  EXPECT_NEAR(knots[2].time, 0.1 + 1.0 / 3.0, 1e-14);
  EXPECT_EQ(knots[3].value, 3.0);
  EXPECT_TRUE(model.forced());
  EXPECT_TRUE(model.periodic());
}

/// The number of points is the file's: two rounds whose ends meet at one value of a parameter are those of a step.
TEST(PeriodicSignal, has_as_many_points_at_every_value_of_a_parameter) {
  const ModelDefinition definition =
      ModelDefinition::parse(head + "[parameters]\np = 1\n" +
                                 signal("points = [[0, 1], [0.2, 3], [0.5, 'p']]\nrepeats = true\nin_periods = true\n"),
                             "f.toml");
  const auto points = [&](double p) { return definition.build({{"p", p}}).signals[0].knots.size(); };
  EXPECT_EQ(points(1.0), points(2.0));
}

/// A steep piece is told by the row of its file, also where rounds are repeated and a first row is never taken.
TEST_F(SignalFile, a_steep_piece_of_a_round_has_its_row) {
  write("road.csv", "t,z\n0,5\n0,1\n0.2,2\n0.200000000001,3\n0.5,1\n");
  const std::string said = message(model("repeats = true\nin_periods = true\n"));
  EXPECT_NE(said.find("road.csv:5: time 0.2"), std::string::npos) << said;
}

/// Signals alone give a model their longest round as its period, and shorter ones are counted in it.
TEST(PeriodicSignal, is_the_clock_where_nothing_else_is) {
  const std::string body = "name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\n";
  const std::string second =
      "[[signal]]\nname = 'quick'\nshape = 'triangle'\nperiod = 0.5\n"
      "[[force]]\non = 'x'\nsignal = 'quick'\namplitude = 1\n";
  const std::string slow = signal("points = [[0, 0], [1, 1], [1.5, 0]]\nrepeats = true\n");
  const Model model = ModelDefinition::parse(body + slow + second, "f.toml").build();
  EXPECT_NEAR(model.forcing_period(), 1.5, 1e-15);
  EXPECT_EQ(model.signals[1].knots.size(), 7U);
  EXPECT_TRUE(model.periodic());
  const std::string other = "[[force]]\non = 'x'\nfrequency = 2\namplitude = ";
  EXPECT_FALSE(ModelDefinition::parse(body + slow + other + "1\n", "f.toml").build().periodic());
  EXPECT_TRUE(ModelDefinition::parse(body + slow + other + "0\n", "f.toml").build().periodic());
}

/// A shape leads by its phase: a square by a quarter turn is high around its old start.
TEST(PeriodicSignal, shapes_lead_by_their_phase) {
  const Model model =
      ModelDefinition::parse(head + signal("shape = 'square'\nphase = 'pi / 2'\nlow = 0\nhigh = 2\n"), "f.toml")
          .build();
  const auto& knots = model.signals[0].knots;
  const std::vector<std::pair<double, double>> expected = {{-0.25, 2.0}, {0.25, 2.0}, {0.25, 0.0}, {0.75, 0.0}};
  ASSERT_EQ(knots.size(), expected.size());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    EXPECT_NEAR(knots[i].time, expected[i].first, 1e-16);
    EXPECT_EQ(knots[i].value, expected[i].second);
  }
}

TEST(SignalRefusal, names_the_line) {
  const std::string s = "[[signal]]\nname = 's'\npoints = [[0, 1], [1, 2]]\n";
  EXPECT_EQ(refusal(head + s + "[[force]]\non = 'x'\nsignal = 't'\namplitude = 1\n"),
            "f.toml:11: force 1: signal: unknown signal 't'; known: s");
  EXPECT_NE(refusal(head + "[[signal]]\nname = 's'\npoints = [[0, 1], [0, 2]]\n").find("all points are at one time"),
            std::string::npos);
  EXPECT_NE(refusal(head + "[[signal]]\nname = 's'\npoints = [[0, 1], [1, 2], [0.5, 2]]\n").find("time 0.5 is below 1"),
            std::string::npos);
  EXPECT_NE(
      refusal(head + s +
              "repeats = true\n[[base]]\nname = 'b'\nsignal = 's'\n[[damper]]\nbetween = ['x', 'b']\ncoefficient = 1\n")
          .find("has a step, at which its rate of change is not finite"),
      std::string::npos);
  EXPECT_NE(refusal("name = 'm'\n[[signal]]\nname = 's'\npoints = [[0, 1], [1, 2], [1, 3]]\n[[base]]\nname = "
                    "'b'\nsignal = 's'\n[[coordinate]]\nname = 'x'\nmass = 1\nbase = 'b'\n")
                .find("which steps: what is measured from it would be elsewhere at once"),
            std::string::npos);
  EXPECT_NE(
      refusal(head + "[[force]]\non = 'x'\nband = { from = 3, to = 2, rms = 1 }\n").find("to: 2 is below from = 3"),
      std::string::npos);
  EXPECT_NE(refusal(head + "[[force]]\non = 'x'\nband = { from = 1, to = 200, rms = 1 }\n").find("200 harmonics"),
            std::string::npos);
  EXPECT_NE(
      refusal(head + "[[force]]\non = 'x'\namplitude = 1\nfrequency = -2\n").find("f.toml:9: force 1: frequency = -2"),
      std::string::npos);
  EXPECT_NE(refusal(head + "[[force]]\non = 'x'\namplitude = 1\nfrequency = 2\nharmonic = 1\n").find("in place of"),
            std::string::npos);
}

}  // namespace
}  // namespace slapstick
