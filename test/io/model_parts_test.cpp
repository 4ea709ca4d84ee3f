/// Two-sided and compliant stops, matrices and the impact law: what a file says is what the Model has, and nonsense is
/// refused.
#include <gtest/gtest.h>

#include "io/refusal.hpp"
#include "io/same_model.hpp"

namespace slapstick {
namespace {

const std::string two =  // 7 lines
    "name = 'm'\n[parameters]\nk = 3\n[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'x2'\nmass = 2\n";
constexpr int next = 10;  // the line after `two`

std::string at(int line) { return "f.toml:" + std::to_string(line) + ": "; }

Model built(const std::string& text, const Overrides& overrides = {}) {
  const auto definition = ModelDefinition::parse(text, "f.toml");
  const auto printed = definition.to_toml(overrides);
  const auto again = ModelDefinition::parse(printed, "g.toml");
  EXPECT_EQ(again.to_toml(), printed);
  expect_same(again.build(), definition.build(overrides));
  return definition.build(overrides);
}

void expect_start(const std::string& message, const std::string& start) {
  EXPECT_TRUE(message.starts_with(start)) << message;
}

const std::string between = "between = ['x1', 'x2']\n";

TEST(TwoSided, a_stop_stands_for_two) {
  const auto stop = "[[stop]]\nname = 's'\n" + between + "restitution = 0.5\ntwo_sided = true\n";
  const auto same = built(two + stop + "clearance = 'k'\n", {{"k", 4}}).stops;
  ASSERT_EQ(same.size(), 2U);
  EXPECT_TRUE(same[0].name == "s_upper" && same[0].a == 0 && same[0].b == 1 && same[0].clearance == 4);
  EXPECT_TRUE(same[1].name == "s_lower" && same[1].a == 1 && same[1].b == 0 && same[1].clearance == 4);
  EXPECT_TRUE(same[0].restitution == 0.5 && same[1].restitution == 0.5);
  const auto own = built(two + stop + "clearance = 1\nclearance_lower = '2 * k'\n").stops;
  EXPECT_EQ(own.at(0).clearance, 1);
  EXPECT_EQ(own.at(1).clearance, 6);
  const auto one =
      built(two + "[[stop]]\nname = 's'\n" + between + "restitution = 0\ntwo_sided = false\nclearance = 1\n");
  EXPECT_EQ(one.stops.size(), 1U);
  EXPECT_EQ(one.stops[0].name, "s");
}

TEST(TwoSided, refusals_name_the_stop_of_the_file) {
  const auto stop = [](const std::string& keys) {
    return refusal(two + "[[stop]]\nname = 's'\n" + between + "restitution = 0.5\n" + keys);
  };
  EXPECT_EQ(stop("clearance = 1\nclearance_lower = 1\n"),
            at(next + 5) + "stop 's': clearance_lower: this key needs two_sided = true");
  EXPECT_EQ(stop("clearance = 1\ntwo_sided = 1\n"),
            at(next + 5) + "stop 's': two_sided: expected true or false, found a number");
  EXPECT_EQ(stop("clearance = 1\ntwo_sided = true\nclearance_lower = -1\n"),
            at(next + 6) +
                "stop 's': clearance = -1 leaves no room opposite stop 's_upper' with clearance = 1: "
                "their sum must be positive");
  expect_start(stop("clearance = 0\ntwo_sided = true\n"), at(next + 4) + "stop 's': clearance = 0 leaves n");
  EXPECT_EQ(stop("clearance = 1\ntwo_sided = true\n[start]\nx1 = -2\n"),
            at(next + 7) + "start: stop 's_lower' is violated: x2 - x1 = 2 > clearance = 1");
  EXPECT_EQ(stop("clearance = 1\ntwo_sided = true\n[[stop]]\nname = 's_lower'\n" + between +
                 "clearance = 1\nrestitution = 1\n"),
            at(next + 6) + "stop 's_lower': name 's_lower' is used twice");
  EXPECT_EQ(stop("clearance = 1\ntwo_sided = true\n[[compliant_stop]]\nname = 's'\n" + between +
                 "clearance = 1\nstiffness = 1\n"),
            at(next + 6) + "compliant_stop 's': name 's' is used twice");
  EXPECT_EQ(refusal(two + "[[stop]]\nname='a'\nrestitution=1\nclearance=1\nbetween=['x1','ground']\n"
                          "[[stop]]\nname='b'\nrestitution=1\nclearance=-1\nbetween=['ground','x1']\n"),
            at(next + 8) +
                "stop 'b': clearance = -1 leaves no room opposite stop 'a' with clearance = 1: "
                "their sum must be positive");
}

TEST(CompliantStop, every_key_and_its_default) {
  const auto part = "[[compliant_stop]]\nname = 'bumper'\n" + between + "clearance = 0.5\nstiffness = 'k'\n";
  const auto plain = built(two + part).compliant_stops;
  ASSERT_EQ(plain.size(), 1U);
  EXPECT_TRUE(plain[0].name == "bumper" && plain[0].a == 0 && plain[0].b == 1 && plain[0].clearance == 0.5);
  EXPECT_TRUE(plain[0].stiffness == 3 && plain[0].damping == 0 && !plain[0].pulls);
  const auto both = built(two + part + "damping = 'k / 2'\npulls = true\ntwo_sided = true\n").compliant_stops;
  ASSERT_EQ(both.size(), 2U);
  EXPECT_TRUE(both[0].damping == 1.5 && both[0].pulls && both[1].pulls && both[1].a == 1);
  EXPECT_EQ(both[1].name, "bumper_lower");
  EXPECT_EQ(built(two + part + "[start]\nx1 = 9\n").compliant_stops.size(), 1U);  // may start pressed
}

TEST(CompliantStop, refusals) {
  const auto stop = [](const std::string& keys) {
    return refusal(two + "[[compliant_stop]]\nname = 'b'\n" + between + "clearance = 0\n" + keys);
  };
  EXPECT_EQ(stop(""), at(next) + "compliant_stop 'b': 'stiffness' is missing");
  EXPECT_EQ(stop("stiffness = 0\n"), at(next + 4) +
                                         "compliant_stop 'b': stiffness = 0 is not positive; a damper alone beyond a "
                                         "gap is a damper that acts within an interval");
  EXPECT_EQ(stop("stiffness = 1\ndamping = -1\n"), at(next + 5) + "compliant_stop 'b': damping = -1 is negative");
  EXPECT_EQ(stop("stiffness = 1\npulls = 'no'\n"),
            at(next + 5) + "compliant_stop 'b': pulls: expected true or false, found a string");
  expect_start(stop("stiffness = 1\nrestitution = 1\n"), at(next + 5) + "compliant_stop 1: unknown key 'restitution'");
  EXPECT_EQ(stop("stiffness = 1\n[[stop]]\nname = 'c'\nbetween = ['x1', 'x1']\nclearance = 0\nrestitution = 1\n"),
            at(next + 5) + "stop 'c': both ends are 'x1'");
}

TEST(Matrix, entries_by_rows_are_numbers_or_expressions) {
  const auto model = built(two + "[matrix]\nstiffness = [[1, '-k'], ['-k', 5]]\nmass = [[0, 0.5], [0.5, 0]]\n");
  EXPECT_EQ(model.stiffness, (SymmetricMatrix{1, -3, -3, 5}));
  EXPECT_EQ(model.mass, (SymmetricMatrix{0, 0.5, 0.5, 0}));
  EXPECT_TRUE(model.damping.empty());
  const auto massless = "name='m'\n[[coordinate]]\nname='a'\n[[coordinate]]\nname='b'\nmass=0\n";
  const auto given = built(std::string(massless) + "[matrix]\nmass = [[2, 1], [1, 2]]\ndamping = [[-1, 0], [0, 1]]\n");
  EXPECT_EQ(given.coordinates[0].mass, 0);
  EXPECT_EQ(given.damping.front(), -1);
  std::string wide = "name = 'm'\n", row = "0.12345678901234,\n", rest;
  for (int i = 0; i < 300; ++i) wide += "[[coordinate]]\nname = 'x" + std::to_string(i) + "'\nmass = 1\n";
  for (int i = 1; i < 300; ++i) {
    row += "0.12345678901234,\n";
    rest += "[0.12345678901234";
    for (int j = 1; j < 300; ++j) rest += ",0";
    rest += "],\n";
  }
  const auto many = built(wide + "[matrix]\nstiffness = [[" + row + "],\n" + rest + "]\n");
  EXPECT_EQ(many.stiffness.size(), 90000U);  // printed in lines that are short enough to be read again
}

TEST(Matrix, refusals_name_the_entries) {
  const auto matrix = [](const std::string& text) { return refusal(two + "[matrix]\n" + text); };
  EXPECT_EQ(matrix("stiffness = [[1, 2], [3, 4]]\n"),
            at(next + 1) + "matrix: stiffness: the matrix is not symmetric: [x2, x1] = 3 differs from [x1, x2] = 2");
  EXPECT_EQ(matrix("damping = [[1, 2]]\n"),
            at(next + 1) + "matrix: damping: expected 2 rows (one per coordinate), found 1");
  EXPECT_EQ(matrix("damping = [[1, 2],\n[1]]\n"),
            at(next + 2) + "matrix: damping[x2]: expected 2 entries (one per coordinate), found 1");
  EXPECT_EQ(matrix("damping = 1\n"), at(next + 1) + "matrix: damping: expected a list, found a number");
  EXPECT_EQ(matrix("dampings = 1\n"), at(next + 1) + "matrix: unknown key 'dampings'; did you mean 'damping'?");
  EXPECT_EQ(matrix("damping = [[0, 0], [0, '1 / (k - 3)']]\n"),
            at(next + 1) + "matrix: damping[x2, x2]: expression '1 / (k - 3)': its value is inf with k = 3");
  expect_start(matrix("damping = [[0, 0], [0, 1e60]]\n"),
               at(next + 1) + "matrix: damping: [x2, x2] = 1e+60 is too large");
  EXPECT_EQ(matrix("mass = [[0, 2], [2, 0]]\n"),
            at(next + 1) +
                "matrix: mass: with the coordinates' masses it is not positive definite: some motion of the "
                "coordinates up to 'x2' has no positive mass");
  EXPECT_EQ(
      matrix("mass = [[0, 0], [0, -2]]\n"),
      at(next - 1) + "coordinate 'x2': the coordinate has no mass: its own and its entry of [matrix] mass add up to 0");
  const auto bare = std::string("name='m'\n[[coordinate]]\nname='a'\n");
  EXPECT_EQ(refusal(bare + "[matrix]\nstiffness = [[1]]\n"), at(2) + "coordinate 'a': 'mass' is missing");
  EXPECT_EQ(refusal(bare + "[matrix]\nmass = [[0]]\n"),
            at(2) + "coordinate 'a': the coordinate has no mass: its own and its entry of [matrix] mass add up to 0");
}

TEST(ImpactLaw, words) {
  EXPECT_EQ(built(two).impact_law, ImpactLaw::moreau);
  EXPECT_EQ(built("impact_law = 'sequence'\n" + two).impact_law, ImpactLaw::sequence);
  EXPECT_EQ(built("impact_law = 'moreau'\n" + two).impact_law, ImpactLaw::moreau);
  EXPECT_EQ(refusal("impact_law = 'sequense'\n" + two),
            at(1) + "impact_law: unknown word 'sequense'; did you mean 'sequence'?");
  EXPECT_EQ(refusal("impact_law = 1\n" + two), at(1) + "impact_law: expected a string, found a number");
}

}  // namespace
}  // namespace slapstick
