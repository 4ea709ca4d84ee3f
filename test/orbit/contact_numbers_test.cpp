/// Several contacts on one pair of bodies: a belt and a stop, whose numbers move with different speeds while the belt
/// holds the pair, and two stops of which a parameter makes one and then the other the nearest.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "families.hpp"
#include "orbit/mode_set.hpp"
#include "orbit/orbit_rate.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/orbit/search.hpp"
#include "slapstick/quantity/cycle_energy.hpp"

namespace slapstick::test {
namespace {

/// A unit mass on a unit spring sticks from x = 2 f_k - f_s to f_s, and slips about f_k for the rest of a turn.
double stick_slip_period(double V, double f_s, double f_k) {
  const double fall = f_s - f_k;
  return 2.0 * std::numbers::pi - 2.0 * std::atan(fall / V) + 2.0 * fall / V;
}

/// Near or far, a wall that is never reached changes neither the cycle nor how it moves with the parameters.
TEST(BeltAndStop, AWallThatIsNeverReachedLeavesThePeriodOfStickSlip) {
  for (const double wall : {1.3, 5.0, 1e3, 1e6, 1e9}) {
    const double V = 0.5, f_s = 1.0, f_k = 0.5, h = 1e-5;
    const Posed posed(SLAPSTICK_ORBIT_MODELS "belt-and-wall.toml", {}, {"wall", "belt_speed", "static", "kinetic"},
                      {wall, V, f_s, f_k});
    const auto solution = posed.settled();
    ASSERT_TRUE(solution) << wall;
    EXPECT_TRUE(solution->is_motion);
    constexpr double ten_bits =
        0x1p10;  // that a wall may cost before the pair is numbered without one (mode/numbering.cpp)
    EXPECT_NEAR(solution->cycle, stick_slip_period(V, f_s, f_k), 4.0 * ten_bits * 0x1p-53) << wall;
    ASSERT_EQ(solution->multipliers.size(), 1U);
    EXPECT_EQ(std::abs(solution->multipliers[0]), 0.0);  // stick forgets all, exactly
    const orbit::ModeSet set(posed.family, solution->orbit.values);
    const auto rates = orbit::orbit_rates(*posed.problem, set, solution->orbit);
    const auto by = [&](auto moved) { return (moved(h) - moved(-h)) / (2.0 * h); };
    const double expected[] = {0.0, by([&](double e) { return stick_slip_period(V + e, f_s, f_k); }),
                               by([&](double e) { return stick_slip_period(V, f_s + e, f_k); }),
                               by([&](double e) { return stick_slip_period(V, f_s, f_k + e); })};
    for (std::size_t j = 0; j < rates.size(); ++j)
      EXPECT_NEAR(rates[j].t.back() - rates[j].t.front(), expected[j], 1e-8) << wall << " by parameter " << j;
  }
}

/// The cycle that the motion settles on has an orbit, with an impact and with a reversal.
TEST(BeltAndStop, TheCycleThatHitsTheStopHasAnOrbit) {
  const Posed posed(SLAPSTICK_ORBIT_MODELS "belt-and-pad.toml", {}, {}, {});
  const auto solution = posed.settled();
  ASSERT_TRUE(solution);
  EXPECT_EQ(solution->label, "1-1-II");
  EXPECT_TRUE(solution->is_motion);
  const CycleEnergy energy = cycle_energy(*posed.problem, solution->orbit);
  EXPECT_LT(std::abs(energy.balance()), 1e-12 * energy.impacts.at(0));
}

/// On the branch the upper stop is nearest first, then the lower one. Behind the change it has the orbit that a motion
/// settles on there.
TEST(TwoStops, ABranchGoesOnWhereTheOtherOneBecomesTheNearest) {
  const auto posed_at = [](double lower) {
    return std::make_unique<Posed>("two-sided-rattle", Overrides{{"omega", 1.5}},
                                   std::vector<std::string>{"clearance_lower"}, std::vector<double>{lower});
  };
  const auto before = posed_at(0.52), behind = posed_at(0.48);
  const auto first = before->settled();
  ASSERT_TRUE(first);
  const orbit::Branch branch = orbit::follow(*before->problem, first->orbit, {.from = 0.48, .to = 0.52});
  const auto expected = behind->settled();
  ASSERT_TRUE(expected);
  ASSERT_FALSE(branch.points.empty());
  const orbit::Solution& there = branch.points.front();
  EXPECT_EQ(there.orbit.parameter(), 0.48) << orbit::ended(branch);
  EXPECT_TRUE(there.is_motion);
  EXPECT_EQ(there.label, expected->label);
  ASSERT_EQ(there.multipliers.size(), expected->multipliers.size());
  for (std::size_t i = 0; i < expected->multipliers.size(); ++i)
    EXPECT_NEAR(std::abs(there.multipliers[i] - expected->multipliers[i]), 0.0, 1e-9);
}

/// A pad between two masses that slips and sticks: a contact that rests has its cycle named so, also where its number
/// depends on those of the masses' own pads, as a loop of contacts makes it.
TEST(LoopOfContacts, APadThatRestsIsNamedWhateverTheOrder) {
  const std::string head =
      "name = 'm'\nomega = 1.3\n[[coordinate]]\nname = 'x1'\nmass = 1\n[[coordinate]]\nname = 'x2'\nmass = 0.5\n"
      "[[spring]]\nbetween = ['x1', 'ground']\nstiffness = 1\n[[damper]]\nbetween = ['x2', 'ground']\ncoefficient = "
      "0.4\n"
      "[[force]]\non = 'x1'\namplitude = 2\n";
  const std::vector<std::string> pads{
      "[[friction]]\nname = 'one'\nbetween = ['x1', 'ground']\nkinetic = 0.1\nstatic = 0.1\n",
      "[[friction]]\nname = 'two'\nbetween = ['x2', 'ground']\nbelt_speed = 9\nkinetic = 0.2\nstatic = 0.2\n",
      "[[friction]]\nname = 'between'\nbetween = ['x1', 'x2']\nkinetic = 0.8\nstatic = 0.8\n"};
  for (const auto& order : {std::vector{0, 1, 2}, std::vector{2, 0, 1}, std::vector{0, 2, 1}}) {
    std::string text = head;
    for (const int k : order) text += pads[static_cast<std::size_t>(k)];
    const auto definition = ModelDefinition::parse(text, "loop.toml");
    const System system(definition.build());
    const auto problem = orbit::pose(definition.family({}), {});
    const orbit::Settled settled = orbit::settle(*problem, system, definition.start(), {.transient = 100});
    ASSERT_TRUE(settled.orbit) << order[0];
    EXPECT_EQ(settled.orbit->label, "1-0-II") << order[0];
    EXPECT_EQ(classify(system, definition.start(), {.transient_periods = 100}).label, "1-0-II") << order[0];
  }
}

/// A body that rests while a belt on the other body slips: its velocity is a sum of numbers, which the orbit's
/// equations must hold, or there is a multiplier 1 too many.
TEST(LoopOfContacts, ABodyThatRestsBesideABeltHasAnOrbit) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 3.7\n[[coordinate]]\nname = 'x1'\nmass = 2.8\n[[coordinate]]\nname = 'x2'\nmass = 2\n"
      "[[spring]]\nbetween = ['x1', 'ground']\nstiffness = 1.7\n[[spring]]\nbetween = ['x2', 'x1']\nstiffness = 1.9\n"
      "[[damper]]\nbetween = ['x1', 'ground']\ncoefficient = 0.5\n[[force]]\non = 'x1'\namplitude = 0.97\n"
      "[[friction]]\nname = 'belt'\nbetween = ['x1', 'x2']\nkinetic = 0.1\nstatic = 0.3\nbelt_speed = 0.0447\n"
      "[[friction]]\nname = 'foot'\nbetween = ['ground', 'x2']\nkinetic = 1\nstatic = 1.1\n"
      "[[stop]]\nname = 'wall'\nbetween = ['ground', 'x1']\nclearance = 0.2\nrestitution = 0.5\n",
      "loop.toml");
  const System system(definition.build());
  const auto problem = orbit::pose(definition.family({}), {});
  const orbit::Settled settled = orbit::settle(*problem, system, definition.start());
  ASSERT_TRUE(settled.orbit);
  const Classification found = classify(system, definition.start());
  EXPECT_EQ(settled.orbit->label, found.label);
  EXPECT_EQ(settled.orbit->family, found.family);
  ASSERT_EQ(settled.orbit->multipliers.size(), found.multipliers.size());
  for (std::size_t i = 0; i < found.multipliers.size(); ++i)
    EXPECT_LT(std::abs(settled.orbit->multipliers[i] - found.multipliers[i]), 1e-8) << i;
}

}  // namespace
}  // namespace slapstick::test
