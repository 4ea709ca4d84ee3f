/// Partial slip: some sliders of a joint slip in each cycle, and others never do. Each orbit is one of a family, with
/// derivatives and a branch on which what rests stays where it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "followed.hpp"
#include "orbit/equations.hpp"
#include "orbit/mode_set.hpp"
#include "orbit/orbit_rate.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/orbit/search.hpp"

namespace slapstick::test {
namespace {

/// A unit mass on a spring and a damper, with sliders of one stiffness and rising limits.
struct Joint {
  double spring = 0.6, damping = 0.05, element = 0.1;
  std::vector<double> limits = {0.03, 0.06, 0.09};
  double place = 0.0;                          ///< of the last slider, at the start
  std::vector<std::size_t> order = {0, 1, 2};  ///< in the file

  [[nodiscard]] ModelDefinition definition() const {
    std::string text =
        "name = 'joint'\nomega = 'omega'\n[parameters]\nomega = 0.9\nforce = 0.2\n[[coordinate]]\nname = 'x'\nmass = "
        "1\n"
        "[[spring]]\nbetween = ['x', 'ground']\nstiffness = " +
        std::to_string(spring) + "\n[[damper]]\nbetween = ['x', 'ground']\ncoefficient = " + std::to_string(damping) +
        "\n[[force]]\non = 'x'\namplitude = 'force'\n";
    for (const std::size_t i : order)
      text += "[[jenkins]]\nname = 'e" + std::to_string(i) +
              "'\nbetween = ['x', 'ground']\nstiffness = " + std::to_string(element) +
              "\nlimit = " + std::to_string(limits[i]) + "\n";
    text += "[start]\ns_e" + std::to_string(limits.size() - 1) + " = " + std::to_string(place) + "\n";
    return ModelDefinition::parse(text, "joint.toml");
  }
  /// .. while all rest: of a linear oscillator.
  [[nodiscard]] std::complex<double> response(double omega, double force) const {
    const double stiffness = spring + element * static_cast<double>(limits.size());
    return force / std::complex(stiffness - omega * omega, damping * omega);
  }
};

/// Of two sliders one slips and the other never does: its row of the equations is zero, which no estimate of a
/// condition may miss. The orbit is one of a family, with the multipliers that classify finds.
TEST(PartialSlip, HasAnOrbitOfAFamily) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 1.9\n[[coordinate]]\nname = 'x'\nmass = 1\n"
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 0.8\n[[damper]]\nbetween = ['x', 'ground']\ncoefficient = "
      "0.1\n"
      "[[jenkins]]\nname = 'slips'\nbetween = ['ground', 'x']\nstiffness = 1.1\nlimit = 0.07\n"
      "[[jenkins]]\nname = 'rests'\nbetween = ['x', 'ground']\nstiffness = 0.34\nlimit = 0.2\n"
      "[[force]]\non = 'x'\namplitude = 0.55\n",
      "f.toml");
  const System system(definition.build());
  const auto problem = orbit::pose(definition.family({}), {});
  const orbit::Settled settled = orbit::settle(*problem, system, definition.start());
  const Classification found = classify(system, definition.start());
  ASSERT_TRUE(settled.orbit);
  EXPECT_EQ(settled.orbit->label, found.label);
  EXPECT_EQ(found.family, 1);
  EXPECT_EQ(settled.orbit->family, 1);
  ASSERT_EQ(settled.orbit->multipliers.size(), found.multipliers.size());
  for (std::size_t i = 0; i < found.multipliers.size(); ++i)
    EXPECT_LT(std::abs(settled.orbit->multipliers[i] - found.multipliers[i]), 1e-8) << i;
}

/// The slider stays where it rests as a parameter moves: so do motions that start with it there.
TEST(PartialSlip, HasTheDerivativesOfMotionsWithTheSliderWhereItRests) {
  const Joint joint{.place = 0.05};
  const ModelDefinition definition = joint.definition();
  const double omega = 0.76, force = 0.2;
  const auto here = settled(definition, {{"omega", omega}});
  ASSERT_TRUE(here);
  ASSERT_EQ(here->family, 1);
  const Family family = definition.family({"omega", "force"});
  const auto problem = orbit::pose(family, {omega, force});
  orbit::Orbit orbit = here->orbit;
  orbit.values = {omega, force};
  const auto rates = orbit::orbit_rates(*problem, orbit::ModeSet(family, orbit.values), orbit);
  const State start = orbit::at_phase_zero(*problem, orbit);  // from here what rests is not moved on the way
  constexpr double h = 1e-5;
  const std::array steps = {Overrides{{"omega", omega + h}}, Overrides{{"omega", omega - h}},
                            Overrides{{"omega", omega}, {"force", force + h}},
                            Overrides{{"omega", omega}, {"force", force - h}}};
  for (std::size_t j = 0; j < 2; ++j) {
    const auto more = settled(definition, steps[2 * j], start), less = settled(definition, steps[2 * j + 1], start);
    ASSERT_TRUE(more && less);
    ASSERT_EQ(more->orbit.shape.legs, orbit.shape.legs);
    ASSERT_EQ(less->orbit.shape.legs, orbit.shape.legs);
    for (std::size_t i = 0; i < orbit.legs(); ++i) {
      const Eigen::VectorXd by = (more->orbit.x[i] - less->orbit.x[i]) / (2.0 * h);
      EXPECT_LT(problem->translations().numbers(rates[j].x[i] - by).cwiseAbs().maxCoeff(), 1e-6) << j << " leg " << i;
      EXPECT_NEAR(rates[j].t[i], (more->orbit.t[i] - less->orbit.t[i]) / (2.0 * h), 1e-7) << j << " event " << i;
    }
  }
}

/// From where all slip, up to where none does and down to where one does, whichever stands first in the file: the
/// displacement at each change is that at which the force of a slider comes to its limit.
TEST(PartialSlip, IsFollowedFromWhereAllSlipToWhereNoneDoes) {
  for (const auto& order : {std::vector<std::size_t>{0, 1, 2}, {2, 1, 0}, {1, 0, 2}}) {
    const Joint joint{.order = order};
    const ModelDefinition definition = joint.definition();
    const auto first = settled(definition, {});
    ASSERT_TRUE(first);
    ASSERT_EQ(first->family, 0);
    const auto problem = orbit::pose(definition.family({"omega"}), {0.9});
    orbit::Orbit start = first->orbit;
    start.values = {0.9};
    const orbit::Branch branch = orbit::follow(*problem, start, {.from = 0.7, .to = 1.3, .longest_step = 0.05});
    EXPECT_FALSE(branch.failed()) << orbit::ended(branch);
    const std::array<std::size_t, 5> who = {1, 2, 2, 1, 0};
    ASSERT_EQ(branch.special.size(), who.size()) << order[0];
    for (std::size_t k = 0; k < who.size(); ++k) {
      const orbit::SpecialPoint& change = branch.special[k];
      EXPECT_EQ(change.type, orbit::SpecialType::GR);
      EXPECT_EQ(change.passage, orbit::Passage::family) << k;
      const auto at = orbit::ranges(*orbit::pose(definition.family({"omega"}), {change.value}), change.solution.orbit);
      EXPECT_NEAR(at[0].most, joint.limits[who[k]] / joint.element, 1e-12) << k;
    }
    EXPECT_NEAR(std::abs(joint.response(branch.special.back().value, 0.2)), joint.limits[0] / joint.element, 1e-13);
    for (const orbit::Solution& point : branch.points) {
      const double omega = point.orbit.parameter();
      int rest = 0;
      for (std::size_t k = 0; k < who.size(); ++k) rest += (omega < branch.special[k].value) == (k < 2) ? 1 : 0;
      EXPECT_EQ(point.family, rest) << omega;
      EXPECT_TRUE(point.stable()) << omega;
    }
    EXPECT_EQ(branch.points.back().family, 3);
  }
}

/// Two sliders that are alike cease to slip together, and rest both.
TEST(PartialSlip, OfTwoEqualSlidersIsEntered) {
  const orbit::Branch rest =
      followed(Joint{.limits = {0.05, 0.05}, .order = {0, 1}}.definition(), "omega", 0.9, 0.8, 1.3);
  EXPECT_FALSE(rest.failed()) << orbit::ended(rest);
  EXPECT_EQ(rest.points.back().family, 2);  // beyond, both rest
}

/// A slider that rests away from the middle comes to its limit on one side first: beyond, it is drawn along, and the
/// orbits there rest elsewhere.
TEST(PartialSlip, EndsWhereASliderIsDrawnAlong) {
  for (const double damping : {0.05, 0.3}) {
    const Joint joint{.damping = damping, .limits = {0.08}, .place = damping < 0.1 ? 0.3 : 0.6, .order = {0}};
    const ModelDefinition definition = joint.definition();
    const auto first = settled(definition, {{"omega", 1.4}});
    ASSERT_TRUE(first);
    ASSERT_EQ(first->family, 1);
    const auto problem = orbit::pose(definition.family({"omega"}), {1.4});
    orbit::Orbit start = first->orbit;
    start.values = {1.4};
    const orbit::Branch branch = orbit::follow(*problem, start, {.from = 0.9, .to = 1.6});
    EXPECT_FALSE(branch.failed()) << orbit::ended(branch);
    ASSERT_EQ(branch.special.size(), 1U);
    const orbit::SpecialPoint& limit = branch.special[0];
    EXPECT_EQ(limit.passage, orbit::Passage::family);
    // The mean is k s / (K + k): s less the mean is the middle of the slider's force.
    const double off = joint.place * joint.spring / (joint.spring + joint.element);
    EXPECT_NEAR(std::abs(joint.response(limit.value, 0.2)) + off, joint.limits[0] / joint.element, 1e-13);
    EXPECT_EQ(branch.up.kind, orbit::BranchEnd::Kind::range);
  }
}

/// A body that friction holds all along keeps its place, beside another one that strikes a stop.
TEST(PartialSlip, ABodyThatIsHeldHasDerivatives) {
  const ModelDefinition definition = ModelDefinition::parse(
      "name = 'm'\nomega = 0.9\n[parameters]\nforce = 0.5\n[[coordinate]]\nname = 'x1'\nmass = 1\n"
      "[[coordinate]]\nname = 'x2'\nmass = 2\n[[spring]]\nbetween = ['x1', 'ground']\nstiffness = 0.6\n"
      "[[spring]]\nbetween = ['x1', 'x2']\nstiffness = 0.3\n[[damper]]\nbetween = ['x1', 'ground']\n"
      "coefficient = 0.1\n[[stop]]\nname = 'wall'\nbetween = ['x1', 'ground']\nclearance = 0.4\nrestitution = 0.6\n"
      "[[friction]]\nname = 'pad'\nbetween = ['x2', 'ground']\nkinetic = 0.5\nstatic = 0.5\n"
      "[[force]]\non = 'x1'\namplitude = 'force'\n[start]\nx2 = 0.2\n",
      "held.toml");
  constexpr double h = 1e-6;
  const auto here = settled(definition, {}), more = settled(definition, {{"force", 0.5 + h}}),
             less = settled(definition, {{"force", 0.5 - h}});
  ASSERT_TRUE(here && more && less);
  ASSERT_EQ(here->family, 1);
  const Family family = definition.family({"force"});
  const auto problem = orbit::pose(family, {0.5});
  orbit::Orbit orbit = here->orbit;
  orbit.values = {0.5};
  const auto rates = orbit::orbit_rates(*problem, orbit::ModeSet(family, orbit.values), orbit);
  for (std::size_t i = 0; i < orbit.legs(); ++i)
    EXPECT_LT((rates[0].x[i] - (more->orbit.x[i] - less->orbit.x[i]) / (2.0 * h)).cwiseAbs().maxCoeff(), 1e-6) << i;
}

/// Where a slider ceases to slip, over two parameters: against the closed form where no other one slips, and by the
/// largest displacement where others do.
TEST(PartialSlip, BordersAreFollowedInTwoParameters) {
  const Joint joint;
  const ModelDefinition definition = joint.definition();
  const orbit::Branch branch = followed(definition, "omega", 0.9, 0.75, 1.3);
  ASSERT_EQ(branch.special.size(), 4U);
  const Family family = definition.family({"omega", "force"});
  for (const std::size_t which : {std::size_t{3}, std::size_t{1}}) {
    orbit::SpecialPoint point = branch.special[which];
    point.solution.orbit.values = {point.value, 0.2};
    const auto problem = orbit::pose(family, point.solution.orbit.values);
    const orbit::Curve curve = orbit::locus(
        *problem, point, {.from = 0.6, .to = 1.5, .second_from = 0.1, .second_to = 0.4, .longest_step = 0.05});
    EXPECT_FALSE(curve.failed()) << which;
    EXPECT_GT(curve.points.size(), 15U);
    const double amplitude = joint.limits[which == 3 ? 0 : 2] / joint.element;
    for (const orbit::CurvePoint& there : curve.points) {
      EXPECT_TRUE(there.solution.is_motion);
      EXPECT_NEAR(orbit::ranges(*problem, there.solution.orbit)[0].most, amplitude, 1e-12);
      const double known = which == 3 ? std::abs(joint.response(there.values[0], there.values[1])) : amplitude;
      EXPECT_NEAR(known, amplitude, 1e-12);
    }
  }
}

/// Without damping each amplitude is an orbit, and nothing rests: there is no branch.
TEST(PartialSlip, IsNotWhatMakesAConservativeFamily) {
  const ModelDefinition definition = ModelDefinition::parse(
      "name = 'm'\nomega = 1\n[parameters]\nk = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n"
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 'k'\n"
      "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.5\nrestitution = 1\n[start]\nv = 1\n",
      "free.toml");
  const auto first = settled(definition, {});
  ASSERT_TRUE(first);
  ASSERT_GT(first->family, 0);
  const auto problem = orbit::pose(definition.family({"k"}), {1.0});
  orbit::Orbit start = first->orbit;
  start.values = {1.0};
  EXPECT_THROW(static_cast<void>(orbit::follow(*problem, start, {.from = 0.9, .to = 1.1})), NumericalError);
}

/// At rest there is no velocity to go by but rounding. A body that friction holds is one of a family of one dimension,
/// whatever else settles beside it.
TEST(PartialSlip, OfAMachineAtRestIsAFamilyOfWhatIsHeldAlone) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 3\n[[coordinate]]\nname = 'x1'\nmass = 1.7\n[[coordinate]]\nname = 'x2'\nmass = 1\n"
      "[[force]]\non = 'x1'\namplitude = -0.7\nharmonic = 0\n"
      "[[spring]]\nbetween = ['x1', 'ground']\nstiffness = 0.41\n[[spring]]\nbetween = ['x2', 'ground']\nstiffness = "
      "0.2\n[[friction]]\nname = 'pad'\nbetween = ['x2', 'ground']\nstatic = 1\nkinetic = 1\nnormal_force = { "
      "constant = 1 }\n[[force]]\non = 'pad'\namplitude = -0.1\nharmonic = 2\n[[damper]]\nbetween = ['x1', "
      "'x2']\ncoefficient = "
      "0.3\n[start]\nx1 = -0.4\nv1 = -0.4\nx2 = -0.5\nv2 = -0.4\n",
      "m.toml");
  const auto found = settled(definition, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->family, 1);
  EXPECT_EQ(classify(System(definition.build()), definition.start()).family, 1);
}

/// A body that friction holds, and another one that has come to rest beside it: their states are rounding apart.
TEST(PartialSlip, OfAMachineThatAForceDoesNotMoveIsFound) {
  const auto definition = ModelDefinition::parse(
      "name = 'm'\nomega = 1.4\n[[coordinate]]\nname = 'x1'\nmass = 1.85\n[[coordinate]]\nname = 'x2'\nmass = 1.5\n"
      "[[force]]\non = 'x2'\namplitude = -0.2\nharmonic = 0\n[[force]]\non = 'x1'\namplitude = 0.1\n"
      "[[spring]]\nbetween = ['x1', 'ground']\nstiffness = 1.575\n[[spring]]\nbetween = ['x2', 'x1']\nstiffness = 1\n"
      "[[damper]]\nbetween = ['x2', 'x1']\ncoefficient = 0.14\n"
      "[[friction]]\nname = 'pad'\nbetween = ['x1', 'ground']\nstatic = 0.5\n[start]\nv1 = 1\n",
      "m.toml");
  const auto found = settled(definition, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->family, 1);
}

}  // namespace
}  // namespace slapstick::test
