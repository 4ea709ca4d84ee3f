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
  EXPECT_NE(said("t,z\n0,1\n1,2\n1,3\n").find("road.csv:4: time 1 is not above the 1 of the row before"), std::string::npos);
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

TEST(SignalRefusal, names_the_line) {
  const std::string s = "[[signal]]\nname = 's'\npoints = [[0, 1], [1, 2]]\n";
  EXPECT_EQ(refusal(head + s + "[[force]]\non = 'x'\nsignal = 't'\namplitude = 1\n"),
            "f.toml:11: force 1: signal: unknown signal 't'; known: s");
  EXPECT_NE(refusal(head + s + "repeats = true\n").find("a signal that repeats would jump"), std::string::npos);
  EXPECT_NE(refusal(head + "[[signal]]\nname = 's'\npoints = [[0, 1], [0, 2]]\n").find("f.toml:"), std::string::npos);
  EXPECT_NE(refusal("name = 'm'\n" + s + "[[base]]\nname = 'b'\nsignal = 's'\n[[coordinate]]\nname = 'x'\nmass = 1\nbase = 'b'\n")
                .find("whose speed jumps at every point"),
            std::string::npos);
  EXPECT_NE(refusal(head + "[[force]]\non = 'x'\nband = { from = 3, to = 2, rms = 1 }\n").find("to: 2 is below from = 3"),
            std::string::npos);
  EXPECT_NE(refusal(head + "[[force]]\non = 'x'\nband = { from = 1, to = 200, rms = 1 }\n").find("200 harmonics"),
            std::string::npos);
  EXPECT_NE(refusal(head + "[[force]]\non = 'x'\namplitude = 1\nfrequency = -2\n").find("f.toml:9: force 1: frequency = -2"),
            std::string::npos);
  EXPECT_NE(refusal(head + "[[force]]\non = 'x'\namplitude = 1\nfrequency = 2\nharmonic = 1\n").find("in place of"),
            std::string::npos);
}

}  // namespace
}  // namespace slapstick
