/// Derivatives of a cycle's statistics: against closed forms, and against differences of `measure`.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "settled.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/span.hpp"

namespace slapstick::test {
namespace {

/// x'' + 2 zeta x' + x = cos(omega t): A = ((1 - omega^2)^2 + (2 zeta omega)^2)^(-1/2) and its lag, differentiated.
TEST(Rates, OfALinearOscillatorAreThoseOfItsAmplitude) {
  const double omega = 1.3, zeta = 0.1;
  const ModelDefinition model = load_model("impact-oscillator");
  const Overrides values = {{"clearance", 100.0}, {"omega", omega}};
  const SettledCycle cycle(model, values);
  const std::vector<Quantity> of = {cycle.named("x"), cycle.named("kinetic_energy"), cycle.named("power_in")};
  const Measured found = measure(*cycle.problem, cycle.solution.orbit, of);
  const Measured rate = measure_rates(model, values, {"omega"}, cycle.solution.orbit, of).front();
  const double stiff = 1.0 - omega * omega, lossy = 2.0 * zeta * omega, A = 1.0 / std::hypot(stiff, lossy);
  const double A_rate = A * A * A * (2.0 * omega * stiff - 4.0 * zeta * zeta * omega);
  EXPECT_NEAR(rate.duration, -2.0 * std::numbers::pi / (omega * omega), 1e-13);
  EXPECT_NEAR(rate.of[0].rms, A_rate / std::numbers::sqrt2, 1e-11);
  EXPECT_NEAR(rate.of[0].greatest, A_rate, 1e-11);
  EXPECT_NEAR(rate.of[0].least, -A_rate, 1e-11);
  EXPECT_NEAR(rate.of[0].mean, 0.0, 1e-11);
  EXPECT_NEAR(statistic_rate(found.of[0], rate.of[0], "crest"), 0.0, 1e-10);
  EXPECT_NEAR(statistic_rate(found.of[0], rate.of[0], "peak_to_peak"), 2.0 * A_rate, 1e-11);
  EXPECT_NEAR(rate.of[1].mean, 0.5 * A * omega * (A_rate * omega + A), 1e-11);
  EXPECT_NEAR(rate.of[2].mean, 2.0 * zeta * A * omega * (A_rate * omega + A), 1e-11);
  const double lag = std::atan2(lossy, stiff), lag_rate = (2.0 * zeta * stiff + 2.0 * omega * lossy) * A * A;
  const auto expect_harmonic = [&](const char* name, double value, double by) {
    EXPECT_NEAR(statistic(found.of[0], name), value, 1e-13) << name;
    EXPECT_NEAR(statistic_rate(found.of[0], rate.of[0], name), by, 1e-11) << name;
  };
  expect_harmonic("h1", A, A_rate);
  expect_harmonic("h1:phase", -lag, -lag_rate);
  EXPECT_NEAR(statistic(found.of[0], "h2"), 0.0, 1e-13);
  EXPECT_NEAR(rate.of[0].greatest_at, (lag_rate * omega - lag) / (omega * omega), 1e-9);
}

/// A ball that is thrown up once in a period T of the table: w = gravity T / (1 + r).
TEST(Rates, OfABounceAreThoseOfItsSpeed) {
  const ModelDefinition model = load_model("shaken-table");
  const double r = 0.5, w = 2.0 * std::numbers::pi / (1.0 + r);
  const SettledCycle cycle(model);
  const std::vector<Quantity> of = {cycle.named("w"), cycle.named("impulse"), cycle.named("energy_lost"),
                                    cycle.named("flight"), cycle.named("F_table")};
  const auto rates = measure_rates(model, {}, {"restitution", "gravity", "omega"}, cycle.solution.orbit, of);
  EXPECT_NEAR(rates[0].of[0].mean, -w / (1.0 + r), 1e-11);
  EXPECT_NEAR(rates[0].of[1].mean, 0.0, 1e-11);     // the impulse is the weight times the period
  EXPECT_NEAR(rates[0].of[2].mean, -w * w, 1e-10);  // of (1 - r) / (1 + r) (gravity T)^2 / 2
  EXPECT_NEAR(rates[0].of[3].mean, 0.0, 1e-12);
  EXPECT_NEAR(rates[1].of[0].mean, w, 1e-11);
  EXPECT_NEAR(rates[1].of[4].mean, 1.0, 1e-11);  // the mean force bears the weight
  EXPECT_NEAR(rates[2].of[0].mean, -w, 1e-11);
  EXPECT_NEAR(rates[2].stops[0].w.rms, -w, 1e-11);
  EXPECT_EQ(rates[2].of[0].values.size(), 1u);
}

/// A statistic at a parameter beside the orbit's, by Newton's method from it.
Measured beside(const ModelDefinition& model, const Overrides& values, const std::string& name, double by,
                orbit::Orbit orbit, const std::vector<Quantity>& of) {
  orbit.values = {model.present_value(name, values)};
  const auto problem = orbit::pose(model.family({name}, values), orbit.values);
  orbit.parameter() += by;
  const auto found = orbit::refine(*problem, orbit);
  if (!found) throw std::runtime_error(name + ": no orbit beside");
  return measure(*problem, *found, of);
}

/// The usual ones, and the harmonics that are there: of none the phase is rounding.
std::vector<std::string> with_harmonics(const Quantity& quantity, const Statistics& here) {
  std::vector<std::string> all = usual_statistics(quantity);
  for (const char* name : {"h1", "h2", "h3"}) {
    if (quantity.at_impacts() || !(statistic(here, name) > 1e-6 * here.rms)) continue;
    all.emplace_back(name);
    all.emplace_back(name + std::string(":phase"));
  }
  return all;
}

/// Differences over h and 2h: exact to the fourth order, apart from what is left of Newton's method over h.
void expect_differences(const std::string& name, const Overrides& values, const std::vector<std::string>& parameters) {
  const ModelDefinition model = load_model(name);
  const SettledCycle cycle(model, values);
  std::vector<Quantity> of;
  for (const Quantity& one : cycle.all)
    if (one.kind != Quantity::Kind::parameter &&
        (cycle.solution.drift.empty() || one.kind != Quantity::Kind::displacement))
      of.push_back(one);
  const Measured here = measure(*cycle.problem, cycle.solution.orbit, of);
  const auto rates = measure_rates(model, values, parameters, cycle.solution.orbit, of);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double value = model.present_value(parameters[j], values), h = 1e-5 * (value != 0.0 ? std::abs(value) : 1.0);
    const auto at = [&](int k) { return beside(model, values, parameters[j], k * h, cycle.solution.orbit, of); };
    const Measured below2 = at(-2), below = at(-1), above = at(1), above2 = at(2);
    const auto compare = [&](const std::string& what, const auto& of_one, double found, double scale) {
      const double expected = (8.0 * (of_one(above) - of_one(below)) - (of_one(above2) - of_one(below2))) / (12.0 * h);
      if (std::isnan(expected) && std::isnan(found)) return;
      EXPECT_NEAR(found, expected, 1e-6 * std::abs(expected) + 3e-12 * scale / h)
          << name << " " << what << " by " << parameters[j];
    };
    compare(
        "time", [](const Measured& m) { return m.duration; }, rates[j].duration, here.duration);
    for (std::size_t k = 0; k < of.size(); ++k)
      for (const std::string& statistic_name : with_harmonics(of[k], here.of[k])) {
        double scale = of[k].at_impacts() || statistic_name != "crest" ? std::abs(here.of[k].rms) : here.of[k].crest();
        if (statistic_name.ends_with(":phase"))
          scale = 1.0 + scale / statistic(here.of[k], statistic_name.substr(0, 2));
        if (statistic_name == "min_at" || statistic_name == "max_at") continue;  // equal extremes take turns
        if (!(here.of[k].rms > 1e-9) && statistic_name == "crest") continue;     // rounding over rounding
        compare(
            of[k].name + ":" + statistic_name, [&](const Measured& m) { return statistic(m.of[k], statistic_name); },
            statistic_rate(here.of[k], rates[j].of[k], statistic_name),
            std::isnan(scale) ? 1e-6 : std::max(scale, 1e-6));
      }
  }
}

TEST(Rates, AgreeWithDifferencesOfImpactsAndFriction) {
  expect_differences("vibro-impact", {{"omega", 2.6}},
                     {"omega", "friction", "restitution", "clearance", "mass_ratio", "damping_ratio"});
}

TEST(Rates, AgreeWithDifferencesThroughStickAndCompleteChatter) {
  expect_differences("vibro-impact", {{"omega", 0.552}}, {"omega", "friction", "restitution"});
}

TEST(Rates, AgreeWithDifferencesOfStopsOnBothSides) {
  expect_differences("two-sided-rattle", {}, {"omega", "restitution"});
  expect_differences("gear-pair", {}, {"omega"});
}

TEST(Rates, AgreeWithDifferencesOfAFreeMotionWhosePeriodMoves) {
  expect_differences("belt", {{"damping_ratio", 0.05}}, {"belt_speed", "damping_ratio", "static_friction"});
}

TEST(Rates, AgreeWithDifferencesOfCompliantStopsAndCharacteristics) {
  expect_differences("bump-stop", {}, {"omega", "bump_stiffness", "rebound"});
  expect_differences("bilinear-oscillator", {{"contact_damping", 0.05}}, {"omega", "contact_damping"});
  expect_differences("falling-friction", {}, {"belt_speed", "fast_friction"});
  expect_differences("pressed-block", {}, {"belt_speed", "stiffness"});
}

TEST(Rates, AgreeWithDifferencesOfAClutchThatIsOvercome) {
  expect_differences(SLAPSTICK_ORBIT_MODELS "overrun.toml", {}, {"holds", "drag", "load", "swing"});
}

TEST(Rates, AgreeWithDifferencesOfJenkinsElements) {
  expect_differences(SLAPSTICK_ORBIT_MODELS "joint.toml", {}, {"stiffness", "limit", "loose", "gap", "omega"});
}

TEST(Rates, AgreeWithDifferencesOfMaxwellElements) {
  expect_differences(SLAPSTICK_ORBIT_MODELS "mount.toml", {}, {"stiffness", "damping", "softer", "gap", "omega"});
}

/// The kinetic energy of a symmetric motion has its greatest value twice in a cycle: value, instant and their
/// derivatives are those of the first.
TEST(Rates, OfEqualExtremesBelongToTheOneThatIsNamed) {
  const ModelDefinition model = load_model("coulomb-oscillator");
  const SettledCycle cycle(model);
  const std::vector<Quantity> of = {cycle.named("kinetic_energy")};
  const orbit::Orbit& orbit = cycle.solution.orbit;
  const Statistics rate = measure_rates(model, {}, {"omega"}, orbit, of)[0].of[0];
  constexpr double h = 1e-4;
  const Statistics above = beside(model, {}, "omega", h, orbit, of).of[0],
                   below = beside(model, {}, "omega", -h, orbit, of).of[0];
  EXPECT_NEAR(rate.greatest_at, (above.greatest_at - below.greatest_at) / (2.0 * h), 1e-2);  // the other's is 4.9 away
  EXPECT_NEAR(rate.greatest, (above.greatest - below.greatest) / (2.0 * h), 1e-3);
}

/// A mass that sticks for ever stays where it is: of the force that holds it the amplitude is the drive's.
TEST(Rates, OfAMassThatFrictionHoldsAreThoseOfItsForce) {
  const ModelDefinition model = load_model("coulomb-oscillator");
  const Overrides values = {{"amplitude", 0.1}, {"omega", 0.8}};
  const SettledCycle cycle(model, values);
  ASSERT_FALSE(cycle.solution.isolated());
  const auto rates = measure_rates(model, values, {"amplitude", "omega"}, cycle.solution.orbit,
                                   {cycle.named("x"), cycle.named("F_friction")});
  EXPECT_NEAR(rates[0].of[0].greatest, 0.0, 1e-15);
  EXPECT_NEAR(rates[0].of[1].greatest, 1.0, 1e-13);
  EXPECT_NEAR(rates[0].of[1].least, -1.0, 1e-13);
  EXPECT_NEAR(rates[1].of[1].greatest, 0.0, 1e-13);
}

/// A ball between its spring and a wall that takes nothing has cycles of any size: no derivative, and no number that
/// looks like one.
TEST(Rates, OfAConservativeFamilyAreRefused) {
  const ModelDefinition model = ModelDefinition::parse(
      "name = 'm'\nomega = 1\n[parameters]\nk = 1\n[[coordinate]]\nname = 'x'\nmass = 1\n"
      "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 'k'\n"
      "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.5\nrestitution = 1\n[start]\nv = 1\n",
      "free.toml");
  const SettledCycle cycle(model);
  ASSERT_FALSE(cycle.solution.isolated());
  EXPECT_THROW((void)measure_rates(model, {}, {"k"}, cycle.solution.orbit, {cycle.named("x")}), NumericalError);
}

TEST(Rates, OfUnknownNamesAndOfParametersAreRefused) {
  const ModelDefinition model = load_model("impact-oscillator");
  const Overrides values = {{"clearance", 100.0}};
  const SettledCycle cycle(model, values);
  EXPECT_THROW((void)measure_rates(model, values, {"no_such"}, cycle.solution.orbit, {cycle.named("x")}), InputError);
  EXPECT_THROW((void)measure_rates(model, values, {"omega"}, cycle.solution.orbit, {cycle.named("omega")}), InputError);
}

}  // namespace
}  // namespace slapstick::test
