#include "slapstick/flow/tangent.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <random>

#include "attractor/jacobians.hpp"
#include "attractor/paper_system.hpp"
#include "property/machine.hpp"

namespace slapstick {
namespace {

using test::paper_model;

using test::differences;
using test::same_events;
using test::tangent_jacobian;

struct Case {
  const char* what;  ///< ends the test's name
  test::PaperParameters parameters;
  State start;
  double periods;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.what; }

class Jacobian : public testing::TestWithParam<Case> {};

TEST_P(Jacobian, matches_finite_differences_through_the_events) {
  const System system(paper_model(GetParam().parameters));
  const Instant end = Instant{}.plus(GetParam().periods);
  const Eigen::MatrixXd exact = tangent_jacobian(system, GetParam().start, end);
  const Eigen::MatrixXd numerical = differences(system, GetParam().start, end, 1e-4);
  EXPECT_LT((exact - numerical).cwiseAbs().maxCoeff(), 2e-7 * (1.0 + exact.cwiseAbs().maxCoeff())) << exact << "\n\n"
                                                                                                   << numerical;
}

INSTANTIATE_TEST_SUITE_P(
    events, Jacobian,
    testing::Values(Case{"slip only", {.omega = 2.2}, {-0.5, 0.3, 0.02, 0.05}, 0.2},
                    Case{"impact", {.omega = 2.2}, {-0.5, 0.3, 0.02, 0.05}, 0.6},
                    Case{"impact and reversals", {.omega = 2.2}, {-0.5, 0.3, 0.02, 0.05}, 3.3},
                    Case{"stick and release with f_k = f_s", {.omega = 1.5}, {-0.5, 0.3, 0.02, 0.05}, 2.2},
                    Case{"stick and release with f_k below f_s",
                         {.omega = 1.5, .kinetic_friction = 0.1},
                         {-0.5, 0.3, 0.02, 0.05},
                         2.2},
                    Case{"clearance", {.omega = 1.5, .clearance = 0.1}, {-0.5, 0.3, 0.02, 0.05}, 2.2}));

TEST(tangent, an_impact_at_the_very_start_counts) {
  const System system(paper_model({.omega = 2.2}));
  const State start = {-0.5, 0.3, 0.02, 0.05};
  Motion motion(system, start);
  while (motion.advance({5, 0.0}) == Outcome::event && motion.event().kind != EventKind::impact) {
  }
  const Instant hit = motion.event().time, end = hit.plus(0.3);
  const State before(motion.before().begin(), motion.before().end());
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(4, 4);
  const auto carried = [&](const State& from, Instant begin, Instant until, const Eigen::MatrixXd& tangents) {
    TangentMotion run(system, from, tangents, begin);
    while (run.advance(until) == Outcome::event) {
    }
    return run.tangents();
  };
  const Eigen::MatrixXd to_hit = carried(start, {}, hit.plus(-1e-10), identity);
  const Eigen::MatrixXd from_hit = carried(before, hit, end, to_hit), whole = carried(start, {}, end, identity);
  EXPECT_LT((from_hit - whole).cwiseAbs().maxCoeff(), 1e-8) << from_hit << "\n\n" << whole;
}

TEST(tangent, chatter_limit_matches_finite_differences) {
  const System system(paper_model({.omega = 0.552}));
  const State start = {-0.5, 0.3, 0.02, 0.05};  // w != 0: the flow is not differentiable where friction changes sign
  const Instant end = Instant{}.plus(0.5);
  Motion motion(system, start);
  while (motion.advance(end) == Outcome::event) {
  }
  ASSERT_EQ(system.mode_name(motion.mode_id()), "stick|closed");
  const Eigen::MatrixXd exact = tangent_jacobian(system, start, end);
  const Eigen::MatrixXd numerical = differences(system, start, end, 1e-5);
  EXPECT_LT((exact - numerical).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((exact.row(0) - exact.row(2)).cwiseAbs().maxCoeff(), 1e-14);  // the blocks move as one
}

/// A mass on a spring and a belt of speed 1/2: it slips, sticks to the belt from about t = 2.03 to 3.50, slips on.
Model mass_on_a_belt() {
  Model model;
  model.coordinates = {{"x", 1.0}};
  model.springs = {{0, ground, 1.0}};
  model.frictions = {{"belt", 0, ground, 0.5, 1.5, 1.0}};
  return model;
}

TEST(tangent, started_in_stick_loses_the_velocity_of_slip) {
  // A small velocity of slip is gone after a time proportional to it, on either side: the end state does not depend on
  // it to first order.
  for (const double belt_speed : {0.5, 0.0}) {
    Model model = mass_on_a_belt();
    model.frictions[0].belt_speed = belt_speed;
    const System system(model);
    const State start = {0.1, belt_speed};
    const Instant end = Instant{}.plus(0.7);
    Eigen::MatrixXd expected(2, 2);
    expected << 1.0, 0.0, 0.0, 0.0;
    EXPECT_LT((differences(system, start, end, 1e-6) - expected).cwiseAbs().maxCoeff(), 1e-6);
    const Eigen::MatrixXd jacobian = tangent_jacobian(system, start, end);
    EXPECT_LT((jacobian - expected).cwiseAbs().maxCoeff(), 1e-15) << "belt " << belt_speed << "\n" << jacobian;
  }
}

TEST(tangent, through_stick_on_a_moving_belt_matches_finite_differences) {
  const System system(mass_on_a_belt());
  const State start = {0.1, 0.0};
  for (const double time : {0.3, 1.0, 2.5, 5.0}) {
    const Instant end = Instant{}.plus(time);
    const Eigen::MatrixXd exact = tangent_jacobian(system, start, end);
    const Eigen::MatrixXd numerical = differences(system, start, end, 1e-4);
    EXPECT_LT((exact - numerical).cwiseAbs().maxCoeff(), 1e-9) << time << "\n" << exact << "\n\n" << numerical;
  }
}

TEST(tangent, of_random_systems_matches_finite_differences) {
  const test::Shape shape{.most_coordinates = 3,
                          .most_stops = 1,
                          .most_frictions = 1,
                          .most_compliant = 0,
                          .most_restitution = 1.0,
                          .least_gap = 1e-2,
                          .at_rest = false};
  int compared = 0, on_a_belt = 0;
  for (std::uint64_t k = 0; k < 400; ++k) {
    const test::Machine machine = test::random_machine(k, shape);
    const System system(machine.model);
    std::mt19937_64 random(k);
    const Instant end = Instant{}.plus(std::uniform_real_distribution<double>(0.3, 2.5)(random));
    constexpr double h = 2e-5;
    if (!same_events(system, machine.start, end, h)) continue;
    test::expect_equal_jacobians(system, machine.start, end, h, "case " + std::to_string(k));
    ++compared;
    const auto& frictions = system.model().frictions;
    on_a_belt += !frictions.empty() && frictions[0].belt_speed != 0.0 ? 1 : 0;
  }
  std::printf("%d systems compared, %d of them on belts\n", compared, on_a_belt);
  EXPECT_GE(compared, 200);
  EXPECT_GE(on_a_belt, 60);
}

}  // namespace
}  // namespace slapstick
