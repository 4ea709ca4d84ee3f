/// Laws that all quantities obey together, on motions of every kind of contact: energy, momentum, and the laws of
/// contact forces.
#include <gtest/gtest.h>

#include <cmath>

#include "settled.hpp"
#include "slapstick/quantity/cycle_energy.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::test {
namespace {

/// d(T + V)/dt = power_in - power_damping - sum of the powers of contacts, impulses of impacts included.
void expect_energy_balance(const ModelDefinition& definition, const Overrides& values, long periods) {
  const auto all = quantities(definition, values);
  std::vector<Quantity> of;
  for (const Quantity& one : all)
    if (one.kind == Quantity::Kind::power || one.kind == Quantity::Kind::damping || one.kind == Quantity::Kind::input)
      of.push_back(one);
  const System system(definition.build(values));
  const auto energy = [&](const State& state) {  // by what is measured over next to nothing
    const std::vector<Quantity> both = {find_quantity(all, "kinetic_energy"), find_quantity(all, "potential_energy")};
    const Measured now = measure(Motion(system, state), Instant{}.plus(1e-12), both);
    return now.of[0].mean + now.of[1].mean;
  };
  const State start = definition.start(values);
  Motion motion(system, start);
  const Measured found = measure(motion, Instant{periods, 0.0}, of);
  while (motion.advance(Instant{periods, 0.0}) == Outcome::event) {
  }
  double balance = energy(start) - energy(motion.state()), turned_over = 0.0;
  for (std::size_t k = 0; k < of.size(); ++k) {
    const double share = found.of[k].mean * found.duration;
    balance += of[k].kind == Quantity::Kind::input ? share : -share;
    turned_over += found.of[k].rms * found.duration + std::abs(found.of[k].impulse);
  }
  EXPECT_NEAR(balance, 0.0, 1e-9 * turned_over) << definition.name();
}

TEST(Balance, OfEnergyHoldsWithEveryKindOfContact) {
  expect_energy_balance(load_model("vibro-impact"), {{"omega", 4.8}}, 40);
  expect_energy_balance(load_model("vibro-impact"), {{"omega", 0.552}}, 10);
  expect_energy_balance(load_model("two-sided-rattle"), {}, 40);
  expect_energy_balance(load_model("belt"), {}, 40);
  expect_energy_balance(load_model("two-blocks-on-belt"), {}, 40);
  expect_energy_balance(load_model("gear-pair"), {}, 40);
  expect_energy_balance(load_model("falling-friction"), {}, 40);
  expect_energy_balance(load_model("mode-coupling-brake"), {}, 40);
  expect_energy_balance(load_model("pressed-block"), {}, 40);
  expect_energy_balance(load_model("drill-string"), {}, 40);
  expect_energy_balance(load_model("bilinear-oscillator"), {}, 40);
  expect_energy_balance(load_model("shaken-table"), {{"acceleration", 1.9}}, 40);
}

/// What the forces of a cycle add up to is zero: on block 1 spring, dashpot, stop and friction; its forcing has no
/// mean.
TEST(Balance, OfMomentumHoldsOverACycleOfTheTwoBlocks) {
  for (const double omega : {0.552, 1.5, 2.9}) {
    const SettledCycle cycle(load_model("vibro-impact"), {{"omega", omega}});
    const Measured found =
        measure(*cycle.problem, cycle.solution.orbit,
                {cycle.named("F_stop"), cycle.named("F_friction"), cycle.named("x1-x2"), cycle.named("a1"),
                 cycle.named("a2"), cycle.named("power_stop"), cycle.named("w_stop")});
    const double size = found.of[0].rms + found.of[2].rms;
    EXPECT_NEAR(found.of[0].mean + found.of[1].mean + found.of[2].mean, 0.0, 1e-10 * size) << omega;
    EXPECT_NEAR(found.of[3].mean, 0.0, 1e-9 * found.of[3].rms) << omega;
    EXPECT_NEAR(found.of[4].mean, 0.0, 1e-9 * found.of[4].rms) << omega;
    const CycleEnergy energy = cycle_energy(*cycle.problem, cycle.solution.orbit);
    EXPECT_NEAR(found.of[5].impulse, energy.impacts[0], 1e-10) << omega;
  }
}

/// Where stop and friction hold one pair, friction bears what it can and the stop what is beyond: |F_friction| <= f_s,
/// F_stop >= 0.
TEST(Balance, ForcesOfAClosedStopWithFrictionStayWithinTheirLaws) {
  const SettledCycle cycle(load_model("vibro-impact"), {{"omega", 0.552}});
  const Measured found = measure(*cycle.problem, cycle.solution.orbit,
                                 {cycle.named("F_stop"), cycle.named("F_friction"), cycle.named("gap_stop")});
  EXPECT_TRUE(cycle.solution.chatter);
  EXPECT_GE(found.of[0].least, -1e-14);
  EXPECT_GT(found.of[0].greatest, 0.01);
  EXPECT_LE(found.of[1].greatest, 0.15 + 1e-14);
  EXPECT_GE(found.of[1].least, -0.15 - 1e-14);
  EXPECT_GE(found.of[2].least, -1e-14);
}

/// P = (1 + r) m w and E = (1 - r^2) m w^2 / 2 of a ball of mass 1 on the table.
TEST(Balance, ImpulseAndLossOfAnImpactAreNewtons) {
  const SettledCycle cycle(load_model("shaken-table"));
  const Measured found = measure(*cycle.problem, cycle.solution.orbit,
                                 {cycle.named("w"), cycle.named("impulse"), cycle.named("energy_lost")});
  ASSERT_EQ(found.of[0].impulses, 1);
  const double w = found.of[0].mean, r = 0.5;
  EXPECT_NEAR(found.of[1].mean, (1.0 + r) * w, 1e-13 * w);
  EXPECT_NEAR(found.of[2].mean, 0.5 * (1.0 - r * r) * w * w, 1e-13 * w * w);
}

}  // namespace
}  // namespace slapstick::test
