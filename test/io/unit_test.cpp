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

TEST(Unit, micro_as_people_type_it) {
  for (const char* um : {"um", "\u00b5m", "\u03bcm"}) EXPECT_EQ(parse_unit(um).factor, 1e-6) << um;
  EXPECT_EQ(parse_unit("m/\u00b5s^2").factor, parse_unit("m/us^2").factor);
}

TEST(Unit, products_and_powers_written_together_are_taken_apart) {
  EXPECT_EQ(unit_refusal("Nmm"), "unknown unit 'Nmm'; did you mean 'N mm'?");
  EXPECT_EQ(unit_refusal("Nm/rad"), "unknown unit 'Nm'; did you mean 'N m'?");
  EXPECT_EQ(unit_refusal("m/s2"), "unknown unit 's2'; did you mean 's^2'?");
  EXPECT_EQ(unit_refusal("rpm"),
            "unknown unit 'rpm'; a speed of rotation is in rad/s (1 rpm = 0.10471975511965977 rad/s) or 1/min");
}

TEST(Unit, refusals) {
  for (const char* unit : {"furlong", "ks"})  // the second is too short to guess
    EXPECT_TRUE(
        unit_refusal(unit).starts_with("unknown unit '" + std::string(unit) + "'; known: m km cm mm um nm in ft"));
  EXPECT_EQ(unit_refusal("kNN"), "unknown unit 'kNN'; did you mean 'kN'? (docs/reference/model_file.md lists them)");
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
    "name = 'm'\n[scale]\nlength = { value = 0.5, unit = 'mm' }\ntime = { value = 'D / 8', unit = 'ms' }\n"
    "mass = { value = 'M', unit = 'g' }\n[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'x2'\n"
    "mass = 1\nunit = 'um'\n[[observable]]\nname = 'force'\nvalue = 'x1 - x2'\n";

TEST(Scale, columns_are_physical_by_the_units_powers) {
  const auto definition =
      ModelDefinition::parse(scaled + "unit = 'N'\n[parameters]\nM = { value = 4, unit = 'g' }\nD = 2\n", "f.toml");
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
  const std::string m = "[parameters]\nM = 1\nD = 1\n";
  EXPECT_EQ(refusal(scaled + "unit = 'N'\n" + m), "accepted");
  EXPECT_EQ(refusal(scaled + m),
            "f.toml:13: observable 'force': 'unit' is missing: [scale] cannot turn it into a physical quantity "
            "(write \"1\" for a ratio)");
  const auto parameter = [&](const std::string& unit) {
    return refusal(scaled + "unit = 'N'\n" + m + "k = { value = 1, unit = '" + unit + "' }\n");
  };
  for (const char* fits : {"N", "N/mm", "g/ms^2", "1/ms", "mm/ms", "rad", "1"}) EXPECT_EQ(parameter(fits), "accepted");
  for (const auto& [mixed, right] : {std::pair<std::string, std::string>{"N/m", "the number in g/ms^2"},
                                     {"m/s^2", "the number in mm/ms^2"},
                                     {"1/s", "the number in 1/ms"},
                                     {"J", "the number in g mm^2/ms^2"},
                                     {"deg", "a plain number, of an angle in rad"},
                                     {"%", "a plain number, of an angle in rad"}})
    EXPECT_EQ(parameter(mixed), "f.toml:20: parameter 'k': unit '" + mixed +
                                    "' is mixed with those of [scale]: expressions do not convert, so give " + right);
  EXPECT_TRUE(parameter("smoot").starts_with("f.toml:20: parameter 'k': unknown unit 'smoot'; known: m km"));
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
  EXPECT_EQ(scale(""), "f.toml:2: scale: nothing is in it");
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

TEST(Scale, w_is_in_the_unit_of_the_coordinates_that_contacts_act_on) {
  const auto w_unit = [](const std::string& first, const std::string& second) {
    return ModelDefinition::parse(
               "name='m'\n[scale]\nlength = { value = 2, unit = 'mm' }\ntime = { value = 3, unit = 's' }\n"
               "[[coordinate]]\nname = 'a'\nmass = 1\n" +
                   first + "[[coordinate]]\nname = 'b'\nmass = 1\n" + second +
                   "[[friction]]\nname = 'f'\nbetween = ['a', 'b']\nstatic = 1\n",
               "f.toml")
        .physical()
        ->w;
  };
  EXPECT_EQ(w_unit("unit = 'um'\n", "unit = 'um'\n").unit, "um/s");
  EXPECT_DOUBLE_EQ(w_unit("unit = 'um'\n", "unit = 'um'\n").factor, 2000.0 / 3.0);
  EXPECT_EQ(w_unit("unit = 'um'\n", "").unit, "mm/s");
  EXPECT_EQ(w_unit("", "").unit, "mm/s");
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
  EXPECT_TRUE(with("", "", "[parameters.gap]\nvalue = 1\nunit = 'whatever'\n")
                  .starts_with("f.toml:3: parameter 'gap': unknown unit 'whatever'; known: m km"));
  EXPECT_EQ(with("", "", "[parameters.gap]\nvalue = 1\nunit = 'm'\n[parameters.way]\nvalue = 1\nunit = 'mm'\n"),
            "accepted");
}

}  // namespace
}  // namespace slapstick
