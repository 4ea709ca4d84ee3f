/// Many contacts at once, on random machines: what every state must satisfy, and agreement with a scheme that has no events.
#include <gtest/gtest.h>

#include <cmath>

#include "flow/networks.hpp"
#include "flow/runs.hpp"

namespace slapstick {
namespace {

using test::NetworkShape;
using test::random_network;

double kinetic_energy(const Model& model, std::span<const double> state) {
  double energy = 0.0;
  for (int i = 0; i < model.size(); ++i)
    energy += 0.5 * model.coordinates[i].mass * state[2 * i + 1] * state[2 * i + 1];
  return energy;
}

/// The largest gap violated, and the guard of the present mode furthest below zero.
double worst_violation(const Motion& motion) {
  const System& system = motion.system();
  const Model& model = system.model();
  const State x = motion.state();
  double worst = 0.0;
  for (const Stop& stop : model.stops) {
    const double xa = stop.a == ground ? 0.0 : x[2 * stop.a], xb = stop.b == ground ? 0.0 : x[2 * stop.b];
    worst = std::max(worst, xa - xb - stop.clearance);
  }
  const mode::Mode& mode = system.mode(motion.mode_id());
  const Eigen::Map<const Eigen::VectorXd> X(motion.extended().data(), mode.size());
  for (const mode::Guard& guard : mode.guards()) worst = std::max(worst, -guard.row.dot(X));
  return worst;
}

void expect_lawful(const Model& model, long seed, long& events) {
  const System system(model);
  Motion motion(system, State(2 * model.coordinates.size(), 0.0));
  Instant last{};
  while (motion.advance({15, 0.0}) == Outcome::event) {
    ++events;
    const Event& event = motion.event();
    ASSERT_LE(last, event.time) << seed;
    last = event.time;
    ASSERT_LE(worst_violation(motion), 1e-13) << "seed " << seed << " " << name(event.kind);
    if (event.kind != EventKind::impact) continue;
    ASSERT_GT(event.w, 0.0) << seed;
    const double before = kinetic_energy(model, motion.before()), after = kinetic_energy(model, motion.state());
    ASSERT_LE(after, before * (1 + 1e-14)) << "an impact made energy, seed " << seed;
  }
}

/// Gaps open, stops push, friction within its limits, slip in its direction: the complementarity conditions, at every event.
TEST(Network, EveryEventLeavesALawfulState) {
  long events = 0;
  for (long seed = 1; seed <= 150 * testing::campaign(); ++seed)
    expect_lawful(random_network(static_cast<std::uint64_t>(seed), {}), seed, events);
  std::printf("%ld events\n", events);
  EXPECT_GT(events, 20'000);
}

TEST(Network, WithCompliantStopsToo) {
  long events = 0;
  for (long seed = 1; seed <= 80 * testing::campaign(); ++seed)
    expect_lawful(random_network(static_cast<std::uint64_t>(seed), {.compliant = true}), seed, events);
  EXPECT_GT(events, 5'000);
}

/// Impulses act between the partners of a stop only: with no stop on the ground momentum is kept.
TEST(Network, ImpactsKeepMomentum) {
  int impacts = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Model model = random_network(seed, {});
    const bool grounded =
        std::ranges::any_of(model.stops, [](const Stop& s) { return s.a == ground || s.b == ground; });
    if (model.stops.empty() || grounded) continue;
    const System system(model);
    Motion motion(system, State(2 * model.coordinates.size(), 0.0));
    while (motion.advance({10, 0.0}) == Outcome::event) {
      if (motion.event().kind != EventKind::impact) continue;
      ++impacts;
      double change = 0.0, size = 0.0;
      const State after = motion.state();
      for (int i = 0; i < model.size(); ++i) {
        const double m = model.coordinates[i].mass;
        change += m * (after[2 * i + 1] - motion.before()[2 * i + 1]);
        size += m * std::abs(after[2 * i + 1]);
      }
      ASSERT_NEAR(change, 0.0, 1e-13 * (1.0 + size)) << seed;
    }
  }
  EXPECT_GT(impacts, 500);
}

TEST(Network, CutsChangeNothing) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const System system(random_network(seed, {.compliant = true}));
    const State start(2 * static_cast<std::size_t>(system.model().size()), 0.0);
    Motion whole(system, start), cut(system, start);
    const auto expected = testing::run(whole, 5 * system.period());
    std::vector<Event> found;
    for (int k = 1; k <= 500; ++k)
      while (cut.advance(Instant{}.plus(k / 100.0)) == Outcome::event) found.push_back(cut.event());
    std::erase_if(found, [&](const Event& e) { return e.time > Instant{5, 0.0}; });
    // A cut inside the last bounces of a chatter lists them: compare the others.
    const auto plain = [](const std::vector<Event>& all) {
      std::string text;
      for (const Event& e : all)
        if (e.kind != EventKind::impact && e.kind != EventKind::slip_plus && e.kind != EventKind::slip_minus)
          text += std::string(name(e.kind)) + std::to_string(e.contact) + " ";
      return text;
    };
    EXPECT_EQ(plain(found), plain(expected)) << seed;
  }
}

/// Moreau's scheme is of first order in its step: the difference to it must vanish with the step.
TEST(Network, TimeSteppingConvergesToTheEvents) {
  int compared = 0;
  double gain = 0.0, worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Model model = random_network(seed, {.most_coordinates = 5, .most_contacts = 4, .one_friction = true});
    model.impact_law = ImpactLaw::moreau;
    const System system(model);
    Motion motion(system, State(2 * model.coordinates.size(), 0.0));
    const double T = 1.25 * system.period();
    const auto events = testing::run(motion, T);
    if (events.size() < 3) continue;
    const State exact = motion.state();
    const test::TimeStepping reference(model);
    const auto distance = [&](long steps) {
      const Eigen::VectorXd q = reference.positions(T / static_cast<double>(steps), steps);
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
