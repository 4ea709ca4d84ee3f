/// Laws of nothing in short: edits that change nothing, on some random files (the campaign `neutral` is the long form).
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "neutral/laws.hpp"
#include "neutral/spectrum.hpp"
#include "property/random_file.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::neutral {
namespace {

/// Kinds of parts and their keys, and what else a file may have.
constexpr const char* features[] = {"coordinate",
                                    "signal",
                                    "impulse",
                                    "base",
                                    "spring",
                                    "damper",
                                    "maxwell",
                                    "jenkins",
                                    "force",
                                    "friction",
                                    "freewheel",
                                    "stop",
                                    "compliant_stop",
                                    "two_sided",
                                    "repeats",
                                    "frequency",
                                    "unloading_stiffness",
                                    "coefficient_outside",
                                    "stribeck",
                                    "normal_force",
                                    "spring points",
                                    "damper points",
                                    "friction points",
                                    "stop points",
                                    "within",
                                    "parameter",
                                    "matrix",
                                    "ratio",
                                    "pressed",
                                    "no drive",
                                    "belt_speed",
                                    "law"};

TEST(Neutral, FilesAreSoundAndHaveEveryFeature) {
  std::map<std::string, int> seen;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Definition file = test::random_file(seed);
    EXPECT_EQ(text(read_definition(text(file), "random.toml")), text(file));
    for (const auto& [kind, all] : file.parts)
      for (const Part& part : all) {
        ++seen[kind];
        for (const auto& [key, on] : part.flags) ++seen[key];
        for (const auto& [key, word] : part.texts) ++seen[key];
        for (const auto& [key, scalar] : part.fields) ++seen[key];
        seen["stribeck"] += !part.stribeck.empty(), seen["normal_force"] += !part.load.empty();
        seen["ratio"] += part.ratio.has_value(), seen["pressed"] += !part.presses.empty();
        seen[kind + " points"] += !part.points.empty(), seen["within"] += !part.within.empty();
      }
    seen["parameter"] += !file.parameters.empty(), seen["matrix"] += !file.matrices.empty(),
        seen["no drive"] += !has_harmonics(file);
  }
  for (const char* feature : features) EXPECT_GE(seen[feature], 8) << feature;
}

TEST(Neutral, SimplerFilesAreSound) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const Definition& file : simpler(test::random_file(seed)))
      EXPECT_NO_THROW((void)read(file).build()) << text(file);
}

/// An edit that does change something is seen: else nothing below means anything.
TEST(Neutral, SeesASpringThatIsStronger) {
  int seen = 0, tried = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Asked first(test::random_file(seed, {.most_coordinates = 2, .tones = false, .signals = false}));
    Edited second{first.file(), {}};
    auto& springs = parts(second.file, "spring");
    if (springs.empty() || !field(springs[0], "stiffness")) continue;
    multiply(*field(springs[0], "stiffness"), 1.0 + 1e-6);
    ++tried;
    seen += judge(first, find_edit("show"), second, Verb::simulate).verdict == Verdict::different;
  }
  EXPECT_GE(seen, tried * 3 / 4);
}

/// Each to its own digits, half of them where two meet: a slow one beside a fast one is neither lost nor rounding.
TEST(Neutral, EigenvaluesHaveTheSameDigitsInAllUnits) {
  constexpr double half_the_digits = 1e-6;
  long compared = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Asked first(test::random_file(seed));
    if (!has_harmonics(first.file())) continue;  // the clock has a unit of time then
    const auto& wanted = first.answer(Verb::modes).eigenvalues;
    for (const double unit : {0x1p-20, 0x1p20}) {
      const Answer answer = Asked(in_units(first.file(), 1.0, unit, 1.0 / unit).file).answer(Verb::modes);
      Spectrum found;
      for (const std::complex<double>& value : answer.eigenvalues) found.push_back(value * unit);
      ASSERT_EQ(found.size(), wanted.size()) << seed << ' ' << answer.message;
      for (const std::complex<double>& one : wanted) {
        EXPECT_LE(std::abs(*take_nearest(found, one) - one), half_the_digits * std::abs(one)) << seed << ", " << unit;
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 800);
}

/// A verb, and the files that it is asked about: [from, to).
struct Share {
  Verb verb;
  std::uint64_t from, to;
};
class OfNothing : public testing::TestWithParam<Share> {};

TEST_P(OfNothing, EditsChangeNoAnswer) {
  const auto& [verb, from, to] = GetParam();
  std::map<Verdict, int> count;
  for (std::uint64_t seed = from; seed < to; ++seed) {
    Asked first(test::random_file(seed));
    if (first.definition().parameters().size() < parameters_of(verb)) continue;
    for (const Edit& edit : edits()) {
      campaign::Random random(seed, 0);
      const auto second = edit.apply(first.file(), random);
      if (!second) continue;
      const Judgement outcome = judge(first, edit, *second, verb);
      ++count[outcome.verdict];
      if (outcome.verdict != Verdict::different) continue;
      const Definition small = smallest(first.file(), edit, verb, seed, outcome.why, 300);
      ADD_FAILURE() << edit.name << ", seed " << seed << ": " << outcome.why << '\n'
                    << both_commands(small, edit, verb, seed);
    }
  }
  EXPECT_LE(50 * count[Verdict::excused], count[Verdict::agreed] + count[Verdict::excused]);
  EXPECT_GE(count[Verdict::agreed], 50);
}

INSTANTIATE_TEST_SUITE_P(Laws, OfNothing,
                         testing::Values(Share{Verb::simulate, 0, 150}, Share{Verb::measure, 0, 150},
                                         Share{Verb::classify, 0, 40}, Share{Verb::modes, 0, 150},
                                         Share{Verb::orbit, 0, 40}, Share{Verb::branch, 4, 30}),
                         [](const auto& info) { return std::string(name(info.param.verb)); });

TEST(BetweenVerbs, AnswersOfOneFileAgree) {
  std::map<std::string, int> kept;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Definition file = test::random_file(seed);
    const ModelDefinition definition = read(file);
    for (const Law& law : laws()) {
      const auto broken = check(law, definition);
      if (!broken) continue;
      if (broken->empty()) {
        ++kept[law.name];
        continue;
      }
      ADD_FAILURE() << law.name << ", seed " << seed << ": " << *broken << '\n' << text(smallest(file, law, 300));
    }
  }
  for (const Law& law : laws()) EXPECT_GE(kept[law.name], 3) << law.name;
}

}  // namespace
}  // namespace slapstick::neutral
