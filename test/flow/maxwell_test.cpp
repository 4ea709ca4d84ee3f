/// Springs and dampers in series against closed forms: free motion, impacts, response, energy, exponents, modes.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/flow/system.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/quantity/measure.hpp"

namespace slapstick::testing {
namespace {

constexpr double pi = std::numbers::pi;

ModelDefinition file(const std::string& parts) { return ModelDefinition::parse("name = 'm'\n" + parts, "f.toml"); }

const char* const body = "[[coordinate]]\nname = 'x'\nmass = 2\n";

std::string element(double k, double c, const std::string& ends = "['x', 'ground']") {
  return "[[maxwell]]\nname = 'mount'\nbetween = " + ends + "\nstiffness = " + std::to_string(k) +
         "\ndamping = " + std::to_string(c) + "\n";
}

/// Of a body of mass m on an element alone: m v' = -f, f' = k v - (k / c) f, from v and f at the start.
struct Free {
  double m = 2.0, k = 3.0, c = 4.0;
  [[nodiscard]] double decay() const { return 0.5 * k / c; }
  [[nodiscard]] double turn() const { return std::sqrt(k / m - decay() * decay()); }
  [[nodiscard]] double force(double v, double f, double t) const {
    const double b = (k * v - (k / c) * f + decay() * f) / turn();
    return std::exp(-decay() * t) * (f * std::cos(turn() * t) + b * std::sin(turn() * t));
  }
  /// From f' = k v - (k / c) f.
  [[nodiscard]] double velocity(double v, double f, double t) const {
    const double h = 1e-5;
    const double rate = (force(v, f, t + h) - force(v, f, t - h)) / (2.0 * h);
    return (rate + (k / c) * force(v, f, t)) / k;
  }
};

/// The state has s and s', and s' = f / c at any time.
TEST(Maxwell, OfABodyAloneIsADampedSwing) {
  const Free free;
  const System system(file(std::string(body) + element(free.k, free.c)).build());
  Motion motion(system, {0.0, 1.5, 0.0, 99.0});  // what is given for s' is not read
  for (int i = 1; i <= 40; ++i) {
    ASSERT_EQ(motion.advance(Instant{}.plus(0.25 * i)), Outcome::reached_end);
    const State at = motion.state();
    const double f = free.force(1.5, 0.0, 0.25 * i);
    EXPECT_NEAR(free.k * (at[0] - at[2]), f, 1e-14) << i;
    EXPECT_NEAR(free.c * at[3], f, 1e-14) << i;
    EXPECT_NEAR(at[1], free.velocity(1.5, 0.0, 0.25 * i), 1e-9) << i;  // of the difference quotient
    EXPECT_NEAR(2.0 * at[1] + free.c * at[2], 3.0, 1e-14) << i;        // m v + c s: (m v)' = -f = -c s'
  }
}

/// All momentum goes into the damper in the end: c s = m v_0, and x = s.
TEST(Maxwell, KeepsAStretchOfTheDamperForEver) {
  const System system(file(std::string(body) + element(3, 4)).build());
  Motion motion(system, {0.0, 1.5, 0.0, 0.0});
  (void)motion.advance(Instant{}.plus(2000.0));
  EXPECT_NEAR(motion.state()[0], 0.75, 1e-13);
  EXPECT_NEAR(motion.state()[2], 0.75, 1e-13);
  EXPECT_EQ(classify(system, {0.0, 1.5, 0.0, 0.0}).attractor, Attractor::equilibrium);
}

/// A blow turns the body round, and the force of the element does not jump.
TEST(Maxwell, ForceDoesNotJumpAtAnImpact) {
  const Free free;
  const System system(file(std::string(body) + element(free.k, free.c) +
                           "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.3\nrestitution = 0.7\n")
                          .build());
  Motion motion(system, {0.0, 1.5, 0.0, 0.0});
  ASSERT_EQ(motion.advance(Instant{}.plus(5.0)), Outcome::event);
  const State before(motion.before().begin(), motion.before().end()), after = motion.state();
  const double t = seconds(motion.event(), motion), f = free.force(1.5, 0.0, t);
  EXPECT_EQ(motion.event().kind, EventKind::impact);
  EXPECT_NEAR(before[1], free.velocity(1.5, 0.0, t), 1e-9);
  EXPECT_EQ(after[1], -0.7 * before[1]);
  EXPECT_NEAR(free.c * after[3], f, 1e-14);
  EXPECT_EQ(after[3], before[3]);
  (void)motion.advance(Instant{}.plus(t + 0.9));
  EXPECT_NEAR(free.c * motion.state()[3], free.force(after[1], f, 0.9), 1e-13);
}

/// m x'' + k_0 x + f = F sin(omega t), f = k i omega c / (k + i omega c) x.
TEST(Maxwell, RespondsAsItsDynamicStiffnessSays) {
  const double m = 2, k0 = 5, k = 3, c = 4, omega = 1.3, F = 0.8;
  const ModelDefinition definition =
      file("omega = 1.3\n" + std::string(body) + "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 5\n" +
           element(k, c) + "[[force]]\non = 'x'\namplitude = 0.8\n");
  const std::complex<double> i(0.0, 1.0), of_element = k * i * omega * c / (k + i * omega * c);
  const std::complex<double> x = F / (k0 - m * omega * omega + of_element), s = of_element * x / (i * omega * c);
  const System system(definition.build());
  const Classification found = classify(system, definition.start());
  ASSERT_EQ(found.label, "1-0-I");
  Motion settling(system, definition.start());
  (void)settling.advance({200, 0.0});
  const State there = {x.imag(), (i * omega * x).imag(), s.imag(), (i * omega * s).imag()}, at = settling.state();
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(at[k], there[k], 1e-13) << k;
  ASSERT_EQ(found.multipliers.size(), 3u);  // 2n + 1: the rate of s follows
  std::complex<double> product = 1.0;
  for (const auto& mu : found.multipliers) product *= mu;
  EXPECT_NEAR(product.real(), std::exp(-k / c * 2.0 * pi / omega), 1e-12);  // the trace of A is -k / c
  std::vector<Quantity> wanted;
  for (const char* one : {"power_damping", "power_in", "F_mount", "potential_energy", "power_mount"})
    wanted.push_back(find_quantity(quantities(definition.build()), one));
  const double T = 2.0 * pi / omega;
  const Measured cycle = measure(Motion(system, there), Instant{}.plus(T / system.period()), wanted);
  EXPECT_NEAR(cycle.of[0].mean, 0.5 * of_element.imag() * omega * std::norm(x), 1e-13);
  EXPECT_NEAR(cycle.of[1].mean, cycle.of[0].mean, 1e-13);
  EXPECT_NEAR(cycle.of[4].mean, cycle.of[0].mean, 1e-15);
  EXPECT_NEAR(cycle.of[2].greatest, std::abs(of_element * x), 1e-13);
  EXPECT_NEAR(cycle.of[3].mean, 0.25 * (k0 * std::norm(x) + k * std::norm(x - s)), 1e-13);
}

/// Zener's: a spring in parallel. Roots of (m lambda^2 + k_0)(c lambda + k) + k c lambda.
TEST(Maxwell, ModesAreTheRootsOfTheCubic) {
  const double m = 2, k0 = 5, k = 3, c = 4;
  const ModelDefinition definition =
      file(std::string(body) + "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 5\n" + element(k, c));
  const System system(definition.build());
  const auto modes = natural_modes(system, sliding_states(system, definition.start()));
  ASSERT_EQ(modes.size(), 2u);  // one that creeps, and a pair
  for (const NaturalMode& mode : modes) {
    const double turn = 2.0 * pi * mode.cycles();
    const std::complex<double> lambda(-mode.decay, turn);
    EXPECT_LT(std::abs((m * lambda * lambda + k0) * (c * lambda + k) + k * c * lambda), 1e-12);
    EXPECT_LT(std::abs(mode.shape[1] * (k + c * lambda) - k * mode.shape[0]), 1e-12);
  }
}

/// (lambda + 2) (lambda^2 + 3.5 lambda + 1.5): a mode that decays at 2 k / c, the rate at which A lets s' settle.
TEST(Maxwell, ModesAtTheRateOfSettlingAreKept) {
  const ModelDefinition definition = ModelDefinition::parse(
      "name = 'm'\n[[coordinate]]\nname = 'x'\nmass = 1\n[[spring]]\nbetween = ['x', 'ground']\nstiffness = 3\n"
      "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 4.5\n" +
          element(1, 1),
      "f.toml");
  const System system(definition.build());
  const auto modes = natural_modes(system, sliding_states(system, definition.start()));
  ASSERT_EQ(modes.size(), 3u);
  const double decays[] = {0.5, 2.0, 3.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_FALSE(modes[i].oscillates());
    EXPECT_NEAR(modes[i].decay, decays[i], 1e-14);
  }
}

/// The sum of the exponents is the trace: the rate of s is no direction of its own.
TEST(Maxwell, HasOneExponentMore) {
  const ModelDefinition definition = file("omega = 1.3\n" + std::string(body) +
                                          "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 5\n" + element(3, 4) +
                                          "[[force]]\non = 'x'\namplitude = 0.8\n"
                                          "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.1\n"
                                          "restitution = 0.7\n");
  const LyapunovExponents found = lyapunov(System(definition.build()), definition.start(), {.most_periods = 500});
  ASSERT_EQ(found.per_period.size(), 3u);
  EXPECT_TRUE(std::isfinite(found.sum));
  EXPECT_TRUE(found.sum_rule_holds());
}

/// A cycle that turns as it is neared, beside a body that may rest anywhere: a return after several periods is seen
/// first. Its rate of s, which no class has, must not be compared.
TEST(Maxwell, ACycleOfAFamilyHasItsOwnPeriod) {
  for (const double omega : {2.3, 2.9, 3.1, 3.7, 4.1}) {
    const ModelDefinition definition =
        file("omega = " + std::to_string(omega) + "\n" + body + "[[coordinate]]\nname = 'y'\nmass = 2\n" +
             "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 3\n" + element(1.2, 1.9) +
             "[[spring]]\nbetween = ['x', 'y']\nstiffness = 0.5\n[[force]]\non = 'x'\namplitude = 0.7\n" +
             "[[friction]]\nname = 'pad'\nbetween = ['y', 'ground']\nstatic = 1.1\nkinetic = 1\n" +
             "[[stop]]\nname = 'wall'\nbetween = ['x', 'ground']\nclearance = 0.2\nrestitution = 0.5\n");
    const Classification found = classify(System(definition.build()), definition.start(), {.transient_periods = 100});
    EXPECT_EQ(found.label, "1-0-II") << omega;
    EXPECT_EQ(found.family, 1) << omega;
  }
}

/// A gear of ratio 2 sees four times the stiffness and the damping.
TEST(Maxwell, RatiosActOnItsStretch) {
  const auto state = [&](const std::string& parts) {
    const System system(file(std::string(body) + parts).build());
    Motion motion(system, {0.4, 1.0, 0.0, 0.0});
    (void)motion.advance(Instant{}.plus(3.0));
    return motion.state();
  };
  const State one = state(element(12, 16)), geared = state(element(3, 4, "['x', 'ground']\nratio = [2, 1]"));
  EXPECT_NEAR(geared[0], one[0], 1e-15);
  EXPECT_NEAR(geared[1], one[1], 1e-15);
  EXPECT_NEAR(geared[2], 2.0 * one[2], 1e-15);
  const State turned = state(element(12, 16, "['ground', 'x']"));
  EXPECT_EQ(turned[0], one[0]);
  EXPECT_EQ(turned[2], -one[2]);
}

TEST(Maxwell, RefusesWhatHasNoMeaning) {
  const auto message = [&](const std::string& parts) {
    try {
      const ModelDefinition definition = file(std::string(body) + parts);
      (void)definition.build();
      (void)definition.start();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(element(0, 1)).find("maxwell 'mount': stiffness = 0 is not a positive"), std::string::npos);
  EXPECT_NE(message(element(1, -1)).find("maxwell 'mount': damping = -1 is not a positive"), std::string::npos);
  EXPECT_NE(message(element(1, 1) + "[start]\nv_s_mount = 1\n").find("'v_s_mount' follows"), std::string::npos);
  EXPECT_EQ(message(element(1, 1) + "[start]\ns_mount = 1\n"), "");
  EXPECT_NE(
      message(element(1, 1) + "[[force]]\non = 's_mount'\namplitude = 1\nharmonic = 0\n").find("unknown coordinate"),
      std::string::npos);
  Model model = file(std::string(body) + element(1, 1)).build();
  model.forces.push_back({1, 0, 1.0});
  EXPECT_THROW(validate(model), InputError);
  model.forces.clear();
  model.dampers.clear();
  EXPECT_THROW(validate(model), InputError);
}

}  // namespace
}  // namespace slapstick::testing
