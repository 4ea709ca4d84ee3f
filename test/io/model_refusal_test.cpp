/// Every mistake in a model file is named with its line, and a mistyped name with the nearest known one.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/refusal.hpp"

namespace slapstick {
namespace {

const std::string head = "name = 'm'\n";                               // line 1
const std::string mass = "[[coordinate]]\nname = 'x1'\nmass = 'm'\n";  // lines 3, 4, 5 after one line of parameters
const std::string good = head + "parameters.m = { value = 2, above = 0, below = 9 }\n" + mass;

TEST(ModelFile, smallest_model) {
  EXPECT_EQ(refusal(good), "accepted");
  const auto definition = ModelDefinition::parse(good, "f.toml");
  EXPECT_EQ(definition.build({{"m", 3}}).coordinates.at(0).mass, 3.0);
  EXPECT_EQ(definition.start(), (State{0, 0}));
  EXPECT_EQ(definition.build().omega, 0.0);
}

TEST(ModelFile, unknown_names_suggest_the_nearest) {
  EXPECT_EQ(refusal("nmae = 'm'\n"), "f.toml:1: unknown key 'nmae'; did you mean 'name'?");
  EXPECT_EQ(refusal(good + "stifness = 1\n"),
            "f.toml:6: coordinate 1: unknown key 'stifness'; known: description, name, mass, unit, base");
  EXPECT_EQ(refusal(good + "[[sprin]]\n"), "f.toml:6: unknown key 'sprin'; did you mean 'spring'?");
  EXPECT_EQ(refusal(good + "[[spring]]\nbetween = ['x1', 'ground']\nstifness = 1\n"),
            "f.toml:8: spring 1: unknown key 'stifness'; did you mean 'stiffness'?");
  EXPECT_EQ(refusal(good + "[[spring]]\nbetween = ['x1', 'groud']\nstiffness = 1\n"),
            "f.toml:7: spring 1: between: unknown coordinate 'groud'; did you mean 'ground'?");
  EXPECT_EQ(refusal(good + "[[spring]]\nbetween = ['x1', 'ground']\nstiffness = '2 * mm'\n"),
            "f.toml:8: spring 1: stiffness: expression '2 * mm': unknown parameter 'mm'; did you mean 'm'?");
  EXPECT_EQ(refusal(good + "[start]\nx2 = 1\n"), "f.toml:7: start: unknown key 'x2'; did you mean 'x1'?");
  EXPECT_EQ(refusal(good + "[groups]\ng = ['n']\n"), "f.toml:7: group 'g': unknown parameter 'n'; known: m");
  EXPECT_EQ(refusal(good, {{"mm", 1}}), "model 'm' has no parameter 'mm'; did you mean 'm'?");
}

TEST(ModelFile, a_polyline_that_is_none_is_named_with_its_point) {
  const std::string spring = good + "[[spring]]\nbetween = ['x1', 'ground']\n", here = "f.toml:8: spring 1: ";
  EXPECT_EQ(refusal(spring), "f.toml:6: spring 1: 'stiffness' is missing");
  EXPECT_EQ(refusal(spring + "characteristic = [[0, 0], [1, 2]]\nstiffness = 3\n"),
            here + "characteristic: this key stands in place of 'stiffness': give one of the two");
  EXPECT_EQ(refusal(spring + "characteristic = [[0, 0]]\n"),
            here + "characteristic: expected 2 to 100 points [x, force], found 1");
  EXPECT_EQ(refusal(spring + "characteristic = [[0, 0], [1]]\n"),
            here + "characteristic: point 2: expected [x, force], found 1 numbers");
  EXPECT_EQ(refusal(spring + "stiffness = 1\nslope_above = 2\n").substr(0, 66),
            "f.toml:9: spring 1: slope_above: this key belongs to a 'characteri");
  for (const char* points : {"[[0, 0], [0, 1], [1, 2]]", "[[0, 0], [1, 1], [0.5, 2]]"})
    EXPECT_NE(refusal(spring + "characteristic = " + points + "\n").find("is not above"), std::string::npos) << points;
  EXPECT_EQ(refusal(spring + "characteristic = [[0, 0], ['m', 1], [1, 2]]\n"),
            here + "characteristic: point 3: 1 is not above the 2 of the point before");
  EXPECT_EQ(refusal(spring + "characteristic = [[0, 0], [1, 1], [2, 3]]\n"), "accepted");
}

TEST(ModelFile, friction_over_the_speed_begins_at_rest) {
  const std::string dry = good + "[[friction]]\nname = 'dry'\nbetween = ['x1', 'ground']\nstatic = 1\n";
  EXPECT_EQ(refusal(dry + "characteristic = [[0, 1], [1, 0.5]]\n"), "accepted");
  for (const char* points : {"[[0.1, 1], [1, 0.5]]", "[[0, 2], [1, 0.5]]", "[[0, 1], [1, -0.5]]"})
    EXPECT_NE(refusal(dry + "characteristic = " + points + "\n"), "accepted") << points;
  EXPECT_EQ(refusal(dry + "kinetic = 1\ncharacteristic = [[0, 1], [1, 0.5]]\n"),
            "f.toml:11: friction 'dry': characteristic: this key stands in place of 'kinetic': give one of the two");
}

TEST(ModelFile, an_interval_of_a_damper_has_an_inside) {
  const std::string damper = good + "[[damper]]\nbetween = ['x1', 'ground']\ncoefficient = 1\n",
                    here = "f.toml:9: damper 1: ";
  EXPECT_EQ(refusal(damper + "within = [0, 'm']\n"), "accepted");
  EXPECT_EQ(refusal(damper + "within = [1, 0]\n"), here + "within: 0 is not above the 1 before it");
  EXPECT_EQ(refusal(damper + "within = [2, 'm']\n"), here + "within: 2 is not above the 2 before it");
  EXPECT_EQ(refusal(damper + "within = [1]\n"), here + "within: expected [from, to], found 1 numbers");
  EXPECT_EQ(refusal(damper + "within = 1\n"), here + "within: expected a list, found a number");
  EXPECT_EQ(refusal(damper + "within = [0, 'n']\n"),
            here + "within: to: expression 'n': unknown parameter 'n'; known: m");
  EXPECT_EQ(refusal(damper + "coefficient_outside = 1\n"),
            here + "coefficient_outside: this key belongs to a 'within', and the part has no such key");
  EXPECT_EQ(refusal(damper + "characteristic = [[0, 0], [1, 1], [2, 0]]\n"),
            here + "characteristic: this key stands in place of 'coefficient': give one of the two");
}

TEST(ModelFile, a_stribeck_law_falls_to_a_friction_that_there_is) {
  const std::string friction = good + "[[friction]]\nname = 'f'\nbetween = ['x1', 'ground']\n",
                    here = "f.toml:9: friction 'f': stribeck: ";
  EXPECT_EQ(refusal(friction + "stribeck = { static = 'm', kinetic = 1, speed = 0.5 }\n"), "accepted");
  const std::pair<const char*, const char*> cases[] = {
      {"static = 1, kinetic = 'm', speed = 0.5", "kinetic = 2 exceeds static = 1"},
      {"static = 2, kinetic = -1, speed = 0.5", "kinetic = -1 is negative"},
      {"static = 2, kinetic = 1", "'speed' is missing"},
      {"static = 2, kinetic = 1, speed = 0", "speed = 0 is not positive"},
      {"static = 2, kinetic = 1, sped = 1", "unknown key 'sped'; did you mean 'speed'?"},
      {"static = 2, kinetic = 1, speed = 1, exponent = 0.4", "exponent = 0.4 is not a fixed number in [0.5, 10]"},
      {"static = 2, kinetic = 1, speed = 1, corners = 0", "corners = 0 is not a fixed whole number in [1, 100]"},
      {"static = 2, kinetic = 1, speed = 1, corners = 101", "corners = 101 is not a fixed whole number in [1, 100]"},
      {"static = 2, kinetic = 1, speed = 1, corners = 2.5", "corners = 2.5 is not a fixed whole number in [1, 100]"}};
  for (const auto& [law, why] : cases) EXPECT_EQ(refusal(friction + "stribeck = { " + law + " }\n"), here + why);
  EXPECT_EQ(refusal(friction + "static = 2\nstribeck = { static = 2, kinetic = 1, speed = 0.5 }\n"),
            "f.toml:10: friction 'f': stribeck: this key stands in place of 'static': give one of the two");
}

TEST(ModelFile, laws_of_stops_name_the_number_that_is_none) {
  const std::string soft =
      good + "[[compliant_stop]]\nname = 'c'\nbetween = ['x1', 'ground']\nclearance = 0\nstiffness = 4\n";
  EXPECT_EQ(refusal(soft + "unloading_stiffness = 'm'\n"), "accepted");
  for (const char* value : {"5", "0", "-1"})
    EXPECT_EQ(refusal(soft + "unloading_stiffness = " + value + "\n"),
              "f.toml:11: compliant_stop 'c': unloading_stiffness = " + std::string(value) +
                  " is outside (0, stiffness]: beyond, each contact would feed energy");
  EXPECT_EQ(
      refusal(soft + "damping = 1\nunloading_stiffness = 2\n"),
      "f.toml:12: compliant_stop 'c': unloading_stiffness: this key stands in place of 'damping': give one of the two");
  EXPECT_EQ(refusal(soft + "law = 'bound'\n"),
            "f.toml:11: compliant_stop 'c': law: unknown word 'bound'; did you mean 'bounded'?");
  EXPECT_EQ(refusal(soft + "law = 'bounded'\npulls = true\n"),
            "f.toml:11: compliant_stop 'c': law: this key stands in place of 'pulls': give one of the two");
  const std::string rigid = good + "[[stop]]\nname = 's'\nbetween = ['x1', 'ground']\nclearance = 0\n",
                    key = "restitution_over_speed";
  const std::pair<const char*, const char*> cases[] = {
      {"[[0, 0.5], ['m', 0.4]]", "point 1: speed = 0 is not positive"},
      {"[[1, 0.5], [1, 0.4]]", "point 2: 1 is not above the 1 of the point before"},
      {"[[1, 0.5], [2, 'm']]", "point 2: restitution = 2 is outside [0, 1]"},
      {"[[1, 0.5]]", "expected 2 to 100 points [speed, restitution], found 1"},
      {"[[1, 0.5], [2]]", "point 2: expected [speed, restitution], found 1 numbers"}};
  for (const auto& [points, why] : cases)
    EXPECT_EQ(refusal(rigid + key + " = " + points + "\n"), "f.toml:10: stop 's': " + key + ": " + why);
  EXPECT_EQ(refusal(rigid + "restitution = 0.3\n" + key + " = [[1, 0.5], [2, 0.4]]\n"),
            "f.toml:11: stop 's': " + key + ": this key stands in place of 'restitution': give one of the two");
}

TEST(ModelFile, values_out_of_range_name_parameter_value_and_range) {
  EXPECT_EQ(refusal(good, {{"m", 0}}), "parameter 'm' = 0 is outside (0, 9)");
  EXPECT_EQ(refusal(good, {{"m", 9}}), "parameter 'm' = 9 is outside (0, 9)");
  EXPECT_EQ(refusal(good, {{"m", std::nan("")}}), "parameter 'm' = nan is not a finite number");
  EXPECT_EQ(refusal(good, {{"m", std::numeric_limits<double>::infinity()}}),
            "parameter 'm' = inf is not a finite number");
  EXPECT_EQ(refusal(head + "parameters.m = { value = 2, max = 1 }\n" + mass),
            "f.toml:2: parameter 'm': value = 2 is outside (-inf, 1]");
  EXPECT_EQ(refusal(head + "parameters.m = { value = 2, min = 3, max = 1 }\n"),
            "f.toml:2: parameter 'm': the range [3, 1] is empty");
  EXPECT_EQ(refusal(head + "parameters.m = { value = 2, min = 3, above = 1 }\n"),
            "f.toml:2: parameter 'm': both 'min' and 'above' are given");
  EXPECT_EQ(refusal(head + "parameters.m = { value = 2, min = 'a' }\n"),
            "f.toml:2: parameter 'm': min: expected a number, found a string");
}

TEST(ModelFile, wrong_types_and_missing_keys) {
  EXPECT_EQ(refusal(""), "f.toml:1: model: 'name' is missing");
  EXPECT_EQ(refusal(head), "f.toml:1: model: the model has no coordinates");
  EXPECT_EQ(refusal("name = 3\n"), "f.toml:1: model: name: expected a string, found a number");
  EXPECT_EQ(refusal(head + "parameters = 3\n"), "f.toml:2: parameters: expected a table, found a number");
  EXPECT_EQ(refusal(head + "parameters.m = true\n"),
            "f.toml:2: parameter 'm': expected a number or an expression, found a boolean");
  EXPECT_EQ(refusal(head + "parameters.m = {}\n"), "f.toml:2: parameter 'm': 'value' is missing");
  EXPECT_EQ(refusal(head + "parameters.m = inf\n"), "f.toml:2: parameter 'm': inf is not a finite number");
  EXPECT_EQ(refusal(head + "parameters.sin = 1\n"), "f.toml:2: parameter 'sin': a function or constant has this name");
  EXPECT_EQ(refusal(head + "parameters.'a b' = 1\n"),
            "f.toml:2: parameter 'a b': a name is 1 to 64 letters, digits and '_', beginning with a letter");
  EXPECT_EQ(refusal(head + "[[coordinate]]\nname = 'pi'\nmass = 1\n"),
            "f.toml:2: coordinate 'pi': a function or constant has this name");
  EXPECT_EQ(refusal(head + "parameters.x1 = 1\n[[coordinate]]\nname='x1'\nmass=1\n"),
            "f.toml:3: coordinate 'x1': a parameter has the name 'x1'");
  EXPECT_EQ(refusal(head + "[coordinate]\n"), "f.toml:2: coordinate: expected [[coordinate]], found a table");
  EXPECT_EQ(refusal(head + "[[coordinate]]\nmass = 1\n"), "f.toml:2: coordinate 1: 'name' is missing");
  EXPECT_EQ(refusal(head + "[[coordinate]]\nname = 'x'\n"), "f.toml:2: coordinate 'x': 'mass' is missing");
  EXPECT_EQ(refusal(good + "[[spring]]\nstiffness = 1\n"), "f.toml:6: spring 1: 'between' is missing");
  EXPECT_EQ(refusal(good + "[[spring]]\nbetween = ['x1']\nstiffness = 1\n"),
            "f.toml:7: spring 1: between: expected two ends, found 1");
  EXPECT_EQ(refusal(good + "[[spring]]\nbetween = ['x1', 1]\nstiffness = 1\n"),
            "f.toml:7: spring 1: between: expected a string, found a number");
  EXPECT_EQ(refusal(good + "[[force]]\non = 'x1'\namplitude = 1\nharmonic = 1.5\n"),
            "f.toml:9: force 1: harmonic = 1.5 is not a whole number in [0, 1000000]");
  EXPECT_EQ(refusal("name = \"a\\nb\"\n"), "f.toml:1: model: name: control character in 'a\\x0ab'");
}

TEST(ModelFile, expressions_that_fail_are_named) {
  const auto with = [](const std::string& value) {
    return head + "parameters.m = 0\n[[coordinate]]\nname = 'x'\nmass = '" + value + "'\n";
  };
  EXPECT_EQ(refusal(with("1 / m")), "f.toml:5: coordinate 'x': mass: expression '1 / m': its value is inf with m = 0");
  EXPECT_EQ(refusal(with("1 +")).substr(0, 52), "f.toml:5: coordinate 'x': mass: expression '1 +': un");
  EXPECT_EQ(refusal(head + "[parameters]\na = 'b'\nb = 'c + 1'\nc = 'a'\n"),
            "f.toml:3: parameter 'a': the value depends on itself: a -> b -> c -> a");
  EXPECT_EQ(refusal(head + "parameters.a = '1 / b'\nparameters.b = 0\n"),
            "f.toml:2: parameter 'a': expression '1 / b': its value is inf with b = 0");
}

TEST(ModelFile, meaningless_models_are_refused_at_their_line) {
  const auto contact = [](const std::string& numbers) {
    return good + "[[friction]]\nname = 'f'\nbetween = ['x1', 'ground']\n" + numbers;
  };
  EXPECT_EQ(refusal(contact("static = 1\nkinetic = 2\n")), "f.toml:10: friction 'f': kinetic = 2 exceeds static = 1");
  EXPECT_EQ(refusal(contact("static = -1\n")), "f.toml:9: friction 'f': static = -1 is negative");
  EXPECT_EQ(refusal(contact("static = 1\n")), "accepted");  // kinetic is static
  EXPECT_EQ(refusal(good + "[[spring]]\nbetween = ['x1', 'x1']\nstiffness = 1\n"),
            "f.toml:6: spring 1: both ends are 'x1'");
  EXPECT_EQ(refusal(good + "[[coordinate]]\nname = 'x1'\nmass = 1\n"),
            "f.toml:6: coordinate 'x1': name 'x1' is used twice");
  EXPECT_EQ(refusal("omega = 0\n" + good + "[[force]]\non = 'x1'\namplitude = 1\n"),
            "f.toml:1: model: omega = 0 is not positive");
  EXPECT_EQ(refusal(good + "[[stop]]\nname = 's'\nbetween = ['x1', 'ground']\nclearance = 1\nrestitution = 2\n"),
            "f.toml:10: stop 's': restitution = 2 is outside [0, 1]");
  EXPECT_EQ(
      refusal(good +
              "[[stop]]\nname = 's'\nbetween = ['x1', 'ground']\nclearance = 'm'\nrestitution = 0\n[start]\nx1 = 3\n"),
      "f.toml:12: start: stop 's' is violated: x1 - ground = 3 > clearance = 2");
}

TEST(ModelFile, awkward_numbers_and_texts_survive_printing) {
  const std::string text =
      head + "notes = \"\"\"\na \\\\ \\\"quoted\\\" line\n\n  and ''' more\"\"\"\n" +
      "parameters.m = { value = 123456789012345680000.0, description = \"a \\\"b\\\" \\\\ \xc3\xa9\" }\n" +
      "parameters.n = { value = -0.0 }\nparameters.d = { value = 5e-324 }\n" + mass +
      "[start]\nv1 = 'm / 3'\nx1 = -1e49\n";
  const auto definition = ModelDefinition::parse(text, "f.toml");
  const auto printed = definition.to_toml();
  const auto again = ModelDefinition::parse(printed, "g.toml");
  EXPECT_EQ(again.to_toml(), printed);
  EXPECT_EQ(again.notes(), definition.notes());
  EXPECT_EQ(again.notes(), "a \\ \"quoted\" line\n\n  and ''' more");
  EXPECT_EQ(again.parameters()[0].description, definition.parameters()[0].description);
  EXPECT_EQ(again.values(), definition.values());
  EXPECT_TRUE(std::signbit(again.values().at("n")));
  EXPECT_EQ(again.start(), definition.start());
}

TEST(ModelFile, a_reserved_coordinate_name_is_told_before_what_follows_from_it) {
  try {
    (void)ModelDefinition::parse(
        "name = 'm'\n[[coordinate]]\nname = 'w'\nmass = 1\n[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n",
        "f.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 40), "f.toml:2: coordinate 'w': this name is r");
  }
}

}  // namespace
}  // namespace slapstick
