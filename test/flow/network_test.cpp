/// Many contacts at once, on random machines: agreement with a scheme that has no events. What every state must satisfy
/// is in ../property.
#include <gtest/gtest.h>

#include <cmath>

#include "flow/runs.hpp"
#include "flow/time_stepping.hpp"
#include "property/machine.hpp"

namespace slapstick {
namespace {

/// Moreau's scheme is of first order in its step: the difference to it must vanish with the step.
TEST(Network, TimeSteppingConvergesToTheEvents) {
  int compared = 0;
  double gain = 0.0, worst = 0.0;
  const test::Shape shape{.least_coordinates = 2,
                          .most_coordinates = 5,
                          .most_compliant = 0,
                          .one_restitution = true,
                          .one_friction = true,
                          .sequence = false};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const test::Machine machine = test::random_machine(seed, shape);
    const Model& model = machine.model;
    const System system(model);
    Motion motion(system, machine.start);
    const double T = 1.25 * system.period();
    const auto events = testing::run(motion, T);
    if (events.size() < 3) continue;
    const State exact = motion.state();
    const test::TimeStepping reference(model);
    const auto distance = [&](long steps) {
      const Eigen::VectorXd q = reference.positions(machine.start, T / static_cast<double>(steps), steps);
      double d = 0.0;
      for (int i = 0; i < model.size(); ++i) d = std::max(d, std::abs(q[i] - exact[2 * i]));
      return d;
    };
    const double coarse = distance(2'000), fine = distance(32'000);
    ++compared;
    gain += std::log2(coarse / fine) / 4.0;  // the order
    worst = std::max(worst, fine);
    EXPECT_LT(fine, 2e-3) << "seed " << seed << ", " << events.size() << " events";
  }
  std::printf("%d machines, mean order %.2f, worst difference at the fine step %.1e\n", compared, gain / compared,
              worst);
  EXPECT_GE(compared, 20);
  EXPECT_GT(gain / compared, 0.8);
}

}  // namespace
}  // namespace slapstick
