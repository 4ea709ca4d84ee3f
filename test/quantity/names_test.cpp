/// The list of quantities: names that users type, and what a wrong one is answered with.
#include <gtest/gtest.h>

#include <set>

#include "slapstick/base/error.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::test {
namespace {

std::string message(const std::vector<Quantity>& all, const std::string& name) {
  try {
    static_cast<void>(find_quantity(all, name));
  } catch (const InputError& error) {
    return error.message();
  }
  return "";
}

TEST(Quantities, FollowTheNamesOfCoordinatesAndContacts) {
  const auto all = quantities(load_model("vibro-impact"));
  for (const char* name : {"x1",
                           "v1",
                           "a1",
                           "x2",
                           "v2",
                           "a2",
                           "gap_stop",
                           "w_stop",
                           "F_stop",
                           "power_stop",
                           "w_friction",
                           "F_friction",
                           "power_friction",
                           "kinetic_energy",
                           "potential_energy",
                           "power_in",
                           "power_damping",
                           "w",
                           "impulse",
                           "energy_lost",
                           "flight",
                           "sliding",
                           "omega"})
    EXPECT_EQ(find_quantity(all, name).name, name);
  std::set<std::string> names;
  for (const Quantity& one : all) EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

TEST(Quantities, OfContactsWithFixedLimitsHaveNoNormalForce) {
  EXPECT_EQ(find_quantity(quantities(load_model("pressed-block")), "N_belt").kind, Quantity::Kind::normal);
  EXPECT_NE(message(quantities(load_model("vibro-impact")), "N_friction"), "");
}

/// The acceleration of x1 would be a1, which is a coordinate here: both can be asked for.
TEST(Quantities, OfACoordinateThatHasTheNameOfAnAccelerationAreTwo) {
  Model model;
  model.coordinates = {{"a1", 1.0}, {"x1", 1.0}};
  const auto all = quantities(model);
  EXPECT_EQ(find_quantity(all, "a1").kind, Quantity::Kind::displacement);
  EXPECT_EQ(find_quantity(all, "a1_2").kind, Quantity::Kind::acceleration);
}

TEST(Quantities, OfABareCoordinateHaveNoNumber) {
  const auto all = quantities(load_model("belt"));
  for (const char* name : {"x", "v", "a"}) EXPECT_EQ(find_quantity(all, name).name, name);
}

TEST(Quantities, AnUnknownNameIsAnsweredWithTheNearest) {
  const auto all = quantities(load_model("vibro-impact"));
  EXPECT_NE(message(all, "F_stpo").find("did you mean 'F_stop'?"), std::string::npos) << message(all, "F_stpo");
  EXPECT_NE(message(all, "x1-v1").find("a difference"), std::string::npos);
  EXPECT_NE(message(all, "w-w").find("a difference"), std::string::npos);
  EXPECT_THROW(check_statistic(find_quantity(all, "a1"), "rsm"), InputError);
  EXPECT_THROW(check_statistic(find_quantity(all, "a1"), "q50"), InputError);
  EXPECT_NO_THROW(check_statistic(find_quantity(all, "impulse"), "q50"));
}

TEST(Quantities, AParameterIsWhatIsSet) {
  const auto all = quantities(load_model("vibro-impact"), {{"omega", 1.75}});
  EXPECT_EQ(find_quantity(all, "omega").value, 1.75);
}

TEST(Quantities, HaveTheUnitsOfTheFile) {
  const auto all = quantities(load_model("bouncing-ball"));
  EXPECT_EQ(find_quantity(all, "gravity").unit, "m/s^2");
}

/// A ball on a floor, with a parameter that has the name of the speed at impacts.
std::string ball(const std::string& length, const std::string& mass, const std::string& weight) {
  return "name = \"ball\"\n[parameters]\nw = { value = 3, unit = \"" + weight + "\" }\nm = { value = 2, unit = \"" +
         mass + "\" }\nk = { value = 5, unit = \"" + weight + "/" + length +
         "\" }\n[[coordinate]]\nname = \"x\"\nmass = \"m\"\nunit = \"" + length +
         "\"\n[[force]]\non = \"x\"\nharmonic = 0\namplitude = \"-w\"\n[[spring]]\nbetween = [\"x\", "
         "\"ground\"]\nstiffness = \"k\"\n"
         "[[stop]]\nname = \"floor\"\nbetween = [\"ground\", \"x\"]\nclearance = 0\nrestitution = 0.5\n[start]\nx = "
         "1\n";
}

TEST(Quantities, ThatShareANameAreBothThere) {
  const auto all = quantities(ModelDefinition::parse(ball("m", "kg", "N"), "ball"));
  EXPECT_TRUE(find_quantity(all, "w").at_impacts());
  EXPECT_EQ(find_quantity(all, "w_2").value, 3.0);
  std::set<std::string> names;
  for (const Quantity& one : all) EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

TEST(Quantities, HaveTheUnitsOfTheFilesOwnSystem) {
  const auto unit = [](const std::vector<Quantity>& all, const char* name) { return find_quantity(all, name).unit; };
  const auto si = quantities(ModelDefinition::parse(ball("m", "kg", "N"), "ball"));
  EXPECT_EQ(
      unit(si, "F_floor") + "," + unit(si, "kinetic_energy") + "," + unit(si, "power_in") + "," + unit(si, "impulse"),
      "N,J,W,N s");
  const auto small = quantities(ModelDefinition::parse(ball("mm", "t", "N"), "ball"));
  EXPECT_EQ(unit(small, "F_floor") + "," + unit(small, "kinetic_energy"), "N,mJ");
  const auto odd = quantities(ModelDefinition::parse(ball("mm", "g", "g mm/ms^2"), "ball"));
  EXPECT_EQ(unit(odd, "F_floor") + "," + unit(odd, "kinetic_energy"), "N,mJ");
  const auto bare = quantities(ModelDefinition::parse(ball("1", "1", "1"), "ball"));
  EXPECT_EQ(unit(bare, "F_floor"), "");
}

}  // namespace
}  // namespace slapstick::test
