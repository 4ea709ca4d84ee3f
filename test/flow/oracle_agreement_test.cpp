/// The engine against the independent 50-digit solution: every segment on its own, and whole runs.
#include <gtest/gtest.h>

#include "flow/engine.hpp"
#include "flow/oracle_runs.hpp"
#include "oracle/models.hpp"

namespace slapstick {
namespace {

using oracle::Real;
using testing::Comparison;

/// The oracle's start moved on by `s` in 50 digits, within its mode and without looking for events.
void move_on(const Model& model, oracle::SegmentStart& start, const Real& s) {
  const oracle::Mechanics mechanics(model);
  oracle::Vector x, v;
  for (std::size_t i = 0; i < start.state.size(); i += 2) x.push_back(start.state[i]), v.push_back(start.state[i + 1]);
  Real t = start.phase_fraction * mechanics.period();
  const Real step = std::min<Real>(s, mechanics.longest_step());
  const oracle::Jet jet = mechanics.expand(start.mode, x, v, t, step, mechanics.order(step));
  for (std::size_t i = 0; i < x.size(); ++i) {
    start.state[2 * i] = oracle::evaluate(jet.x[i], Real(1));
    start.state[2 * i + 1] = oracle::evaluate(jet.v[i], Real(1));
  }
  start.phase_fraction = (t + step) / mechanics.period();
  start.no_slip = start.touching = false;
}

/// The exact event of a segment. Just after a release the pair's acceleration is zero within rounding: its sign means
/// nothing to digits that the engine's state does not have, so the oracle starts a thousandth later.
std::optional<oracle::OracleEvent> exact_event(const Model& model, const System& system, const Motion& motion,
                                               bool after_release) {
  const Motion::Segment segment = motion.segment();
  oracle::SegmentStart start =
      testing::oracle_start(system, motion.engine().extended_at_start().data(), segment.mode, segment.start.fraction);
  Real moved = 0;
  if (after_release) {
    moved = std::min<Real>(Real(segment.duration) / 1000, oracle::Mechanics(model).longest_step());
    move_on(model, start, moved);
  }
  auto exact = oracle::first_event(model, start, Real(2 * segment.duration + 1e-9));
  if (exact) exact->time += moved;
  return exact;
}

/// Every segment of a run, started in the oracle from the engine's own state: the largest relative error of a duration.
double worst_segment(const Model& model, const State& start, long events) {
  const System system(model);
  Motion motion(system, start);
  double worst = 0.0;
  bool after_release = true;
  for (long n = 0; n < events; ++n) {
    if (motion.advance(testing::after(motion, 1e6)) != Outcome::event) break;
    const Motion::Segment segment = motion.segment();
    const std::string kind(name(motion.event().kind));
    const bool skipped = kind == "chatter" || segment.duration == 0.0 || motion.event().time == segment.start;
    if (!skipped) {
      const auto exact = exact_event(model, system, motion, after_release);
      if (!exact) {
        ADD_FAILURE() << "event " << n << ", " << kind << ": the oracle sees none in "
                      << system.mode_name(segment.mode);
        return worst;
      }
      EXPECT_EQ(exact->kind, kind) << "event " << n;
      const double error = abs(Real(segment.duration) - exact->time).convert_to<double>() / segment.duration;
      EXPECT_LE(error, 1e-13) << "event " << n << " " << exact->kind << " after " << segment.duration;
      worst = std::max(worst, error);
    }
    after_release = kind == "release" || kind == "chatter";
  }
  return worst;
}

TEST(Segment, TimesAgreeWithTheOracleTo13Digits) {
  double worst = 0.0;
  for (const double omega : {0.552, 1.5, 2.2, 4.801, 4.9})
    worst = std::max(worst, worst_segment(oracle::vibro_impact(omega), {-0.5, 0, 0, 0}, 250));
  std::printf("largest relative error of a segment: %.2e\n", worst);
}

TEST(Segment, OfSystemsWithContactsOnDifferentPairs) {
  Model m = oracle::vibro_impact(1.3);
  m.frictions[0] = {"floor", 1, ground, 0.0, 0.25, 0.125};
  worst_segment(m, {-0.5, 0, 0, 0}, 120);
  m.frictions[0].belt_speed = 0.25;
  worst_segment(m, {-0.5, 0, 0, 0}, 120);
  m.stops[0] = {"wall", 0, ground, 0.25, 0.5};
  worst_segment(m, {-0.5, 0, 0, 0}, 120);
}

class WholeRun : public ::testing::TestWithParam<double> {};

TEST_P(WholeRun, TwentyPeriodsAgreeWithTheOracleTo11Digits) {
  const Model model = oracle::vibro_impact(GetParam());
  const System system(model);
  Motion motion(system, {-0.5, 0, 0, 0});
  oracle::Oracle exact(model, {-0.5, 0.0, 0.0, 0.0});
  const double time = 20 * system.period();
  const Comparison c = testing::compare(testing::engine_events(motion, time), testing::oracle_events(exact, time));
  EXPECT_EQ(c.mismatch, "");
  EXPECT_GT(c.events, 20u);
  EXPECT_LE(c.worst, 1e-11);
  const oracle::Vector end = exact.state();
  const State state = motion.state();
  double worst_state = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    worst_state = std::max(worst_state, abs(Real(state[i]) - end[i]).convert_to<double>());
  EXPECT_LE(worst_state, 1e-11);
  std::printf("omega %g: %zu events, largest error of a time %.2e, of the final state %.2e\n", GetParam(), c.events,
              c.worst, worst_state);
}

INSTANTIATE_TEST_SUITE_P(Omega, WholeRun, ::testing::Values(0.552, 1.5, 2.2, 4.9));

}  // namespace
}  // namespace slapstick
