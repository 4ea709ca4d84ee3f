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
  for (const char* name : {"x1", "v1", "a1", "x2", "v2", "a2", "gap_stop", "w_stop", "F_stop", "power_stop", "w_friction", "F_friction",
                           "power_friction", "kinetic_energy", "potential_energy", "power_in", "power_damping", "w", "impulse",
                           "energy_lost", "flight", "sliding", "omega"})
    EXPECT_EQ(find_quantity(all, name).name, name);
  std::set<std::string> names;
  for (const Quantity& one : all) EXPECT_TRUE(names.insert(one.name).second) << one.name;
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

}  // namespace
}  // namespace slapstick::test
