// Looking for orbits: where searches start, what they count, what a motion settles on, and which of several orbits is
// taken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "families.hpp"
#include "flow/contact_state.hpp"
#include "orbit/continuum.hpp"
#include "orbit/same_motion.hpp"
#include "orbit/starts.hpp"
#include "slapstick/attractor/classify.hpp"

namespace slapstick::test {
namespace {

using orbit::OrbitChoice;
using orbit::SpecialType;

orbit::Chosen choose(const Posed& posed, const State& state, const OrbitChoice& choice,
                     const orbit::SearchOptions& search = {}) {
  return orbit::choose(*posed.problem, posed.system, state, choice, {}, search);
}

/// The motion from there is at rest at phase 0 of every period: its states at phase 0 say nothing about how large other
/// motions are. One bounce in a period is stable all the same; its impact has w = 2 pi g / (omega (1 + r)), the flight
/// of a period being a parabola's.
TEST(Search, FindsTheBounceBesideAMotionThatRestsAtPhaseZero) {
  const Posed posed("shaken-table", {{"acceleration", 1.304}}, {}, {});
  OrbitChoice bounce;
  bounce.n = 1, bounce.p = 1;
  const auto found = choose(posed, {0.0, 0.0}, bounce).orbit;
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->stable());
  const double w = 2.0 * std::numbers::pi / 1.5;
  for (const orbit::EventOfOrbit& event : orbit::events(*posed.problem, found->orbit))
    if (event.kind == EventKind::impact) {
      EXPECT_NEAR(event.w, w, 1e-12 * w);
    }
}

/// Random states may lie behind stops; those of dependent stops cannot be mirrored one by one, and a motion that rests
/// on its stop has no mean inside.
TEST(Starts, AreAdmissibleAndFillTheRoom) {
  const auto draws = [](const std::string& model, const Overrides& values, double low, double high) {
    const Posed posed(model, values, {}, {});
    const flow::Translations translations(posed.system);
    const orbit::Starts starts(translations, Motion(posed.system, posed.start()), nullptr);
    std::mt19937 random(7);
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < 500; ++i) {
      const State state = flow::user_state(posed.system, starts.draw(random, 1.0));
      EXPECT_NO_THROW((void)Motion(posed.system, state)) << model << ": x = " << state[0];
      least = std::min(least, state[0]);
      most = std::max(most, state[0]);
    }
    EXPECT_LT(least, low) << model;
    EXPECT_GT(most, high) << model;
  };
  draws("impact-pair", {}, -0.45, 0.45);
  draws("two-sided-rattle", {}, -0.45, 0.45);
  draws("shaken-table", {{"acceleration", 0.9}}, 0.1, 1.0);  // rests for ever
  draws("coulomb-oscillator", {{"amplitude", 0.1}}, -0.1, 0.1);
  draws("vibro-impact", {}, -0.5, 0.2);
}

/// The reports of a search add up, and a deadline that is over is said.
TEST(Search, CountsWhatItTried) {
  const Posed posed("vibro-impact", {{"omega", 2.88}}, {}, {});
  orbit::SearchOptions options{.most_n = 2, .starts = 6, .periods = 60};
  const orbit::SearchResult all = orbit::search(*posed.problem, posed.system, posed.start(), options);
  const orbit::SearchReport& report = all.report;
  EXPECT_EQ(report.end, orbit::SearchEnd::all_starts);
  EXPECT_EQ(report.motions, 6);
  EXPECT_GT(report.known, 0);
  EXPECT_EQ(report.found, static_cast<long>(all.orbits.size()));
  EXPECT_EQ(report.newton_runs, report.diverged + report.known + report.shorter + report.no_motions + report.found);
  options.until = std::chrono::steady_clock::now();
  const orbit::SearchResult none = orbit::search(*posed.problem, posed.system, posed.start(), options);
  EXPECT_EQ(none.report.end, orbit::SearchEnd::time);
  EXPECT_EQ(none.report.motions, 0);
}

/// What `classify` names `orbit` finds, also close to bifurcations, where motions settle slowly: beside each special
/// point of a branch, at distances that shrink to a 1e-5 of the range, from the model's own start.
/// @returns how many of the motions are slow
int settles_as_classify_says(const std::string& model, const std::string& parameter, double present, double from,
                             double to) {
  const Posed posed(model, {}, {parameter}, {present});
  const auto first = posed.settled();
  if (!first) {
    ADD_FAILURE() << model;
    return 0;
  }
  const orbit::Branch branch = orbit::follow(*posed.problem, first->orbit, {.from = from, .to = to});
  std::mt19937 random(20);
  int slow = 0;
  for (const orbit::SpecialPoint& special : branch.special) {
    if (special.type == SpecialType::BP || special.value <= from || special.value >= to) continue;
    for (const double side : {-1.0, 1.0, -1.0, 1.0, -1.0, 1.0}) {
      const double distance = std::pow(10.0, std::uniform_real_distribution<double>(-5.0, -3.0)(random));
      const double value = special.value + side * distance * (to - from);
      const Posed beside(model, {{parameter, value}}, {}, {});
      const Classification seen = classify(beside.system, beside.start());
      if (seen.attractor != Attractor::periodic) continue;
      const orbit::Settled found = orbit::settle(*beside.problem, beside.system, beside.start());
      EXPECT_TRUE(found.orbit) << model << " at " << parameter << " = " << value << ": " << seen.label;
      if (!found.orbit) continue;
      EXPECT_EQ(found.orbit->label, seen.label) << value;
      const double slowest = std::abs(seen.multipliers.front());
      EXPECT_NEAR(std::abs(found.orbit->multipliers.front()), slowest, 1e-6) << value;
      slow += slowest > 0.99 ? 1 : 0;
    }
  }
  return slow;
}

TEST(Settling, IsOneNotionForClassifyAndOrbit) {
  const int slow = settles_as_classify_says("vibro-impact", "omega", 2.7, 2.0, 3.0) +
                   settles_as_classify_says("impact-oscillator", "clearance", 0.5, 0.1, 0.6) +
                   settles_as_classify_says("shaken-table", "acceleration", 1.2, 1.05, 1.8);
  EXPECT_GE(slow, 3) << "too few slow motions were drawn";
}

/// --orbit 1-1-II is no 1-1-I.
TEST(Choice, TellsOrbitsWithStickFromThoseWithout) {
  for (const bool sticking : {true, false}) {
    const Posed posed("coulomb-oscillator", {{"amplitude", sticking ? 0.3 : 1.0}, {"omega", sticking ? 0.2 : 0.8}}, {},
                      {});
    const auto settled = posed.settled();
    ASSERT_TRUE(settled);
    ASSERT_EQ(settled->sticking, sticking);
    OrbitChoice choice;
    choice.n = settled->orbit.shape.n, choice.p = settled->impacts, choice.sticking = sticking;
    EXPECT_TRUE(choice.admits(*posed.problem, *settled));
    choice.sticking = !sticking;
    EXPECT_FALSE(choice.admits(*posed.problem, *settled));
  }
}

/// The motion settles on the doubled orbit; the one that doubled is meant.
TEST(Choice, TakesTheUnstableOrbitThatNoMotionSettlesOn) {
  const Posed posed("vibro-impact", {{"omega", 2.88}}, {}, {});
  OrbitChoice choice;
  choice.stable = false;
  orbit::SearchOptions search;
  search.most_n = 2;
  const orbit::Chosen unstable = choose(posed, posed.start(), choice, search);
  ASSERT_TRUE(unstable.orbit);
  EXPECT_FALSE(unstable.settles);
  EXPECT_EQ(unstable.orbit->label, "1-1-I");
  EXPECT_GT(std::abs(unstable.orbit->multipliers.front()), 1.0);
  choice.stable = true;
  const orbit::Chosen stable = choose(posed, posed.start(), choice, search);
  ASSERT_TRUE(stable.orbit);
  EXPECT_TRUE(stable.settles);
  EXPECT_EQ(stable.orbit->label, "2-2-I");
}

/// Below the place where the rattle's symmetry breaks motions settle on one of two images; the symmetric orbit between
/// them is unstable.
TEST(Choice, TakesTheSymmetricOrbitAmongBrokenOnes) {
  const Posed posed("two-sided-rattle", {{"omega", 1.4}}, {}, {});
  OrbitChoice choice;
  choice.n = 1;
  const orbit::Chosen broken = choose(posed, posed.start(), choice);
  ASSERT_TRUE(broken.orbit);
  EXPECT_FALSE(orbit::symmetric(*posed.problem, broken.orbit->orbit));
  choice.symmetric = true;
  const orbit::Chosen whole = choose(posed, posed.start(), choice);
  ASSERT_TRUE(whole.orbit);
  EXPECT_FALSE(whole.orbit->stable());
  EXPECT_LT(orbit::apart_from_image(*posed.problem, whole.orbit->orbit, whole.orbit->orbit), 1e-9);
}

/// Of two images that are equally good in everything else, and of a stable and an unstable orbit, the one that the
/// state is on.
TEST(Choice, TakesTheOrbitNearestToAState) {
  const Posed posed("two-sided-rattle", {{"omega", 1.4}}, {}, {});
  const auto all = orbit::search(*posed.problem, posed.system, posed.start(), {.starts = 16, .periods = 60}).orbits;
  ASSERT_GE(all.size(), 3U);
  for (const orbit::Solution& meant : all) {
    State state = orbit::at_phase_zero(*posed.problem, meant.orbit);
    for (double& number : state) number *= 1.0 + 1e-4;
    OrbitChoice choice;
    choice.n = 1;
    choice.nearest = state;
    orbit::SearchOptions few;
    few.starts = 16, few.periods = 60;
    const auto taken = choose(posed, state, choice, few).orbit;
    ASSERT_TRUE(taken);
    EXPECT_LT(orbit::apart(*posed.problem, meant.orbit, taken->orbit), 1e-6) << meant.label;
  }
}

/// A force below friction: the mass sticks wherever it lies, |x| <= friction - amplitude. A member is the member that
/// it is, known as one of a family, and the family is one answer.
TEST(Continuum, OfAMassThatSticksAnywhereIsOneFamily) {
  const Posed posed("coulomb-oscillator", {{"amplitude", 0.1}}, {}, {});
  for (const double x : {0.05, -0.0625, 0.0}) {
    const orbit::Settled found = orbit::settle(*posed.problem, posed.system, {x, 0.0});
    ASSERT_TRUE(found.orbit);
    EXPECT_EQ(found.orbit->family, 1);
    EXPECT_FALSE(found.orbit->isolated());
    EXPECT_TRUE(found.orbit->stable());
    EXPECT_EQ(orbit::at_phase_zero(*posed.problem, found.orbit->orbit)[0], x);
  }
  const auto all = orbit::search(*posed.problem, posed.system, posed.start(), {.starts = 20, .periods = 60}).orbits;
  EXPECT_EQ(std::ranges::count_if(all, [](const auto& found) { return found.family > 0; }), 1);
}

/// A ball that loses nothing bounces at every height. The multiplier 1 is double and defective: computed, it is off by
/// 2e-8.
TEST(Continuum, OfABallWithoutLossIsAFamily) {
  const Posed posed("bouncing-ball", {{"restitution", 1.0}}, {}, {});
  const orbit::Settled found = orbit::settle(*posed.problem, posed.system, posed.start(), {.transient = 5});
  ASSERT_TRUE(found.orbit);
  EXPECT_EQ(found.orbit->family, 1);
  EXPECT_TRUE(found.orbit->stable());
  EXPECT_NEAR(found.orbit->cycle, 2.0 * std::sqrt(2.0 / 9.81), 1e-9);
}

/// Without loss and force every amplitude and every phase is a cycle of two periods of omega = 1, the oscillator's own
/// being pi + pi / 3 at every amplitude. A family over the amplitude keeps the clock: its continuum has two dimensions.
TEST(Continuum, OfAConservativeOscillatorHasAmplitudeAndPhase) {
  const Posed posed("bilinear-oscillator", {{"damping_ratio", 0.0}}, {"amplitude"}, {0.0});
  const orbit::Settled found = orbit::settle(*posed.problem, posed.system, {-0.7, 0.1});
  ASSERT_TRUE(found.orbit);
  EXPECT_EQ(found.orbit->label, "2-3-I");
  EXPECT_EQ(found.orbit->family, 2);
  const State state = orbit::at_phase_zero(*posed.problem, found.orbit->orbit);
  EXPECT_NEAR(state[0], -0.7, 1e-9);
  EXPECT_NEAR(state[1], 0.1, 1e-9);
}

/// Without it the motion is free: phases are no dimension, and the period is the oscillator's own.
TEST(Continuum, OfAFreeConservativeOscillatorHasAnAmplitude) {
  const Posed posed("bilinear-oscillator", {{"amplitude", 0.0}, {"damping_ratio", 0.0}}, {}, {});
  const Classification named = classify(posed.system, {-0.7, 0.1});
  EXPECT_EQ(named.label, "free-1-I");
  EXPECT_EQ(named.attractor, Attractor::family);
  EXPECT_EQ(named.family, 1);
  const orbit::Settled found = orbit::settle(*posed.problem, posed.system, {-0.7, 0.1});
  ASSERT_TRUE(found.orbit);
  EXPECT_EQ(found.orbit->label, "free-1-I");
  EXPECT_EQ(found.orbit->family, 1);
  for (const double period : {named.period, found.orbit->cycle})
    EXPECT_NEAR(period, 4.0 / 3.0 * std::numbers::pi, 1e-9);
  const auto events = orbit::events(*posed.problem, found.orbit->orbit);
  for (const auto& event : events)
    EXPECT_NEAR(std::abs(event.w), std::hypot(0.7, 0.1), 1e-9);  // the energy of the start
}

/// At a fold, and where a symmetry breaks, a multiplier is 1 and the equations are singular: there is one orbit all the
/// same.
TEST(Continuum, IsNotTakenForOneAtAFoldOrACrossing) {
  const auto family_at = [](const std::string& model, const std::string& parameter, double present, double from,
                            double to, SpecialType type) {
    const Posed posed(model, {}, {parameter}, {present});
    const auto first = posed.settled();
    const orbit::Branch branch = orbit::follow(*posed.problem, first.value().orbit, {.from = from, .to = to});
    const auto point = std::ranges::find(branch.special, type, &orbit::SpecialPoint::type);
    EXPECT_NE(point, branch.special.end()) << model;
    if (point == branch.special.end()) return -1;
    const std::vector<std::complex<double>> one = {1.0};
    return orbit::continuum(*posed.problem, point->solution.orbit, one);
  };
  EXPECT_EQ(family_at("two-sided-rattle", "omega", 0.8, 0.75, 1.0, SpecialType::LP), 0);
  EXPECT_EQ(family_at("two-sided-rattle", "omega", 1.6, 1.2, 1.7, SpecialType::BP), 0);
  EXPECT_EQ(family_at("stick-slip-impact", "drive", 0.9, 0.3, 2.7, SpecialType::LP), 0);
}

/// What happens in a cycle is counted by contact: the mass of Den Hartog's machine turns round twice, with a stick each
/// time where the force is small.
TEST(Solution, CountsSticksAndReversals) {
  for (const auto& [amplitude, sticks] : {std::pair(0.3, true), std::pair(1.0, false)}) {
    const Posed posed("coulomb-oscillator", {{"amplitude", amplitude}, {"omega", sticks ? 0.2 : 0.8}}, {}, {});
    const auto found = posed.settled();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->sticks + found->reversals, 2);
    EXPECT_EQ(found->sticks > 0, sticks);
    EXPECT_EQ(found->chatters, 0);
  }
  EXPECT_EQ(Posed("vibro-impact", {{"omega", 0.55}}, {}, {}).settled().value().chatters, 1);
}

/// Extremes are those of the motion in between too: the linear response has |x| <= 1 / sqrt((1 - omega^2)^2 + (2 zeta
/// omega)^2), and omega times that.
TEST(Solution, HasTheExtremesOfTheWholeCycle) {
  const double omega = 0.7, zeta = 0.05;
  const Posed posed("bilinear-oscillator", {{"omega", omega}, {"clearance", 10.0}, {"damping_ratio", zeta}}, {}, {});
  const auto found = posed.settled();
  ASSERT_TRUE(found);
  const double amplitude = 1.0 / std::hypot(1.0 - omega * omega, 2.0 * zeta * omega);
  const std::vector<orbit::Range> ranges = orbit::ranges(*posed.problem, found->orbit);
  ASSERT_EQ(ranges.size(), 2U);
  for (const auto& [range, most] : {std::pair(ranges[0], amplitude), std::pair(ranges[1], omega * amplitude)}) {
    EXPECT_NEAR(range.most, most, 1e-12 * most);
    EXPECT_NEAR(range.least, -most, 1e-12 * most);
  }
}

}  // namespace
}  // namespace slapstick::test
