/// The built-in models are what they say, and print to files that are the same models.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "io/same_model.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Sums springs or dampers into a matrix: K x is what pulls back.
template <class Links, class Strength>
Matrix assembled(const Model& model, const Links& links, Strength strength) {
  const auto n = model.coordinates.size();
  Matrix matrix(n, std::vector<double>(n, 0.0));
  for (const auto& link : links) {
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    if (link.a != ground) matrix[a][a] += strength(link);
    if (link.b != ground) matrix[b][b] += strength(link);
    if (link.a != ground && link.b != ground) {
      matrix[a][b] -= strength(link);
      matrix[b][a] -= strength(link);
    }
  }
  return matrix;
}

void expect_near(const Matrix& matrix, const Matrix& expected) {
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_NEAR(matrix[i][j], expected[i][j], 1e-14 * (1.0 + std::abs(expected[i][j])));
}

TEST(VibroImpact, matrices_are_those_of_equation_2) {
  const auto definition = load_model("vibro-impact");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0.01, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double mu_m = 20 * any(random), mu_k = 10 * any(random), mu_c = 10 * any(random), xi = any(random),
                 b = any(random) - 0.4;
    const double f20 = any(random), f_k = any(random), f_s = f_k + any(random), r = any(random),
                 omega = 8 * any(random), tau = 6 * any(random);
    const auto model = definition.build({{"mass_ratio", mu_m},
                                         {"stiffness_ratio", mu_k},
                                         {"dashpot_ratio", mu_c},
                                         {"damping_ratio", xi},
                                         {"clearance", b},
                                         {"force_share_2", f20},
                                         {"static_friction", f_s},
                                         {"kinetic_friction", f_k},
                                         {"restitution", r},
                                         {"omega", omega},
                                         {"phase", tau}});
    ASSERT_EQ(model.size(), 2);
    EXPECT_EQ(model.coordinates[0].mass, 1.0);
    EXPECT_EQ(model.coordinates[1].mass, mu_m);
    expect_near(assembled(model, model.springs, [](const Spring& s) { return s.stiffness; }),
                {{1, -1}, {-1, 1 + mu_k}});
    expect_near(assembled(model, model.dampers, [](const Damper& d) { return d.coefficient; }),
                {{2 * xi, -2 * xi}, {-2 * xi, 2 * xi * (1 + mu_c)}});
    ASSERT_EQ(model.forces.size(), 2U);
    for (const auto& force : model.forces) {
      EXPECT_EQ(force.amplitude, force.coordinate == 0 ? 1 - f20 : f20);
      EXPECT_EQ(force.harmonic, 1);
      EXPECT_EQ(force.phase, tau);
    }
    const auto& friction = model.frictions.at(0);
    const auto& stop = model.stops.at(0);
    EXPECT_TRUE(friction.a == 0 && friction.b == 1 && friction.belt_speed == 0.0);
    EXPECT_TRUE(friction.static_friction == f_s && friction.kinetic_friction == f_k);
    EXPECT_TRUE(stop.a == 0 && stop.b == 1 && stop.clearance == b && stop.restitution == r);
    EXPECT_EQ(model.omega, omega);
  }
}

TEST(VibroImpact, defaults_are_the_papers_with_its_three_corrections) {
  const auto definition = load_model("vibro-impact");
  const std::map<std::string, double> expected = {{"mass_ratio", 10},
                                                  {"stiffness_ratio", 5},
                                                  {"dashpot_ratio", 5},
                                                  {"damping_ratio", 0.1},
                                                  {"clearance", 0},
                                                  {"force_share_2", 0},
                                                  {"static_friction", 0.15},
                                                  {"kinetic_friction", 0.15},
                                                  {"restitution", 0.8},
                                                  {"omega", 2.2},
                                                  {"phase", 0}};
  EXPECT_EQ(definition.values(), expected);
  EXPECT_EQ(definition.start(), (State{-0.5, 0, 0, 0}));
  EXPECT_EQ(state_names(definition.build()), (std::vector<std::string>{"x1", "v1", "x2", "v2"}));
  EXPECT_NE(definition.notes().find("0.08"), std::string::npos);
}

TEST(VibroImpact, friction_sets_both_and_kinetic_follows_static) {
  const auto definition = load_model("vibro-impact");
  const auto friction = [&](const Overrides& overrides) {
    const auto contact = definition.build(overrides).frictions.at(0);
    return std::pair(contact.static_friction, contact.kinetic_friction);
  };
  EXPECT_EQ(friction({{"friction", 0.1}}), std::pair(0.1, 0.1));
  EXPECT_EQ(friction({{"static_friction", 0.3}}), std::pair(0.3, 0.3));
  EXPECT_EQ(friction({{"kinetic_friction", 0.1}}), std::pair(0.15, 0.1));
  EXPECT_EQ(friction({{"friction", 0.3}, {"kinetic_friction", 0.1}}), std::pair(0.3, 0.1));
  EXPECT_EQ(definition.values({{"stiffness_ratio", 7}}).at("dashpot_ratio"), 5.0);
}

TEST(BuiltinModels, print_parse_print_is_a_fixed_point) {
  ASSERT_EQ(builtin_models(), (std::vector<std::string>{"belt",
                                                        "bilinear-oscillator",
                                                        "bouncing-ball",
                                                        "buffers",
                                                        "bump-stop",
                                                        "colliding-blocks",
                                                        "coulomb-oscillator",
                                                        "drill-string",
                                                        "falling-friction",
                                                        "friction-rattle",
                                                        "gear-pair",
                                                        "gear-rattle",
                                                        "impact-absorber",
                                                        "impact-friction-oscillator",
                                                        "impact-oscillator",
                                                        "impact-pair",
                                                        "mode-coupling-brake",
                                                        "pressed-block",
                                                        "shaken-belt",
                                                        "shaken-table",
                                                        "sliding-block",
                                                        "sliding-pair",
                                                        "spool",
                                                        "stick-slip-impact",
                                                        "two-blocks-on-belt",
                                                        "two-sided-rattle",
                                                        "vibro-impact"}));
  for (const auto& name : builtin_models()) {
    const auto definition = load_model(name);
    EXPECT_EQ(definition.name(), name);
    EXPECT_FALSE(definition.summary().empty());
    const auto text = definition.to_toml();
    const auto again = ModelDefinition::parse(text, name);
    EXPECT_EQ(again.to_toml(), text);
    expect_same(again.build(), definition.build());
    EXPECT_EQ(again.start(), definition.start());
    for (const auto& parameter : definition.parameters()) {
      EXPECT_FALSE(parameter.description.empty()) << parameter.name;
      EXPECT_TRUE(parameter.admits(parameter.value));
    }
  }
}

TEST(BuiltinModels, print_with_overrides_reloads_to_the_same_model) {
  std::mt19937 random(2);
  for (const auto& name : builtin_models()) {
    const auto definition = load_model(name);
    for (int i = 0; i < 100; ++i) {
      Overrides overrides;
      for (const auto& parameter : definition.parameters()) {
        const double value = std::ldexp(static_cast<double>(random()) + 1.0 / 3.0, -32);
        if (random() % 2 == 0) overrides[parameter.name] = value + 0.1 * (value < 0.9);
        if (parameter.name == "kinetic_friction")
          overrides[parameter.name] = 0.1 * value;  // always below static_friction
      }
      const auto text = definition.to_toml(overrides);
      const auto again = ModelDefinition::parse(text, name);
      expect_same(again.build(), definition.build(overrides));
      EXPECT_EQ(again.start(), definition.start(overrides));
      EXPECT_EQ(again.values(), definition.values(overrides));
      EXPECT_EQ(again.to_toml(), text);
    }
  }
}

TEST(BuiltinModels, unforced_forced_ground_and_belt_members_of_the_family) {
  const auto ball = load_model("bouncing-ball").build();
  EXPECT_FALSE(ball.forced());
  EXPECT_EQ(ball.forces.at(0).amplitude, -9.81);
  EXPECT_TRUE(ball.stops.at(0).a == ground && ball.stops.at(0).b == 0);
  const auto belt = load_model("belt").build();
  EXPECT_EQ(belt.frictions.at(0).belt_speed, 0.5);
  EXPECT_GT(belt.frictions.at(0).static_friction, belt.frictions.at(0).kinetic_friction);
  EXPECT_EQ(load_model("impact-oscillator").build().forces.at(1).phase, std::numbers::pi / 2);
  EXPECT_EQ(load_model("coulomb-oscillator").build().frictions.at(0).b, ground);
}

}  // namespace
}  // namespace slapstick
