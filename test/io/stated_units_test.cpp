/// Which units the axes of pictures may name: those that a file states, of time only where its numbers are in it.
#include <gtest/gtest.h>

#include "slapstick/io/model_file.hpp"

namespace slapstick::test {
namespace {

struct Written {
  std::string length = "m", mass = "kg", stiffness = "N/m", frequency = "Hz";
  std::string omega = "2 * pi * f", k = "k", unit = "unit = \"m\"\n", scale = "";
};

StatedUnits stated(const Written& file) {
  const auto parameter = [](const std::string& name, const std::string& unit, const std::string& value) {
    return "[parameters." + name + "]\nvalue = " + value + "\nunit = \"" + unit + "\"\n";
  };
  const std::string text =
      "name = \"t\"\nomega = \"" + file.omega + "\"\n" + file.scale + parameter("f", file.frequency, "3") +
      parameter("m", file.mass, "2") + parameter("k", file.stiffness, "500") + parameter("gap", file.length, "0.1") +
      "[[coordinate]]\nname = \"x\"\nmass = \"m\"\n" + file.unit +
      "[[spring]]\nbetween = [\"x\", \"ground\"]\nstiffness = \"" + file.k + "\"\n" +
      "[[force]]\non = \"x\"\namplitude = \"k * gap\"\n" +
      "[[stop]]\nname = \"wall\"\nbetween = [\"x\", \"ground\"]\nclearance = \"gap\"\nrestitution = 0.5\n";
  return ModelDefinition::parse(text, "t.toml").stated_units();
}

TEST(StatedUnits, AreOneSystemInWhichTheModelCalculates) {
  const StatedUnits si = stated({});
  EXPECT_EQ(si.coordinates, std::vector<std::string>{"m"});
  EXPECT_EQ(si.time, "s");
  Written small;  // N/mm is t/s^2
  small.length = "mm", small.unit = "unit = \"mm\"\n", small.mass = "t", small.stiffness = "N/mm";
  EXPECT_EQ(stated(small).time, "s");
}

/// mm and kg and N/mm: a velocity would be in mm over 0.03 s.
TEST(StatedUnits, HaveNoTimeIfTheyAreNoSystem) {
  Written mixed;
  mixed.length = "mm", mixed.unit = "unit = \"mm\"\n", mixed.stiffness = "N/mm";
  EXPECT_EQ(stated(mixed).time, "");
  EXPECT_EQ(stated(mixed).coordinates, std::vector<std::string>{"mm"});
}

/// Numbers that an expression has made dimensionless are in no unit that a parameter names.
TEST(StatedUnits, HaveNoTimeIfTheModelsNumbersAreNotInIt) {
  Written divided;
  divided.omega = "2 * pi * f / sqrt(k / m)";
  EXPECT_EQ(stated(divided).time, "");
  Written bare;
  bare.k = "500";
  EXPECT_EQ(stated(bare).time, "");
}

TEST(StatedUnits, AreNoneWhereTheFileStatesNone) {
  Written none;
  none.unit = "";
  EXPECT_EQ(stated(none).coordinates, std::vector<std::string>{""});
  for (const std::string& name : builtin_models())
    for (const std::string& unit : load_model(name).stated_units().coordinates)
      EXPECT_EQ(unit, name == "gear-rattle" ? "m" : "") << name;
  EXPECT_EQ(load_model("gear-rattle").stated_units().time, "s");
}

/// With [scale] pictures stay in the model's numbers.
TEST(StatedUnits, AreNoneWithAScale) {
  Written scaled;
  scaled.scale =
      "[scale]\nlength = { value = 2, unit = \"m\" }\ntime = { value = 3, unit = \"s\" }\nmass = { value = 1, unit = "
      "\"kg\" }\n";
  scaled.omega = "2 * pi * f * scale_time", scaled.stiffness = "1", scaled.mass = "1", scaled.length = "1";
  const StatedUnits units = stated(scaled);
  EXPECT_EQ(units.coordinates, std::vector<std::string>{""});
  EXPECT_EQ(units.time, "");
}

}  // namespace
}  // namespace slapstick::test
