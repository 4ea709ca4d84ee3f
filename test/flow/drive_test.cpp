/// Frequencies beside that of the forcing, signals, and bands: against closed forms, and against the same motion
/// written in another way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runs.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/run_up.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::testing {
namespace {

using std::numbers::pi;

const std::string mass = "[[coordinate]]\nname = 'x'\nmass = 1\n";
const std::string spring = "[[spring]]\nbetween = ['x', 'ground']\nstiffness = 1\n";

Model built(const std::string& text) { return ModelDefinition::parse("name = 'm'\n" + text, "f.toml").build(); }

std::string signal(const std::string& points, const std::string& more = "") {
  return "[[signal]]\nname = 's'\npoints = " + points + "\n" + more +
         "[[force]]\non = 'x'\nsignal = 's'\namplitude = 1\n";
}

/// As run, without the knots.
std::vector<Event> run_without_knots(Motion& motion, double time) {
  std::vector<Event> events;
  for (const Event& event : run(motion, time))
    if (event.kind != EventKind::knot) events.push_back(event);
  return events;
}

/// The paper's system shaken by a frequency of its own, on a clock that knows nothing of it, is the paper's system.
TEST(Tone, AFrequencyOfItsOwnIsTheSameForceAsAHarmonic) {
  Model harmonic = load_model("vibro-impact").build({{"omega", 1.5}}), tone = harmonic;
  const double omega = harmonic.omega;
  for (Force& force : tone.forces) {
    ASSERT_EQ(force.harmonic, 1);
    force.harmonic = 0;
    force.frequency = omega;
  }
  tone.omega = 0.0;
  EXPECT_FALSE(tone.periodic());
  EXPECT_EQ(tone.forcing_period(), 1.0);
  const State start = load_model("vibro-impact").start();
  const System one(harmonic), other(tone);
  Motion a(one, start), b(other, start);
  const std::vector<Event> expected = run(a, 200.0), events = run(b, 200.0);
  ASSERT_EQ(kinds(events), kinds(expected));
  ASSERT_GT(events.size(), 100U);
  for (std::size_t i = 0; i < events.size(); ++i)
    EXPECT_NEAR(seconds(events[i], b), seconds(expected[i], a), 1e-11) << i;
}

/// x'' + 2 z x' + x = sin t + sin(w t), w = sqrt 2, long after the start: each force has its own response. Phases of
/// 1e6 periods are 9e6 turns; a phase that drifted by one rounding of the sum a period would be off by 1e-10.
TEST(Tone, TwoFrequenciesDoNotDriftOverAMillionPeriods) {
  const Model model = built("omega = 1\n" + mass + spring +
                            "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.2\n"
                            "[[force]]\non = 'x'\namplitude = 1\n[[force]]\non = 'x'\namplitude = 1\nfrequency = "
                            "'sqrt(2)'\nphase = 0.3\n");
  const System system(model);
  Motion motion(system, {0.0, 0.0});
  const Instant end{1'000'000, 0.25};
  while (motion.advance(end) == Outcome::event) {
  }
  const auto response = [](double w, long double angle) {
    const double real = 1.0 - w * w, imaginary = 0.2 * w, size = std::hypot(real, imaginary);
    return std::sin(static_cast<double>(angle) - std::atan2(imaginary, real)) / size;
  };
  // The turns that the clock counts: w T / 2 pi periods, w T / 2 pi a double.
  const double frequency = std::sqrt(2.0), turns = frequency * model.forcing_period() / (2.0 * pi);
  const auto split = static_cast<double>(static_cast<float>(turns));
  const double rest = std::fmod(split * 1'000'000.25, 1.0) + (turns - split) * 1'000'000.25;  // both products exact
  const double expected = response(1.0, pi / 2) + response(frequency, 2.0 * pi * rest + 0.3);
  EXPECT_NEAR(motion.state()[0], expected, 2e-14);
}

/// x'' + x = s(t) from rest: every change of the slope at t_i adds (t - t_i) - sin(t - t_i).
TEST(Signal, StraightLinesAreSolvedExactly) {
  const System system(built(mass + spring + signal("[[0, 0], [1.5, 3], [2.25, -1], [7, 0.5]]")));
  Motion motion(system, {0.0, 0.0});
  const std::vector<Event> events = run(motion, 11.0);
  EXPECT_EQ(kinds(events), "knot knot knot");
  EXPECT_NEAR(seconds(events[1], motion), 2.25, 1e-15);
  const double slopes[] = {2.0, -4.0 / 0.75, 1.5 / 4.75, 0.0}, knots[] = {0.0, 1.5, 2.25, 7.0};
  double expected = 0.0, before = 0.0;
  for (int i = 0; i < 4; ++i) {
    expected += (slopes[i] - before) * ((11.0 - knots[i]) - std::sin(11.0 - knots[i]));
    before = slopes[i];
  }
  EXPECT_NEAR(motion.state()[0], expected, 1e-13);
}

/// The force rises by 0.4 a unit of time; at static friction 0.5 the mass is let go.
TEST(Signal, ReleasesWhereItsForceReachesFriction) {
  const System system(built(mass + spring +
                            "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.5\nkinetic = 0.3\n" +
                            signal("[[0, 0], [10, 4]]")));
  Motion motion(system, {0.0, 0.0});
  const std::vector<Event> events = run(motion, 2.0);
  ASSERT_EQ(kinds(events), "release");
  EXPECT_NEAR(seconds(events[0], motion), 1.25, 1e-15);
  // x'' + x = 0.2 + 0.4 s from then on
  const double s = 0.75;
  EXPECT_NEAR(motion.state()[0], 0.2 * (1.0 - std::cos(s)) + 0.4 * (s - std::sin(s)), 1e-15);
}

/// A step is two motions, one after the other: it lets a contact go at its instant, and is no event of a stop that it
/// presses.
TEST(Signal, StepsAtItsInstant) {
  const std::string pad = "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.5\nkinetic = 0.25\n";
  const System system(built(mass + spring + pad + signal("[[0, 0.4], [1, 0.4], [1, 1.25], [3, 1.25]]")));
  Motion motion(system, {0.0, 0.0});
  const std::vector<Event> events = run(motion, 2.0);
  ASSERT_EQ(kinds(events), "knot release");
  EXPECT_EQ(seconds(events[1], motion), 1.0);
  EXPECT_NEAR(motion.state()[0], 1.0 - std::cos(1.0), 1e-15);

  const std::string wall = "[[stop]]\nname = 'w'\nbetween = ['x', 'ground']\nclearance = 0\nrestitution = 0.7\n";
  const System pressed(built(mass + wall + signal("[[0, 1], [1, 1], [1, 0.25], [2, 0.25], [2, -2], [9, -2]]")));
  Motion held(pressed, {0.0, 0.0});
  ASSERT_EQ(kinds(run(held, 4.0)), "knot knot release");
  EXPECT_NEAR(held.state()[0], -4.0, 1e-14);
}

/// A signal that ends with another value than it begins with steps between its rounds.
TEST(Signal, ThatRepeatsStepsBetweenItsRounds) {
  const System saw(built("omega = 1\n" + mass + signal("[[0, 0], [1, 1]]", "repeats = true\n")));
  Motion motion(saw, {0.0, 0.0});
  run(motion, 3.0);
  EXPECT_NEAR(motion.state()[1], 1.5, 1e-15);  // of x'' = t - floor t
  EXPECT_NEAR(motion.state()[0], 3.0 / 6.0 + 0.5 + 1.0, 1e-15);
}

/// A round of any length may end with a step: the end of a round and the start of the next are one instant. Beside a
/// frequency of its own the round is no period, and its length is no whole number of the clock's.
TEST(Signal, ThatRepeatsMayEndARoundWithAStep) {
  const std::string points = "[[0.1, 0.25], [0.83, 1], [0.83, 0.25]]";
  const std::string tone = "[[force]]\non = 'x'\nfrequency = 1.7\namplitude = 0.1\n";
  const System saw(built(mass + tone + signal(points, "repeats = true\n")));
  ASSERT_FALSE(saw.model().periodic());
  Motion motion(saw, {0.0, 0.0});
  const std::vector<Event> events = run(motion, 0.1 + 500.5 * 0.73);
  EXPECT_EQ(std::count_if(events.begin(), events.end(), [](const Event& e) { return e.kind == EventKind::knot; }), 501);
  EXPECT_EQ(static_cast<long>(events.size()), 501);
}

/// Rounds of a signal that repeats are what is written out, and knots fall where they fall.
TEST(Signal, ThatRepeatsGoesOnAsWrittenOut) {
  std::string points = "[";
  for (int round = 0; round < 30; ++round)
    for (const auto& [time, value] : {std::pair(0.0, 0.2), std::pair(0.7, 1.0), std::pair(0.9, -0.4)})
      points += "[" + std::to_string(1.3 * round + time) + ", " + std::to_string(value) + "], ";
  const std::string stop = "[[stop]]\nname = 'w'\nbetween = ['x', 'ground']\nclearance = 0.3\nrestitution = 0.7\n";
  const System repeated(
      built(mass + spring + stop + signal("[[0, 0.2], [0.7, 1], [0.9, -0.4], [1.3, 0.2]]", "repeats = true\n")));
  const System written(built(mass + spring + stop + signal(points + "[39, 0.2]]")));
  Motion a(repeated, {0.0, 0.0}), b(written, {0.0, 0.0});
  const std::vector<Event> one = run(a, 38.0), other = run(b, 38.0);
  ASSERT_EQ(kinds(one), kinds(other));
  ASSERT_GT(one.size(), 100U);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(seconds(one[i], a), seconds(other[i], b), 1e-11) << i;
  EXPECT_NEAR(a.state()[1], b.state()[1], 1e-10);
}

/// Rounds go on before the first point: points a whole round later are the same signal, and from t = 0 to 1 the
/// triangle below rises from 0 to 1.
TEST(Signal, ThatRepeatsDoesSoBeforeItsFirstPoint) {
  const System late(built(mass + signal("[[1, 1], [2, 0], [3, 1]]", "repeats = true\n")));
  const System early(built(mass + signal("[[-1, 1], [0, 0], [1, 1]]", "repeats = true\n")));
  Motion a(late, {0.0, 0.0}), b(early, {0.0, 0.0});
  (void)run(a, 1.0);
  (void)run(b, 1.0);
  EXPECT_NEAR(a.state()[1], 0.5, 1e-15);
  EXPECT_EQ(a.state(), b.state());
}

TEST(Signal, CutsChangeNoBit) {
  const System system(built("omega = 1.3\n" + mass + spring +
                            "[[stop]]\nname = 'w'\nbetween = ['x', 'ground']\nclearance = 0.3\nrestitution = 0.5\n"
                            "[[force]]\non = 'x'\namplitude = 0.4\nfrequency = 0.77\n" +
                            signal("[[0, 0], [0.4, 1], [1.1, -1], [1.7, 0]]", "repeats = true\n")));
  Motion whole(system, {0.0, 0.1}), cut(system, {0.0, 0.1});
  const Instant end{20, 0.0};
  while (whole.advance(end) == Outcome::event) {
  }
  for (Instant at; at < end;) {
    at = std::min(at.plus(0.0371), end);
    while (cut.advance(at) == Outcome::event) {
    }
  }
  EXPECT_EQ(whole.state(), cut.state());
  EXPECT_EQ(whole.counters().events, cut.counters().events);
}

/// A damper stands on a base whose speed jumps from 0.1 to 2 at t = 1: its force jumps from 0.05 to 1, above friction.
TEST(Signal, ABaseWhoseSpeedJumpsLetsGoAtTheKnot) {
  const System system(built("[[signal]]\nname = 's'\npoints = [[0, 0], [1, 0.1], [3, 4.1]]\n" + mass +
                            "[[base]]\nname = 'b'\nsignal = 's'\n[[damper]]\nbetween = ['x', 'b']\ncoefficient = 0.5\n"
                            "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 0.2\n"));
  Motion motion(system, {0.0, 0.0});
  const std::vector<Event> events = run_without_knots(motion, 2.0);
  ASSERT_LE(events.size(), 1U);
  // v' = 0.5 (2 - v) - 0.2 from rest: v = 1.6 (1 - exp(-s / 2))
  EXPECT_NEAR(motion.state()[1], 1.6 * (1.0 - std::exp(-0.5)), 1e-14);
}

/// A ball that comes to rest by infinitely many bounces does so at the same instant where a signal of nothing has its
/// knots in between; a knot after which the ball is lifted comes first.
TEST(Signal, KnotsInAChatterAreKnotsInAChatter) {
  const std::string ball = mass +
                           "[[force]]\non = 'x'\nharmonic = 0\namplitude = -1\n"
                           "[[stop]]\nname = 'floor'\nbetween = ['ground', 'x']\nclearance = 0\nrestitution = 0.5\n";
  const System plain(built(ball)), knots(built(ball + signal("[[0, 0], [1, 0], [3.99, 0], [3.999, 0], [9, 0]]")));
  Motion a(plain, {0.5, 0.0}), b(knots, {0.5, 0.0});
  const std::vector<Event> expected = run(a, 8.0), events = run_without_knots(b, 8.0);
  ASSERT_EQ(expected.back().kind, EventKind::chatter);
  ASSERT_EQ(events.back().kind, EventKind::chatter);
  EXPECT_NEAR(seconds(events.back(), b), seconds(expected.back(), a), 1e-13);
  EXPECT_NEAR(seconds(expected.back(), a), 3.0, 1e-14);  // 1 + 2 (1/2 + 1/4 + ..)
}

/// A ramp of 2e-8 stands for a step: friction 150 stops the mass that 100 pushes at t = 0.4, long before the step.
TEST(Signal, ThatIsSteepElsewhereDoesNotHideEventsWhereItIsFlat) {
  const System system(built(mass + signal("[[0.5, 100], [0.50000002, 0]]") +
                            "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 150\n"));
  Motion motion(system, {0.0, 20.0});
  const std::vector<Event> events = run_without_knots(motion, 2.0);
  ASSERT_EQ(kinds(events), "stick");
  EXPECT_NEAR(seconds(events[0], motion), 0.4, 1e-15);
  EXPECT_NEAR(motion.state()[0], 4.0, 1e-14);
}

/// Behind a step of 100 the mass moves on at 1e-6, against a friction of 1: it stops after 1e-6.
TEST(Signal, ThatWasSteepDoesNotStopASlowMotion) {
  const System system(built(mass + signal("[[0.25, 100], [0.25000002, 0]]") +
                            "[[force]]\non = 'x'\nharmonic = 0\namplitude = -100\n"
                            "[[friction]]\nname = 'pad'\nbetween = ['x', 'ground']\nstatic = 200\nkinetic = 1\n"));
  Motion motion(system, {0.0, 0.25 + 3e-6});
  const std::vector<Event> events = run_without_knots(motion, 1.0);
  ASSERT_EQ(kinds(events), "stick");
  // v = 3e-6 at the step, whose ramp takes 100 * 2e-8 / 2 + 2e-8; then v' = -101
  EXPECT_NEAR(seconds(events[0], motion), 0.25 + 2e-8 + (3e-6 - 1.02e-6) / 101.0, 1e-14);
}

/// The exponents of a linear oscillator do not depend on what drives it.
TEST(Signal, TangentsPassKnotsUnchanged) {
  const System system(built(mass + spring + "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.2\n" +
                            signal("[[0, 0], [0.4, 1], [1.1, -1], [1.7, 0]]", "repeats = true\n")));
  const LyapunovExponents found = lyapunov(system, {0.0, 0.0}, {.transient_periods = 10, .most_periods = 500});
  ASSERT_EQ(found.per_period.size(), 2U);
  EXPECT_NEAR(found.per_period[0], -0.1 * 1.7, 1e-2);
  EXPECT_NEAR(found.sum, -0.2 * 1.7, 1e-12);  // per round
  EXPECT_TRUE(found.sum_rule_holds());
}

TEST(Band, HasTheRootMeanSquareThatIsAskedForAndPhasesFromItsSeed) {
  const auto band = [](const std::string& more) {
    return built("omega = 0.5\n" + mass + "[[force]]\non = 'x'\nband = { from = 10, to = 40, rms = 0.7" + more + " }\n")
        .forces;
  };
  const std::vector<Force> all = band(""), nine = band(", lines = 9"), other = band(", lines = 9, seed = 4");
  ASSERT_EQ(all.size(), 31U);
  ASSERT_EQ(nine.size(), 9U);
  double square = 0.0;
  for (const Force& force : nine) square += 0.5 * force.amplitude * force.amplitude;
  EXPECT_NEAR(square, 0.49, 1e-15);
  EXPECT_EQ(nine.front().harmonic, 10);
  EXPECT_EQ(nine.back().harmonic, 40);
  EXPECT_EQ(nine[0].phase, band(", lines = 9")[0].phase);
  EXPECT_NE(nine[0].phase, other[0].phase);
}

/// x'' + 0.2 x' + x = sin w t: at each value the motion is that of a run that starts in the same state at phase 0.
TEST(RunUp, EveryStepStartsWhereTheLastOneEnded) {
  const auto model = [](double omega) {
    return ModelDefinition::parse("name = 'm'\nomega = 'w'\n[parameters]\nw = 1\n" + mass + spring +
                                      "[[damper]]\nbetween = ['x', 'ground']\ncoefficient = 0.2\n"
                                      "[[force]]\non = 'x'\namplitude = 1\n",
                                  "f.toml")
        .build({{"w", omega}});
  };
  RunUp run(model, {.from = 0.5, .to = 1.5, .steps = 11, .hold = 3}, {0.1, 0.0});
  State state{0.1, 0.0};
  double time = 0.0;
  long steps = 0;
  for (; run.next(); ++steps) {
    EXPECT_NEAR(run.value(), 0.5 + 0.1 * static_cast<double>(steps), 1e-15);
    EXPECT_NEAR(run.time({}), time, 1e-12);
    EXPECT_EQ(run.motion().state(), state);
    while (run.motion().advance(run.end()) == Outcome::event) {
    }
    state = run.motion().state();
    time += 3.0 * 2.0 * pi / run.value();
  }
  EXPECT_EQ(steps, 11);
  EXPECT_EQ(run.value(), 1.5);
}

/// From 0.5 to 4 in equal ratios: w_k = 2^(k - 1), and one period at each is 2 pi (2 + 1 + 1/2 + 1/4).
TEST(RunUp, ALogarithmicOneHasAsManyValuesInEachOctave) {
  const auto model = [](double omega) {
    return ModelDefinition::parse("name = 'm'\nomega = 'w'\n[parameters]\nw = 1\n" + mass + spring +
                                      "[[force]]\non = 'x'\namplitude = 1\n",
                                  "f.toml")
        .build({{"w", omega}});
  };
  RunUp run(model, {.from = 0.5, .to = 4.0, .steps = 4, .hold = 1, .logarithmic = true}, {0.0, 0.0});
  for (double value = 0.5; run.next(); value *= 2.0) {
    EXPECT_NEAR(run.value(), value, 1e-15 * value);
    while (run.motion().advance(run.end()) == Outcome::event) {
    }
  }
  EXPECT_EQ(run.value(), 4.0);
  EXPECT_NEAR(run.time({}), 2.0 * pi * 3.75, 1e-13);
  EXPECT_THROW(RunUp(model, {.from = -1.0, .to = 4.0, .steps = 4, .hold = 1, .logarithmic = true}, {0.0, 0.0}),
               InputError);
}

/// A parameter that does nothing climbs: the motion under a tone and a signal, with impacts, is the one without steps.
TEST(RunUp, TonesAndSignalsGoOnThroughTheSteps) {
  const Model model = built("omega = 1.3\n" + mass + spring +
                            "[[stop]]\nname = 'w'\nbetween = ['x', 'ground']\nclearance = 0.3\nrestitution = 0.5\n"
                            "[[force]]\non = 'x'\namplitude = 0.4\nfrequency = 0.77\nphase = 0.4\n"
                            "[[force]]\non = 'x'\namplitude = 0.3\n" +
                            signal("[[0.2, 0], [7.1, 1], [21.7, -1], [28, 0]]"));
  const System system(model);
  Motion whole(system, {0.1, 0.0});
  std::vector<double> expected, times;
  while (whole.advance({20, 0.0}) == Outcome::event) expected.push_back(whole.event().time.seconds(system.period()));
  RunUp run([&](double) { return model; }, {.from = 1.0, .to = 2.0, .steps = 10, .hold = 2}, {0.1, 0.0});
  while (run.next())
    while (run.motion().advance(run.end()) == Outcome::event) times.push_back(run.time(run.motion().event().time));
  ASSERT_EQ(times.size(), expected.size());
  ASSERT_GT(times.size(), 20U);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 1e-11) << i;
  EXPECT_NEAR(run.motion().state()[0], whole.state()[0], 1e-11);
}

/// The frequency of a force on a free mass climbs, v' = sin(phase), phase' = w: over each step v changes by
/// (cos(phase before) - cos(phase behind)) / w.
TEST(RunUp, ATonesPhaseIsContinuousWhereItsFrequencyClimbs) {
  const auto model = [](double frequency) {
    return ModelDefinition::parse("name = 'm'\n[parameters]\nw = 1\n" + mass +
                                      "[[force]]\non = 'x'\namplitude = 1\nfrequency = 'w'\nphase = 0.2\n",
                                  "f.toml")
        .build({{"w", frequency}});
  };
  RunUp run(model, {.from = 0.5, .to = 3.5, .steps = 13, .hold = 4}, {0.0, 0.0});
  double phase = 0.2, v = 0.0;
  while (run.next()) {
    while (run.motion().advance(run.end()) == Outcome::event) {
    }
    const double next = phase + 4.0 * run.value();
    v += (std::cos(phase) - std::cos(next)) / run.value();
    phase = next;
    EXPECT_NEAR(run.motion().state()[1], v, 1e-13) << run.value();
  }
}

TEST(Drive, WhatNeedsAPeriodSaysThatThereIsNone) {
  const System system(
      built("omega = 1\n" + mass + spring +
            "[[force]]\non = 'x'\namplitude = 1\n[[force]]\non = 'x'\namplitude = 1\nfrequency = 1.7\n"));
  try {
    (void)classify(system, {0.0, 0.0});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a frequency beside its forcing"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace slapstick::testing
