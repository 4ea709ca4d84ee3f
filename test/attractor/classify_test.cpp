#include "slapstick/attractor/classify.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <ostream>

#include "attractor/paper_system.hpp"
#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "slapstick/flow/tangent.hpp"

namespace slapstick {
namespace {

using test::paper_model;
using test::paper_start;

Classification at(double omega) { return classify(System(paper_model({.omega = omega})), paper_start); }

struct Expected {
  double omega;
  const char* label;
  Attractor attractor;
  Chatter chatter;
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.label << " at " << expected.omega; }

class PaperMotion : public testing::TestWithParam<Expected> {};

TEST_P(PaperMotion, has_the_class_that_the_paper_names) {
  const Classification found = at(GetParam().omega);
  EXPECT_EQ(found.label, GetParam().label);
  EXPECT_EQ(found.attractor, GetParam().attractor);
  EXPECT_EQ(found.chatter, GetParam().chatter);
}

INSTANTIATE_TEST_SUITE_P(claims, PaperMotion,
                         testing::Values(Expected{1.5, "1-1-II", Attractor::periodic, Chatter::none},
                                         Expected{2.2, "1-1-I", Attractor::periodic, Chatter::none},
                                         Expected{0.552, "1-inf-II", Attractor::periodic, Chatter::complete},
                                         Expected{2.85, "2-2-I", Attractor::periodic, Chatter::none},
                                         Expected{3.5, "2-1-I", Attractor::periodic, Chatter::none},
                                         Expected{4.801, "4-2-I", Attractor::periodic, Chatter::none},
                                         Expected{4.805, "quasi-periodic", Attractor::quasi_periodic, Chatter::none},
                                         Expected{6.69, "chaotic", Attractor::chaotic, Chatter::none}));

TEST(classify, the_cycle_found_by_newton_is_not_a_multiple_of_a_shorter_one) {
  EXPECT_EQ(at(6.5).label, "3-1-I");
  EXPECT_EQ(at(8.0).label, "4-1-I");
}

/// The fixed point of the one-period map near `start`, stable or not, by Newton's method.
State fixed_point(const System& system, State start) {
  const int n = system.compiled().frame().n;
  for (int k = 0; k < 12; ++k) {
    TangentMotion run(system, start, Eigen::MatrixXd::Identity(2 * n, 2 * n));
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(run.motion().engine().extended().data(), 2 * n);
    while (run.advance({1, 0.0}) == Outcome::event) {
    }
    const Eigen::Map<const Eigen::VectorXd> image(run.motion().engine().extended().data(), 2 * n);
    x += (Eigen::MatrixXd::Identity(2 * n, 2 * n) - run.tangents()).fullPivLu().solve(image - x);
    system.compiled().frame().leave(x.data(), start.data());
  }
  return start;
}

TEST(classify, a_start_exactly_on_a_cycle_that_repels_is_not_taken_for_its_attractor) {
  const State stable = at(2.84).state;
  const System system(paper_model({.omega = 2.88}));  // 1-1-I has doubled at 2.846
  const State cycle = fixed_point(system, stable);
  Motion motion(system, cycle);
  while (motion.advance({1, 0.0}) == Outcome::event) {
  }
  for (std::size_t i = 0; i < cycle.size(); ++i) ASSERT_NEAR(motion.state()[i], cycle[i], 1e-12);
  EXPECT_EQ(classify(system, cycle, {.transient_periods = 0}).label, "2-2-I");
}

TEST(classify, the_returned_state_repeats_itself_without_a_transient) {
  const System system(paper_model({.omega = 4.801}));
  const Classification found = classify(system, paper_start);
  Motion motion(system, found.state);
  while (motion.advance({found.n, 0.0}) == Outcome::event) {
  }
  const State end = motion.state();
  for (std::size_t i = 0; i < end.size(); ++i) EXPECT_NEAR(end[i], found.state[i], 1e-9);
}

TEST(classify, the_multipliers_of_a_cycle_are_its_decay_seen_in_the_motion) {
  // Two routes: eigenvalues of the Jacobian, and the exponent of a tangent carried along.
  const System system(paper_model({.omega = 2.2}));
  const Classification found = classify(system, paper_start);
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Ones(4, 1);
  TangentMotion motion(system, found.state, tangent);
  double growth = 0.0;
  constexpr int periods = 20000;
  for (int k = 0; k < periods; ++k) {
    while (motion.advance({k + 1, 0.0}) == Outcome::event) {
    }
    growth += std::log(motion.tangents().norm());
    motion.set_tangents(motion.tangents().normalized());
  }
  EXPECT_NEAR(growth / periods, std::log(std::abs(found.multipliers.front())), 1e-3);
}

TEST(classify, stick_costs_a_multiplier_and_chatter_two) {
  const Classification stick = at(1.5), chatter = at(0.552);
  ASSERT_EQ(stick.multipliers.size(), 4u);
  EXPECT_LT(std::abs(stick.multipliers[3]), 1e-12);
  EXPECT_GT(std::abs(stick.multipliers[2]), 1e-3);
  EXPECT_LT(std::abs(chatter.multipliers[2]), 1e-12);
  EXPECT_GT(std::abs(chatter.multipliers[1]), 1e-3);
}

TEST(classify, a_linear_oscillator_without_contact_is_one_zero_one) {
  Model model = paper_model({.omega = 2.2});
  model.frictions.clear();
  model.stops.clear();
  const Classification found = classify(System(model), paper_start);
  EXPECT_EQ(found.label, "1-0-I");
  // Floquet multipliers of a linear system: exp(lambda T), closed form through the trace of C / M:
  // product = exp(-tr(M^-1 C) T).
  std::complex<double> product = 1.0;
  for (const auto& multiplier : found.multipliers) product *= multiplier;
  const double trace = 0.2 / 1.0 + (0.2 + 1.0) / 10.0;
  EXPECT_NEAR(product.real(), std::exp(-trace * model.forcing_period()), 1e-12);
}

TEST(classify, a_period_that_ends_on_the_closed_stop_is_not_taken_for_a_violated_one) {
  // x1 - x2 = clearance is not kept to the last bit by a state in the user's coordinates.
  for (const double clearance : {0.01, 0.03, -0.1}) {
    Model model = paper_model({.omega = 0.45, .clearance = clearance});
    model.forces[0].phase = 2.0;
    const Classification found =
        classify(System(model), {-0.5, 0, 0, 0}, {.transient_periods = 100, .most_periods = 600});
    EXPECT_EQ(found.attractor, Attractor::periodic) << clearance;
    EXPECT_EQ(found.chatter, Chatter::complete) << clearance;
  }
}

TEST(classify, a_motion_that_is_at_rest_in_the_origin_at_every_return_has_its_size_from_in_between) {
  // x = sin t - sin(2 t) / 2 is at rest in the origin at phase 0; the force is x'' + c x' + k x.
  const double c = 0.5, k = 3.0;
  Model model;
  model.name = "two harmonics";
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, k}};
  model.dampers = {{0, ground, c}};
  model.omega = 1.0;
  model.forces = {{0, 1, std::hypot(k - 1.0, c), std::atan2(c, k - 1.0)},
                  {0, 2, -std::hypot(0.5 * k - 2.0, c), std::atan2(c, 0.5 * k - 2.0)}};
  const Classification found = classify(System(model), {0.3, 0.0});
  EXPECT_EQ(found.label, "1-0-I");
  EXPECT_NEAR(found.state[0], 0.0, 1e-14);
  EXPECT_NEAR(found.state[1], 0.0, 1e-14);
}

TEST(classify, an_unforced_model_comes_to_rest) {
  Model model = paper_model({});
  model.forces.clear();
  model.omega = 0.0;
  EXPECT_EQ(classify(System(model), paper_start).attractor, Attractor::equilibrium);
}

}  // namespace
}  // namespace slapstick
