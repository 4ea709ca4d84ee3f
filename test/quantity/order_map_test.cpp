/// Lines over a run-up: against the stationary spectra of slow ones, and against a closed form.
#include "slapstick/quantity/order_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "settled.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/spectrum.hpp"

namespace slapstick::test {
namespace {

RunUp climb(const ModelDefinition& definition, const RunUpOptions& options) {
  return {[&definition](double omega) { return definition.build({{"omega", omega}}); }, options, definition.start()};
}

/// After a long hold each value has the lines of the cycle that the motion settles on there; impulses included.
TEST(OrderMap, OfASlowRunUpAreTheStationarySpectra) {
  const ModelDefinition definition = load_model("vibro-impact");
  const Quantity of = find_quantity(quantities(definition), "a1");
  RunUp run = climb(definition, {2.2, 2.4, 3, 600});
  const OrderMap map = order_map(run, of, {6.0, 596, nullptr, {}});
  ASSERT_EQ(map.value.size(), 3U);
  ASSERT_EQ(map.order.size(), 25U);
  for (std::size_t i = 0; i < map.value.size(); ++i) {
    const SettledCycle cycle(definition, {{"omega", map.value[i]}});
    const LineSpectrum lines = spectrum(*cycle.problem, cycle.solution.orbit, cycle.named("a1"), 6.0);
    for (std::size_t k = 0; k < map.order.size(); ++k) {
      const bool own = k % 4 == 0;  // the cycle has one period
      const double expected = own ? lines.lines[k / 4].amplitude() : 0.0;
      EXPECT_NEAR(map.amplitude[i * map.order.size() + k], expected, 2e-8) << map.value[i] << " " << map.order[k];
    }
  }
}

/// x'' + 2 zeta x' + x = cos(omega t): after the transient 1 / |1 - omega^2 + 2 i zeta omega|.
TEST(OrderMap, OfALinearOscillatorIsItsResonanceCurve) {
  const ModelDefinition definition = load_model("impact-oscillator");
  RunUp run({[&definition](double omega) {
              return definition.build({{"omega", omega}, {"clearance", 1e6}});
            }},
            {0.5, 1.5, 5, 80}, {0.0, 0.0});
  const OrderMap map = order_map(run, find_quantity(quantities(definition), "x"), {2.0, 70, nullptr, {}});
  for (std::size_t i = 0; i < 5; ++i) {
    const double omega = map.value[i], expected = 1.0 / std::hypot(1.0 - omega * omega, 0.2 * omega);
    EXPECT_NEAR(map.amplitude[i * map.order.size() + 10], expected, 1e-7) << omega;
    EXPECT_NEAR(map.amplitude[i * map.order.size() + 5], 0.0, 1e-7) << omega;
  }
  EXPECT_NEAR(map.time[1], 80.0 * map.period[0], 1e-9);
}

TEST(OrderMap, WishesThatHaveNoMeaningAreRefused) {
  const ModelDefinition definition = load_model("vibro-impact");
  const auto all = quantities(definition);
  RunUp run = climb(definition, {2.0, 3.0, 2, 4});
  EXPECT_THROW((void)order_map(run, find_quantity(all, "w"), {}), InputError);
  EXPECT_THROW((void)order_map(run, find_quantity(all, "a1"), {20.0, 4, nullptr, {}}), InputError);
  EXPECT_THROW((void)order_map(run, find_quantity(all, "a1"), {0.0, 0, nullptr, {}}), InputError);
}

}  // namespace
}  // namespace slapstick::test
