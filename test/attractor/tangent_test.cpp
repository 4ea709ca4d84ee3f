#include "slapstick/flow/tangent.hpp"

#include <gtest/gtest.h>

#include "attractor/paper_system.hpp"

namespace slapstick {
namespace {

using test::paper_model;

State end_state(const System& system, const State& start, Instant end) {
  Motion motion(system, start);
  while (motion.advance(end) == Outcome::event) {
  }
  return motion.state();
}

/// Central differences of the flow in the user's coordinates, Richardson-extrapolated: error about h^4.
Eigen::MatrixXd differences(const System& system, const State& start, Instant end, double h) {
  Eigen::MatrixXd result(4, 4);
  for (int j = 0; j < 4; ++j) {
    const auto column = [&](double step) {
      State plus = start, minus = start;
      plus[j] += step;
      minus[j] -= step;
      const State a = end_state(system, plus, end), b = end_state(system, minus, end);
      Eigen::VectorXd slope(4);
      for (int i = 0; i < 4; ++i) slope[i] = (a[i] - b[i]) / (2.0 * step);
      return slope;
    };
    result.col(j) = (4.0 * column(0.5 * h) - column(h)) / 3.0;
  }
  return result;
}

/// The tangent flow's Jacobian in the user's coordinates x1, v1, x2, v2.
Eigen::MatrixXd tangent_jacobian(const System& system, const State& start, Instant end) {
  Eigen::MatrixXd to_contact(4, 4);  // rows p1 p2 u1 u2, columns x1 v1 x2 v2
  to_contact.setZero();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) to_contact(i, 2 * j) = to_contact(2 + i, 2 * j + 1) = system.frame().W(i, j);
  }
  TangentMotion motion(system, start, to_contact);
  while (motion.advance(end) == Outcome::event) {
  }
  return to_contact.inverse() * motion.tangents();
}

struct Case {
  const char* what;
  test::PaperParameters parameters;
  State start;
  double periods;
};

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
    testing::Values(
        Case{"slip only", {.omega = 2.2}, {-0.5, 0.3, 0.02, 0.05}, 0.2},
        Case{"impact", {.omega = 2.2}, {-0.5, 0.3, 0.02, 0.05}, 0.6},
        Case{"impact and reversals", {.omega = 2.2}, {-0.5, 0.3, 0.02, 0.05}, 3.3},
        Case{"stick and release, f_k = f_s", {.omega = 1.5}, {-0.5, 0.3, 0.02, 0.05}, 2.2},
        Case{"stick and release, f_k < f_s", {.omega = 1.5, .kinetic_friction = 0.1}, {-0.5, 0.3, 0.02, 0.05}, 2.2},
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

}  // namespace
}  // namespace slapstick
