/// The motion in one mode over times of many steps: against closed forms.
#include "orbit/mode_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "families.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::test {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

constexpr double rounding = std::numeric_limits<double>::epsilon();
constexpr double few = 10.0;  // roundings of a step

/// stiff-rod.toml moves as two oscillators: both masses together, and against each other.
///
///     x = a + b,   y = (a - b / mass) / unit
struct StiffRod {
  explicit StiffRod(double unit = 1.0)
      : posed(SLAPSTICK_ORBIT_MODELS "stiff-rod.toml", {{"unit", unit}}, {"force", "rod"}, {1.0, rod}),
        set(posed.family, posed.values) {}

  [[nodiscard]] const orbit::ModeRates& mode() const { return set.mode(posed.system.states(0)); }
  /// Of both oscillators.
  static constexpr double rod = 1e5, mass = 0.5, share = 1.0 + 1.0 / mass, damping[] = {0.1, 0.1 + 0.02 * share},
                          square[] = {1.0, 1.0 + rod*share}, inertia[] = {1.0 + mass, share};
  /// Complex amplitude of x by a force of amplitude 1.
  [[nodiscard]] static Complex response(double omega) {
    Complex sum = 0.0;
    for (const int i : {0, 1}) sum += 1.0 / (inertia[i] * Complex(square[i] - omega * omega, damping[i] * omega));
    return sum;
  }
  [[nodiscard]] static Complex exponent(int i) {
    return {-0.5 * damping[i], std::sqrt(square[i] - 0.25 * damping[i] * damping[i])};
  }

  Posed posed;
  orbit::ModeSet set;
};

/// b(0) = 1 at rest, b(s) = exp(-g s) (cos(n s) + g / n sin(n s)), which depends on the rod by dn = share / (2 n).
TEST(LongTime, IsFlownAsInClosedForm) {
  const StiffRod machine;
  const double s = 20.0 * pi, steps = machine.mode().steps(s);
  ASSERT_GT(steps, 1e4);
  orbit::Jet X(machine.set.frame().size(), 0, 2);
  X.value()[0] = 1.0;
  X.value()[1] = -1.0 / StiffRod::mass;
  orbit::flow(machine.mode(), s, X);
  const Complex exponent = StiffRod::exponent(1);
  const double g = -exponent.real(), n = exponent.imag(), decay = std::exp(-g * s);
  const double b = decay * (std::cos(n * s) + g / n * std::sin(n * s));
  const double by_n = decay * (-s * std::sin(n * s) + g * s / n * std::cos(n * s) - g / (n * n) * std::sin(n * s));
  const double by_rod = by_n * StiffRod::share / (2.0 * n);
  const double error = few * steps * rounding;
  EXPECT_NEAR(X.value()[0], b, error);
  EXPECT_NEAR(X.value()[1], -b / StiffRod::mass, error / StiffRod::mass);
  EXPECT_EQ(X.by_parameter()(0, 0), 0.0) << "by the force";
  EXPECT_NEAR(X.by_parameter()(0, 1), by_rod, error * s * StiffRod::share / (2.0 * n)) << "by the rod";
}

/// The same time in parts, each too short to be doubled. A step moves velocities by roundings of its rate times the
/// displacements, and these move the masses together for the rest of the time.
TEST(LongTime, IsTheSumOfItsParts) {
  const StiffRod machine;
  const auto columns = [&] {
    orbit::Jet X(machine.set.frame().size(), 2, 2);
    X.all.setRandom();
    return X;
  };
  orbit::Jet whole = columns();
  orbit::Jet parts = whole;
  const double s = 1000.3 * machine.mode().longest_step;
  ASSERT_TRUE(orbit::is_long(machine.mode(), s));
  ASSERT_FALSE(orbit::is_long(machine.mode(), s / 100.0));
  orbit::flow(machine.mode(), s, whole);
  for (int i = 0; i < 100; ++i) orbit::flow(machine.mode(), s / 100.0, parts);
  const double rate = 2.0 / machine.mode().longest_step, size = parts.all.topRows(2).cwiseAbs().maxCoeff();
  const double error = few * machine.mode().steps(s) * rounding * rate * size;
  for (Eigen::Index row = 0; row < whole.all.rows(); ++row)
    for (Eigen::Index column = 0; column < whole.all.cols(); ++column)
      EXPECT_NEAR(whole.all(row, column), parts.all(row, column), row < 2 ? error * s : error) << row << ", " << column;
}

/// Roundings of the rod's stiffness act on both masses together too: to these their frequency's square is known.
TEST(LongTime, OfAnOrbitHasTheMultipliersAndTheGrazeOfItsClosedForm) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "stiff-rod.toml", {}, {"force"}, {0.5});
  const auto found = posed.settled(1, 6);  // near enough for Newton's method
  ASSERT_TRUE(found);
  const double omega = 0.25, T = 2.0 * pi / omega;
  const double error = rounding * (few * StiffRod().mode().steps(T) + StiffRod::square[1] * T);
  std::vector<Complex> expected;
  for (const int i : {0, 1})
    for (const Complex exponent : {StiffRod::exponent(i), std::conj(StiffRod::exponent(i))})
      expected.push_back(std::exp(exponent * T));
  ASSERT_EQ(found->multipliers.size(), expected.size());
  for (const Complex multiplier : found->multipliers) {
    double nearest = INFINITY;
    for (const Complex one : expected) nearest = std::min(nearest, std::abs(one - multiplier));
    EXPECT_LT(nearest, error) << multiplier;
  }
  const orbit::Branch branch = orbit::follow(*posed.problem, found->orbit, {.from = 0.4, .to = 1.8});
  ASSERT_FALSE(branch.special.empty());
  const auto graze = std::find_if(branch.special.begin(), branch.special.end(),
                                  [](const auto& point) { return point.type == orbit::SpecialType::GR; });
  ASSERT_NE(graze, branch.special.end());
  EXPECT_NEAR(graze->value, 1.0 / std::abs(StiffRod::response(omega)), error);
}

/// A rod measured in metres and in micrometres is as fast.
TEST(LongTime, TakesAsManyStepsInOtherUnitsOfACoordinate) {
  const double steps = StiffRod().mode().steps(1.0);
  for (const double unit : {1e-6, 1e-3, 1e3, 1e6}) {
    const double others = StiffRod(unit).mode().steps(1.0);
    EXPECT_LT(others, 1.5 * steps) << unit;
    EXPECT_GT(others, steps / 1.5) << unit;
  }
}

}  // namespace
}  // namespace slapstick::test
