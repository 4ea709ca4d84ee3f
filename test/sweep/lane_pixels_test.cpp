/// Quick pixels in lanes against the scalar `classify`: where both decide, they agree.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "slapstick/io/model_file.hpp"
#include "slapstick/sweep/map.hpp"

namespace slapstick::sweep {
namespace {

const ModelDefinition& paper() {
  static const ModelDefinition definition = load_model("vibro-impact");
  return definition;
}

Overrides at(double omega, double friction) { return {{"omega", omega}, {"friction", friction}}; }

/// Pixel by pixel of a chart, by number.
MapProblem paper_chart(GridAxis omega, GridAxis friction) {
  MapProblem problem;
  problem.model_at = [](double x, double y) { return paper().build(at(x, y)); };
  problem.start_at = [](double x, double y) { return paper().start(at(x, y)); };
  problem.x = omega;
  problem.y = friction;
  return problem;
}

/// This many random points of the paper's chart, as a row.
struct RandomPixels {
  explicit RandomPixels(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> omega(1.0, 6.0), friction(0.05, 0.3);
    for (int i = 0; i < count; ++i) {
      const double x = omega(random);
      values.emplace_back(x, friction(random));
    }
    const auto values_at = [this](double i) { return at(values[std::lround(i)].first, values[std::lround(i)].second); };
    problem.model_at = [=](double i, double) { return paper().build(values_at(i)); };
    problem.start_at = [=](double i, double) { return paper().start(values_at(i)); };
    problem.x = {0.0, count - 1.0, count};
    problem.y = {0.0, 0.0, 1};
  }
  std::vector<std::pair<double, double>> values;
  MapProblem problem;
};

int times() {
  const char* const campaign = std::getenv("SLAPSTICK_CAMPAIGN");
  return campaign == nullptr ? 1 : std::max(1, std::atoi(campaign));
}

struct Comparison {
  int both = 0, differ = 0, border = 0, undecided = 0;
  double exponent = 0.0;
};

/// Whether starts nearer than any measurement find this class too: then the pixel lies where two basins meet, and
/// rounding decides which attractor is found.
template <class Classify>
bool where_basins_meet(const System& system, const State& start, const std::string& label,
                       const Classify& classify_alone) {
  for (int k = 1; k <= 12; ++k) {
    State near = start;
    near[0] += k * 5e-13;
    if (classify_alone(system, near).label == label) return true;
  }
  return false;
}

template <class Classify>
Comparison compare(int count, unsigned seed, const Classify& classify_alone) {
  const RandomPixels pixels(count, seed);
  Comparison result;
  for (const Finding& found : run_map(pixels.problem).findings) {
    const auto [omega, friction] = pixels.values[static_cast<std::size_t>(found.pixel)];
    result.undecided += found.attractor == Attractor::undecided;
    const System system(paper().build(at(omega, friction)));
    const State start = paper().start(at(omega, friction));
    const Classification alone = classify_alone(system, start);
    if (alone.attractor == Attractor::undecided || found.attractor == Attractor::undecided) continue;
    ++result.both;
    if (alone.label == found.label()) {
      result.exponent = std::max(result.exponent, std::abs(alone.exponent - found.exponent));
      continue;
    }
    if (where_basins_meet(system, start, found.label(), classify_alone)) {
      ++result.border;
      continue;
    }
    ++result.differ;
    ADD_FAILURE() << "omega = " << omega << ", friction = " << friction << ": " << found.label() << " in lanes, "
                  << alone.label << " alone";
  }
  std::printf(
      "%d pixels: %d decided by both, %d differ, %d more where basins meet, %d undecided in lanes, exponents within "
      "%.1e\n",
      count, result.both, result.differ, result.border, result.undecided, result.exponent);
  return result;
}

TEST(LanePixels, AgreeWithTheSerialScalarRouteWhereBothDecide) {
  const int count = 500 * times();
  const Comparison found =
      compare(count, 27, [](const System& system, const State& start) { return classify_quickly(system, start, 300); });
  EXPECT_GT(found.both, 85 * count / 100);
  EXPECT_LE(found.border, count / 1000);
  EXPECT_LT(found.exponent, 1e-6);
}

TEST(LanePixels, AgreeWithTheFullLevelWhereBothDecide) {
  const int count = 100 * times();
  const Comparison found =
      compare(count, 28, [](const System& system, const State& start) { return classify(system, start); });
  EXPECT_GT(found.both, 85 * count / 100);
  EXPECT_LE(found.border, count / 1000);
  EXPECT_LT(found.exponent, 1e-6);
}

/// Some 7 % of this chart are chaotic; a search that has lost its way leaves far more open.
TEST(LanePixels, FewAreUndecided) {
  int undecided = 0;
  const Map map = run_map(paper_chart({1.0, 6.0, 50}, {0.05, 0.3, 40}));
  for (const Finding& found : map.findings) undecided += found.attractor == Attractor::undecided;
  EXPECT_LT(undecided, 240) << "of 2000";
}

/// Lanes are shared with other pixels; tiles depend on the size of the chart.
TEST(LanePixels, WhatRunsBesideAPixelChangesNoBit) {
  const Map map = run_map(paper_chart({1.2, 5.8, 20}, {0.05, 0.3, 3}));
  for (const Finding& found : map.findings) {
    const double x = map.x_of(found), y = map.y_of(found);
    const Map alone = run_map(paper_chart({x, x, 1}, {y, y, 1}));
    EXPECT_EQ(found.label(), alone.findings[0].label());
    if (found.n > 0) {
      EXPECT_EQ(found.multiplier, alone.findings[0].multiplier) << found.label();
    }
  }
}

/// Free motions, translations, loads: what lanes do not take is a Motion's.
TEST(LanePixels, EveryBuiltInModelHasTheClassOfItsScalarRoute) {
  int both = 0;
  for (const std::string& name : builtin_models()) {
    const ModelDefinition definition = load_model(name);
    const Model model = definition.build();
    if (!model.periodic()) continue;
    MapProblem problem;
    problem.model_at = [&](double, double) { return definition.build(); };
    problem.start_at = [&](double, double) { return definition.start(); };
    problem.x = problem.y = {0.0, 0.0, 1};
    const Classification alone = classify_quickly(System(model), definition.start(), 300);
    const Finding found = run_map(problem).findings.at(0);
    if (found.attractor == Attractor::undecided || alone.attractor == Attractor::undecided) continue;
    ++both;
    EXPECT_EQ(found.attractor, alone.attractor) << name;
    EXPECT_EQ(found.n, alone.n) << name;
    EXPECT_EQ(found.p, alone.p) << name;
    EXPECT_EQ(found.sticking, alone.sticking) << name;
    EXPECT_EQ(found.chatter, alone.chatter) << name;
  }
  EXPECT_GT(both, 15);
}

}  // namespace
}  // namespace slapstick::sweep
