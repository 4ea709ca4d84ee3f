/// Units, [scale], and what it refuses: units that are missing, unknown or mixed.
#include "io/unit.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "io/refusal.hpp"

namespace slapstick {
namespace {

using Powers = std::array<int, 3>;

std::string unit_refusal(const std::string& text) {
  try {
    (void)parse_unit(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Unit, products_and_powers) {
  EXPECT_EQ(parse_unit("N/m").powers, (Powers{0, -2, 1}));
  EXPECT_EQ(parse_unit("kg m/s^2").powers, parse_unit("N").powers);
  EXPECT_EQ(parse_unit("kg*m*s^-2").powers, parse_unit("N").powers);
  EXPECT_EQ(parse_unit("m/s/s").powers, (Powers{1, -2, 0}));
  EXPECT_EQ(parse_unit("m / s").powers, (Powers{1, -1, 0}));
  EXPECT_EQ(parse_unit("1/s").powers, parse_unit("Hz").powers);
  EXPECT_DOUBLE_EQ(parse_unit("mm^2").factor, 1e-6);
  EXPECT_DOUBLE_EQ(parse_unit("kN/mm").factor, 1e6);
  EXPECT_DOUBLE_EQ(parse_unit("deg").factor, std::numbers::pi / 180);
  EXPECT_EQ(parse_unit("1").factor, 1.0);
}

TEST(Unit, refusals) {
  EXPECT_TRUE(unit_refusal("furlong").starts_with("unknown unit 'furlong'; known: m, km, cm,"));
  EXPECT_EQ(unit_refusal("ks"), "unknown unit 'ks' (docs/model_file.md lists them)");  // too short to guess
  EXPECT_EQ(unit_refusal("kNN"), "unknown unit 'kNN'; did you mean 'kN'? (docs/model_file.md lists them)");
  EXPECT_EQ(unit_refusal("m^x"), "unit 'm^x': a power is a whole number in [-9, 9]");
  EXPECT_EQ(unit_refusal("m^"), "unit 'm^': a power is a whole number in [-9, 9]");
  EXPECT_EQ(unit_refusal("m^99999999999999999999"),
            "unit 'm^99999999999999999999': a power is a whole number in [-9, 9]");
  std::string huge = "km^9";
  for (int i = 0; i < 9; ++i) huge += " km^9";
  EXPECT_TRUE(unit_refusal(huge).ends_with("is too large or too small: beyond 1e100 of the basic units"));
  EXPECT_EQ(unit_refusal("/s"), "unit '/s': a unit is missing before '/'");
  EXPECT_EQ(unit_refusal("m//s"), "unit 'm//s': a unit is missing before '/'");
  EXPECT_EQ(unit_refusal("m/"), "unit 'm/': a unit is missing at its end (write \"1\" for a plain number)");
  EXPECT_EQ(unit_refusal(""), "unit '': a unit is missing at its end (write \"1\" for a plain number)");
}

const std::string scaled =  // 15 lines
    "name = 'm'\n[scale]\nlength = { value = 0.5, unit = 'mm' }\ntime = { value = 'M / 8', unit = 'ms' }\n"
    "mass = { value = 'M', unit = 'g' }\n[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'x2'\n"
    "mass = 1\nunit = 'um'\n[[observable]]\nname = 'force'\nvalue = 'x1 - x2'\n";

TEST(Scale, columns_are_physical_by_the_units_powers) {
  const auto definition =
      ModelDefinition::parse(scaled + "unit = 'N'\n[parameters]\nM = { value = 4, unit = 'g' }\n", "f.toml");
  const auto units = definition.physical({{"M", 2}});
  ASSERT_TRUE(units);
  EXPECT_EQ(units->time.unit, "ms");
  EXPECT_DOUBLE_EQ(units->time.factor, 0.25);
  EXPECT_EQ(units->w.unit, "mm/ms");
  EXPECT_DOUBLE_EQ(units->w.factor, 2.0);
  ASSERT_EQ(units->state.size(), 4U);
  EXPECT_EQ(units->state[0].unit, "mm");
  EXPECT_DOUBLE_EQ(units->state[0].factor, 0.5);
  EXPECT_EQ(units->state[3].unit, "um/ms");
  EXPECT_DOUBLE_EQ(units->state[3].factor, 2000.0);
  EXPECT_DOUBLE_EQ(units->observables.at(0).factor, 2e-3 * 0.5e-3 / (0.25e-3 * 0.25e-3));
  const auto printed = definition.to_toml({{"M", 2}});
  const auto again = ModelDefinition::parse(printed, "g.toml");
  EXPECT_EQ(again.to_toml(), printed);
  EXPECT_EQ(again.physical()->observables[0].factor, units->observables[0].factor);
  EXPECT_FALSE(load_model("vibro-impact").physical());
}

TEST(Scale, missing_unknown_and_mixed_units_are_refused) {
  const std::string m = "[parameters]\nM = 1\n";
  EXPECT_EQ(refusal(scaled + "unit = 'N'\n" + m), "accepted");
  EXPECT_EQ(refusal(scaled + m),
            "f.toml:13: observable 'force': 'unit' is missing: [scale] cannot turn it into a physical quantity "
            "(write \"1\" for a ratio)");
  const auto parameter = [&](const std::string& unit) {
    return refusal(scaled + "unit = 'N'\n" + m + "k = { value = 1, unit = '" + unit + "' }\n");
  };
  for (const char* fits : {"N", "N/mm", "g/ms^2", "1/ms", "mm/ms", "rad", "1"}) EXPECT_EQ(parameter(fits), "accepted");
  for (const std::string mixed : {"N/m", "m", "s", "kg", "deg", "%"})
    EXPECT_EQ(parameter(mixed), "f.toml:19: parameter 'k': unit '" + mixed +
                                    "' is mixed with those of [scale] (mm, ms, g): expressions do not convert, so give "
                                    "the number in products of these");
  EXPECT_TRUE(parameter("smoot").starts_with("f.toml:19: parameter 'k': unknown unit 'smoot'; known: m, km"));
  const std::string massless =
      "name='m'\n[scale]\nlength = { value = 1, unit = 'm' }\ntime = { value = 1, unit = 's' }\n"
      "[[coordinate]]\nname = 'x'\nmass = 1\n";
  EXPECT_EQ(refusal(massless + "[[observable]]\nname = 'f'\nvalue = 'x'\nunit = 'N'\n"),
            "f.toml:8: observable 'f': unit 'N' has a mass in it, and [scale] has none");
  EXPECT_EQ(refusal(massless + "unit = 'rad'\n"), "f.toml:5: coordinate 'x': unit 'rad' is not one of length");
}

TEST(Scale, its_own_keys) {
  const std::string rest = "\n[[coordinate]]\nname = 'x'\nmass = 1\n", length = "length = { value = 1, unit = 'm' }\n";
  const auto scale = [&](const std::string& keys) { return refusal("name = 'm'\n[scale]\n" + keys + rest); };
  EXPECT_EQ(scale(""), "f.toml:2: scale: it is empty");
  EXPECT_EQ(scale(length), "f.toml:3: scale: 'time' is missing");
  EXPECT_EQ(scale(length + "time = { value = 1, unit = 's' }"), "accepted");
  EXPECT_EQ(scale(length + "time = { value = 1, unit = 'm' }"), "f.toml:4: scale: time: unit 'm' is not one of time");
  EXPECT_EQ(
      scale(length + "time = { value = 1e-50, unit = 's' }\n[[observable]]\nname = 'o'\nvalue = 1\nunit = '1/s^9'\n"),
      "f.toml:5: scale: 1 is inf 1/s^9, which is out of range");
  EXPECT_EQ(scale(length + "time = { value = 1 }"), "f.toml:4: scale: time: 'unit' is missing");
  EXPECT_EQ(scale(length + "time = 1"), "f.toml:4: scale: time: expected a table, found a number");
  EXPECT_EQ(scale(length + "time = { value = 0, unit = 's' }"),
            "f.toml:4: scale: time: value = 0 is outside [1e-50, 1e50]");
  EXPECT_EQ(scale(length + "tme = { value = 0, unit = 's' }"),
            "f.toml:4: scale: unknown key 'tme'; did you mean 'time'?");
  EXPECT_TRUE(scale("length = { value = 1, unit = 'smoot' }").starts_with("f.toml:3: scale: length: unknown unit"));
}

TEST(CoordinateUnit, without_scale_all_or_none_and_one_per_dimension) {
  const auto with = [](const std::string& first, const std::string& second, const std::string& more = "") {
    return refusal("name = 'm'\n" + more + "[[coordinate]]\nname = 'a'\nmass = 1\n" + first +
                   "[[coordinate]]\nname = 'b'\nmass = 1\n" + second);
  };
  EXPECT_EQ(with("unit = 'mm'\n", "unit = 'mm'\n"), "accepted");
  EXPECT_EQ(with("unit = 'mm'\n", "unit = 'rad'\n"), "accepted");
  EXPECT_EQ(with("unit = 'mm'\n", ""), "f.toml:6: coordinate 'b': 'unit' is missing: coordinate 'a' has one");
  EXPECT_EQ(with("unit = 'mm'\n", "unit = 'm'\n"),
            "f.toml:6: coordinate 'b': unit 'm' is mixed with 'mm' of a coordinate");
  EXPECT_EQ(with("unit = 'mm'\n", "unit = 'mm'\n", "[parameters.gap]\nvalue = 1\nunit = 'm'\n"),
            "f.toml:3: parameter 'gap': unit 'm' is mixed with 'mm' of a coordinate");
  EXPECT_EQ(with("", "", "[parameters.gap]\nvalue = 1\nunit = 'whatever'\n"), "accepted");
}

}  // namespace
}  // namespace slapstick
