/// Results do not depend on the unit of a parameter, nor on the size of multipliers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/bracketed_root.hpp"
#include "families.hpp"
#include "orbit/path.hpp"

namespace slapstick::test {
namespace {

/// A forced mass before a stop, lengths and forces in units of 1 / scale, with what is found on its branch over the
/// clearance.
struct InUnit {
  explicit InUnit(double scale, const orbit::Orbit* first)
      : posed("impact-oscillator", {{"cosine", scale}}, {"clearance"}, {0.3 * scale}),
        both("impact-oscillator", {{"cosine", scale}}, {"clearance", "restitution"}, {0.3 * scale, 0.8}) {
    orbit::Orbit start = first != nullptr ? *first : posed.settled().value().orbit;
    if (first != nullptr) {
      start.values[0] *= scale;
      for (Eigen::VectorXd& x : start.x) x *= scale;
    }
    const double from = 0.0, to = 1.5 * scale;
    branch = orbit::follow(*posed.problem, start, {.from = from, .to = to});
    for (const orbit::SpecialPoint& point : branch.special)
      rates.push_back(orbit::sensitivity(both.family, {point.value, 0.8}, point, to - from).front());
  }
  Posed posed, both;
  orbit::Branch branch;
  std::vector<double> rates;
};

/// Lengths in m, in mm and without dimension, as powers of two: roundings are the same, and nothing may differ.
TEST(Units, OfAParameterChangeNoBranch) {
  const InUnit one(1.0, nullptr);
  const orbit::Orbit& first = [&]() -> const orbit::Orbit& {
    return std::ranges::find_if(one.branch.points,
                                [](const orbit::Solution& point) { return point.orbit.parameter() == 0.3; })
        ->orbit;
  }();
  ASSERT_TRUE(std::ranges::any_of(one.branch.special, [](const orbit::SpecialPoint& point) {
    return point.type == orbit::SpecialType::PD && point.normal_form.coefficient && !point.born.empty();
  }));
  for (const double scale : {0x1p-10, 0x1p-20, 0x1p10}) {
    const InUnit other(scale, &first);
    ASSERT_EQ(other.branch.points.size(), one.branch.points.size()) << scale;
    for (std::size_t i = 0; i < one.branch.points.size(); ++i)
      EXPECT_NEAR(other.branch.points[i].orbit.parameter() / scale, one.branch.points[i].orbit.parameter(), 1e-13)
          << scale;
    ASSERT_EQ(other.branch.special.size(), one.branch.special.size()) << scale;
    for (std::size_t i = 0; i < one.branch.special.size(); ++i) {
      const orbit::SpecialPoint &a = other.branch.special[i], &b = one.branch.special[i];
      EXPECT_EQ(a.type, b.type) << scale;
      EXPECT_NEAR(a.value / scale, b.value, 1e-13) << scale << " " << name(a.type);
      EXPECT_NEAR(other.rates[i] / scale, one.rates[i], 1e-9 * std::abs(one.rates[i])) << scale << " " << name(a.type);
      EXPECT_NEAR(a.normal_form.coefficient.value_or(0.0), b.normal_form.coefficient.value_or(0.0),
                  1e-9 * std::abs(b.normal_form.coefficient.value_or(0.0)))
          << scale;
      ASSERT_EQ(a.born.size(), b.born.size()) << scale << " " << name(a.type);
      for (std::size_t k = 0; k < a.born.size(); ++k)
        EXPECT_NEAR(a.born[k].values[0] / scale, b.born[k].values[0], 1e-13) << scale;
    }
  }
}

/// The multipliers of ten masses, of which the largest has some size and one pair or one of them passes the unit circle
/// at p = 0.
std::vector<std::complex<double>> of_ten_masses(double largest, double p, bool torus) {
  std::vector<std::complex<double>> all;
  for (int i = 0; i < 18; ++i) all.emplace_back(largest * std::pow(10.0, -2.5 * i), 0.0);
  if (torus) {
    all.push_back(std::polar(1.0 + p, 0.7));
    all.push_back(std::polar(1.0 + p, -0.7));
  } else {
    all.emplace_back(-1.0 - p, 0.0);
    all.emplace_back(0.0, 0.0);
  }
  return all;
}

/// A product of 190 pairs of multipliers up to 1e19 is no number. Bounded factors keep sign and zero, and the zero is
/// found in a few steps.
TEST(Multipliers, HoweverLargeHideNeitherADoublingNorATorus) {
  for (const double largest : {1.0, 1e6, 1e19}) {
    int steps = 0;
    const auto flip = [&](double p) {
      ++steps;
      return orbit::flip_function(of_ten_masses(largest, p, false));
    };
    EXPECT_NEAR(bracketed_root(flip, -0.3, 0.5, 1e-14), 0.0, 1e-12) << largest;
    EXPECT_LT(steps, 20) << largest;
    steps = 0;
    const auto torus = [&](double p) {
      ++steps;
      return orbit::torus_function(of_ten_masses(largest, p, true));
    };
    ASSERT_LT(torus(-0.1) * torus(0.1), 0.0) << largest;
    EXPECT_NEAR(bracketed_root(torus, -0.1, 0.1, 1e-14), 0.0, 1e-12) << largest;
    EXPECT_LT(steps, 22) << largest;
  }
}

}  // namespace
}  // namespace slapstick::test
