/// Observables: their values along a motion, what they may name, and names that clash.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/refusal.hpp"
#include "slapstick/io/observer.hpp"

namespace slapstick {
namespace {

const std::string head =
    "name = 'm'\nomega = 2\n[parameters]\nk = 3\ngap_clash = 1\n"
    "[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'y'\nmass = 1\n"
    "[[base]]\nname = 'shaker'\nharmonics = [{ amplitude = 'k', harmonic = 1 }, { amplitude = 1, harmonic = 0 }]\n"
    "[[spring]]\nbetween = ['y', 'shaker']\nstiffness = 1\n"
    "[[stop]]\nname = 'wall'\nbetween = ['x1', 'y']\nclearance = 5\nrestitution = 1\n"
    "[[compliant_stop]]\nname = 'pad'\nbetween = ['ground', 'y']\nclearance = 'k'\nstiffness = 1\ntwo_sided = true\n";
constexpr int next = 29;  // the line after `head`

std::string observable(const std::string& value, const std::string& name = "o") {
  return "[[observable]]\nname = '" + name + "'\nvalue = " + value + "\n";
}

TEST(Observable, values_are_those_of_the_state_and_the_instant) {
  const auto text = head + observable("'k * (x1 - y)', unit = 'N'\ndescription = 'spring force'", "force");
  EXPECT_NE(refusal(text), "accepted");  // TOML has one key a line
  const auto definition = ModelDefinition::parse(
      head + observable("'k * (x1 - y)'\nunit = 'N'\ndescription = 'spring force'", "force") +
          observable("'v1 * v_y + time'", "power") + observable("'shaker'", "motion") +
          observable("'gap_wall'", "wall") + observable("'gap_pad_upper - 10 * gap_pad_lower'", "pad") +
          observable("7", "seven") + observable("'1 / x1'", "inverse"),
      "f.toml");
  ASSERT_EQ(definition.observables().size(), 7U);
  const auto& force = definition.observables()[0];
  EXPECT_TRUE(force.name == "force" && force.expression == "k * (x1 - y)" && force.unit == "N");
  EXPECT_EQ(force.description, "spring force");
  auto observer = definition.observer({{"k", 2}});
  for (const double t : {0.0, 0.3, 11.0}) {
    const auto& values = observer.read(t, {0.5, 2.0, -0.25, 3.0});
    ASSERT_EQ(values.size(), 7U);
    EXPECT_EQ(values[0], 1.5);
    EXPECT_EQ(values[1], 6.0 + t);
    EXPECT_DOUBLE_EQ(values[2], 2 * std::sin(2 * t) + 1);
    EXPECT_EQ(values[3], 4.25);
    EXPECT_EQ(values[4], (2 - 0.25) - 10 * (2 + 0.25));
    EXPECT_EQ(values[5], 7.0);
    EXPECT_EQ(values[6], 2.0);
  }
  EXPECT_TRUE(std::isinf(observer.read(0.0, {0, 0, 0, 0})[6]));
  const auto printed = definition.to_toml({{"k", 2}});
  const auto again = ModelDefinition::parse(printed, "g.toml");
  EXPECT_EQ(again.to_toml(), printed);
  EXPECT_EQ(again.observer().read(1.0, {0.5, 2.0, -0.25, 3.0}), observer.read(1.0, {0.5, 2.0, -0.25, 3.0}));
}

TEST(Observable, unknown_and_ambiguous_names_are_refused) {
  const std::string at = "f.toml:" + std::to_string(next + 2) + ": observable 'o': value: expression ";
  const auto value = [](const std::string& text) { return refusal(head + observable(text)); };
  EXPECT_EQ(value("'x1 + v_y'"), "accepted");
  EXPECT_EQ(value("'gap_wal'"), at + "'gap_wal': unknown name 'gap_wal'; did you mean 'gap_wall'?");
  EXPECT_TRUE(value("'vy'").starts_with(at + "'vy': unknown name 'vy'"));
  EXPECT_EQ(value("'x1 +'").substr(0, at.size()), at);
  EXPECT_EQ(refusal(head + observable("'2 * o'", "p") + observable("1")).substr(0, 29),
            "f.toml:31: observable 'p': va");
  EXPECT_EQ(refusal(head + "[[stop]]\nname = 'clash'\nbetween = ['x1', 'ground']\nclearance = 1\nrestitution = 1\n" +
                    observable("'gap_clash'")),
            "f.toml:36: observable 'o': value: expression 'gap_clash': 'gap_clash' has two meanings here");
}

TEST(Observable, its_name_is_a_column_of_its_own) {
  const std::string at = "f.toml:" + std::to_string(next) + ": observable ";
  const auto named = [](const std::string& name) { return refusal(head + observable("1", name)); };
  EXPECT_EQ(named("v_y"), at + "'v_y': name 'v_y' is used twice");
  EXPECT_EQ(named("shaker"), at + "'shaker': name 'shaker' is used twice");
  EXPECT_EQ(named("k"), at + "'k': a parameter has this name");
  EXPECT_EQ(named("mode"), at + "'mode': this name is reserved (it is a column of tables, or the surroundings)");
  EXPECT_EQ(named("a b"), at + "'a b': a name is 1 to 64 letters, digits and '_', beginning with a letter");
  EXPECT_EQ(refusal(head + observable("1") + observable("2")), "f.toml:32: observable 'o': name 'o' is used twice");
  EXPECT_EQ(refusal(head + "[[observable]]\nname = 'o'\n"), at + "'o': 'value' is missing");
}

}  // namespace
}  // namespace slapstick
