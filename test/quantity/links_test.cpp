/// Forces of named springs and dampers, on the ground, between masses and on a base that moves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "settled.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/quantity/span.hpp"

namespace slapstick::test {
namespace {

/// A mass on a named spring and damper that stand on a base y = Y sin(omega t), or on the ground with a force.
constexpr const char* on_base = R"(
name = "mount"
omega = 1.7
[parameters]
k = 4
c = 0.3
[[coordinate]]
name = "x"
mass = 2
[[base]]
name = "floor"
harmonics = [{ amplitude = 0.1 }]
[[spring]]
name = "coil"
between = ["x", "floor"]
stiffness = "k"
[[damper]]
name = "oil"
between = ["floor", "x"]
coefficient = "c"
)";

Measured of(const SettledCycle& cycle, const std::vector<std::string>& names) {
  std::vector<Quantity> wanted;
  for (const std::string& name : names) wanted.push_back(cycle.named(name));
  return measure(*cycle.problem, cycle.solution.orbit, wanted);
}

/// H = (k + i c omega) / (k - m omega^2 + i c omega): spring and damper carry k |x - y| and c omega |x - y|.
TEST(Links, OnABaseThatMovesCarryWhatTheTransferFunctionSays) {
  const SettledCycle cycle(ModelDefinition::parse(on_base, "mount"));
  const double k = 4.0, c = 0.3, m = 2.0, omega = 1.7, Y = 0.1;
  const double relative = Y * m * omega * omega / std::hypot(k - m * omega * omega, c * omega);
  const Measured found = of(cycle, {"F_coil", "F_oil", "power_oil", "power_damping", "w_oil"});
  EXPECT_NEAR(found.of[0].greatest, k * relative, 1e-11);
  EXPECT_NEAR(found.of[1].greatest, c * omega * relative, 1e-11);
  EXPECT_NEAR(found.of[2].mean, 0.5 * c * omega * omega * relative * relative, 1e-12);
  EXPECT_NEAR(found.of[4].greatest, omega * relative, 1e-11);
}

/// m a = -F_coil + F_oil: the damper's pair runs from the floor to the mass.
TEST(Links, TogetherAreTheForceOnTheMass) {
  const ModelDefinition definition = ModelDefinition::parse(on_base, "mount");
  const SettledCycle cycle(definition);
  const Measured found = of(cycle, {"a", "F_coil-F_oil"});
  EXPECT_NEAR(2.0 * found.of[0].greatest, found.of[1].greatest, 1e-11);
  EXPECT_NEAR(2.0 * found.of[0].rms, found.of[1].rms, 1e-11);
  const Measured rate =
      measure_rates(definition, {}, {"k"}, cycle.solution.orbit, {cycle.named("a"), cycle.named("F_coil-F_oil")})
          .front();
  EXPECT_NEAR(2.0 * rate.of[0].rms, rate.of[1].rms, 1e-11);
}

TEST(Links, ANameOfTwoPartsIsRefused) {
  std::string text = on_base;
  text.replace(text.find("\"oil\""), 5, "\"coil\"");
  EXPECT_THROW((void)ModelDefinition::parse(text, "mount"), InputError);
  text = on_base;
  text.replace(text.find("oil\""), 4, "o i l\"");
  EXPECT_THROW((void)ModelDefinition::parse(text, "mount"), InputError);
}

TEST(Links, WithoutANameHaveNoQuantities) {
  for (const Quantity& one : quantities(load_model("vibro-impact")))
    EXPECT_EQ(one.name.find("spring"), std::string::npos) << one.name;
  const auto all = quantities(ModelDefinition::parse(on_base, "mount"));
  EXPECT_THROW((void)find_quantity(all, "w_coil"), std::exception);  // the base's velocity is no number of the state
}

}  // namespace
}  // namespace slapstick::test
