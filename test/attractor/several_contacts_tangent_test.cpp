#include <gtest/gtest.h>

#include <random>

#include "attractor/jacobians.hpp"
#include "attractor/paper_system.hpp"
#include "flow/compiled_system.hpp"
#include "property/machine.hpp"

namespace slapstick {
namespace {

using test::kinds;
using test::same_events;
using test::tangent_jacobian;

/// A ball flies at two that rest on each other and on a wall, pressed by a spring each: one blow goes through all
/// contacts.
Model cradle(ImpactLaw law) {
  Model m;
  m.coordinates = {{"ball", 1.0}, {"middle", 1.5}, {"last", 0.7}};
  m.springs = {{0, ground, 0.3}, {1, ground, 0.8}, {2, ground, 1.2}};
  m.forces = {{1, 0, 0.5, 0.0}, {2, 0, 0.4, 0.0}, {0, 1, 0.3, 0.2}};
  m.omega = 1.7;
  m.stops = {{"blow", 0, 1, 0.0, 0.6}, {"middle", 1, 2, 0.0, 0.5}, {"wall", 2, ground, 0.0, 0.4}};
  m.impact_law = law;
  return m;
}

class Cradle : public ::testing::TestWithParam<ImpactLaw> {};

TEST_P(Cradle, a_blow_that_goes_through_resting_contacts_is_one_reset) {
  const System system(cradle(GetParam()));
  const State start = {-0.5, 1.0, 0.0, 0.0, 0.0, 0.0};
  const Instant end = Instant{}.plus(0.2);
  Motion motion(system, start);
  int impacts = 0;
  while (motion.advance(end) == Outcome::event && motion.time() < end)
    impacts += motion.event().kind == EventKind::impact;
  EXPECT_GE(impacts, GetParam() == ImpactLaw::sequence ? 3 : 1) << kinds(system, start, end);
  const Eigen::MatrixXd exact = tangent_jacobian(system, start, end);
  const double h = 1e-5;
  for (Eigen::Index j = 0; j < 2; ++j) {  // the others rest: moved, they would not
    const auto column = [&](double step) {
      State plus = start, minus = start;
      plus[j] += step;
      minus[j] -= step;
      const State a = test::end_state(system, plus, end), b = test::end_state(system, minus, end);
      Eigen::VectorXd slope(6);
      for (Eigen::Index i = 0; i < 6; ++i) slope[i] = (a[i] - b[i]) / (2.0 * step);
      return slope;
    };
    const Eigen::VectorXd numerical = (4.0 * column(0.5 * h) - column(h)) / 3.0;
    EXPECT_LT((exact.col(j) - numerical).cwiseAbs().maxCoeff(), 1e-8) << exact.col(j).transpose() << "\n"
                                                                      << numerical.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(law, Cradle, ::testing::Values(ImpactLaw::sequence, ImpactLaw::moreau));

/// Two copies of a model as one, that do not touch each other.
Model twice(const Model& one) {
  Model two = one;
  const int n = one.size();
  const auto moved = [n](int i) { return i == ground ? ground : i + n; };
  for (Coordinate c : one.coordinates) c.name += "_2", two.coordinates.push_back(c);
  for (Spring s : one.springs) s.a = moved(s.a), s.b = moved(s.b), two.springs.push_back(s);
  for (Damper s : one.dampers) s.a = moved(s.a), s.b = moved(s.b), two.dampers.push_back(s);
  for (Force f : one.forces) f.coordinate = moved(f.coordinate), two.forces.push_back(f);
  for (FrictionContact f : one.frictions)
    f.name += "_2", f.a = moved(f.a), f.b = moved(f.b), two.frictions.push_back(f);
  for (Stop s : one.stops) s.name += "_2", s.a = moved(s.a), s.b = moved(s.b), two.stops.push_back(s);
  return two;
}

TEST(tangent, of_a_pair_of_equal_machines_is_that_of_each) {
  for (const double omega : {2.2, 1.5, 4.9}) {
    for (const ImpactLaw law : {ImpactLaw::sequence, ImpactLaw::moreau}) {
      Model model = twice(test::paper_model({.omega = omega, .kinetic_friction = 0.1}));
      model.impact_law = law;
      const System one(test::paper_model({.omega = omega, .kinetic_friction = 0.1})), two(model);
      const State start = {-0.5, 0.3, 0.02, 0.05};
      State both = start;
      both.insert(both.end(), start.begin(), start.end());
      const Instant end = Instant{}.plus(2.2);
      const Eigen::MatrixXd single = tangent_jacobian(one, start, end), pair = tangent_jacobian(two, both, end);
      const double size = 1.0 + single.cwiseAbs().maxCoeff();
      EXPECT_LT((pair.topLeftCorner(4, 4) - single).cwiseAbs().maxCoeff(), 1e-11 * size) << omega;
      EXPECT_LT((pair.bottomRightCorner(4, 4) - single).cwiseAbs().maxCoeff(), 1e-11 * size) << omega;
      EXPECT_LT(pair.topRightCorner(4, 4).cwiseAbs().maxCoeff(), 1e-11 * size) << omega;
      EXPECT_LT(pair.bottomLeftCorner(4, 4).cwiseAbs().maxCoeff(), 1e-11 * size) << omega;
    }
  }
}

TEST(tangent, of_random_networks_matches_finite_differences) {
  const test::Shape shape{.least_coordinates = 2,
                          .most_coordinates = 5,
                          .most_stops = 3,
                          .most_frictions = 3,
                          .most_compliant = 2,
                          .least_gap = 1e-3,
                          .at_rest = false};
  int compared = 0, dependent = 0;
  for (std::uint64_t seed = 0; seed < 240; ++seed) {
    const test::Machine machine = test::random_machine(seed, shape);
    const System system(machine.model);
    std::mt19937_64 random(seed);
    const Instant end = Instant{}.plus(std::uniform_real_distribution<double>(0.3, 1.5)(random));
    constexpr double h = 2e-5;
    if (!same_events(system, machine.start, end, h)) continue;
    test::expect_equal_jacobians(system, machine.start, end, h, "seed " + std::to_string(seed));
    ++compared;
    dependent += system.compiled().frame().d > system.compiled().frame().n ? 1 : 0;
  }
  std::printf("%d networks compared, %d of them with dependent contacts\n", compared, dependent);
  EXPECT_GE(compared, 100);
  EXPECT_GE(dependent, 30);
}

}  // namespace
}  // namespace slapstick
