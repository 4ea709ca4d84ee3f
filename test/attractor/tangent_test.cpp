#include "slapstick/flow/tangent.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <random>

#include "attractor/jacobians.hpp"
#include "attractor/paper_system.hpp"

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
  // A small velocity of slip is gone after a time proportional to it, on either side: the end state does not depend on it to first order.
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

/// Chains of one to three bodies with a stop, a friction contact or both, half of them on belts.
class RandomSystem {
 public:
  explicit RandomSystem(std::uint64_t seed) : random_(seed) {}

  Model model() {
    Model m;
    const int n = integer(1, 3);
    for (int i = 0; i < n; ++i) {
      m.coordinates.push_back({"x" + std::to_string(i + 1), uniform(0.3, 3)});
      m.springs.push_back({i, i == 0 ? ground : i - 1, uniform(0.5, 3)});
      m.dampers.push_back({i, i == 0 ? ground : i - 1, uniform(0, 0.5)});
    }
    m.omega = uniform(0.5, 3);
    m.forces = {{integer(0, n - 1), 1, uniform(0.5, 2), uniform(0, 6)}};
    const int with = integer(0, 3);  // 0: friction only, 1: stop only, 2: both on one pair
    constexpr double restitutions[] = {0.0, 0.3, 0.8, 1.0};
    const auto [a, b] = pair(n);
    if (with != 0) m.stops = {{"stop", a, b, uniform(-0.2, 0.4), restitutions[integer(0, 3)]}};
    if (with == 1) return m;
    const auto [c, d] = with == 2 ? std::pair{b, a} : pair(n);
    const double f_s = uniform(0.1, 0.8);
    m.frictions = {{"friction", c, d, integer(0, 1) == 0 ? uniform(-0.4, 0.4) : 0.0, f_s, f_s * uniform(0.3, 1)}};
    return m;
  }

  State state(const Model& m) {
    for (;;) {
      State s;
      for (int i = 0; i < m.size(); ++i) s.push_back(uniform(-0.6, 0.6)), s.push_back(uniform(-1, 1));
      const auto at = [&](int i) { return i == ground ? 0.0 : s[2 * i]; };
      if (m.stops.empty() || m.stops[0].clearance - at(m.stops[0].a) + at(m.stops[0].b) > 1e-2) return s;
    }
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  std::pair<int, int> pair(int n) {
    int a = integer(0, n - 1), b = integer(-1, n - 1);
    if (a == b) b = ground;
    if (integer(0, 1) == 0) std::swap(a, b);
    return {a, b};
  }

  std::mt19937_64 random_;
};

TEST(tangent, of_random_systems_matches_finite_differences) {
  int compared = 0, on_a_belt = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    RandomSystem random(k);
    const System system(random.model());
    const State start = random.state(system.model());
    const Instant end = Instant{}.plus(random.uniform(0.3, 2.5));
    constexpr double h = 2e-5;
    if (!same_events(system, start, end, h)) continue;
    test::expect_equal_jacobians(system, start, end, h, "case " + std::to_string(k));
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
