/// A number with a unit where a model with [scale] calculates with its own: silently wrong by the size of 1, if it were
/// taken.
#include <gtest/gtest.h>

#include "io/refusal.hpp"

namespace slapstick {
namespace {

/// 1 is 0.05 mm and 0.5 ms, so 1 of velocity is 100 mm/s, and 3 N. The part of the third argument begins in line 20.
std::string with(const std::string& parameters, const std::string& part, const std::string& length = "0.05") {
  const std::string text =
      "name = 'm'\n[parameters]\nspeed = { value = 0.2, unit = 'mm/s' }\nflow = 0.2\nstill = { value = 0, unit = "
      "'mm/s' }\n"
      "load = { value = 6, unit = 'kg mm/s^2' }\ngap = { value = 0.1, unit = 'mm' }\n";
  return text + parameters + "[scale]\nlength = { value = " + length +
         ", unit = 'mm' }\ntime = { value = 0.0005, unit = 's' }\nmass = { value = 1.5e-5, unit = 'kg' }\n"
         "[[coordinate]]\nname = 'x'\nmass = 1\n" +
         part;
}

std::string belt(const std::string& speed, const std::string& parameters = "", const Overrides& overrides = {}) {
  return refusal(
      with(parameters, "[[friction]]\nname = 'b'\nbetween = ['x', 'ground']\nstatic = 1\nbelt_speed = " + speed + "\n"),
      overrides);
}

TEST(ModelNumbers, a_physical_speed_as_the_models_own_is_refused_with_what_to_write) {
  EXPECT_EQ(belt("'speed'"),
            "f.toml:19: friction 'b': belt_speed: expression 'speed': its value is in mm/s, and a model with [scale] "
            "calculates in units "
            "of its own: write 'speed / scale_length * scale_time'");
  EXPECT_EQ(belt("'speed / scale_length * scale_time'"), "accepted");
  EXPECT_NE(belt("'2 * (speed - still)'").find("write '(2 * (speed - still)) / scale_length * scale_time'"),
            std::string::npos);
  EXPECT_EQ(belt("'flow'"), "accepted");
  EXPECT_EQ(belt("0.2"), "accepted");
}

TEST(ModelNumbers, the_remedy_gives_the_physical_number) {
  const auto model = ModelDefinition::parse(with("",
                                                 "[[friction]]\nname = 'b'\nbetween = ['x', 'ground']\nstatic = "
                                                 "1\nbelt_speed = 'speed / scale_length * scale_time'\n"),
                                            "f.toml");
  EXPECT_DOUBLE_EQ(model.build().frictions[0].belt_speed * model.physical()->state[1].factor, 0.2);
}

TEST(ModelNumbers, a_ratio_of_physical_numbers_is_the_models_however_much_cancels) {
  EXPECT_EQ(belt("'(speed * (1 + 1e-15) - speed) / speed'"), "accepted");
  EXPECT_EQ(belt("'sqrt(load * gap / 1.5e-5) / speed'", "", {}).find("accepted"), std::string::npos);
  EXPECT_EQ(belt("'sqrt(load * gap / mass) / speed'", "mass = { value = 3, unit = 'kg' }\n"), "accepted");
  EXPECT_EQ(belt("'load / gap > 7 * scale_mass / scale_time^2 ? speed / (still + speed) : 1'"), "accepted");
}

TEST(ModelNumbers, a_sum_of_both_kinds_is_refused) {
  EXPECT_EQ(belt("'flow + speed'"),
            "f.toml:19: friction 'b': belt_speed: expression 'flow + speed': the expression mixes numbers that have a "
            "unit (speed "
            "in mm/s) with numbers "
            "of the model: divide each by scale_length, scale_time or scale_mass first");
}

TEST(ModelNumbers, a_parameter_that_follows_others_carries_their_unit_on) {
  EXPECT_NE(belt("'twice'", "twice = '2 * speed'\n").find("its value is in mm/s"), std::string::npos);
  const std::string twice = "twice = '2 * still'\n";
  EXPECT_EQ(belt("'twice'", twice, {{"twice", 0.1}}), "accepted");  // set itself, it is a number of the model
  EXPECT_NE(belt("'twice'", twice, {{"still", 0.1}}).find("its value is in mm/s"), std::string::npos);
  EXPECT_EQ(belt("'own'", "own = 'speed * 0.01'\n").find("accepted"), std::string::npos);
  EXPECT_EQ(belt("'own'", "own = 'speed / (scale_length / scale_time)'\n"), "accepted");
}

TEST(ModelNumbers, a_speed_of_zero_is_zero_and_is_looked_at_again_when_it_is_set) {
  EXPECT_EQ(belt("'still'"), "accepted");
  EXPECT_NE(belt("'still'", "", {{"still", 1}}).find("its value is in mm/s"), std::string::npos);
}

TEST(ModelNumbers, what_1_is_has_names_that_nothing_else_has) {
  const std::string scale_length = "scale_length = 2\n";
  EXPECT_EQ(belt("0", scale_length),
            "f.toml:8: parameter 'scale_length': expressions call the value of [scale] by this name");
  EXPECT_EQ(belt("0", "[groups]\ng = ['scale_length']\n").find("f.toml:9: group 'g': unknown parameter 'scale_length'"),
            0U);
  EXPECT_NE(belt("0", "", {{"scale_length", 2}}).find("has no parameter 'scale_length'"), std::string::npos);
  EXPECT_NE(
      refusal(with("", "", "'2 * scale_length'")).find("the value depends on itself: scale_length -> scale_length"),
      std::string::npos);
  EXPECT_EQ(refusal("name = 'm'\n[parameters]\nscale_length = 2\n[[coordinate]]\nname = 'x'\nmass = 'scale_length'\n"),
            "accepted");
}

TEST(ModelNumbers, every_place_that_takes_an_expression_is_looked_at) {
  for (const char* part : {"[[stop]]\nname = 's'\nbetween = ['x', 'ground']\nrestitution = 0\nclearance = 'gap'\n",
                           "[[force]]\non = 'x'\nharmonic = 0\namplitude = 'load'\n", "[start]\nx = 'gap'\n",
                           "[matrix]\nstiffness = [['load / gap']]\n",
                           "[[observable]]\nname = 'f'\nunit = 'N'\nvalue = 'load / gap * x'\n",
                           "[[observable]]\nname = 'f'\nunit = 'N'\nvalue = 'x < 0 ? load : 0'\n"})
    EXPECT_NE(refusal(with("", part)).find("a model with [scale] calculates in units of its own"), std::string::npos)
        << part;
}

TEST(ModelNumbers, where_one_is_the_unit_itself_nothing_is_to_be_converted) {
  const std::string stop = "[[stop]]\nname = 's'\nbetween = ['x', 'ground']\nrestitution = 0\nclearance = 'gap'\n";
  EXPECT_EQ(refusal(with("", stop, "1")), "accepted");
  EXPECT_NE(refusal(with("", stop, "2")), "accepted");
}

TEST(ModelNumbers, an_expression_has_the_unit_that_its_parameter_or_scale_names) {
  EXPECT_EQ(belt("0", "half = { value = 'gap / 2', unit = 'mm' }\n"), "accepted");
  EXPECT_EQ(belt("0", "half = { value = '0.1 / 2', unit = 'mm' }\n"), "accepted");
  EXPECT_EQ(belt("0", "half = { value = 'speed / 2', unit = 'mm' }\n"),
            "f.toml:8: parameter 'half': expression 'speed / 2': its value is not in mm (speed in mm/s)");
  EXPECT_EQ(refusal(with("", "", "'gap'")), "accepted");
  EXPECT_EQ(refusal(with("", "", "'speed'")),
            "f.toml:9: scale: length: expression 'speed': its value is not in mm (speed in mm/s)");
}

}  // namespace
}  // namespace slapstick
