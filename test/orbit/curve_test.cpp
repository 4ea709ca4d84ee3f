/// Loci of special points in two parameters: where they end, and what they meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "beside.hpp"
#include "continuation/curve_events.hpp"

namespace slapstick::test {
namespace {

using orbit::CurveEnd, orbit::Jump, orbit::Occurrence, orbit::Passage, orbit::Sliding, orbit::SpecialType;

struct Ranges {
  double from, to, second_from, second_to;
};

orbit::Curve curve_of(const std::string& model, const std::vector<std::string>& names, std::vector<double> values,
                      int n, SpecialType type, const Ranges& in) {
  const Posed single(model, {{names[1], values[1]}}, {names[0]}, {values[0]});
  const auto first = single.settled(n, 3000);
  if (!first) throw std::runtime_error("no orbit");
  const orbit::Branch branch = orbit::follow(*single.problem, first->orbit, {.from = in.from, .to = in.to});
  orbit::SpecialPoint point = only(branch, type);
  values[0] = point.value;
  const Posed both(model, {}, names, values);
  point.solution.orbit.values = values;
  return orbit::locus(*both.problem, point,
                      {.from = in.from, .to = in.to, .second_from = in.second_from, .second_to = in.second_to});
}

/// A mass that sticks once a cycle forgets all else: its multiplier is zero, and no curve of its cycles has a fold.
TEST(Curve, OfACycleWithoutMemoryHasNoFolds) {
  const orbit::Curve curve = curve_of("falling-friction", {"belt_speed", "damping_ratio"}, {0.5, 0.05}, 0,
                                      SpecialType::SL, {0.4, 1.8, 0.05, 0.055});
  ASSERT_GT(curve.points.size(), 5U) << ended(curve);
  for (const orbit::CurvePoint& point : curve.points) EXPECT_EQ(std::abs(point.solution.multipliers.front()), 0.0);
  for (const orbit::CurveEvent& event : curve.met)
    EXPECT_NE(event.met.front().type, SpecialType::LP) << event.values[0] << " " << event.values[1];
}

/// Beyond the resonance 1:2 the product of two real multipliers is 1: a zero of the same function, and no torus.
TEST(Curve, OfATorusEndsWhereItsMultipliersBecomeReal) {
  const orbit::Curve curve =
      curve_of("vibro-impact", {"omega", "friction"}, {4.78, 0.15}, 4, SpecialType::NS, {4.7, 4.9, 0.0, 0.5});
  EXPECT_TRUE(curve.met.empty());
  const orbit::Curve wide =
      curve_of("vibro-impact", {"omega", "friction"}, {4.78, 0.15}, 4, SpecialType::NS, {4.4, 4.9, 0.1, 0.5});
  EXPECT_FALSE(wide.failed()) << ended(wide);
  EXPECT_TRUE(wide.down.kind == CurveEnd::Kind::end_of_torus || wide.up.kind == CurveEnd::Kind::end_of_torus);
  for (const orbit::CurvePoint& point : wide.points)
    EXPECT_NEAR(std::abs(point.solution.multipliers.front()), 1.0, 1e-3) << point.values[0] << " " << point.values[1];
  EXPECT_EQ(std::ranges::count_if(wide.met, [](const auto& event) { return name(event.met.front()) == "R2"; }), 1);
  const auto& last = wide.points.back().solution.multipliers;
  EXPECT_NEAR(std::abs(last[0] + 1.0), 0.0, 1e-2);
  EXPECT_NEAR(std::abs(last[1] + 1.0), 0.0, 1e-2);
}

/// A curve used to come to the end of a range by ever smaller steps, and never there.
TEST(Curve, EndsOnTheEndOfItsRangeInOneStep) {
  const Ranges in{2.0, 4.0, 0.0, 0.5};  // there is no model of less friction
  const orbit::Curve curve = curve_of("vibro-impact", {"omega", "friction"}, {2.7, 0.15}, 1, SpecialType::PD, in);
  EXPECT_FALSE(curve.failed()) << ended(curve);
  EXPECT_EQ(curve.points.front().values[1], 0.0);
  EXPECT_EQ(curve.points.back().values[1], 0.5);
  int tiny = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    tiny += std::abs(curve.points[i].values[1] - curve.points[i - 1].values[1]) < 1e-5 ? 1 : 0;
  EXPECT_EQ(tiny, 0);
  for (const orbit::CurvePoint* end : {&curve.points.front(), &curve.points.back()}) {
    const auto off = [](const std::complex<double>& mu) { return std::abs(mu + 1.0); };
    EXPECT_LT(off(*std::ranges::min_element(end->solution.multipliers, {}, off)), 1e-7);
  }
}

/// Two points of codimension two are apart, and each stands where it is, not where the next step ended.
TEST(Curve, ListsEachPointThatItMeetsOnceAndWhereItIs) {
  const Ranges in{1.0, 2.0, 0.05, 0.3};
  const orbit::Curve fine = curve_of("vibro-impact", {"omega", "friction"}, {1.53, 0.15}, 1, SpecialType::SL, in);
  for (std::size_t i = 0; i < fine.met.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GT(
          std::hypot(fine.met[i].values[0] - fine.met[k].values[0], fine.met[i].values[1] - fine.met[k].values[1]),
          1e-6);
  const auto turn = std::ranges::find_if(fine.met, [](const auto& event) { return name(event.met.front()) == "turn"; });
  ASSERT_NE(turn, fine.met.end());
  double farthest = 0.0;
  for (const orbit::CurvePoint& point : fine.points) farthest = std::max(farthest, point.values[0]);
  EXPECT_GE(turn->values[0], farthest);
  EXPECT_LT(turn->values[0] - farthest, 1e-4);
}

/// An impact without speed beside sticks without length: all of it is zero all along, and its rounding changes sign a
/// hundred times. Its multiplier is infinite, those beside it are rounding.
TEST(Curve, PassesThroughNothingThatIsZeroAllAlong) {
  const Ranges in{0.6, 1.0, 0.4, 0.7};
  const orbit::Curve curve = curve_of("stick-slip-impact", {"drive", "clearance"}, {0.6, 0.5}, 1, SpecialType::GR, in);
  EXPECT_FALSE(curve.failed()) << ended(curve);
  EXPECT_GT(curve.points.size(), 50U);
  EXPECT_TRUE(curve.met.empty()) << curve.met.size() << ", first " << name(curve.met.front().met.front());
  for (const orbit::CurvePoint& point : curve.points) EXPECT_TRUE(point.solution.is_motion) << point.solution.why;
}

/// prod (mu_i mu_j - 1) is zero at a neutral saddle too, prod (mu + 1) changes its sign through infinity.
TEST(Curve, IsNoTorusAtANeutralSaddleAndNoDoublingAtAPole) {
  const Posed posed("vibro-impact", {}, {"omega", "friction"}, {2.5, 0.15});
  const auto first = posed.settled(1, 3000);
  ASSERT_TRUE(first);
  orbit::SpecialPoint point;
  point.type = SpecialType::CO;
  point.solution = *first;
  const auto with = [](std::vector<Complex> multipliers) {
    orbit::Watched watched;
    watched.multipliers = std::move(multipliers);
    return watched;
  };
  const std::vector<orbit::CurveTest> tests = orbit::curve_tests(point, {}, {});
  const auto of = [&](const std::string& type) {
    return *std::ranges::find_if(tests, [&](const orbit::CurveTest& test) { return name(test.met) == type; });
  };
  EXPECT_FALSE(of("NS").holds(with({2.0, 0.5, 0.1})));
  EXPECT_FALSE(of("NS").holds(with({-2.0, -0.5})));
  EXPECT_TRUE(of("NS").holds(with({std::polar(1.0, 1.3), std::polar(1.0, -1.3), 0.1})));
  EXPECT_FALSE(of("PD").holds(with({1e5, 0.5})));
  EXPECT_TRUE(of("PD").holds(with({1e5, -1.0})));
  const orbit::Watched pole = with({1e28, -1e12});
  EXPECT_TRUE(std::isnan(of("PD").value({pole, {}})));
}

/// What is zero all along a curve is not told by its size: heavier by a million, with all forces, the same machine has
/// the same curve.
TEST(Curve, DoesNotDependOnTheUnitOfMass) {
  const Ranges in{8.0, 20.0, 0.001, 0.006};
  std::array<std::pair<long, std::size_t>, 2> seen;
  for (const double factor : {1.0, 1e6}) {
    Overrides values = {{"force", 120.0}, {"m1", 1.5},  {"m2", 4.0},  {"k1", 6000.0},
                        {"k2", 4e4},      {"c1", 12.0}, {"c2", 40.0}, {"kinetic", 30.0}};
    for (auto& [name, value] : values) value *= factor;
    const Posed single(SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", values, {"frequency"}, {14.0});
    const auto first = single.settled();
    ASSERT_TRUE(first);
    const orbit::Branch branch = orbit::follow(*single.problem, first->orbit, {.from = in.from, .to = in.to});
    const auto sl = std::ranges::find(branch.special, SpecialType::SL, &orbit::SpecialPoint::type);
    ASSERT_NE(sl, branch.special.end());
    orbit::SpecialPoint point = *sl;
    const Posed both(SLAPSTICK_ORBIT_MODELS "hammer-drill.toml", values, {"frequency", "gap"}, {point.value, 0.004});
    point.solution.orbit.values = {point.value, 0.004};
    const orbit::Curve curve = orbit::locus(
        *both.problem, point, {.from = in.from, .to = in.to, .second_from = in.second_from, .second_to = in.second_to});
    seen[factor > 1.0 ? 1 : 0] = {
        std::ranges::count_if(curve.points, [](const orbit::CurvePoint& p) { return p.solution.is_motion; }),
        curve.met.size()};
  }
  EXPECT_GT(seen[0].first, 10);
  EXPECT_EQ(seen[0], seen[1]);
}

/// The locus of a BP came to the ends of its ranges by ever smaller steps, and never there.
TEST(Curve, OfABranchPointEndsOnItsRange) {
  const Ranges in{0.9, 1.7, 0.6, 0.8};
  const orbit::Curve curve = curve_of("two-sided-rattle", {"omega", "restitution"}, {1.0, 0.7}, 1, SpecialType::BP, in);
  EXPECT_FALSE(curve.failed()) << ended(curve);
  for (const orbit::CurvePoint* end : {&curve.points.front(), &curve.points.back()})
    EXPECT_TRUE(end->values[1] == 0.6 || end->values[1] == 0.8 || end->values[0] == 0.9 || end->values[0] == 1.7)
        << end->values[0] << " " << end->values[1];
  EXPECT_GT(std::hypot(curve.points.front().values[0] - curve.points.back().values[0],
                       curve.points.front().values[1] - curve.points.back().values[1]),
            0.1);
}

}  // namespace
}  // namespace slapstick::test
