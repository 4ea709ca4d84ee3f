#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "attractor/paper_system.hpp"
#include "flow/translations.hpp"
#include "slapstick/attractor/classify.hpp"

namespace slapstick {
namespace {

/// m x'' + c x' = sin(omega t) + F: v has the mean F / c and the multiplier exp(-c T / m), x is determined up to a
/// constant.
Model dragged_mass(double drag, double push) {
  Model model;
  model.name = "dragged mass";
  model.coordinates = {{"x", 1.0}};
  model.dampers = {{0, ground, drag}};
  model.forces = {{0, 1, 1.0, 0.0}, {0, 0, push, 0.0}};
  model.omega = 2.0;
  return model;
}

/// A hammer that is pressed on and shaken, the bit it strikes, and rock that holds the bit by friction.
Model drill() {
  Model model;
  model.name = "drill";
  model.coordinates = {{"hammer", 1.0}, {"bit", 0.5}};
  model.dampers = {{0, ground, 0.1}};
  model.forces = {{0, 1, 1.0, 0.0}, {0, 0, 0.3, 0.0}};
  model.frictions = {{"rock", 1, ground, 0.0, 0.8, 0.6}};
  model.stops = {{"blow", 0, 1, 0.1, 0.3}};
  model.omega = 1.0;
  return model;
}

/// Two inertias with backlash between them; drag on both, and the torques that balance it at the mean speed.
Model rotors(double speed) {
  Model model;
  model.name = "rotors";
  model.coordinates = {{"a", 1.0}, {"b", 0.5}};
  model.dampers = {{0, ground, 0.1}, {1, ground, 0.05}};
  model.forces = {{0, 1, 0.4, 0.0}, {0, 0, 0.1 * speed, 0.0}, {1, 0, 0.05 * speed, 0.0}};
  model.compliant_stops = {{"front", 0, 1, 0.1, 5.0, 0.2}, {"back", 1, 0, 0.1, 5.0, 0.2}};
  model.omega = 1.1;
  return model;
}

State after(const System& system, const State& start, std::int64_t periods) {
  Motion motion(system, start);
  while (motion.advance({periods, 0.0}) == Outcome::event) {
  }
  return motion.state();
}

int translations(const Model& model) { return flow::Translations(System(model)).count(); }

TEST(drift, a_mass_pushed_against_its_drag_is_a_cycle_that_moves_by_the_closed_form) {
  const Model model = dragged_mass(0.3, 0.15);
  const System system(model);
  const Classification found = classify(system, {0.4, 0.0});
  EXPECT_EQ(found.label, "1-0-I");
  ASSERT_EQ(found.drift.size(), 1u);
  EXPECT_NEAR(found.drift[0], model.forcing_period() * 0.15 / 0.3, 1e-12);
  ASSERT_EQ(found.multipliers.size(), 1u);  // of v; that of x is left out
  EXPECT_NEAR(found.exponent, -0.3 * model.forcing_period(), 1e-12);
  const State next = after(system, found.state, 1);
  EXPECT_NEAR(next[0] - found.state[0], found.drift[0], 1e-12);
  EXPECT_NEAR(next[1], found.state[1], 1e-12);
  EXPECT_EQ(found.state[0], 0.4);  // any place is as good: that of the start
}

TEST(drift, slow_drag_is_found_by_newtons_method_although_the_jacobian_has_a_multiplier_one) {
  const Model model = dragged_mass(3e-4, 1.5e-4);
  const Classification found = classify(System(model), {0.0, -0.3});
  EXPECT_EQ(found.label, "1-0-I");
  EXPECT_LT(found.periods_used, 5000);  // the speed needs 23000 to come to within 1e-10
  EXPECT_NEAR(found.exponent, -3e-4 * model.forcing_period(), 1e-13);
  ASSERT_EQ(found.drift.size(), 1u);
  EXPECT_NEAR(found.drift[0], model.forcing_period() * 0.5, 1e-9);
}

TEST(drift, what_does_not_move_has_a_drift_of_exactly_zero) {
  EXPECT_EQ(classify(System(dragged_mass(0.3, 0.0)), {0.0, 0.0}).drift, std::vector<double>{0.0});
}

TEST(drift, a_motion_that_is_at_rest_at_every_return_is_measured_in_between) {
  // Without drag x'' = sin(omega t) from rest keeps v = (1 - cos(omega t)) / omega, zero at phase 0; started at the
  // crest it does not even move on.
  Model model = dragged_mass(0.0, 0.0);
  const Classification moving = classify(System(model), {0.0, 0.0});
  EXPECT_EQ(moving.label, "1-0-I");
  ASSERT_EQ(moving.drift.size(), 1u);
  EXPECT_NEAR(moving.drift[0], model.forcing_period() / model.omega, 1e-9);
  model.forces[0].phase = 0.5 * std::numbers::pi;
  const Classification resting = classify(System(model), {0.0, 0.0});
  EXPECT_EQ(resting.label, "1-0-I");
  EXPECT_EQ(resting.drift, std::vector<double>{0.0});
}

TEST(drift, a_mass_that_nothing_holds_and_a_force_pushes_is_on_no_cycle) {
  EXPECT_EQ(classify(System(dragged_mass(0.0, 0.1)), {0.0, 0.0}, {.most_periods = 3000}).attractor,
            Attractor::undecided);
}

TEST(drift, a_drill_advances_by_what_a_long_run_advances) {
  const System system(drill());
  const Classification found = classify(system, {0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(found.label, "1-inf-II");
  ASSERT_EQ(found.drift.size(), 2u);
  EXPECT_GT(found.drift[0], 1.0);
  EXPECT_NEAR(found.drift[0], found.drift[1], 1e-13);
  EXPECT_LT(std::abs(found.multipliers.front()), 0.5);
  constexpr int transient = 200, periods = 1000;
  const double advance =
      after(system, {0, 0, 0, 0}, transient + periods)[2] - after(system, {0, 0, 0, 0}, transient)[2];
  EXPECT_NEAR(advance / periods, found.drift[1], 1e-12);
  const State next = after(system, found.state, 1);
  for (std::size_t i : {0, 2}) EXPECT_NEAR(next[i] - found.state[i], found.drift[i / 2], 1e-12);
}

TEST(drift, rotors_rattle_alike_at_rest_and_turning) {
  // Galileo: the forces between and on the rotors are the same in a frame that turns along.
  constexpr double speed = 7.0;
  const Classification rest = classify(System(rotors(0.0)), {0.0, 0.0, 0.0, 0.0});
  const Classification turning = classify(System(rotors(speed)), {0.0, speed, 0.0, speed});
  EXPECT_EQ(rest.label, "1-3-I");
  EXPECT_EQ(turning.label, rest.label);
  ASSERT_EQ(rest.multipliers.size(), 3u);
  ASSERT_EQ(turning.multipliers.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(std::abs(turning.multipliers[i] - rest.multipliers[i]), 1e-9) << i;
  ASSERT_EQ(turning.impacts.size(), rest.impacts.size());
  for (std::size_t i = 0; i < rest.impacts.size(); ++i) EXPECT_NEAR(turning.impacts[i].w, rest.impacts[i].w, 1e-9);
  EXPECT_EQ(rest.drift, (std::vector<double>{0.0, 0.0}));
  for (const double drift : turning.drift) EXPECT_NEAR(drift, speed * 2.0 * std::numbers::pi / 1.1, 1e-9);
}

/// The paper's oscillator and, apart from it, the dragged mass: a product of two systems.
Model oscillator_and_mass(double omega) {
  Model model = test::paper_model({.omega = omega});
  model.coordinates.push_back({"x3", 1.0});
  model.dampers.push_back({2, ground, 0.3});
  model.forces.push_back({2, 0, 0.15, 0.0});
  return model;
}

TEST(drift, an_aperiodic_motion_keeps_its_kind_beside_a_mass_that_moves_away) {
  for (const auto& [omega, kind] : {std::pair{4.805, Attractor::quasi_periodic}, std::pair{6.69, Attractor::chaotic}}) {
    const Model model = oscillator_and_mass(omega);
    const Classification found = classify(System(model), {-0.5, 0, 0, 0, 0, 0});
    EXPECT_EQ(found.attractor, kind) << omega;
    ASSERT_EQ(found.drift.size(), 3u);
    EXPECT_EQ(found.drift[0], 0.0);
    EXPECT_EQ(found.drift[1], 0.0);
    EXPECT_NEAR(found.drift[2], 0.5 * model.forcing_period(), 1e-9);
  }
}

TEST(drift, the_multipliers_of_a_free_coupled_pair_are_those_of_its_relative_motion_and_its_mean_speed) {
  // The pair moves as one along (1, 1), which is no single coordinate: Liouville's formula for what is left.
  Model model = dragged_mass(0.3, 0.15);
  model.coordinates.push_back({"y", 2.0});
  model.springs = {{0, 1, 1.5}};
  model.dampers.push_back({0, 1, 0.2});
  const Classification found = classify(System(model), {0.4, 0.0, 0.0, 0.0});
  EXPECT_EQ(found.label, "1-0-I");
  ASSERT_EQ(found.multipliers.size(), 3u);
  std::complex<double> product = 1.0;
  for (const auto& multiplier : found.multipliers) product *= multiplier;
  EXPECT_NEAR(product.real(), std::exp(-(0.5 / 1.0 + 0.2 / 2.0) * model.forcing_period()), 1e-12);
  for (const double drift : found.drift) EXPECT_NEAR(drift, 0.5 * model.forcing_period(), 1e-9);
}

TEST(drift, a_model_with_a_wall_spring_has_none) {
  const Classification found = classify(System(test::paper_model({})), test::paper_start);
  EXPECT_TRUE(found.drift.empty());
  EXPECT_EQ(found.multipliers.size(), 4u);
}

TEST(translations, are_what_neither_springs_nor_stops_nor_the_stiffness_matrix_see) {
  Model model = drill();
  EXPECT_EQ(translations(model), 1);
  model.stops.clear();
  EXPECT_EQ(translations(model), 2);
  model.stiffness = {3.0, -3.0, -3.0, 3.0};
  EXPECT_EQ(translations(model), 1);
  model.stiffness = {3.0, -3.0, -3.0, 4.0};
  EXPECT_EQ(translations(model), 0);
  model.stiffness.clear();
  model.stops = {{"wall", 1, ground, 5.0, 0.5}};
  EXPECT_EQ(translations(model), 1);
  model.stops.clear();
  model.compliant_stops = {{"wall", 0, ground, 5.0, 1.0, 0.0}, {"gap", 0, 1, 5.0, 1.0, 0.0}};
  EXPECT_EQ(translations(model), 0);
}

TEST(translations, a_spring_however_soft_beside_stiff_ones_is_seen) {
  Model model = drill();
  model.springs = {{0, 1, 1e12}, {1, ground, 0.0}};
  EXPECT_EQ(translations(model), 1);
  model.springs = {{0, 1, 1e12}, {1, ground, 1e-12}};
  EXPECT_EQ(translations(model), 0);
}

TEST(translations, a_lever_of_the_stiffness_matrix_moves_its_coordinates_in_proportion) {
  // Energy (2 a - b)^2 / 2: invariant along a : b = 1 : 2.
  Model model = drill();
  model.stops.clear();
  model.stiffness = {4.0, -2.0, -2.0, 1.0};
  const System system(model);
  const flow::Translations lever(system);
  ASSERT_EQ(lever.count(), 1);
  const std::vector<double> move = lever.by_coordinate(Eigen::VectorXd::Constant(1, 1.0));
  EXPECT_NEAR(move[1], 2.0 * move[0], 1e-15);
  EXPECT_GT(std::abs(move[0]), 0.1);
}

}  // namespace
}  // namespace slapstick
